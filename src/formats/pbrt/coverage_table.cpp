// The table itself: the models and parameters of the pbrt-v4 file format that have no counterpart yet.
#include <array>

#include "formats/pbrt/coverage.h"

namespace etd::pbrt {

std::span<const UnsupportedModel> unsupported_models() {
  static const std::vector<UnsupportedModel> table = {
      {Family::kShape, "loopsubdiv", "trianglemesh", "its control mesh", {{"P", "P"}, {"indices", "indices"}}},
      {Family::kShape, "curve", "", "no shape"},

      {Family::kMaterial,
       "subsurface",
       "diffuse",
       "a diffuse material of the same reflectance",
       {{"reflectance", "reflectance"}}},
      {Family::kMaterial, "hair", "diffuse", "a diffuse material of the same colour", {{"color", "reflectance"}}},
      {Family::kMaterial, "measured", "diffuse", "a diffuse material of reflectance 0.5", {}, {"reflectance", 0.5}},

      {Family::kTexture, "ptex", "constant", "a constant texture of value 0.5", {}, {"value", 0.5}},

      {Family::kCamera, "realistic", "perspective", "a perspective camera of the default field of view"},

      {Family::kFilm,
       "spectral",
       "rgb",
       "an rgb film",
       {{"filename", "filename"},
        {"xresolution", "xresolution"},
        {"yresolution", "yresolution"},
        {"cropwindow", "cropwindow"},
        {"pixelbounds", "pixelbounds"},
        {"savefp16", "savefp16"},
        {"iso", "iso"},
        {"exposuretime", "exposuretime"},
        {"imagingratio", "imagingratio"},
        {"whitebalance", "whitebalance"},
        {"maxcomponentvalue", "maxcomponentvalue"}}},

      // These compute another quantity, not the same one in another way (render/other_names.h).
      {Family::kIntegrator, "ambientocclusion", "path", "the light of the scene by \"path\", not its occlusion"},
      {Family::kIntegrator, "function", "path", "the light of the scene by \"path\", not the function"},
  };
  return table;
}

std::span<const UnsupportedParam> unsupported_params() {
  static const std::vector<UnsupportedParam> table = {
      {Family::kShape, "trianglemesh", "S", "", "tangents from the texture coordinates"},
      {Family::kShape, "trianglemesh", "faceIndices", "*", "only ptex textures read it"},
      {Family::kShape, "bilinearmesh", "emissionfilename", "*",
       "it guides the sampling of a light and changes no mean"},
      {Family::kShape, "bilinearmesh", "faceIndices", "*", "only ptex textures read it"},
      {Family::kShape, "plymesh", "displacement", "", "the undisplaced surface"},
      {Family::kShape, "plymesh", "edgelength", "*", "only displacement reads it"},

      {Family::kCamera, "spherical", "lensradius", "*", "a spherical camera has no lens"},
      {Family::kCamera, "spherical", "focaldistance", "*", "a spherical camera has no lens"},
      {Family::kCamera, "spherical", "frameaspectratio", "*", "a spherical camera sees all directions"},
      {Family::kCamera, "spherical", "screenwindow", "*", "a spherical camera sees all directions"},

      {Family::kFilm, "", "diagonal", "*", "only realistic cameras read it"},

      {Family::kIntegrator, "sppm", "seed", "*", "photons have the sampler's seed"},
  };
  return table;
}

std::span<const OptionRule> known_options() {
  using Effect = OptionRule::Effect;
  static constexpr std::array<OptionRule, 11> table = {
      {{"seed", Effect::kSeed, "the sampler's seed, unless it has its own"},
       {"rendercoordsys", Effect::kNone, "coordinates are always recentred exactly"},
       {"disabletexturefiltering", Effect::kNoTextureFiltering, "textures are looked up at points if it is true"},
       {"disablewavelengthjitter", Effect::kNone, "there are no wavelengths to sample"},
       {"displacementedgescale", Effect::kNone, "there is no displacement"},
       {"wavefront", Effect::kNone, "it chooses an implementation, not an image"},
       {"disablepixeljitter", Effect::kUnsupportedIfTrue, "samples spread over the pixel filter"},
       {"forcediffuse", Effect::kUnsupportedIfTrue, "the materials as they are"},
       {"pixelstats", Effect::kNote, "no statistics of single pixels are written"},
       {"msereferenceimage", Effect::kNote, "no comparison with a reference is made while rendering"},
       {"msereferenceout", Effect::kNote, "no comparison with a reference is made while rendering"}}};
  return table;
}

}  // namespace etd::pbrt
