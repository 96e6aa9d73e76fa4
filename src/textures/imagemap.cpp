#include "textures/imagemap.h"

#include "io/layer_param.h"

namespace etd {

const ModelDecl& ImageMapTexture::decl() {
  static const ModelDecl d = with_mapping(
      {Family::kTexture,
       "imagemap",
       "An image file; of a float texture, its alpha if it is anywhere below 1, otherwise the mean of its colours.",
       {{.name = "filename",
         .type = ParamType::kString,
         .required = true,
         .doc = "The file, relative to the scene's folder: PNG, JPEG, TGA, TIFF, EXR, HDR, PFM."},
        {.name = "filter",
         .type = ParamType::kString,
         .default_value = std::string("bilinear"),
         .choices = {"point", "bilinear", "trilinear", "ewa"},
         .doc = "The nearest texel, or bilinear between texels; or over the footprint of a pixel, which is taken as a "
                "square (trilinear) or an ellipse (ewa)."},
        {.name = "maxanisotropy",
         .default_value = 8.0,
         .min = 1,
         .max = 1024,
         .doc = "Filter ewa: how much longer than wide an ellipse may be; longer ones are widened."},
        {.name = "wrap",
         .type = ParamType::kString,
         .default_value = std::string("repeat"),
         .choices = {"repeat", "black", "clamp", "octahedralsphere"},
         .doc = "What lies outside the unit square."},
        {.name = "scale", .default_value = 1.0, .doc = "Factor on the values."},
        {.name = "invert",
         .type = ParamType::kBool,
         .default_value = false,
         .doc = "Use one minus the scaled value instead."},
        {.name = "encoding",
         .type = ParamType::kString,
         .doc =
             "How integers in the file stand for values: sRGB, linear, or gamma X; otherwise what a PNG file says, and "
             "sRGB where none does."},
        layer_param()}});
  return d;
}

ImageMapTexture ImageMapTexture::create(const ParamReader& p, TextureBuilder& b) {
  ImageMapTexture t;
  const std::string filter = p.string("filter"), wrap = p.string("wrap");
  t.filter = filter == "point"       ? ImageFilter::kPoint
             : filter == "trilinear" ? ImageFilter::kTrilinear
             : filter == "ewa"       ? ImageFilter::kEwa
                                     : ImageFilter::kBilinear;
  t.wrap = wrap == "black"              ? ImageWrap::kBlack
           : wrap == "clamp"            ? ImageWrap::kClamp
           : wrap == "octahedralsphere" ? ImageWrap::kOctahedralSphere
                                        : ImageWrap::kRepeat;
  t.max_anisotropy = static_cast<float>(p.number("maxanisotropy"));
  t.mapping = Mapping2::create(p, b);
  t.scale = static_cast<float>(p.number("scale"));
  t.invert = p.boolean("invert");
  t.is_float = b.is_float();
  const bool over_footprint = t.filter == ImageFilter::kTrilinear || t.filter == ImageFilter::kEwa;
  const Param* encoding = p.given("encoding");
  if (encoding && encoding->strings[0].empty())
    p.diagnostics().error(encoding->value_loc, "the image encoding is empty",
                          "valid: \"sRGB\", \"linear\", \"gamma 2.2\", or no \"encoding\" for what the file says");
  if (const Param* file = p.given("filename"))
    t.image = b.image(*file, encoding ? encoding->strings[0] : "", layer_name(p),
                      over_footprint ? std::optional(t.wrap) : std::nullopt, p.diagnostics());
  return t;
}

Spectrum ImageMapTexture::eval(const TexCoord& at, const TextureTable& table, const ShadingContext&) const {
  const TextureImage& source = table.images[static_cast<size_t>(image)];
  const MappedPoint2 m = mapping(at, table);
  const Spectrum rgba =
      source.lookup({{m.st.x, 1.0f - m.st.y}, {m.dx.x, -m.dx.y}, {m.dy.x, -m.dy.y}, filter, wrap, max_anisotropy});
  Spectrum value = Spectrum::rgb(rgba[0], rgba[1], rgba[2]);
  if (is_float && source.channels() > 1) value = Spectrum(source.channels() == 4 ? rgba[3] : mean_value(value));
  value *= scale;
  return max(invert ? Spectrum(1.0f) - value : value, 0.0f);
}

}  // namespace etd
