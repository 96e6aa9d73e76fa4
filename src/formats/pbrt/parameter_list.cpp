#include "formats/pbrt/parameter_list.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "formats/pbrt/old_names.h"

namespace etd::pbrt {

namespace {

struct TypeName {
  std::string_view name;
  ParamKind kind;
};
constexpr std::array<TypeName, 16> kTypes = {{{"bool", ParamKind::kBool},
                                              {"integer", ParamKind::kInteger},
                                              {"float", ParamKind::kFloat},
                                              {"string", ParamKind::kString},
                                              {"point2", ParamKind::kPoint2},
                                              {"vector2", ParamKind::kVector2},
                                              {"point3", ParamKind::kPoint3},
                                              {"vector3", ParamKind::kVector3},
                                              {"normal", ParamKind::kNormal},
                                              {"rgb", ParamKind::kRgb},
                                              {"spectrum", ParamKind::kSpectrum},
                                              {"blackbody", ParamKind::kBlackbody},
                                              {"texture", ParamKind::kTexture},
                                              {"point", ParamKind::kPoint3},
                                              {"vector", ParamKind::kVector3},
                                              {"normal3", ParamKind::kNormal}}};

// The two words of "type name"; either is empty when it is not there, `extra` is set when there are more.
struct Declaration {
  std::string type, name;
  bool extra = false;
};

Declaration split(const std::string& text) {
  size_t at = 0;
  const auto next_word = [&] {
    const size_t begin = std::min(text.find_first_not_of(" \t", at), text.size());
    at = std::min(text.find_first_of(" \t", begin), text.size());
    return text.substr(begin, at - begin);
  };
  Declaration d;
  d.type = next_word();
  d.name = next_word();
  d.extra = !next_word().empty();
  return d;
}

const TypeName* find_type(std::string_view name) {
  for (const TypeName& t : kTypes)
    if (t.name == name) return &t;
  return nullptr;
}

// Whether a string looks like the head of a parameter: what stands there when a "]" was forgotten.
bool is_declaration(const Token& token) {
  if (token.kind != Token::Kind::kString) return false;
  const Declaration d = split(token.value());
  return !d.name.empty() && !d.extra && find_type(d.type);
}

std::string type_hint(std::string_view type, std::string_view name, const SourceLoc& loc, Diagnostics& diagnostics) {
  if (std::string old = old_type_hint(type, name, loc, diagnostics); !old.empty()) return old;
  std::vector<std::string_view> names;
  std::string list;
  for (const TypeName& t : kTypes) {
    names.push_back(t.name);
    list += (list.empty() ? "types: " : ", ") + std::string(t.name);
  }
  const std::string_view near = nearest_name(type, names);
  return near.empty() ? list : fmt::format("did you mean \"{} {}\"? {}", near, name, list);
}

class ParameterReader {
 public:
  ParameterReader(TokenStream& tokens, const std::function<bool(std::string_view)>& is_directive,
                  Diagnostics& diagnostics)
      : tokens_(tokens), is_directive_(is_directive), diagnostics_(diagnostics) {}

  // Reads the parameter whose head is `head`; none when it cannot be used.
  std::optional<Param> read(const Token& head) {
    const Declaration d = split(head.value());
    const TypeName* type = find_type(d.type);
    bool usable = false;
    if (d.name.empty() || d.extra)
      diagnostics_.error(head.loc, fmt::format("\"{}\" is not a type and a name", head.text),
                         "a parameter is written \"float radius\" 2 or \"float radius\" [ 2 ]");
    else if (!type)
      diagnostics_.error(head.loc, fmt::format("unknown parameter type \"{}\"", d.type),
                         type_hint(d.type, d.name, head.loc, diagnostics_));
    else
      usable = true;
    param_ = {};
    param_.name = usable ? d.name : std::string();
    param_.kind = type ? type->kind : ParamKind::kFloat;
    param_.loc = param_.value_loc = head.loc;
    read_values(head, usable);
    if (!usable) return {};
    reject_old_blackbody(param_, diagnostics_);
    return std::move(param_);
  }

 private:
  bool ends_list(const Token& token) const {
    return token.kind == Token::Kind::kOpen || (token.kind == Token::Kind::kWord && is_directive_(token.text)) ||
           (param_.kind != ParamKind::kString && param_.kind != ParamKind::kTexture && is_declaration(token));
  }

  void read_values(const Token& head, bool usable) {
    const std::optional<Token> first = tokens_.peek();
    if (!first || first->kind == Token::Kind::kClose || (first->kind != Token::Kind::kOpen && ends_list(*first))) {
      diagnostics_.error(head.loc, fmt::format("parameter \"{}\" has no value", head.text));
      param_.malformed = true;
      if (first && first->kind == Token::Kind::kClose) tokens_.next();
      return;
    }
    tokens_.next();
    if (first->kind != Token::Kind::kOpen) {
      if (usable) add(*first);
      return;
    }
    bool is_first = true;
    while (const std::optional<Token> token = tokens_.peek()) {
      if (token->kind != Token::Kind::kClose && ends_list(*token)) break;
      tokens_.next();
      if (token->kind == Token::Kind::kClose) return;
      if (is_first) param_.value_loc = token->loc;
      is_first = false;
      if (!usable) continue;
      add(*token);
      take_numbers();
    }
    diagnostics_.error(first->loc, fmt::format("the list of \"{}\" is not closed", head.text), "a \"]\" is missing");
    param_.malformed = true;
    while (const std::optional<Token> token = tokens_.peek()) {
      if ((token->kind == Token::Kind::kWord && is_directive_(token->text)) || is_declaration(*token)) break;
      tokens_.next();
    }
  }

  // Only the first wrong value of a parameter is worth a message.
  void wrong(const Token& token, std::string_view expected) {
    const std::string_view quote = token.kind == Token::Kind::kString ? "\"" : "";
    if (!param_.malformed)
      diagnostics_.error(token.loc,
                         fmt::format("\"{} {}\" takes {}, not {}{}{}", kind_name(param_.kind), param_.name, expected,
                                     quote, token.text, quote),
                         expected == "numbers" ? number_hint(token.text) : "");
    param_.malformed = true;
  }

  void add(const Token& token) {
    if (param_.strings.empty() && param_.numbers.empty() && param_.integers.empty()) param_.value_loc = token.loc;
    switch (param_.kind) {
      case ParamKind::kBool:
        return add_bool(token);
      case ParamKind::kInteger:
        return add_integer(token);
      case ParamKind::kString:
      case ParamKind::kTexture:
        return add_string(token,
                          param_.kind == ParamKind::kTexture ? "the name of a texture in quotes" : "strings in quotes");
      case ParamKind::kSpectrum:
        if (token.kind == Token::Kind::kString) {
          if (param_.numbers.empty()) return add_string(token, "");
          return wrong(token, "either a name or numbers");
        }
        if (!param_.strings.empty()) return wrong(token, "either a name or numbers");
        return add_number(token);
      default:
        return add_number(token);
    }
  }

  // Behind a number of a list mostly come others that nothing is wrong with, a million of them in a mesh.
  void take_numbers() {
    if (param_.kind == ParamKind::kInteger)
      tokens_.take(param_.integers);
    else if (!param_.numbers.empty())
      tokens_.take(param_.numbers);
  }

  void add_bool(const Token& token) {
    const bool valid = token.text == "true" || token.text == "false";
    if (!valid) wrong(token, "true or false");
    param_.integers.push_back(token.text == "true");
  }

  void add_integer(const Token& token) {
    const std::optional<int32_t> value =
        token.kind == Token::Kind::kWord ? parse_integer(token.text) : std::optional<int32_t>();
    if (!value) wrong(token, "integers of 32 bits");
    param_.integers.push_back(value.value_or(0));
  }

  void add_number(const Token& token) {
    const std::optional<double> value =
        token.kind == Token::Kind::kWord ? parse_number(token.text) : std::optional<double>();
    if (!value) wrong(token, "numbers");
    // The place of a number that is not finite is known only here; the check of the value itself comes later.
    if (value && !std::isfinite(*value) && param_.value_loc.file >= 0) param_.value_loc = token.loc;
    param_.numbers.push_back(value.value_or(0.0));
  }

  void add_string(const Token& token, std::string_view expected) {
    if (token.kind != Token::Kind::kString) wrong(token, expected);
    param_.strings.push_back(token.value());
  }

  TokenStream& tokens_;
  const std::function<bool(std::string_view)>& is_directive_;
  Diagnostics& diagnostics_;
  Param param_;
};

}  // namespace

std::vector<Param> read_parameters(TokenStream& tokens, const std::function<bool(std::string_view)>& is_directive,
                                   Diagnostics& diagnostics) {
  std::vector<Param> params;
  ParameterReader reader(tokens, is_directive, diagnostics);
  while (const std::optional<Token> head = tokens.peek()) {
    if (head->kind != Token::Kind::kString) break;
    tokens.next();
    if (std::optional<Param> param = reader.read(*head)) params.push_back(std::move(*param));
  }
  return params;
}

}  // namespace etd::pbrt
