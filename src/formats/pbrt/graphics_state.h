// What a directive leaves behind for those after it, and the blocks that put it back.
#pragma once

#include <array>
#include <string_view>

#include "core/transform.h"
#include "params/source.h"
#include "spectrum/color_space.h"

namespace etd::pbrt {

// What `Attribute` can give default parameters to.
enum class AttributeTarget : uint8_t { kShape, kLight, kMaterial, kMedium, kTexture };
inline constexpr std::array<std::string_view, 5> kAttributeTargets = {"shape", "light", "material", "medium",
                                                                      "texture"};

struct GraphicsState {
  TransformPair ctm;                            // the current transform
  bool start_active = true, end_active = true;  // which of the two the transform directives change
  bool reverse_orientation = false;
  ColorSpace color_space = ColorSpace::kSrgb;  // of rgb values that follow
  int material = -1;                           // index into the description's materials
  int area_light = -1;                         // index into the description's area lights

  // ctm = ctm * t, for the active ones.
  void concat(const Transform& t) {
    if (start_active) ctm.start = ctm.start * t;
    if (end_active) ctm.end = ctm.end * t;
  }
  void replace(const Transform& t) {
    if (start_active) ctm.start = t;
    if (end_active) ctm.end = t;
  }
};

// An open AttributeBegin, TransformBegin or ObjectBegin.
struct Block {
  enum class Kind : uint8_t { kAttribute, kTransform, kObject };
  Kind kind;
  SourceLoc loc;
  GraphicsState outside;
  size_t defaults_outside;  // mark of Parser::defaults
};
inline std::string_view block_name(Block::Kind kind) {
  return kind == Block::Kind::kAttribute ? "Attribute" : kind == Block::Kind::kTransform ? "Transform" : "Object";
}

}  // namespace etd::pbrt
