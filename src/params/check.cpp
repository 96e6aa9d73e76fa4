#include "params/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "params/describe.h"

namespace etd {

namespace {

// What may be written for a declared type, the usual way first.
std::vector<ParamKind> accepted_kinds(ParamType type) {
  switch (type) {
    case ParamType::kBool:
      return {ParamKind::kBool};
    case ParamType::kInteger:
      return {ParamKind::kInteger};
    case ParamType::kFloat:
      return {ParamKind::kFloat};
    case ParamType::kString:
      return {ParamKind::kString};
    case ParamType::kPoint2:
      return {ParamKind::kPoint2};
    case ParamType::kVector2:
      return {ParamKind::kVector2};
    case ParamType::kPoint3:
      return {ParamKind::kPoint3};
    case ParamType::kVector3:
      return {ParamKind::kVector3};
    case ParamType::kNormal:
      return {ParamKind::kNormal};
    case ParamType::kSpectrum:
      return {ParamKind::kRgb, ParamKind::kSpectrum, ParamKind::kBlackbody, ParamKind::kFloat};
    case ParamType::kFloatTexture:
      return {ParamKind::kFloat, ParamKind::kTexture};
    case ParamType::kSpectrumTexture:
      return {ParamKind::kRgb, ParamKind::kSpectrum, ParamKind::kBlackbody, ParamKind::kFloat, ParamKind::kTexture};
    case ParamType::kImageTexture:
      return {ParamKind::kString, ParamKind::kTexture};
  }
  return {};
}

// `parameter "radius" of shape "sphere"`
std::string named(const ModelDecl& model, std::string_view param) {
  return fmt::format("parameter \"{}\" of {} \"{}\"", param, family_name(model.family), model.name);
}

std::string_view value_noun(ParamKind kind, size_t n) {
  if (kind == ParamKind::kString || kind == ParamKind::kTexture) return n == 1 ? "string" : "strings";
  if (kind == ParamKind::kBool) return n == 1 ? "bool" : "bools";
  if (kind == ParamKind::kInteger) return n == 1 ? "integer" : "integers";
  return n == 1 ? "number" : "numbers";
}

std::optional<ParamProblem> type_problem(const ModelDecl& model, const ParamDecl& decl, const Param& param) {
  const std::vector<ParamKind> kinds = accepted_kinds(decl.type);
  if (std::find(kinds.begin(), kinds.end(), param.kind) != kinds.end()) return {};
  std::string valid;
  for (size_t i = 0; i < kinds.size(); ++i)
    valid += fmt::format("{}\"{} {}\"",
                         i == 0                  ? ""
                         : i + 1 == kinds.size() ? " or "
                                                 : ", ",
                         kind_name(kinds[i]), decl.name);
  return ParamProblem{
      param.loc,
      fmt::format("{} is of type {}, not {}", named(model, decl.name), type_name(decl.type), kind_name(param.kind)),
      fmt::format("write {} instead of \"{} {}\"", valid, kind_name(param.kind), param.name)};
}

std::optional<ParamProblem> count_problem(const ModelDecl& model, const ParamDecl& decl, const Param& param) {
  const size_t n = param.numbers.size() + param.integers.size() + param.strings.size();
  const size_t per_value = static_cast<size_t>(component_count(param.kind));
  const auto problem = [&](std::string_view expected) {
    return ParamProblem{param.loc, fmt::format("{} takes {}, not {}", named(model, decl.name), expected, n), {}};
  };
  if (param.kind == ParamKind::kSpectrum && param.strings.empty()) {
    if (n == 0 || n % 2 != 0) return problem("the name of a spectrum or pairs of a wavelength and a value");
    for (size_t i = 2; i < n; i += 2)
      if (!(param.numbers[i] > param.numbers[i - 2]))
        return ParamProblem{param.value_loc,
                            fmt::format("wavelengths of {} must increase: {} after {}", named(model, decl.name),
                                        param.numbers[i], param.numbers[i - 2]),
                            "the numbers of a spectrum are pairs of a wavelength in nm and a value"};
    return {};
  }
  if (decl.array) {
    if (n % per_value == 0) return {};
    return problem(fmt::format("a multiple of {} numbers", per_value));
  }
  if (n == per_value) return {};
  return problem(fmt::format("{} {}", per_value, value_noun(param.kind, per_value)));
}

// Whether `decl` allows x, counting as allowed what clamping will mend.
bool in_range(const ParamDecl& decl, double x) {
  if (decl.above_min && x <= decl.min) return false;
  return decl.clamp || (x >= decl.min && x <= decl.max);
}

std::optional<ParamProblem> value_problem(const ModelDecl& model, const ParamDecl& decl, const Param& param) {
  const auto problem = [&](std::string message, std::string hint) {
    return ParamProblem{param.value_loc, std::move(message), std::move(hint)};
  };
  const bool is_pairs = param.kind == ParamKind::kSpectrum;
  for (size_t i = 0; i < param.numbers.size(); ++i) {
    const double x = param.numbers[i];
    if (!std::isfinite(x))
      return problem(fmt::format("value {} of {} is {}", i + 1, named(model, decl.name),
                                 std::isnan(x) ? "not a number" : "infinite"),
                     "every number must be finite");
    if (param.kind == ParamKind::kBlackbody || (is_pairs && i % 2 == 0)) {
      if (x > 0) continue;
      return problem(fmt::format("{} of {} is {}", is_pairs ? "wavelength" : "temperature", named(model, decl.name), x),
                     is_pairs ? "wavelengths are positive, in nm" : "a temperature is positive, in kelvin");
    }
    if (!in_range(decl, x))
      return problem(fmt::format("{} is {}, out of range", named(model, decl.name), x), "valid: " + range_text(decl));
  }
  for (const int32_t x : param.integers)
    if (param.kind == ParamKind::kInteger && !in_range(decl, x))
      return problem(fmt::format("{} is {}, out of range", named(model, decl.name), x), "valid: " + range_text(decl));
  for (const std::string& s : param.strings)
    if (s.size() > kLongestName)
      return problem(fmt::format("{} is a string of {} bytes", named(model, decl.name), s.size()),
                     fmt::format("valid: up to {} bytes", kLongestName));
  if (decl.choices.empty()) return {};
  for (const std::string& s : param.strings) {
    if (std::find(decl.choices.begin(), decl.choices.end(), s) != decl.choices.end()) continue;
    const std::vector<std::string_view> choices(decl.choices.begin(), decl.choices.end());
    const std::string_view near = nearest_name(s, choices);
    return problem(fmt::format("{} cannot be \"{}\"", named(model, decl.name), s),
                   (near.empty() ? "" : fmt::format("did you mean \"{}\"? ", near)) + "valid: " + range_text(decl));
  }
  return {};
}

void report_unknown(const ModelDecl& decl, const Param& param, Diagnostics& diagnostics) {
  std::vector<std::string_view> names;
  for (const ParamDecl& p : decl.params) names.push_back(p.name);
  const std::string_view near = nearest_name(param.name, names);
  std::string hint = near.empty() ? "" : fmt::format("did you mean \"{}\"? ", near);
  hint += fmt::format("\"{}\" takes", decl.name);
  for (size_t i = 0; i < names.size(); ++i) hint += fmt::format("{} {}", i == 0 ? ":" : ",", names[i]);
  if (names.empty()) hint += " no parameters";
  diagnostics.error(param.loc,
                    fmt::format("{} \"{}\" has no parameter \"{}\"", family_name(decl.family), decl.name, param.name),
                    std::move(hint));
}

void warn_of_clamping(const ModelDecl& model, const ParamDecl& decl, const Param& param, Diagnostics& diagnostics) {
  const auto out_of_range = [&](double x) { return x < decl.min || x > decl.max; };
  const bool is_pairs = param.kind == ParamKind::kSpectrum;
  for (size_t i = is_pairs ? 1 : 0; i < param.numbers.size(); i += is_pairs ? 2 : 1)
    if (param.kind != ParamKind::kBlackbody && out_of_range(param.numbers[i]))
      return diagnostics.warning(param.value_loc,
                                 fmt::format("{} is {}, clamped", named(model, decl.name), param.numbers[i]),
                                 "valid: " + range_text(decl));
  for (const int32_t x : param.integers)
    if (out_of_range(x))
      return diagnostics.warning(param.value_loc, fmt::format("{} is {}, clamped", named(model, decl.name), x),
                                 "valid: " + range_text(decl));
}

}  // namespace

std::optional<ParamProblem> find_problem(const ModelDecl& model, const ParamDecl& decl, const Param& param) {
  if (auto problem = type_problem(model, decl, param)) return problem;
  if (auto problem = count_problem(model, decl, param)) return problem;
  return value_problem(model, decl, param);
}

void check_params(const ModelDecl& decl, const ModelUse& use, Diagnostics& diagnostics) {
  std::map<std::string_view, const Param*> first_of;
  for (const Param& param : use.params) {
    const ParamDecl* declared = decl.find(param.name);
    if (!declared) {
      report_unknown(decl, param, diagnostics);
      continue;
    }
    if (const Param* first = first_of.emplace(param.name, &param).first->second; first != &param) {
      const std::string where =
          first->loc.file == param.loc.file ? std::string() : diagnostics.sources().name(first->loc.file) + ", ";
      diagnostics.error(param.loc, fmt::format("{} is given twice", named(decl, param.name)),
                        first->loc.file < 0 ? "" : fmt::format("first given at {}line {}", where, first->loc.line));
      continue;
    }
    if (param.malformed) continue;
    if (auto problem = find_problem(decl, *declared, param))
      diagnostics.error(problem->loc, std::move(problem->message), std::move(problem->hint));
    else if (declared->clamp)
      warn_of_clamping(decl, *declared, param, diagnostics);
  }
  for (const ParamDecl& declared : decl.params)
    if (declared.required && !use.find(declared.name))
      diagnostics.error(
          use.loc,
          fmt::format("{} \"{}\" needs the parameter \"{}\"", family_name(decl.family), decl.name, declared.name),
          declared.doc.empty() ? "" : fmt::format("{}: {}", type_name(declared.type), declared.doc));
}

}  // namespace etd
