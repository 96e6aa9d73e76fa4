// Cuts the text of a pbrt file into words, strings and brackets, each with its place.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "params/diagnostics.h"

namespace etd::pbrt {

struct Token {
  enum class Kind : uint8_t { kWord, kString, kOpen, kClose };
  Kind kind = Kind::kWord;
  std::string_view text;  // of a string: without the quotes, escapes as written
  SourceLoc loc;          // with the quotes

  bool is_word(std::string_view word) const { return kind == Kind::kWord && text == word; }
  // The value of a string: escapes replaced. Of any other token its text.
  std::string value() const;
};

class Tokenizer {
 public:
  // `file` is a source of `diagnostics`; its text must stay.
  Tokenizer(int32_t file, Diagnostics& diagnostics);

  // The next token, none at the end of the text. A broken string is returned as far as it goes, and reported unless
  // `quiet`: what is skipped after an error is not worth a message.
  std::optional<Token> next(bool quiet);
  // Appends the numbers that come next, up to `most` of them in all, as long as each can be read fast and nothing is
  // wrong with it: without a token, whose place costs more than the number. They are what next() would have given.
  void take(std::vector<double>& numbers, size_t most);
  void take(std::vector<int32_t>& integers, size_t most);
  int32_t file() const { return file_; }

 private:
  void skip_space();
  template <class T, class Read>
  void take_with(Read read, std::vector<T>& values, size_t most);
  Token string_token(bool quiet);
  Token token(Token::Kind kind, size_t begin, size_t end) const;
  SourceLoc location(size_t begin, size_t end) const;

  std::string_view text_;
  Diagnostics& diagnostics_;
  size_t at_ = 0, line_start_ = 0;
  int32_t file_, line_ = 1;
};

// A number as pbrt writes it ("1", "-.5", "+3e-4"); none when the text is anything else. Too large ones are infinite.
std::optional<double> parse_number(std::string_view text);
// A 32-bit integer; none when the text is anything else or out of range.
std::optional<int32_t> parse_integer(std::string_view text);
// Returns what a user may have meant by a text that is no number; may be empty.
std::string number_hint(std::string_view text);

}  // namespace etd::pbrt
