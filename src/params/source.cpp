#include "params/source.h"

namespace etd {

int32_t Sources::add(std::string name, std::string text) {
  Source& source = sources_.emplace_back();
  source.name = std::move(name);
  source.text = std::move(text);
  source.line_starts.push_back(0);
  for (size_t at = source.text.find('\n'); at != std::string::npos; at = source.text.find('\n', at + 1))
    source.line_starts.push_back(at + 1);
  return static_cast<int32_t>(sources_.size()) - 1;
}

std::string_view Sources::line(int32_t file, int32_t line) const {
  if (file < 0 || file >= static_cast<int32_t>(sources_.size()) || line < 1) return {};
  const Source& source = sources_[static_cast<size_t>(file)];
  const size_t index = static_cast<size_t>(line) - 1;
  if (index >= source.line_starts.size()) return {};
  const size_t begin = source.line_starts[index];
  size_t end = index + 1 < source.line_starts.size() ? source.line_starts[index + 1] - 1 : source.text.size();
  if (end > begin && source.text[end - 1] == '\r') --end;
  return std::string_view(source.text).substr(begin, end - begin);
}

}  // namespace etd
