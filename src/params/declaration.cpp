#include "params/declaration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "params/check.h"

namespace etd {

namespace {

[[noreturn]] void programming_error(const ModelDecl& decl, std::string_view name, std::string_view problem) {
  fmt::print(stderr, "internal error: {} \"{}\": parameter \"{}\" {}\n", family_name(decl.family), decl.name, name,
             problem);
  std::abort();
}

const ParamDecl& require(const ModelDecl& decl, std::string_view name) {
  const ParamDecl* p = decl.find(name);
  if (!p) programming_error(decl, name, "is read but not declared");
  return *p;
}

// The declaration, once it is sure that it is of one of these types and a single value or an array as asked.
const ParamDecl& require(const ModelDecl& decl, std::string_view name, std::initializer_list<ParamType> types) {
  const ParamDecl& p = require(decl, name);
  if (std::find(types.begin(), types.end(), p.type) == types.end())
    programming_error(decl, name, "is read as another type than its declared one");
  return p;
}

double clamped(const ParamDecl& decl, double x) { return decl.clamp ? std::clamp(x, decl.min, decl.max) : x; }

}  // namespace

std::string_view family_name(Family family) {
  switch (family) {
    case Family::kShape:
      return "shape";
    case Family::kMaterial:
      return "material";
    case Family::kTexture:
      return "texture";
    case Family::kLight:
      return "light";
    case Family::kAreaLight:
      return "area light";
    case Family::kCamera:
      return "camera";
    case Family::kFilter:
      return "filter";
    case Family::kFilm:
      return "film";
    case Family::kSampler:
      return "sampler";
    case Family::kIntegrator:
      return "integrator";
  }
  return "";
}

std::string_view type_name(ParamType type) {
  switch (type) {
    case ParamType::kBool:
      return "bool";
    case ParamType::kInteger:
      return "integer";
    case ParamType::kFloat:
      return "float";
    case ParamType::kString:
      return "string";
    case ParamType::kPoint2:
      return "point2";
    case ParamType::kVector2:
      return "vector2";
    case ParamType::kPoint3:
      return "point3";
    case ParamType::kVector3:
      return "vector3";
    case ParamType::kNormal:
      return "normal";
    case ParamType::kSpectrum:
      return "spectrum";
    case ParamType::kFloatTexture:
      return "float texture";
    case ParamType::kSpectrumTexture:
      return "spectrum texture";
    case ParamType::kImageTexture:
      return "string or spectrum texture";
  }
  return "";
}

const ParamDecl* ModelDecl::find(std::string_view param) const {
  for (const ParamDecl& p : params)
    if (p.name == param) return &p;
  return nullptr;
}

ModelDecl with_params(ModelDecl decl, const std::vector<std::vector<ParamDecl>>& parts) {
  for (const std::vector<ParamDecl>& part : parts) decl.params.insert(decl.params.end(), part.begin(), part.end());
  return decl;
}

bool ParamReader::boolean(std::string_view name) const {
  const ParamDecl& decl = require(decl_, name, {ParamType::kBool});
  if (const Param* p = given(name)) return p->integers[0] != 0;
  const bool* value = std::get_if<bool>(&decl.default_value);
  return value && *value;
}

int ParamReader::integer(std::string_view name) const {
  const ParamDecl& decl = require(decl_, name, {ParamType::kInteger});
  if (decl.array) programming_error(decl_, name, "is an array but read as one integer");
  if (const Param* p = given(name)) return static_cast<int>(clamped(decl, p->integers[0]));
  const int* value = std::get_if<int>(&decl.default_value);
  return value ? *value : 0;
}

double ParamReader::number(std::string_view name) const {
  const ParamDecl& decl = require(decl_, name, {ParamType::kFloat, ParamType::kFloatTexture});
  if (decl.array) programming_error(decl_, name, "is an array but read as one number");
  if (const Param* p = given(name); p && p->kind == ParamKind::kFloat) return clamped(decl, p->numbers[0]);
  if (const double* value = std::get_if<double>(&decl.default_value)) return *value;
  const int* value = std::get_if<int>(&decl.default_value);
  return value ? *value : 0.0;
}

std::string ParamReader::string(std::string_view name) const {
  const ParamDecl& decl = require(decl_, name, {ParamType::kString});
  if (decl.array) programming_error(decl_, name, "is an array but read as one string");
  if (const Param* p = given(name)) return p->strings[0];
  const std::string* value = std::get_if<std::string>(&decl.default_value);
  return value ? *value : std::string();
}

std::vector<double> ParamReader::numbers(std::string_view name) const {
  const ParamDecl& decl = require(decl_, name,
                                  {ParamType::kFloat, ParamType::kPoint2, ParamType::kVector2, ParamType::kPoint3,
                                   ParamType::kVector3, ParamType::kNormal});
  if (const Param* p = given(name)) {
    std::vector<double> values = p->numbers;
    if (decl.clamp)
      for (double& x : values) x = clamped(decl, x);
    return values;
  }
  if (const auto* values = std::get_if<std::vector<double>>(&decl.default_value)) return *values;
  if (const double* value = std::get_if<double>(&decl.default_value)) return {*value};
  return {};
}

std::vector<int32_t> ParamReader::integers(std::string_view name) const {
  const ParamDecl& decl = require(decl_, name, {ParamType::kInteger});
  if (const Param* p = given(name)) {
    std::vector<int32_t> values = p->integers;
    if (decl.clamp)
      for (int32_t& x : values) x = static_cast<int32_t>(clamped(decl, x));
    return values;
  }
  if (const int* value = std::get_if<int>(&decl.default_value)) return {*value};
  return {};
}

const Param* ParamReader::given(std::string_view name) const {
  const ParamDecl& decl = require(decl_, name);
  const Param* p = use_.find(name);
  return p && !p->malformed && !find_problem(decl_, decl, *p) ? p : nullptr;
}

const ParamDecl& ParamReader::declaration(std::string_view name) const { return require(decl_, name); }

}  // namespace etd
