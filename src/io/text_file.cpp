#include "io/text_file.h"

#include "io/gzip.h"

namespace etd {

namespace {

bool is_wide(std::string_view text) {
  using namespace std::string_view_literals;
  for (const std::string_view mark : {"\xff\xfe"sv, "\xfe\xff"sv, "\0\0\xfe\xff"sv})
    if (text.substr(0, mark.size()) == mark) return true;
  // Without a mark, wide text begins with a letter and a zero, in either order.
  const auto is_letter = [](char c) { return c >= '\t' && c <= '~'; };
  return text.size() > 1 && ((text[0] == 0 && is_letter(text[1])) || (is_letter(text[0]) && text[1] == 0));
}

}  // namespace

std::string strip_byte_order_mark(std::string& text) {
  if (is_wide(text)) return "it is text in UTF-16 or UTF-32; save it as UTF-8";
  if (std::string_view(text).substr(0, 3) == "\xef\xbb\xbf") text.erase(0, 3);
  return {};
}

FileBytes read_text_file(const std::filesystem::path& path, const Limits& limits) {
  FileBytes file = read_file_uncompressed(path, limits);
  if (file.error.empty()) file.error = strip_byte_order_mark(file.bytes);
  if (!file.error.empty()) file.bytes.clear();
  return file;
}

}  // namespace etd
