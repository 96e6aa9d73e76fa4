#include "params/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace etd {

namespace {

struct DefaultWriter {
  std::string operator()(std::monostate) const { return "-"; }
  std::string operator()(bool b) const { return b ? "true" : "false"; }
  std::string operator()(int i) const { return fmt::format("{}", i); }
  std::string operator()(double x) const { return fmt::format("{}", x); }
  std::string operator()(const std::string& s) const { return fmt::format("\"{}\"", s); }
  std::string operator()(const std::vector<double>& v) const { return fmt::format("{}", fmt::join(v, " ")); }
};

std::string type_text(const ParamDecl& decl) { return std::string(type_name(decl.type)) + (decl.array ? "[]" : ""); }

}  // namespace

std::string default_text(const ParamDecl& decl) {
  return decl.required ? "required" : std::visit(DefaultWriter(), decl.default_value);
}

std::string range_text(const ParamDecl& decl) {
  std::string text;
  for (const std::string& choice : decl.choices) text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", choice);
  if (!text.empty()) return text;
  const bool has_min = std::isfinite(decl.min), has_max = std::isfinite(decl.max);
  if (has_min && has_max)
    text = decl.above_min ? fmt::format("> {}, up to {}", decl.min, decl.max)
                          : fmt::format("{} to {}", decl.min, decl.max);
  else if (has_min)
    text = fmt::format("{} {}", decl.above_min ? ">" : ">=", decl.min);
  else if (has_max)
    text = fmt::format("<= {}", decl.max);
  if (decl.clamp && !text.empty()) text += ", clamped";
  return text;
}

std::string describe(const ModelDecl& decl) {
  std::string out = fmt::format("{} \"{}\"\n  {}\n", family_name(decl.family), decl.name, decl.doc);
  if (decl.params.empty()) return out + "  It takes no parameters.\n";
  size_t name_width = 0, type_width = 0;
  for (const ParamDecl& p : decl.params) {
    name_width = std::max(name_width, p.name.size());
    type_width = std::max(type_width, type_text(p).size());
  }
  for (const ParamDecl& p : decl.params) {
    std::string facts = p.required ? "required" : "default " + default_text(p);
    if (!p.required && std::holds_alternative<std::monostate>(p.default_value)) facts = "no default";
    if (const std::string range = range_text(p); !range.empty()) facts += "; " + range;
    if (!p.unit.empty()) facts += "; in " + p.unit;
    out += fmt::format("\n  {:{}}  {:{}}  {}\n", p.name, name_width, type_text(p), type_width, facts);
    if (!p.doc.empty()) out += fmt::format("  {:{}}  {}\n", "", name_width, p.doc);
  }
  return out;
}

}  // namespace etd
