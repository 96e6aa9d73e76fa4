// A text file as lines of words, for mesh formats that are written that way (OFF, OBJ, MTL).
#pragma once

#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace etd {

// Goes through the lines that have words, whether they end in LF, CRLF or CR. A word that begins with '#' begins a
// comment (within a word it may belong to a name).
class TextLines {
 public:
  explicit TextLines(std::string_view text) : text_(text) {}

  // The words of the next line that has any, until the next call; false at the end of the text. A word that is a lone
  // backslash at the end of a line joins it with the next one when `joined` is set. Words beyond `most` are left out.
  bool next(std::vector<std::string_view>& words, bool joined = false, size_t most = SIZE_MAX);
  // Returns the number of the line read last, counted from 1.
  int line() const { return line_; }
  // Lines with words that are still to come.
  size_t count_rest() const;

 private:
  std::string_view take_line();

  std::string_view text_;
  size_t offset_ = 0;
  int line_ = 0;
};

// The words from index `from` on with one blank between them: a name that may have blanks in it.
std::string join_words(const std::vector<std::string_view>& words, size_t from);

// The number that is the whole word, as far as a double reaches ("nan" and "inf" included); nothing when it is none.
inline std::optional<double> word_to_number(std::string_view word) {
  if (word.substr(0, 1) == "+") word.remove_prefix(1);
  double value = 0;
  const auto parsed = std::from_chars(word.data(), word.data() + word.size(), value);
  if (parsed.ptr != word.data() + word.size() || parsed.ec == std::errc::invalid_argument) return {};
  // Out of range: strtod tells whether it is infinity or nearly zero.
  if (parsed.ec == std::errc::result_out_of_range) value = std::strtod(std::string(word).c_str(), nullptr);
  return value;
}

// The integer that is the whole word; nothing when it is none or does not fit.
inline std::optional<int64_t> word_to_integer(std::string_view word) {
  if (word.substr(0, 1) == "+") word.remove_prefix(1);
  int64_t value = 0;
  const auto parsed = std::from_chars(word.data(), word.data() + word.size(), value);
  if (parsed.ptr != word.data() + word.size() || parsed.ec != std::errc()) return {};
  return value;
}

}  // namespace etd
