#include "textures/imagemap.h"

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
         .doc = "Interpolation; trilinear and ewa read the finest level bilinearly until mip levels come."},
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
         .doc = "How integers in the file stand for values: sRGB (default), linear, or gamma X."}}});
  return d;
}

namespace {

bool has_alpha(const Image& img) {
  if (img.channels() < 4) return false;
  for (int y = 0; y < img.height(); ++y)
    for (int x = 0; x < img.width(); ++x)
      if (img.texel(x, y, 3) != 1.0f) return true;
  return false;
}

}  // namespace

ImageMapTexture ImageMapTexture::create(const ParamReader& p, TextureBuilder& b) {
  ImageMapTexture t;
  const std::string filter = p.string("filter"), wrap = p.string("wrap");
  t.nearest = filter == "point";
  t.wrap = wrap == "black"              ? Wrap::kBlack
           : wrap == "clamp"            ? Wrap::kClamp
           : wrap == "octahedralsphere" ? Wrap::kOctahedralSphere
                                        : Wrap::kRepeat;
  t.mapping = Mapping2::create(p, b);
  t.scale = static_cast<float>(p.number("scale"));
  t.invert = p.boolean("invert");
  const Param* encoding = p.given("encoding");
  if (const Param* file = p.given("filename"))
    t.image = b.image(*file, encoding ? encoding->strings[0] : "sRGB", p.diagnostics());
  if (b.is_float()) t.channels = t.image >= 0 && has_alpha(b.image_at(t.image)) ? Channels::kAlpha : Channels::kMean;
  return t;
}

namespace {

// The texel that index i stands for, or -1 for black.
int wrapped(int i, int n, ImageMapTexture::Wrap wrap) {
  if (i >= 0 && i < n) return i;
  if (wrap == ImageMapTexture::Wrap::kBlack) return -1;
  if (wrap == ImageMapTexture::Wrap::kClamp) return i < 0 ? 0 : n - 1;
  return (i % n + n) % n;
}

// Beyond an edge of an octahedral map lies the same edge, walked backwards.
void wrap_octahedral(int& x, int& y, int w, int h) {
  if (x < 0 || x >= w) {
    x = x < 0 ? -x - 1 : 2 * w - 1 - x;
    y = h - 1 - y;
  }
  if (y < 0 || y >= h) {
    y = y < 0 ? -y - 1 : 2 * h - 1 - y;
    x = w - 1 - x;
  }
  x = std::clamp(x, 0, w - 1);
  y = std::clamp(y, 0, h - 1);
}

}  // namespace

Spectrum ImageMapTexture::texel(const Image& img, int x, int y) const {
  if (wrap == Wrap::kOctahedralSphere)
    wrap_octahedral(x, y, img.width(), img.height());
  else
    x = wrapped(x, img.width(), wrap), y = wrapped(y, img.height(), wrap);
  if (x < 0 || y < 0) return Spectrum();
  if (img.channels() == 1) return Spectrum(img.texel(x, y, 0));
  if (channels == Channels::kAlpha) return Spectrum(img.texel(x, y, 3));
  const Spectrum color = Spectrum::rgb(img.texel(x, y, 0), img.texel(x, y, 1), img.texel(x, y, 2));
  return channels == Channels::kMean ? Spectrum(mean_value(color)) : color;
}

Spectrum ImageMapTexture::eval(const TexCoord& at, const TextureTable& table) const {
  const Image& img = table.images[static_cast<size_t>(image)];
  const Vec2 st = mapping(at, table).st;
  // Far outside, whole repetitions are taken off first so that float coordinates keep their precision.
  const bool repeats = wrap == Wrap::kRepeat;
  const float s = repeats ? st.x - std::floor(st.x) : clamp(st.x, -1.0f, 2.0f);
  const float t = repeats ? (1.0f - st.y) - std::floor(1.0f - st.y) : clamp(1.0f - st.y, -1.0f, 2.0f);
  const float x = s * static_cast<float>(img.width()), y = t * static_cast<float>(img.height());
  Spectrum value;
  if (nearest) {
    value = texel(img, static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
  } else {
    const float fx = std::floor(x - 0.5f), fy = std::floor(y - 0.5f);
    const int ix = static_cast<int>(fx), iy = static_cast<int>(fy);
    const float dx = x - 0.5f - fx, dy = y - 0.5f - fy;
    value = (texel(img, ix, iy) * (1 - dx) + texel(img, ix + 1, iy) * dx) * (1 - dy) +
            (texel(img, ix, iy + 1) * (1 - dx) + texel(img, ix + 1, iy + 1) * dx) * dy;
  }
  value *= scale;
  return max(invert ? Spectrum(1.0f) - value : value, 0.0f);
}

}  // namespace etd
