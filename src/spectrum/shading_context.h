// What textures, materials, lights and media are told when a ray asks them for a value, beside the place. It is one
// struct, so that what they will be told later (the wavelengths of a path, a medium) changes no model's signature. It
// stands in this room because those wavelengths will.
#pragma once

namespace etd {

struct ShadingContext {
  float time = 0;  // that of the ray
};

}  // namespace etd
