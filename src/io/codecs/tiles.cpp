// Files of tiles, as OpenImageIO writes and caches them.
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <atomic>
#include <mutex>

#include <fmt/format.h>

#include "io/codecs/codecs.h"
#include "io/codecs/oiio_setup.h"
#include "io/pending_file.h"

namespace etd {
namespace {

constexpr int kTile = CachedTexels::kTile;

OIIO::TypeDesc stored_type(TexelFormat::Kind kind) {
  if (kind == TexelFormat::Kind::kByte) return OIIO::TypeDesc::UINT8;
  return kind == TexelFormat::Kind::kHalf ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT;
}

std::optional<TexelFormat::Kind> kind_of(OIIO::TypeDesc type) {
  for (const auto kind : {TexelFormat::Kind::kByte, TexelFormat::Kind::kHalf, TexelFormat::Kind::kFloat})
    if (type == stored_type(kind)) return kind;
  return {};
}

// Nothing that a library could take for colours or alpha, and multiply.
OIIO::ImageSpec spec_of(const Image& level, const std::string& description) {
  OIIO::ImageSpec spec(level.width(), level.height(), level.channels(), stored_type(level.format().kind()));
  spec.tile_width = spec.tile_height = kTile;
  spec.tile_depth = 1;
  spec.alpha_channel = -1;
  for (size_t c = 0; c < spec.channelnames.size(); ++c) spec.channelnames[c] = fmt::format("channel{}", c);
  spec["oiio:UnassociatedAlpha"] = 1;
  spec["compression"] = "zip:1";
  spec["tiff:half"] = 1;  // otherwise halves become floats
  spec["ImageDescription"] = description;
  return spec;
}

// Lines of text: the encoding, then the notes.
std::string description_of(const TiledInfo& info) {
  std::string text = image_encoding_name(info.encoding);
  for (const std::string& note : info.notes) text += "\n" + note;
  return text;
}

std::optional<TiledInfo> parse_description(std::string_view text) {
  const auto take_line = [&text] {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    return line;
  };
  const auto encoding = parse_image_encoding(take_line());
  if (!encoding) return {};
  TiledInfo info{*encoding, {}};
  while (!text.empty()) info.notes.emplace_back(take_line());
  return info;
}

bool write_tiles(OIIO::ImageOutput& out, const Image& level) {
  const size_t texel = level.format().bytes() * static_cast<size_t>(level.channels());
  std::vector<std::byte> tile(kTile * kTile * texel);
  for (int y = 0; y < level.height(); y += kTile)
    for (int x = 0; x < level.width(); x += kTile) {
      std::fill(tile.begin(), tile.end(), std::byte{0});
      for (int row = 0; row < std::min(kTile, level.height() - y); ++row)
        level.copy_row(x, y + row, std::min(kTile, level.width() - x), &tile[static_cast<size_t>(row) * kTile * texel]);
      if (!out.write_tile(x, y, 0, stored_type(level.format().kind()), tile.data())) return false;
    }
  return true;
}

}  // namespace

class OiioTiles : public TileCache {
 public:
  explicit OiioTiles(size_t bytes);
  ~OiioTiles() override { OIIO::ImageCache::destroy(cache_); }

  std::shared_ptr<const CachedImage> open(const std::filesystem::path& path, std::string& error) override;
  size_t bytes_in_use() const override;
  std::string read_error() const override;
  const std::byte* hold(const CachedImage& image, int level, int tile_x, int tile_y, void*& tile) override;
  void release(void* tile) override { cache_->release_tile(static_cast<OIIO::ImageCache::Tile*>(tile)); }

 private:
  OIIO::ImageCache* cache_ = nullptr;
  std::atomic<bool> failed_ = false;
  mutable std::mutex mutex_;
  std::string first_error_;
};

OiioTiles::OiioTiles(size_t bytes) {
  prepare_oiio();
  cache_ = OIIO::ImageCache::create(false);
  cache_->attribute("max_memory_MB", static_cast<float>(static_cast<double>(bytes) / (1 << 20)));
  cache_->attribute("autotile", 0);
  cache_->attribute("automip", 0);
  cache_->attribute("forcefloat", 0);
  cache_->attribute("unassociatedalpha", 1);
  cache_->attribute("trust_file_extensions", 0);
}

std::shared_ptr<const CachedImage> OiioTiles::open(const std::filesystem::path& path, std::string& error) {
  auto image = std::make_shared<CachedImage>();
  image->tiles_ = this;
  const OIIO::ustring name(path.string());
  OIIO::ImageCache::ImageHandle* handle = cache_->get_image_handle(name);
  image->handle_ = handle;
  for (OIIO::ImageSpec spec; handle && cache_->get_imagespec(handle, nullptr, spec, image->levels());) {
    const auto kind = kind_of(spec.format);
    const bool first = image->levels_.empty();
    const auto info = parse_description(spec.get_string_attribute("ImageDescription"));
    if (!info || !kind || spec.tile_width != kTile || spec.tile_height != kTile ||
        (!first && spec.nchannels != image->channels_)) {
      image->levels_.clear();
      break;
    }
    image->channels_ = spec.nchannels;
    image->info_ = *info;
    image->levels_.push_back({spec.width, spec.height, TexelFormat(*kind, info->encoding)});
  }
  error = cache_->geterror();
  if (!image->levels_.empty()) return image;
  if (error.empty()) error = "it is no file of tiles";
  cache_->invalidate(name);
  return nullptr;
}

size_t OiioTiles::bytes_in_use() const {
  int64_t bytes = 0;
  cache_->getattribute("stat:cache_memory_used", OIIO::TypeDesc::INT64, &bytes);
  return static_cast<size_t>(std::max<int64_t>(bytes, 0));
}

std::string OiioTiles::read_error() const {
  const std::lock_guard lock(mutex_);
  return first_error_;
}

const std::byte* OiioTiles::hold(const CachedImage& image, int level, int tile_x, int tile_y, void*& tile) {
  auto* handle = static_cast<OIIO::ImageCache::ImageHandle*>(image.handle_);
  OIIO::ImageCache::Tile* found =
      cache_->get_tile(handle, cache_->get_perthread_info(), level, 0, tile_x * kTile, tile_y * kTile, 0);
  tile = found;
  if (found) {
    OIIO::TypeDesc type;
    return static_cast<const std::byte*>(cache_->tile_pixels(found, type));
  }
  if (failed_.exchange(true)) return nullptr;
  const std::lock_guard lock(mutex_);
  first_error_ = cache_->geterror();
  if (first_error_.empty()) first_error_ = "a tile could not be read";
  return nullptr;
}

std::unique_ptr<TileCache> OiioCodecs::tile_cache(size_t bytes) const { return std::make_unique<OiioTiles>(bytes); }

std::string OiioCodecs::write_tiled_levels(const std::filesystem::path& path, const TiledInfo& info,
                                           const std::function<const Image*()>& next) const {
  prepare_oiio();
  PendingFile file(path);
  if (!file.error().empty()) return file.error();
  try {
    const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create("tiff");
    if (out == nullptr) return OIIO::geterror();
    auto mode = OIIO::ImageOutput::Create;
    while (const Image* level = next()) {
      if (!out->open(file.path().string(), spec_of(*level, description_of(info)), mode) || !write_tiles(*out, *level))
        return out->geterror();
      mode = OIIO::ImageOutput::AppendSubimage;
    }
    if (!out->close()) return out->geterror();
  } catch (const std::exception& error) {
    return error.what();
  }
  return file.commit();
}

}  // namespace etd
