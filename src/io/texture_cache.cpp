#include "io/texture_cache.h"

#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>

#include <fmt/format.h>

#include "io/oiio_setup.h"
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

std::string write_tiled_levels(const std::filesystem::path& path, const TiledInfo& info,
                               const std::function<const Image*()>& next) {
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

struct TextureCache::Impl {
  OIIO::ImageCache* cache = nullptr;
  std::atomic<bool> failed = false;
  mutable std::mutex mutex;
  std::string first_error;
};

TextureCache::TextureCache(size_t bytes) : impl_(std::make_unique<Impl>()) {
  prepare_oiio();
  impl_->cache = OIIO::ImageCache::create(false);
  impl_->cache->attribute("max_memory_MB", static_cast<float>(static_cast<double>(bytes) / (1 << 20)));
  impl_->cache->attribute("autotile", 0);
  impl_->cache->attribute("automip", 0);
  impl_->cache->attribute("forcefloat", 0);
  impl_->cache->attribute("unassociatedalpha", 1);
  impl_->cache->attribute("trust_file_extensions", 0);
}

TextureCache::~TextureCache() { OIIO::ImageCache::destroy(impl_->cache); }

std::shared_ptr<const CachedImage> TextureCache::open(const std::filesystem::path& path, std::string& error) {
  auto image = std::make_shared<CachedImage>();
  image->cache_ = this;
  OIIO::ImageCache& cache = *impl_->cache;
  const OIIO::ustring name(path.string());
  OIIO::ImageCache::ImageHandle* handle = cache.get_image_handle(name);
  image->handle_ = handle;
  for (OIIO::ImageSpec spec; handle && cache.get_imagespec(handle, nullptr, spec, image->levels());) {
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
  error = cache.geterror();
  if (!image->levels_.empty()) return image;
  if (error.empty()) error = "it is no file of tiles";
  cache.invalidate(name);
  return nullptr;
}

size_t TextureCache::bytes_in_use() const {
  int64_t bytes = 0;
  impl_->cache->getattribute("stat:cache_memory_used", OIIO::TypeDesc::INT64, &bytes);
  return static_cast<size_t>(std::max<int64_t>(bytes, 0));
}

std::string TextureCache::read_error() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->first_error;
}

void CachedTexels::fetch(int level, int tile_x, int tile_y) {
  release();
  level_ = level, tile_x_ = tile_x, tile_y_ = tile_y;
  TextureCache::Impl& impl = *image_.cache_->impl_;
  OIIO::ImageCache& cache = *impl.cache;
  auto* handle = static_cast<OIIO::ImageCache::ImageHandle*>(image_.handle_);
  OIIO::ImageCache::Tile* tile =
      cache.get_tile(handle, cache.get_perthread_info(), level, 0, tile_x * kTile, tile_y * kTile, 0);
  if (tile) {
    OIIO::TypeDesc type;
    tile_ = tile;
    texels_ = static_cast<const std::byte*>(cache.tile_pixels(tile, type));
    return;
  }
  if (impl.failed.exchange(true)) return;
  const std::lock_guard lock(impl.mutex);
  impl.first_error = cache.geterror();
  if (impl.first_error.empty()) impl.first_error = "a tile could not be read";
}

void CachedTexels::release() {
  if (tile_) image_.cache_->impl_->cache->release_tile(static_cast<OIIO::ImageCache::Tile*>(tile_));
  tile_ = nullptr;
  texels_ = nullptr;
}

}  // namespace etd
