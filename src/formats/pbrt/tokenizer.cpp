#include "formats/pbrt/tokenizer.h"

#include <charconv>
#include <cstdlib>
#include <utility>

#include "io/decimal.h"

namespace etd::pbrt {

namespace {

bool is_space(char c) { return static_cast<unsigned char>(c) <= ' '; }
bool ends_word(char c) { return is_space(c) || c == '"' || c == '[' || c == ']' || c == '#'; }

// What a backslash and this character stand for; 0 when it is no escape.
char escaped(char c) {
  switch (c) {
    case 'b':
      return '\b';
    case 'f':
      return '\f';
    case 'n':
      return '\n';
    case 'r':
      return '\r';
    case 't':
      return '\t';
    case '\\':
    case '\'':
    case '"':
      return c;
    default:
      return 0;
  }
}

std::string_view without_plus(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  return text;
}

}  // namespace

std::string Token::value() const {
  if (kind != Kind::kString || text.find('\\') == std::string_view::npos) return std::string(text);
  std::string value;
  for (size_t i = 0; i < text.size(); ++i) {
    const char meant = text[i] == '\\' && i + 1 < text.size() ? escaped(text[i + 1]) : char{0};
    value += meant ? meant : text[i];
    if (meant) ++i;
  }
  return value;
}

Tokenizer::Tokenizer(int32_t file, Diagnostics& diagnostics)
    : text_(diagnostics.sources().text(file)), diagnostics_(diagnostics), file_(file) {}

SourceLoc Tokenizer::location(size_t begin, size_t end) const {
  return {file_, line_, static_cast<int32_t>(begin - line_start_) + 1, static_cast<int32_t>(end - begin)};
}

Token Tokenizer::token(Token::Kind kind, size_t begin, size_t end) const {
  return {kind, text_.substr(begin, end - begin), location(begin, end)};
}

void Tokenizer::skip_space() {
  for (; at_ < text_.size(); ++at_) {
    const char c = text_[at_];
    if (c == '\n') {
      ++line_;
      line_start_ = at_ + 1;
    } else if (c == '#') {
      while (at_ + 1 < text_.size() && text_[at_ + 1] != '\n') ++at_;
    } else if (!is_space(c)) {
      return;
    }
  }
}

std::optional<Token> Tokenizer::next(bool quiet) {
  skip_space();
  if (at_ >= text_.size()) return {};
  const size_t begin = at_;
  switch (text_[at_]) {
    case '"':
      return string_token(quiet);
    case '[':
      return token(Token::Kind::kOpen, begin, ++at_);
    case ']':
      return token(Token::Kind::kClose, begin, ++at_);
    default:
      break;
  }
  while (at_ < text_.size() && !ends_word(text_[at_])) ++at_;
  return token(Token::Kind::kWord, begin, at_);
}

// Read returns the end of a value, or null where it cannot say.
template <class T, class Read>
void Tokenizer::take_with(Read read, std::vector<T>& values, size_t most) {
  const char* const text = text_.data();
  const char* const end = text + text_.size();
  while (values.size() < most) {
    skip_space();
    T value;
    const char* const after = read(text + at_, end, value);
    if (!after || (after != end && !ends_word(*after))) return;
    values.push_back(value);
    at_ = static_cast<size_t>(after - text);
  }
}

void Tokenizer::take(std::vector<double>& numbers, size_t most) { take_with(read_decimal, numbers, most); }

void Tokenizer::take(std::vector<int32_t>& integers, size_t most) { take_with(read_whole, integers, most); }

Token Tokenizer::string_token(bool quiet) {
  const size_t begin = at_++;
  bool report_escapes = !quiet;
  while (at_ < text_.size() && text_[at_] != '"' && text_[at_] != '\n' && text_[at_] != '\r') {
    if (text_[at_] == '\\' && at_ + 1 < text_.size() && text_[at_ + 1] != '\n') {
      if (!escaped(text_[at_ + 1]) && std::exchange(report_escapes, false))
        diagnostics_.error(location(at_, at_ + 2), "unknown escape in a string",
                           "valid: \\b \\f \\n \\r \\t \\\\ \\' \\\"; folders are separated by /");
      ++at_;
    }
    ++at_;
  }
  const bool closed = at_ < text_.size() && text_[at_] == '"';
  Token t = token(Token::Kind::kString, begin + 1, at_);
  if (closed) ++at_;
  t.loc = location(begin, at_);
  if (!closed && !quiet)
    diagnostics_.error(t.loc, "this string is not closed", "a string ends with a \" on the line where it begins");
  return t;
}

std::optional<double> parse_number(std::string_view text) {
  text = without_plus(text);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || text.empty() || error == std::errc::invalid_argument) return {};
  // Out of range means too large or too small; the C library tells which.
  if (error == std::errc::result_out_of_range) return std::strtod(std::string(text).c_str(), nullptr);
  return value;
}

std::optional<int32_t> parse_integer(std::string_view text) {
  text = without_plus(text);
  int32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || error != std::errc()) return {};
  return value;
}

std::string number_hint(std::string_view text) {
  const bool has_digit = text.find_first_of("0123456789") != std::string_view::npos;
  if (!has_digit || text.find(',') == std::string_view::npos) return {};
  return "numbers have a point, not a comma, and only spaces between them";
}

}  // namespace etd::pbrt
