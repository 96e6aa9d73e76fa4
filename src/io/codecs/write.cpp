// Writes images as OpenImageIO does.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>

#include "io/codecs/codecs.h"
#include "io/codecs/oiio_setup.h"
#include "io/pending_file.h"
#include "spectrum/srgb.h"

namespace etd {
namespace {

namespace fs = std::filesystem;

// Encoders put their bytes here. They notice a full disk late, never, or by ending the process: so they are told that
// all went well, and the file knows what did not.
class FileProxy : public OIIO::Filesystem::IOProxy {
 public:
  FileProxy(const fs::path& path, PendingFile& file) : IOProxy(path.string(), Write), file_(file) {}
  const char* proxytype() const override { return "pending"; }
  bool seek(int64_t offset) override { return file_.seek(m_pos = offset), true; }
  size_t write(const void* bytes, size_t size) override {
    file_.write(bytes, size);
    m_pos += static_cast<int64_t>(size);
    end_ = std::max(end_, m_pos);
    return size;
  }
  size_t pwrite(const void* bytes, size_t size, int64_t offset) override {
    const int64_t back = m_pos;
    seek(offset);
    write(bytes, size);
    seek(back);
    return size;
  }
  size_t size() const override { return static_cast<size_t>(end_); }

 private:
  PendingFile& file_;
  int64_t end_ = 0;
};

std::string reason(std::string error) { return error.empty() ? "the encoder gives no reason" : error; }

// Encodes rows strip by strip; `value` makes what is stored out of each of their floats and its channel. Returns what
// went wrong, or an empty string.
template <class Value>
std::string encode_rows(const fs::path& path, const OIIO::ImageSpec& spec, const RowSource& append_row, Value value) {
  using Stored = decltype(value(0.0f, size_t{}));
  constexpr int kStrip = 16;  // as many rows as EXR compresses together
  prepare_oiio();
  PendingFile file(path);
  if (!file.error().empty()) return file.error();
  FileProxy proxy(path, file);  // outlives the encoder, which may write when it is destroyed
  const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(path.string());
  if (out == nullptr) return reason(OIIO::geterror());
  if (!out->set_ioproxy(&proxy) || !out->open(path.string(), spec)) return reason(out->geterror());
  std::vector<float> rows;
  std::vector<Stored> stored;
  for (int begin = 0; begin < spec.height && file.error().empty(); begin += kStrip) {
    const int end = std::min(begin + kStrip, spec.height);
    rows.clear();
    for (int row = begin; row < end; ++row) append_row(row, rows);
    stored.resize(rows.size());
    for (size_t i = 0; i < rows.size(); ++i) stored[i] = value(rows[i], i % static_cast<size_t>(spec.nchannels));
    if (!out->write_scanlines(spec.y + begin, spec.y + end, 0, OIIO::BaseTypeFromC<Stored>::value, stored.data()))
      return reason(out->geterror());
  }
  if (file.error().empty() && !out->close()) return reason(out->geterror());
  return file.commit();
}

void add_metadata(OIIO::ImageSpec& spec, const std::string& name, const MetadataValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) spec.attribute(name, *text);
  if (const auto* number = std::get_if<int>(&value)) spec.attribute(name, *number);
  if (const auto* number = std::get_if<float>(&value)) spec.attribute(name, *number);
  if (const auto* number = std::get_if<double>(&value))
    spec.attribute(name, OIIO::TypeDesc(OIIO::TypeDesc::DOUBLE), number);
}

// Ids are integers that 16 bits do not hold.
bool is_id(std::string_view channel) { return channel.substr(0, 3) == "id."; }

// Finite values stay finite as 16-bit floats.
float within_half(float v) {
  constexpr float kLargest = 65504;
  return std::isfinite(v) ? std::clamp(v, -kLargest, kLargest) : v;
}

// Shared exponents hold neither negative numbers nor what is no number, and end at 2^127.
float within_shared_exponent(float v) {
  constexpr float kLargest = 0x1.fep126f;
  return v > 0 ? std::min(v, kLargest) : 0.0f;
}

}  // namespace

std::string OiioCodecs::write_8bit(const fs::path& path, int width, int height, const RowSource& rgb, float exposure,
                                   bool alpha, bool jpeg) const {
  OIIO::ImageSpec spec(width, height, alpha ? 4 : 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  if (alpha) spec.attribute("oiio:UnassociatedAlpha", 1);
  if (jpeg) {
    spec.attribute("Compression", "jpeg:95");
    spec.attribute("jpeg:subsampling", "4:4:4");
  }
  return encode_rows(path, spec, rgb, [scale = std::exp2(exposure)](float v, size_t channel) -> uint8_t {
    if (channel < 3) return linear_to_srgb8(v * scale);
    return v > 0 ? static_cast<uint8_t>(255.0f * std::min(v, 1.0f) + 0.5f) : uint8_t{0};
  });
}

std::string OiioCodecs::write_hdr(const fs::path& path, int width, int height, const RowSource& rgb) const {
  return encode_rows(path, OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::FLOAT), rgb,
                     [](float v, size_t) { return within_shared_exponent(v); });
}

std::string OiioCodecs::write_exr(const fs::path& path, const RowImage& image) const {
  OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(image.channels.size()),
                       image.half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
  spec.x = image.x;
  spec.y = image.y;
  spec.full_width = image.full_width;
  spec.full_height = image.full_height;
  spec.channelnames = image.channels;
  spec.attribute("compression", "zip");
  for (const auto& [name, value] : image.metadata) add_metadata(spec, name, value);
  if (!image.half) return encode_rows(path, spec, image.append_row, [](float v, size_t) { return v; });
  for (const std::string& channel : image.channels)
    spec.channelformats.emplace_back(is_id(channel) ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::HALF);
  return encode_rows(path, spec, image.append_row,
                     [&image](float v, size_t channel) { return is_id(image.channels[channel]) ? v : within_half(v); });
}

}  // namespace etd
