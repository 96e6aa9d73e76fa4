// A parameter as a scene file gives it: a name, the type written beside it, its values, and where it stands.
#pragma once

#include <string>
#include <vector>

#include "params/source.h"

namespace etd {

// The types that can be written in a file. kRgb, kSpectrum and kBlackbody are three ways to give a spectrum.
enum class ParamKind : uint8_t {
  kBool,
  kInteger,
  kFloat,
  kString,
  kPoint2,
  kVector2,
  kPoint3,
  kVector3,
  kNormal,
  kRgb,
  kSpectrum,
  kBlackbody,
  kTexture
};
std::string_view kind_name(ParamKind kind);
// Numbers that make one value: 3 for a point3 or an rgb, 2 for a point2, otherwise 1.
int component_count(ParamKind kind);

// Values by kind: bool and integer in `integers`; float, points, vectors, rgb, blackbody and numeric spectra in
// `numbers` (all components in a row); string, texture and named spectra in `strings`.
struct Param {
  std::string name;
  ParamKind kind = ParamKind::kFloat;
  std::vector<double> numbers;
  std::vector<int32_t> integers;
  std::vector<std::string> strings;
  SourceLoc loc;        // of the "type name" token
  SourceLoc value_loc;  // of the first value
  // A value could not be read, which the reader has reported: it counts as given, and reads as the default.
  bool malformed = false;
};

// One use of a model in a scene: which, with what parameters, and where.
struct ModelUse {
  std::string model;
  std::vector<Param> params;
  SourceLoc loc;  // of the model's name

  const Param* find(std::string_view name) const {
    for (const Param& p : params)
      if (p.name == name) return &p;
    return nullptr;
  }
};

}  // namespace etd
