#include "formats/pbrt/token_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "formats/foreign.h"
#include "io/gzip.h"
#include "io/missing_file.h"
#include "io/text_file.h"

namespace etd::pbrt {

namespace {

namespace fs = std::filesystem;

// The bytes of a file, or why they cannot be had.
struct Bytes {
  std::string text, problem;
};

Bytes read_bytes(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return {{}, "does not exist"};
  if (fs::is_directory(path, error)) return {{}, "is a folder"};
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) return {{}, "cannot be read"};
  std::string text(static_cast<size_t>(in.tellg()), '\0');
  in.seekg(0);
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!in) return {{}, "cannot be read"};
  return {std::move(text), {}};
}

// Old Macintosh files end their lines with a carriage return alone; others are read as they are.
void with_unix_line_ends(std::string& text) {
  if (text.find('\n') == std::string::npos) std::replace(text.begin(), text.end(), '\r', '\n');
}

bool is_binary(std::string_view text) { return text.substr(0, 4096).find('\0') != std::string_view::npos; }

}  // namespace

int32_t TokenStream::push_text(std::string text, const std::string& name) {
  if (const std::string problem = strip_byte_order_mark(text); !problem.empty())
    diagnostics_.error({}, fmt::format("the file \"{}\": {}", name, problem));
  const int32_t source = diagnostics_.sources().add(name, std::move(text));
  files_.push_back({Tokenizer(source, diagnostics_), fs::path(), false});
  return source;
}

int32_t TokenStream::push_main(const fs::path& file) {
  return push_file(file, {}, false, missing_file_hint({fs::path()}, file.string()));
}

bool TokenStream::push_included(const std::string& name, const SourceLoc& loc, bool isolated) {
  const fs::path given = name;
  if (name.empty()) {
    diagnostics_.error(loc, "the name of the file is empty");
    return false;
  }
  // Names start in the folder of the scene, and where nothing is there, in that of the file that they stand in.
  std::vector<fs::path> folders = {folder_};
  if (!files_.empty() && !files_.back().path.empty()) folders.push_back(files_.back().path.parent_path());
  std::error_code error;
  const auto found =
      std::find_if(folders.begin(), folders.end(), [&](const auto& f) { return fs::exists(f / given, error); });
  const fs::path path = ((found == folders.end() ? folder_ : *found) / given).lexically_normal();
  return push_file(path, loc, isolated, missing_file_hint(folders, name)) >= 0;
}

int32_t TokenStream::push_file(const fs::path& path, const SourceLoc& loc, bool isolated, const std::string& missing) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(path, error);
  if (closes_a_loop(canonical, loc)) return -1;
  auto known = read_.find(canonical);
  if (known == read_.end()) {
    Bytes bytes = read_bytes(path);
    if (!bytes.problem.empty()) {
      diagnostics_.error(loc, fmt::format("the file \"{}\" {}", path.string(), bytes.problem), missing);
      return -1;
    }
    if (is_gzip(bytes.text)) {
      FileBytes inside = gunzip(bytes.text);
      if (!inside.error.empty()) {
        diagnostics_.error(loc, fmt::format("the file \"{}\": {}", path.string(), inside.error));
        return -1;
      }
      bytes.text = std::move(inside.bytes);
    }
    if (const std::string problem = strip_byte_order_mark(bytes.text); !problem.empty()) {
      diagnostics_.error(loc, fmt::format("the file \"{}\": {}", path.string(), problem));
      return -1;
    }
    if (const ForeignFormat foreign = find_foreign_format(bytes.text); !foreign.what.empty()) {
      diagnostics_.error(loc, fmt::format("the file \"{}\" is {}, not a pbrt scene", path.string(), foreign.what),
                         std::string(foreign.hint));
      return -1;
    }
    if (is_binary(bytes.text)) {
      diagnostics_.error(loc, fmt::format("the file \"{}\" is not text", path.string()),
                         "a pbrt scene is plain text; meshes are named in Shape \"plymesh\"");
      return -1;
    }
    with_unix_line_ends(bytes.text);
    known = read_.emplace(canonical, diagnostics_.sources().add(path.string(), std::move(bytes.text))).first;
  }
  files_.push_back({Tokenizer(known->second, diagnostics_), path, isolated});
  files_.back().tokenizer.set_quiet(quiet_);
  return known->second;
}

bool TokenStream::closes_a_loop(const fs::path& canonical, const SourceLoc& loc) {
  std::error_code error;
  for (size_t i = 0; i < files_.size(); ++i) {
    if (files_[i].path.empty() || fs::weakly_canonical(files_[i].path, error) != canonical) continue;
    std::string chain;
    for (size_t j = i; j < files_.size(); ++j) chain += files_[j].path.string() + " -> ";
    diagnostics_.error(loc, "this file includes itself", chain + files_[i].path.string());
    return true;
  }
  return false;
}

void TokenStream::pop_isolated() {
  peeked_.reset();
  while (!files_.empty() && !files_.back().isolated) files_.pop_back();
  if (!files_.empty()) files_.pop_back();
}

std::optional<Token> TokenStream::next() {
  if (peeked_) {
    const std::optional<Token> token = peeked_;
    peeked_.reset();
    return token;
  }
  while (!files_.empty()) {
    if (std::optional<Token> token = files_.back().tokenizer.next()) return token;
    if (files_.back().isolated) break;
    files_.pop_back();
  }
  return {};
}

std::optional<Token> TokenStream::peek() {
  if (!peeked_) peeked_ = next();
  return peeked_;
}

void TokenStream::set_quiet(bool quiet) {
  quiet_ = quiet;
  for (File& file : files_) file.tokenizer.set_quiet(quiet);
}

}  // namespace etd::pbrt
