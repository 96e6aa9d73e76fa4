// Uses of models as a reader would make them, for tests that build one model without a scene file.
#pragma once

#include <string>
#include <vector>

#include "params/param.h"

namespace etd {

inline Param numbers(const std::string& name, ParamKind kind, std::vector<double> values) {
  Param p;
  p.name = name;
  p.kind = kind;
  p.numbers = std::move(values);
  return p;
}
inline Param number(const std::string& name, double value) { return numbers(name, ParamKind::kFloat, {value}); }
inline Param rgb(const std::string& name, double r, double g, double b) {
  return numbers(name, ParamKind::kRgb, {r, g, b});
}
inline Param text(const std::string& name, const std::string& value, ParamKind kind = ParamKind::kString) {
  Param p;
  p.name = name;
  p.kind = kind;
  p.strings = {value};
  return p;
}
inline Param texture(const std::string& name, const std::string& value) {
  return text(name, value, ParamKind::kTexture);
}
inline Param boolean(const std::string& name, bool value) {
  Param p;
  p.name = name;
  p.kind = ParamKind::kBool;
  p.integers = {value ? 1 : 0};
  return p;
}

inline ModelUse use_of(const std::string& model, std::vector<Param> params = {}) {
  return {model, std::move(params), {}};
}

}  // namespace etd
