#include "document_block.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "render_helper.h"

namespace etd {
namespace {

std::string read_page(const std::string& page) {
  std::ifstream in(source_path("docs/" + page), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

struct Range {
  size_t begin, end;
};

std::optional<Range> find_block(const std::string& text, const std::string& name) {
  const std::string begin = "<!-- begin " + name + " -->\n", end = "<!-- end " + name + " -->";
  const size_t first = text.find(begin);
  if (first == std::string::npos) return {};
  const size_t last = text.find(end, first);
  if (last == std::string::npos) return {};
  return Range{first + begin.size(), last};
}

}  // namespace

bool updates_expected() { return std::getenv("ETENDUE_UPDATE_EXPECTED") != nullptr; }

std::optional<std::string> read_document_block(const std::string& page, const std::string& name) {
  const std::string text = read_page(page);
  const auto range = find_block(text, name);
  if (!range) return {};
  return text.substr(range->begin, range->end - range->begin);
}

void write_document_block(const std::string& page, const std::string& name, const std::string& text) {
  std::string all = read_page(page);
  const auto range = find_block(all, name);
  if (!range) throw std::runtime_error("docs/" + page + " has no block " + name);
  all.replace(range->begin, range->end - range->begin, text);
  std::ofstream(source_path("docs/" + page), std::ios::binary) << all;
}

}  // namespace etd
