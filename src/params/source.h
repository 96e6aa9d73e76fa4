// Tells where something stands in a text that the user gave: every value read from a file keeps its place, so that a
// message can show it.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace etd {

// A span in one line of one source. Lines and columns count from 1 (columns in bytes); file -1 is "no place in a file".
struct SourceLoc {
  int32_t file = -1;
  int32_t line = 0;
  int32_t column = 0;
  int32_t length = 1;
};

// The texts that locations point into, by index. Names and texts stay where they are when others are added.
class Sources {
 public:
  // Returns the index to put into SourceLoc::file.
  int32_t add(std::string name, std::string text);
  int32_t count() const { return static_cast<int32_t>(sources_.size()); }
  const std::string& name(int32_t file) const { return sources_[static_cast<size_t>(file)].name; }
  const std::string& text(int32_t file) const { return sources_[static_cast<size_t>(file)].text; }
  // The line without its end; empty when it does not exist.
  std::string_view line(int32_t file, int32_t line) const;

 private:
  struct Source {
    std::string name, text;
    std::vector<size_t> line_starts;
  };
  std::deque<Source> sources_;
};

}  // namespace etd
