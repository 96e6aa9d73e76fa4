#include "io/text_lines.h"

#include <algorithm>

namespace etd {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\0'; }

void split(std::string_view line, std::vector<std::string_view>& words, size_t most) {
  size_t at = 0;
  while (words.size() < most) {
    while (at < line.size() && is_blank(line[at])) ++at;
    if (at == line.size() || line[at] == '#') return;
    const size_t begin = at;
    while (at < line.size() && !is_blank(line[at])) ++at;
    words.push_back(line.substr(begin, at - begin));
  }
}

}  // namespace

std::string_view TextLines::take_line() {
  const size_t end = std::min(text_.find_first_of("\r\n", offset_), text_.size());
  const std::string_view line = text_.substr(offset_, end - offset_);
  offset_ = end + (text_.substr(end, 2) == "\r\n" ? 2 : 1);
  ++line_;
  return line;
}

bool TextLines::next(std::vector<std::string_view>& words, bool joined, size_t most) {
  words.clear();
  while (offset_ < text_.size()) {
    split(take_line(), words, most);
    if (joined && !words.empty() && words.back() == "\\")
      words.pop_back();
    else if (!words.empty())
      return true;
  }
  return !words.empty();
}

std::string join_words(const std::vector<std::string_view>& words, size_t from) {
  std::string all;
  for (size_t i = from; i < words.size(); ++i) {
    if (i > from) all += ' ';
    all += words[i];
  }
  return all;
}

size_t TextLines::count_rest() const {
  TextLines rest = *this;
  std::vector<std::string_view> words;
  size_t count = 0;
  while (rest.next(words)) ++count;
  return count;
}

}  // namespace etd
