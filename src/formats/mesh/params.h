// Parameters that a reader makes up, rather than finds in a file.
#pragma once

#include "core/vec.h"
#include "params/param.h"

namespace etd {

inline Param number_param(std::string name, std::vector<double> values, ParamKind kind = ParamKind::kFloat) {
  Param p;
  p.name = std::move(name);
  p.kind = kind;
  p.numbers = std::move(values);
  return p;
}
inline Param rgb_param(std::string name, Vec3 v) {
  return number_param(std::move(name), {v.x, v.y, v.z}, ParamKind::kRgb);
}
inline Param integer_param(std::string name, std::vector<int32_t> values, ParamKind kind = ParamKind::kInteger) {
  Param p;
  p.name = std::move(name);
  p.kind = kind;
  p.integers = std::move(values);
  return p;
}
inline Param string_param(std::string name, std::string value, ParamKind kind = ParamKind::kString) {
  Param p;
  p.name = std::move(name);
  p.kind = kind;
  p.strings = {std::move(value)};
  return p;
}

}  // namespace etd
