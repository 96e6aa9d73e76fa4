// Reads images as OpenImageIO has them.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <type_traits>

#include <fmt/format.h>

#include "io/codecs/codecs.h"
#include "io/codecs/image_channels.h"
#include "io/codecs/oiio_setup.h"
#include "io/image_limits.h"

namespace etd {
namespace {

// Picks the chosen channels out of pixels of `file_channels` interleaved values.
template <class T>
void gather(const std::vector<T>& rows, int file_channels, const std::vector<int>& of_file, std::vector<T>& out) {
  const bool all =
      of_file.size() == static_cast<size_t>(file_channels) && std::is_sorted(of_file.begin(), of_file.end());
  if (all) {
    out.insert(out.end(), rows.begin(), rows.end());
    return;
  }
  for (size_t pixel = 0; pixel < rows.size(); pixel += static_cast<size_t>(file_channels)) {
    for (const int c : of_file) out.push_back(rows[pixel + static_cast<size_t>(c)]);
  }
}

// Reads the whole image a band of rows at a time, so that a header that promises more than the file holds fails before
// the memory for it is touched. Returns what went wrong, or an empty string.
template <class T>
std::string read_texels(OIIO::ImageInput& in, const OIIO::ImageSpec& spec, const ChannelChoice& choice,
                        std::vector<T>& texels) {
  // What OpenImageIO calls half is here its bits.
  const OIIO::TypeDesc type =
      std::is_same_v<T, uint16_t> ? OIIO::TypeDesc::HALF : OIIO::TypeDesc(OIIO::BaseTypeFromC<T>::value);
  const int band = spec.tile_height > 0 ? spec.tile_height : 256;
  texels.reserve(static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height) * choice.of_file.size());
  std::vector<T> rows;
  for (int y = 0; y < spec.height; y += band) {
    const int count = std::min(band, spec.height - y);
    rows.resize(static_cast<size_t>(count) * static_cast<size_t>(spec.width) * static_cast<size_t>(spec.nchannels));
    const int begin = spec.y + y, end = begin + count;
    const bool good = spec.tile_width > 0
                          ? in.read_tiles(choice.part, 0, spec.x, spec.x + spec.width, begin, end, spec.z, spec.z + 1,
                                          0, spec.nchannels, type, rows.data())
                          : in.read_scanlines(choice.part, 0, begin, end, spec.z, 0, spec.nchannels, type, rows.data());
    if (!good) return in.geterror();
    gather(rows, spec.nchannels, choice.of_file, texels);
  }
  return {};
}

// Says where the pixels of an EXR file (its data window) lie in the picture (its display window).
struct Window {
  int x = 0, y = 0, width = 0, height = 0;  // of the pixels, from the picture's top left corner
  int full_width = 0, full_height = 0;

  bool is_all() const { return x == 0 && y == 0 && width == full_width && height == full_height; }
  int x0() const { return std::max(0, x); }
  int x1() const { return std::min(full_width, x + width); }
  int y0() const { return std::max(0, y); }
  int y1() const { return std::min(full_height, y + height); }
};

Window window_of(const OIIO::ImageInput& in, const OIIO::ImageSpec& spec) {
  Window w{0, 0, spec.width, spec.height, spec.width, spec.height};
  if (std::string_view(in.format_name()) != "openexr" || spec.full_width < 1 || spec.full_height < 1) return w;
  return {spec.x - spec.full_x, spec.y - spec.full_y, spec.width, spec.height, spec.full_width, spec.full_height};
}

// The picture: what is outside of it left out, and black where there are no pixels.
template <class T>
void fit_window(std::vector<T>& texels, const Window& w, size_t channels) {
  if (w.is_all()) return;
  std::vector<T> picture(static_cast<size_t>(w.full_width) * static_cast<size_t>(w.full_height) * channels);
  for (int y = w.y0(); y < w.y1(); ++y) {
    const size_t from = static_cast<size_t>(y - w.y) * static_cast<size_t>(w.width) + static_cast<size_t>(w.x0() - w.x);
    const size_t to = static_cast<size_t>(y) * static_cast<size_t>(w.full_width) + static_cast<size_t>(w.x0());
    std::copy_n(&texels[from * channels], static_cast<size_t>(w.x1() - w.x0()) * channels, &picture[to * channels]);
  }
  texels = std::move(picture);
}

void note_window(const Window& w, std::vector<std::string>& notes) {
  const int width = w.x1() - w.x0(), height = w.y1() - w.y0();
  if (width < w.full_width || height < w.full_height)
    notes.push_back(fmt::format("it has {} x {} of the {} x {} pixels of its display window, the others are black",
                                width, height, w.full_width, w.full_height));
  if (width < w.width || height < w.height)
    notes.push_back(fmt::format("of its {} x {} pixels those outside of its display window of {} x {} are left out",
                                w.width, w.height, w.full_width, w.full_height));
}

// What a PNG says of its integers; libpng passes on a gamma only where there is no mark of sRGB. 1 / 2.2 is what the
// standard has sRGB files say to programs that know gammas alone.
std::optional<ImageEncoding> encoding_of(const OIIO::ImageInput& in, const OIIO::ImageSpec& spec) {
  const float gamma = spec.get_float_attribute("oiio:Gamma", 0);
  if (std::string_view(in.format_name()) != "png" || !(gamma > 0) || !std::isfinite(gamma)) return {};
  if (std::abs(gamma - 2.2f) < 0.01f) return ImageEncoding{ImageEncoding::Kind::kSrgb, 1};
  if (std::abs(gamma - 1.0f) < 0.001f) return ImageEncoding{ImageEncoding::Kind::kLinear, 1};
  return ImageEncoding{ImageEncoding::Kind::kGamma, gamma};
}

// Primaries and white of Rec. 709 in the order of EXR's attribute.
void note_chromaticities(const OIIO::ImageSpec& spec, std::vector<std::string>& notes) {
  constexpr float kRec709[] = {0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f};
  float given[8];
  if (!spec.getattribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), given)) return;
  for (size_t i = 0; i < 8; ++i)
    if (!(std::abs(given[i] - kRec709[i]) < 2e-3f)) {
      notes.push_back("its chromaticities are not those of Rec. 709, but its values are taken for that");
      return;
    }
}

std::string one_line(std::string text, std::string_view otherwise) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.empty() ? std::string(otherwise) : text;
}

ImageResult fail(std::string error) { return {std::nullopt, std::move(error), {}, {}, false}; }

template <class T>
std::string read_picture(OIIO::ImageInput& in, const OIIO::ImageSpec& spec, const ChannelChoice& choice,
                         std::vector<T>& texels) {
  std::string error = read_texels(in, spec, choice, texels);
  if (in.has_error() || !error.empty()) return one_line(error + in.geterror(), "its pixels could not be read");
  fit_window(texels, window_of(in, spec), choice.of_file.size());
  return {};
}

// A file that states a size which it can't be worth. Tiles may be larger than the image, and it than its window.
std::string size_problem(const OIIO::ImageSpec& spec, const Window& window, uint64_t file_bytes, const Limits& limits) {
  const auto across = static_cast<uint64_t>(std::max({spec.width, spec.tile_width, window.full_width})),
             down = static_cast<uint64_t>(std::max({spec.height, spec.tile_height, window.full_height}));
  return image_size_problem(across, down, spec.pixel_bytes(true), file_bytes, limits);
}

ImageResult read_open_image(OIIO::ImageInput& in, uint64_t file_bytes, const ImageOptions& options) {
  const ChannelChoice choice = choose_channels(in, options.layer);
  if (!choice.error.empty()) return {{}, choice.error, {}, {}, choice.needs_name};
  const OIIO::ImageSpec spec = in.spec();
  const Window window = window_of(in, spec);
  constexpr int kLargestSide = 1 << 17;
  const auto fits = [](int side) { return side >= 1 && side <= kLargestSide; };
  if (!fits(spec.width) || !fits(spec.height) || !fits(window.full_width) || !fits(window.full_height) ||
      spec.depth > 1)
    return fail(
        fmt::format("it has {} x {} x {} pixels, which no image here can have", spec.width, spec.height, spec.depth));
  if (std::string error = size_problem(spec, window, file_bytes, options.limits); !error.empty()) return fail(error);
  if (spec.deep) return fail("its pixels are deep, with any number of values in each, which is not supported");
  if (window.x0() >= window.x1() || window.y0() >= window.y1())
    return fail("all of its pixels lie outside of its display window");
  const int channels = static_cast<int>(choice.of_file.size());
  ImageResult result;
  result.encoding = options.encoding.value_or(encoding_of(in, spec).value_or(ImageEncoding()));
  if (!choice.note.empty()) result.notes.push_back(choice.note);
  note_window(window, result.notes);
  note_chromaticities(spec, result.notes);

  if (spec.format == OIIO::TypeDesc::UINT8 && spec.channelformats.empty()) {
    std::vector<uint8_t> texels;
    if (std::string error = read_picture(in, spec, choice, texels); !error.empty()) return fail(error);
    result.image = Image(window.full_width, window.full_height, channels, texels, result.encoding);
    return result;
  }
  if (spec.format == OIIO::TypeDesc::HALF && spec.channelformats.empty() && !choice.luminance_chroma) {
    std::vector<uint16_t> texels;
    if (std::string error = read_picture(in, spec, choice, texels); !error.empty()) return fail(error);
    result.image = Image(window.full_width, window.full_height, channels, texels);
    return result;
  }
  std::vector<float> texels;
  if (std::string error = read_picture(in, spec, choice, texels); !error.empty()) return fail(error);
  if (choice.luminance_chroma)
    for (size_t i = 0; i < texels.size(); i += choice.of_file.size()) luminance_chroma_to_rgb(&texels[i]);
  if (!spec.format.is_floating_point()) {
    for (size_t i = 0; i < texels.size(); ++i) {
      const bool is_alpha = channels == 4 && i % 4 == 3;
      if (!is_alpha) texels[i] = result.encoding.to_linear(texels[i]);
    }
  }
  result.image = Image(window.full_width, window.full_height, channels, texels);
  return result;
}

// The file opened as read_image() and image_bytes() want it; null and a reason if it is no image.
std::unique_ptr<OIIO::ImageInput> open_image(const std::filesystem::path& path, std::string& error) {
  prepare_oiio();
  // Otherwise colours would be multiplied by alpha in the encoded bytes, which loses what textures need.
  OIIO::ImageSpec config;
  config["oiio:UnassociatedAlpha"] = 1;
  std::unique_ptr<OIIO::ImageInput> in = OIIO::ImageInput::open(path.string(), &config);
  if (in != nullptr) return in;
  error = one_line(OIIO::geterror(), "not an image of a known format");
  if (error.find("Subsampled") != std::string::npos)
    error = "channels of lower resolution, as chroma often has, are not supported: " + error;
  return in;
}

}  // namespace

ImageResult OiioCodecs::read_image(const std::filesystem::path& path, const ImageOptions& options) const {
  try {
    std::error_code failed;
    const auto file_bytes = std::filesystem::file_size(path, failed);
    std::string error;
    const std::unique_ptr<OIIO::ImageInput> in = open_image(path, error);
    return in ? read_open_image(*in, failed ? 0 : file_bytes, options) : fail(error);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return fail(one_line(error.what(), "it could not be read"));
  }
}

size_t OiioCodecs::image_bytes(const std::filesystem::path& path, const std::string& layer) const {
  std::string error;
  const std::unique_ptr<OIIO::ImageInput> in = open_image(path, error);
  if (in == nullptr) return 0;
  const ChannelChoice choice = choose_channels(*in, layer);
  const OIIO::ImageSpec spec = in->spec();
  const Window window = window_of(*in, spec);
  const bool same = spec.channelformats.empty() && !choice.luminance_chroma;
  const size_t number = same && spec.format == OIIO::TypeDesc::UINT8  ? 1
                        : same && spec.format == OIIO::TypeDesc::HALF ? 2
                                                                      : 4;
  return static_cast<size_t>(std::max(window.full_width, 0)) * static_cast<size_t>(std::max(window.full_height, 0)) *
         choice.of_file.size() * number;
}

}  // namespace etd
