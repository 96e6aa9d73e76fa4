#include "formats/pbrt/parser.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "formats/pbrt/coverage.h"
#include "formats/pbrt/old_names.h"
#include "formats/pbrt/parameter_list.h"

namespace etd::pbrt {

namespace {

bool is_directive(std::string_view word) { return find_directive(word) != nullptr; }

bool has_other_quotes(std::string_view word) {
  for (const std::string_view quote : {"'", "`", "\u2018", "\u2019", "\u201c", "\u201d", "\u201e", "\u00ab"})
    if (word.substr(0, quote.size()) == quote) return true;
  return false;
}

std::vector<std::string_view> directive_names() {
  std::vector<std::string_view> names;
  for (const auto& list : {transform_directives(), option_directives(), world_directives()})
    for (const Directive& d : list) names.push_back(d.name);
  return names;
}

// Words that do not begin with a letter have none: most of what is passed over after an error are numbers.
std::string_view nearest_directive(std::string_view word) {
  static const std::vector<std::string_view> names = directive_names();
  const char first = static_cast<char>(word.empty() ? 0 : word[0] | 0x20);
  return first >= 'a' && first <= 'z' ? nearest_name(word, names) : std::string_view();
}

void report_unknown_directive(const Token& token, Diagnostics& diagnostics) {
  std::string hint = old_directive_hint(token.text, token.loc, diagnostics);
  if (const std::string_view near = nearest_directive(token.text); hint.empty() && !near.empty())
    hint = fmt::format("did you mean {}?", near);
  if (hint.empty() && token.text[0] >= 'a' && token.text[0] <= 'z')
    hint = "directives begin with a capital letter, parameters are written \"type name\" value";
  diagnostics.error(token.loc, fmt::format("unknown directive {}", token.text), hint);
}

std::string shown(const Token& token) {
  return token.kind == Token::Kind::kString ? fmt::format("\"{}\"", token.text) : std::string(token.text);
}

}  // namespace

const Directive* find_directive(std::string_view name) {
  for (const auto& list : {world_directives(), transform_directives(), option_directives()})
    for (const Directive& d : list)
      if (d.name == name) return &d;
  return nullptr;
}

void Parser::read_directives() {
  while (true) {
    if (const std::optional<Token> token = tokens.next())
      read_directive(*token);
    else if (imports_.empty())
      return;
    else
      end_import();
    if (world_begun && ends_at_world) return;
  }
}

void Parser::read_directive(const Token& token) {
  const Directive* directive = token.kind == Token::Kind::kWord ? find_directive(token.text) : nullptr;
  any_directive = true;
  if (!directive) {
    if (token.kind == Token::Kind::kWord && !parse_number(token.text))
      report_unknown_directive(token, diagnostics);
    else
      diagnostics.error(token.loc, fmt::format("expected a directive, not {}", shown(token)),
                        token.kind == Token::Kind::kWord ? "what stands before it takes no more numbers" : "");
    return resynchronise();
  }
  if (directive->where == Directive::Where::kWorld && !world_begun && !world_implied) {
    diagnostics.error(token.loc, fmt::format("{} before WorldBegin", directive->name),
                      "options come first, then WorldBegin, then the world");
    world_implied = true;
  }
  if (directive->where == Directive::Where::kOptions && world_begun) {
    diagnostics.error(token.loc, fmt::format("{} after WorldBegin", directive->name),
                      "it is an option of the whole scene and stands before WorldBegin");
    return resynchronise();
  }
  directive->read(*this, token);
}

void Parser::resynchronise() {
  tokens.set_quiet(true);
  while (const std::optional<Token> token = tokens.peek()) {
    if (token->kind == Token::Kind::kWord &&
        (is_directive(token->text) || is_old_directive(token->text) || !nearest_directive(token->text).empty()))
      break;
    tokens.next();
  }
  tokens.set_quiet(false);
}

std::optional<Token> Parser::string_argument(const Token& directive, std::string_view what) {
  const std::optional<Token> token = tokens.peek();
  if (token && token->kind == Token::Kind::kString) return tokens.next();
  if (!token || is_directive(token->text))
    diagnostics.error(directive.loc, fmt::format("{} takes {} in quotes", directive.text, what));
  else
    diagnostics.error(token->loc, fmt::format("{} takes {} in quotes, not {}", directive.text, what, shown(*token)),
                      has_other_quotes(token->text) ? "quotes are written \", straight and double" : "");
  resynchronise();
  return {};
}

std::optional<std::vector<double>> Parser::number_arguments(const Token& directive, size_t count) {
  std::vector<double> numbers;
  std::optional<Token> token = tokens.peek();
  const bool bracketed = token && token->kind == Token::Kind::kOpen;
  if (bracketed) tokens.next();
  while (numbers.size() < count) {
    token = tokens.peek();
    const std::optional<double> number =
        token && token->kind == Token::Kind::kWord ? parse_number(token->text) : std::optional<double>();
    if (!number) break;
    if (!std::isfinite(*number)) {
      diagnostics.error(token->loc, fmt::format("{} is not a finite number", token->text));
      resynchronise();
      return {};
    }
    numbers.push_back(*number);
    tokens.next();
    tokens.take(numbers, count);
  }
  token = tokens.peek();
  if (numbers.size() == count && (!bracketed || (token && token->kind == Token::Kind::kClose))) {
    if (bracketed) tokens.next();
    return numbers;
  }
  const SourceLoc loc = token && numbers.size() < count && !is_directive(token->text) ? token->loc : directive.loc;
  if (numbers.size() == count)
    diagnostics.error(directive.loc,
                      fmt::format("the list of {} is not closed after {} numbers", directive.text, count));
  else if (token && token->kind != Token::Kind::kClose && !is_directive(token->text))
    diagnostics.error(loc, fmt::format("{} takes {} numbers; {} is none", directive.text, count, shown(*token)),
                      number_hint(token->text));
  else
    diagnostics.error(loc, fmt::format("{} takes {} numbers, not {}", directive.text, count, numbers.size()));
  resynchronise();
  return {};
}

std::vector<Param> Parser::parameters() { return read_parameters(tokens, is_directive, diagnostics); }

std::optional<ModelUse> Parser::model_arguments(const Token& directive, std::string_view what) {
  const std::optional<Token> name = string_argument(directive, what);
  if (!name) return {};
  ModelUse use{name->value(), {}, name->loc};
  use.params = parameters();
  return use;
}

std::optional<ModelUse> Parser::model_arguments(const Token& directive, std::string_view what, ColorRole role) {
  std::optional<ModelUse> use = model_arguments(directive, what);
  if (use) convert_colors(use->params, role);
  return use;
}

void Parser::convert_colors(std::vector<Param>& params, ColorRole role) {
  pbrt::convert_colors(params, role, state.color_space, spectra, tokens.repeats, diagnostics);
}

std::optional<TransformPair> Parser::placement(const SourceLoc& loc, std::string_view what) {
  const TransformPair& t = state.ctm;
  if (t.start.is_singular() || t.end.is_singular()) {
    diagnostics.error(loc, fmt::format("the transform of this {} is singular", what),
                      "it squeezes space flat, so it has no inverse: look for a Scale by 0 or a broken matrix");
    return {};
  }
  if (!t.start.is_affine() || !t.end.is_affine()) {
    diagnostics.error(loc, fmt::format("the transform of this {} is not affine", what),
                      "the last row of its matrix must be 0 0 0 1");
    return {};
  }
  return t;
}

void Parser::add_defaults(AttributeTarget target, Family family, ModelUse& use) {
  if (defaults.entries().empty()) return;
  for (const std::string_view name : params_of(family, use.model)) {
    const Param* p = defaults.find({target, std::string(name)});
    if (!p || use.find(name)) continue;
    size_t bytes = p->numbers.size() * sizeof(double) + p->integers.size() * sizeof(int32_t);
    for (const std::string& s : p->strings) bytes += sizeof(s) + s.size();
    if (tokens.repeats.take(bytes, use.loc, diagnostics)) use.params.push_back(*p);
  }
}

void Parser::open_block(Block::Kind kind, const SourceLoc& loc) {
  blocks.push_back({kind, loc, state, defaults.mark()});
  ++open_[static_cast<size_t>(kind)];
}

void Parser::close_last_block() {
  --open_[static_cast<size_t>(blocks.back().kind)];
  state = std::move(blocks.back().outside);
  defaults.go_back(blocks.back().defaults_outside);
  blocks.pop_back();
}

bool Parser::close_block(Block::Kind kind, const SourceLoc& loc) {
  if (open_[static_cast<size_t>(kind)] == 0) {
    diagnostics.error(loc, fmt::format("{0}End without {0}Begin", block_name(kind)));
    return false;
  }
  size_t match = blocks.size();
  while (blocks[match - 1].kind != kind) --match;
  report_open_blocks(match);
  close_last_block();
  return true;
}

void Parser::report_open_blocks(size_t from) {
  while (blocks.size() > from) {
    const Block& open = blocks.back();
    diagnostics.error(open.loc, fmt::format("{0}Begin without {0}End", block_name(open.kind)));
    if (open.kind == Block::Kind::kObject) object = -1;
    close_last_block();
  }
}

void Parser::begin_import() {
  imports_.push_back({state, std::exchange(first_block_, blocks.size()), std::exchange(open_, {}), defaults.mark(),
                      coordinate_systems.mark()});
}

void Parser::end_import() {
  report_open_blocks(first_block_);
  const Importing& outside = imports_.back();
  state = outside.state;
  first_block_ = outside.first_block;
  open_ = outside.open;
  defaults.go_back(outside.defaults);
  coordinate_systems.go_back(outside.coordinate_systems);
  imports_.pop_back();
  tokens.pop_isolated();
}

}  // namespace etd::pbrt
