// Maps a place on a surface to the coordinates of a texture, and to how far they change over a pixel: two of them for
// images and patterns on a surface, three for solid textures.
#pragma once

#include "params/declaration.h"
#include "textures/texture.h"

namespace etd {

class TextureBuilder;

// Coordinates in two dimensions, and their change along both axes of the footprint.
struct MappedPoint2 {
  Vec2 st, dx, dy;
};
// The same in texture space, which is object space where the texture was defined.
struct MappedPoint3 {
  Point3 p;
  Vec3 dx, dy;
};

struct Mapping2 {
  enum class Kind : uint8_t { kUv, kSpherical, kCylindrical, kPlanar };

  Kind kind = Kind::kUv;
  int32_t space = -1;                    // of the table; none for kUv
  float su = 1, sv = 1, du = 0, dv = 0;  // kUv: factors and what is added; kPlanar: what is added
  Vec3 v1{1, 0, 0}, v2{0, 1, 0};         // kPlanar

  static Mapping2 create(const ParamReader& p, TextureBuilder& b);
  // Always finite: coordinates beyond all numbers count as 0, and so do changes.
  MappedPoint2 operator()(const TexCoord& at, const TextureTable& table) const;
};

struct Mapping3 {
  int32_t space = -1;

  static Mapping3 create(const ParamReader& p, TextureBuilder& b);
  // Always finite.
  MappedPoint3 operator()(const TexCoord& at, const TextureTable& table) const;
};

// A declaration with the parameters of Mapping2 behind its own.
ModelDecl with_mapping(ModelDecl decl);
// Warns of parameters of Mapping2 that are given to a texture that does not read them.
void warn_of_unread_mapping(const ParamReader& p, std::initializer_list<std::string_view> unread,
                            std::string_view reader);

}  // namespace etd
