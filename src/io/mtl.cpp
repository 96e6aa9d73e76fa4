// The materials of an OBJ file. What cannot be understood is left at its default with a note, because meshes travel
// with material files that programs wrote carelessly.
#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>

#include "io/obj.h"
#include "io/text_file.h"
#include "io/text_lines.h"

namespace etd {

namespace {

// Ka is light that comes from nowhere, and there is none; sharpness belongs to a reflection map.
constexpr std::array<std::string_view, 3> kMeaningless = {"Ka", "map_Ka", "sharpness"};

class MtlReader {
 public:
  MtlReader(std::string_view text, std::string name, std::filesystem::path folder, ObjResult& result)
      : lines_(text), name_(std::move(name)), folder_(std::move(folder)), result_(result) {}

  void read() {
    while (lines_.next(words_)) {
      if (words_[0] == "newmtl") {
        result_.materials.emplace_back().name = join_words(words_, 1);
        inside_ = true;
      } else if (!inside_) {
        note(fmt::format("{} stands before the first newmtl", in_quotes(words_[0])));
      } else if (!statement(result_.materials.back()) &&
                 std::find(kMeaningless.begin(), kMeaningless.end(), words_[0]) == kMeaningless.end()) {
        unused_.insert(std::string(words_[0].substr(0, 40)));
      }
    }
    if (!unused_.empty()) result_.notes.push_back(fmt::format("{}: not used: {}", name_, fmt::join(unused_, ", ")));
  }

 private:
  void note(const std::string& text) {
    result_.notes.push_back(fmt::format("{}: line {}: {}", name_, lines_.line(), text));
  }

  bool statement(ObjMaterial& m) {
    const std::string_view key = words_[0];
    if (key == "Kd") return color(m.kd), true;
    if (key == "Ks") return color(m.ks), true;
    if (key == "Ke") return color(m.ke), true;
    if (key == "Ns") return number(m.ns, 0, 1e9), true;
    if (key == "Ni") return number(m.ni, 0.001, 10), true;
    if (key == "d" || key == "Tr") {
      // "d -halo x" fades towards the rim, which nothing here does.
      if (words_.size() > 1 && words_[1] == "-halo") return false;
      number(m.d, 0, 1);
      if (key == "Tr") m.d = 1 - m.d;
      return true;
    }
    if (key == "illum") {
      double model = m.illum;
      number(model, 0, 10);
      m.illum = static_cast<int>(model);
      return true;
    }
    if (key == "Pr") return number(m.pr.emplace(0.0), 0, 1), true;
    if (key == "Pm") return number(m.pm, 0, 1), true;
    if (key == "map_Kd") return map(m.map_kd), true;
    if (key == "map_d") return map(m.map_d), true;
    return false;
  }

  void number(double& to, double least, double most) {
    const auto value = words_.size() == 2 ? word_to_number(words_[1]) : std::nullopt;
    if (value && *value >= least && *value <= most)
      to = *value;
    else
      note(fmt::format("{} needs one number from {} to {}", words_[0], least, most));
  }

  // Three numbers, or one for all. "spectral" and "xyz" colours are not read.
  void color(Vec3& to) {
    const size_t count = words_.size() - 1;
    Vec3 value;
    bool good = count == 1 || count == 3;
    for (size_t i = 0; good && i < 3; ++i) {
      const auto x = word_to_number(words_[1 + (count == 3 ? i : 0)]);
      good = x && *x >= 0 && *x < 1e30;
      if (good) value[static_cast<int>(i)] = static_cast<float>(*x);
    }
    if (good)
      to = value;
    else
      note(fmt::format("{} needs three numbers that are not negative", words_[0]));
  }

  // Options, then a file name that may have blanks in it.
  void map(ObjMap& to) {
    ObjMap map;
    size_t at = 1;
    while (at + 1 < words_.size() && words_[at].size() > 1 && words_[at][0] == '-') {
      const std::string_view option = words_[at++];
      if (option == "-clamp") map.clamp = words_[at] == "on";
      Vec2* const pair = option == "-s" ? &map.scale : option == "-o" ? &map.offset : nullptr;
      if (pair || option == "-t") {
        for (int i = 0; i < 3 && at + 1 < words_.size(); ++i, ++at) {
          const auto value = word_to_number(words_[at]);
          if (!value) break;
          if (pair && i < 2) (i == 0 ? pair->x : pair->y) = static_cast<float>(*value);
        }
      } else {
        at += option == "-mm" ? 2 : 1;
      }
      if (!pair && option != "-clamp") note(fmt::format("{} {} is not used", words_[0], option));
    }
    std::string file = join_words(words_, std::min(at, words_.size()));
    std::replace(file.begin(), file.end(), '\\', '/');
    if (file.empty()) return note(fmt::format("{} names no file", words_[0]));
    map.file = folder_ / file;
    to = std::move(map);
  }

  TextLines lines_;
  std::string name_;
  std::filesystem::path folder_;
  ObjResult& result_;
  std::vector<std::string_view> words_;
  bool inside_ = false;
  std::set<std::string> unused_;
};

}  // namespace

const ObjMaterial* ObjResult::find(const std::string& name) const {
  const auto it =
      std::find_if(materials.rbegin(), materials.rend(), [&](const ObjMaterial& m) { return m.name == name; });
  return it == materials.rend() ? nullptr : &*it;
}

std::string read_mtl(const std::filesystem::path& path, const std::filesystem::path& folder, ObjResult& result) {
  const FileBytes file = read_text_file(path);
  if (file.error.empty()) MtlReader(file.bytes, path.filename().string(), folder, result).read();
  return file.error;
}

}  // namespace etd
