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
  push(source, {}, {}, false);
  return source;
}

int32_t TokenStream::push_main(const fs::path& file) {
  return push_file(file, {}, false, [&] { return missing_file_hint({fs::path()}, file.string()); });
}

bool TokenStream::push_included(const std::string& name, const SourceLoc& loc, bool isolated) {
  if (name.empty() || name.size() > kLongestName) {
    diagnostics_.error(loc, name.empty() ? std::string("the name of the file is empty")
                                         : fmt::format("the name of the file has {} bytes", name.size()));
    return false;
  }
  const fs::path given = name;
  // Names start in the folder of the scene, and where nothing is there, in that of the file that they stand in.
  std::vector<fs::path> folders = {folder_};
  if (!files_.empty() && !files_.back().path.empty()) folders.push_back(files_.back().path.parent_path());
  std::error_code error;
  const auto found =
      std::find_if(folders.begin(), folders.end(), [&](const auto& f) { return fs::exists(f / given, error); });
  const fs::path path = ((found == folders.end() ? folder_ : *found) / given).lexically_normal();
  return push_file(path, loc, isolated, [&] { return missing_file_hint(folders, name); }) >= 0;
}

int32_t TokenStream::push_file(const fs::path& path, const SourceLoc& loc, bool isolated,
                               const std::function<std::string()>& missing) {
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
      FileBytes inside = gunzip(bytes.text, diagnostics_.limits());
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
  } else {
    // Opening a file takes time, too.
    constexpr size_t kLeast = 4096;
    const size_t bytes = std::max(kLeast, diagnostics_.sources().text(known->second).size());
    if (!repeats.take(bytes, loc, diagnostics_)) return -1;
  }
  push(known->second, path, canonical, isolated);
  return known->second;
}

void TokenStream::push(int32_t source, fs::path path, fs::path canonical, bool isolated) {
  if (!path.empty()) open_.insert(canonical);
  files_.push_back({Tokenizer(source, diagnostics_), std::move(path), std::move(canonical), isolated});
}

void TokenStream::pop() {
  open_.erase(files_.back().canonical);
  files_.pop_back();
}

bool TokenStream::closes_a_loop(const fs::path& canonical, const SourceLoc& loc) {
  if (open_.count(canonical) == 0) return false;
  diagnostics_.error(loc, "this file includes itself", [&] {
    const auto first =
        std::find_if(files_.begin(), files_.end(), [&](const File& f) { return f.canonical == canonical; });
    std::string chain;
    for (auto file = first; file != files_.end(); ++file) chain += file->path.string() + " -> ";
    return chain + first->path.string();
  });
  return true;
}

void TokenStream::pop_isolated() {
  peeked_.reset();
  while (!files_.empty() && !files_.back().isolated) pop();
  if (!files_.empty()) pop();
}

std::optional<Token> TokenStream::next() {
  if (peeked_) {
    const std::optional<Token> token = peeked_;
    peeked_.reset();
    return token;
  }
  while (!files_.empty()) {
    if (std::optional<Token> token = files_.back().tokenizer.next(quiet_)) return token;
    if (files_.back().isolated) break;
    pop();
  }
  return {};
}

const std::optional<Token>& TokenStream::peek() {
  if (!peeked_) peeked_ = next();
  return peeked_;
}

}  // namespace etd::pbrt
