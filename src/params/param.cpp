#include "params/param.h"

namespace etd {

std::string_view kind_name(ParamKind kind) {
  switch (kind) {
    case ParamKind::kBool:
      return "bool";
    case ParamKind::kInteger:
      return "integer";
    case ParamKind::kFloat:
      return "float";
    case ParamKind::kString:
      return "string";
    case ParamKind::kPoint2:
      return "point2";
    case ParamKind::kVector2:
      return "vector2";
    case ParamKind::kPoint3:
      return "point3";
    case ParamKind::kVector3:
      return "vector3";
    case ParamKind::kNormal:
      return "normal";
    case ParamKind::kRgb:
      return "rgb";
    case ParamKind::kSpectrum:
      return "spectrum";
    case ParamKind::kBlackbody:
      return "blackbody";
    case ParamKind::kTexture:
      return "texture";
  }
  return "";
}

int component_count(ParamKind kind) {
  switch (kind) {
    case ParamKind::kPoint2:
    case ParamKind::kVector2:
      return 2;
    case ParamKind::kPoint3:
    case ParamKind::kVector3:
    case ParamKind::kNormal:
    case ParamKind::kRgb:
      return 3;
    default:
      return 1;
  }
}

}  // namespace etd
