// The materials of an OBJ file. What cannot be understood is left at its default with a note, because meshes travel
// with material files that programs wrote carelessly.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "io/obj.h"
#include "io/text_file.h"
#include "io/text_lines.h"

namespace etd {

namespace {

// Ka is light that comes from nowhere, and there is none; sharpness belongs to a reflection map.
constexpr std::array<std::string_view, 3> kMeaningless = {"Ka", "map_Ka", "sharpness"};

// The options of maps, and how many words stand behind each.
struct MapOption {
  std::string_view name;
  size_t values;  // of -o, -s and -t at most: as many as are numbers
};
constexpr MapOption kMapOptions[] = {{"-blendu", 1}, {"-blendv", 1}, {"-bm", 1},      {"-boost", 1}, {"-cc", 1},
                                     {"-clamp", 1},  {"-halo", 0},   {"-imfchan", 1}, {"-mm", 2},    {"-o", 3},
                                     {"-s", 3},      {"-t", 3},      {"-texres", 1},  {"-type", 1}};

const MapOption* find_map_option(std::string_view word) {
  const auto* found = std::find_if(std::begin(kMapOptions), std::end(kMapOptions),
                                   [&](const MapOption& option) { return option.name == word; });
  return found == std::end(kMapOptions) ? nullptr : found;
}

class MtlReader {
 public:
  MtlReader(std::string_view text, std::string name, std::filesystem::path folder, ObjResult& result)
      : lines_(text), name_(std::move(name)), folder_(std::move(folder)), result_(result) {}

  void read() {
    while (lines_.next(words_)) {
      if (words_[0] == "newmtl") {
        const std::string name = join_words(words_, 1);
        result_.index_of[name] = result_.materials.size();
        result_.materials.emplace_back().name = name;
        inside_ = true;
        opacity_.reset(), opacity_by_tr_.reset();
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
      double value = key == "d" ? m.d : 1 - m.d;
      number(value, 0, 1);
      (key == "d" ? opacity_ : opacity_by_tr_) = key == "d" ? value : 1 - value;
      set_opacity(m);
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
    if (key == "map_Bump" || key == "map_bump" || key == "bump") return map(m.bump, true), true;
    if (key == "norm" || key == "map_norm") return map(m.normal), true;
    return false;
  }

  // Tr is 1 - d, but some programs write it as d. Of two statements that contradict each other, the one that shows more
  // counts.
  void set_opacity(ObjMaterial& m) {
    m.d = opacity_.value_or(opacity_by_tr_.value_or(1));
    constexpr double kRounded = 0.01;
    if (!opacity_ || !opacity_by_tr_ || std::abs(*opacity_ - *opacity_by_tr_) <= kRounded) return;
    m.d = std::max(*opacity_, *opacity_by_tr_);
    note(fmt::format("d {} and Tr {} contradict each other: {} has opacity {}", *opacity_, 1 - *opacity_by_tr_,
                     in_quotes(m.name), m.d));
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

  // Options and a file name that may have blanks in it, in either order: options belong first, and some programs write
  // them last.
  void map(ObjMap& to, bool is_bump = false) {
    ObjMap map;
    size_t begin = 1;
    // A word that only looks like an option can be the name when nothing follows it.
    const auto is_option = [this](size_t at) {
      return find_map_option(words_[at]) || (words_[at][0] == '-' && at + 1 < words_.size());
    };
    while (begin < words_.size() && is_option(begin)) begin = option(begin, words_.size() - 1, map, is_bump);
    size_t end = begin;
    while (end < words_.size() && (end == begin || !find_map_option(words_[end]))) ++end;
    for (size_t at = end; at < words_.size();) at = option(at, words_.size(), map, is_bump);
    words_.resize(end);
    std::string file = join_words(words_, std::min(begin, end));
    std::replace(file.begin(), file.end(), '\\', '/');
    if (file.empty()) return note(fmt::format("{} names no file", words_[0]));
    map.file = folder_ / file;
    to = std::move(map);
  }

  // Reads the option at a word, whose values end before `end`, and returns where what follows begins.
  size_t option(size_t at, size_t end, ObjMap& map, bool is_bump) {
    const std::string_view name = words_[at++];
    const MapOption* known = find_map_option(name);
    const bool vector = known && known->values == 3;
    std::vector<double> numbers;
    const size_t first = at;
    for (; at < end && at - first < (known ? known->values : 1); ++at) {
      const auto value = word_to_number(words_[at]);
      if (vector && !value) break;
      if (value) numbers.push_back(*value);
    }
    Vec2* const pair = name == "-s" ? &map.scale : name == "-o" ? &map.offset : nullptr;
    if (pair) {
      if (!numbers.empty()) pair->x = static_cast<float>(numbers[0]);
      if (numbers.size() > 1) pair->y = static_cast<float>(numbers[1]);
    } else if (name == "-clamp") {
      map.clamp = at > first && words_[first] == "on";
    } else if (name == "-bm" && is_bump) {
      if (numbers.size() == 1 && std::isfinite(static_cast<float>(numbers[0])))
        map.height = numbers[0];
      else
        note(fmt::format("{} {} needs a number", words_[0], name));
    } else {
      note(fmt::format("{} {} is not used", words_[0], name));
    }
    return at;
  }

  TextLines lines_;
  std::string name_;
  std::filesystem::path folder_;
  ObjResult& result_;
  std::vector<std::string_view> words_;
  bool inside_ = false;
  std::optional<double> opacity_, opacity_by_tr_;  // of the material, by d and by Tr
  std::set<std::string> unused_;
};

}  // namespace

const ObjMaterial* ObjResult::find(const std::string& name) const {
  const auto it = index_of.find(name);
  return it == index_of.end() ? nullptr : &materials[it->second];
}

std::string read_mtl(const std::filesystem::path& path, const std::filesystem::path& folder, const Limits& limits,
                     ObjResult& result) {
  const FileBytes file = read_text_file(path, limits);
  if (file.error.empty()) MtlReader(file.bytes, path.filename().string(), folder, result).read();
  return file.error;
}

}  // namespace etd
