#include "io/missing_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

namespace etd {

namespace {

namespace fs = std::filesystem;

// The name as it was probably written: scene languages take the backslash in "textures\new" for half of a line's end.
std::string as_written(const std::string& name) {
  constexpr std::string_view kMeant = "\b\f\n\r\t", kLetters = "bfnrt";
  std::string text;
  for (const char c : name) {
    const size_t i = kMeant.find(c);
    text += i == std::string_view::npos ? std::string(1, c) : std::string{'\\', kLetters[i]};
  }
  return text;
}

// Between folders both slashes count; the letter of a drive is no folder.
std::vector<std::string> parts_of(const std::string& name) {
  std::vector<std::string> parts;
  for (size_t begin = 0; begin <= name.size();) {
    const size_t end = std::min(name.find_first_of("/\\", begin), name.size());
    const std::string part = name.substr(begin, end - begin);
    const bool drive = begin == 0 && part.size() == 2 && part[1] == ':';
    if (!part.empty() && part != "." && !drive) parts.push_back(part);
    begin = end + 1;
  }
  return parts;
}

bool same_but_case(const std::string& a, const std::string& b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [&](char x, char y) { return lower(x) == lower(y); });
}

// What the folder calls an entry of this name.
std::optional<std::string> entry_of(const fs::path& folder, const std::string& name) {
  std::error_code error;
  if (fs::exists(folder / name, error)) return name;
  constexpr int kMostEntries = 10000;
  int seen = 0;
  for (fs::directory_iterator i(folder, error), end; !error && i != end && seen < kMostEntries;
       i.increment(error), ++seen)
    if (same_but_case(i->path().filename().string(), name)) return i->path().filename().string();
  return {};
}

// The file in the folder whose path is the last of these parts, from `first` on.
std::optional<fs::path> find_file(const fs::path& folder, const std::vector<std::string>& parts, size_t first) {
  fs::path found;
  for (size_t i = first; i < parts.size(); ++i) {
    const auto entry = entry_of(folder / found, parts[i]);
    if (!entry) return {};
    found /= *entry;
  }
  std::error_code error;
  return fs::is_regular_file(folder / found, error) ? std::optional(found) : std::nullopt;
}

}  // namespace

std::string missing_file_hint(const std::vector<fs::path>& folders, const std::string& name) {
  std::error_code error;
  std::vector<std::string> places;
  for (const fs::path& folder : folders) {
    if (fs::exists(folder / name, error)) return {};
    fs::path place = (fs::current_path(error) / (folder / name).parent_path()).lexically_normal();
    if (!place.has_filename()) place = place.parent_path();
    std::string text = fmt::format("{}{}", place.string(), fs::is_directory(place, error) ? "" : " (no folder)");
    if (std::find(places.begin(), places.end(), text) == places.end()) places.push_back(std::move(text));
  }
  std::string hint = fmt::format("it was looked for in {}", fmt::join(places, " and in "));
  const std::string written = as_written(name);
  const std::vector<std::string> parts = parts_of(written);
  for (const fs::path& folder : folders)
    for (size_t first = 0; first < parts.size(); ++first)
      if (const auto found = find_file(folder, parts, first))
        return hint + fmt::format("\ndid you mean \"{}\"?", found->string());
  if (written.find('\\') != std::string::npos)
    hint += fmt::format("\nfolders are separated by slashes: \"{}\"", fmt::join(parts, "/"));
  return hint;
}

}  // namespace etd
