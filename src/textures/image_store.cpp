#include "textures/image_store.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <set>
#include <system_error>

#include "core/hash.h"
#include "io/layer_param.h"
#include "io/missing_file.h"
#include "textures/pyramid.h"

namespace etd {

namespace fs = std::filesystem;

size_t TextureMemory::half_of_the_machine() {
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  return pages > 0 && page > 0 ? static_cast<size_t>(pages) * static_cast<size_t>(page) / 2 : size_t{1} << 30;
}

fs::path TextureMemory::usual_cache_folder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && fs::path(cache).is_absolute())
    return fs::path(cache) / "etendue" / "textures";
  if (const char* home = std::getenv("HOME"); home && fs::path(home).is_absolute())
    return fs::path(home) / ".cache" / "etendue" / "textures";
  std::error_code failed;
  return fs::temp_directory_path(failed) / "etendue-textures";
}

int32_t ImageStore::add(const Param& filename, std::string_view encoding, const std::string& layer,
                        std::optional<ImageWrap> levels, Diagnostics& diagnostics) {
  const auto parsed = parse_image_encoding(encoding);
  if (!parsed && !encoding.empty()) {
    diagnostics.error(filename.value_loc, fmt::format("unknown image encoding \"{}\"", encoding),
                      "valid: \"sRGB\", \"linear\", \"gamma 2.2\"");
    return -1;
  }
  const fs::path path = folder_ / filename.strings[0];
  const std::string options_text = fmt::format("{}\n{}", encoding, layer);
  const auto [known, is_new] =
      index_of_.try_emplace({path.string(), options_text, levels}, static_cast<int32_t>(requests_.size()));
  if (!is_new) return known->second;
  const std::string& name = filename.strings[0];
  const auto given = given_.find(name);
  if (given != given_.end() && !layer.empty())
    diagnostics.warning(filename.loc, fmt::format("\"layer\" changes nothing: image \"{}\" is in memory", name));
  requests_.push_back({path,
                       {parsed, layer, diagnostics.limits()},
                       options_text,
                       levels,
                       filename.value_loc,
                       name,
                       given == given_.end() ? nullptr : given->second});
  table_.images.emplace_back();
  return known->second;
}

void ImageStore::load(const TextureMemory& memory, Diagnostics& diagnostics) {
  size_t needed = 0;
  std::set<std::pair<fs::path, std::string>> counted;
  for (const Request& r : requests_) {
    if (r.given) continue;
    const size_t finest = image_bytes(r.path, r.options);
    if (counted.emplace(r.path, r.options_text).second) needed += finest;
    if (r.levels) needed += finest * 2 / 3;  // a third of the texels, of up to twice the size
  }
  const bool fits = needed <= memory.limit;
  if (!fits && !table_.cache) {
    table_.cache = std::make_shared<TextureCache>(memory.limit);
    table_.cache_limit = memory.limit;
  }
  for (; loaded_ < requests_.size(); ++loaded_)
    table_.images[loaded_] = fits || requests_[loaded_].given
                                 ? in_memory(requests_[loaded_], diagnostics)
                                 : from_tiles(requests_[loaded_], memory.cache_folder, diagnostics);
}

std::optional<ImageResult> ImageStore::read(const Request& r, Diagnostics& diagnostics) const {
  ImageResult result = read_finite_image(r.path, r.options);
  if (!result.image) {
    diagnostics.error(r.loc, fmt::format("cannot read image \"{}\": {}", r.name, result.error),
                      result.needs_layer ? kLayerHint : missing_file_hint({folder_}, r.name));
    return {};
  }
  result.image = without_opaque_alpha(std::move(*result.image));
  return result;
}

void ImageStore::report(const Request& r, const std::vector<std::string>& notes, Diagnostics& diagnostics) const {
  for (const std::string& note : notes) diagnostics.note(r.loc, fmt::format("image \"{}\": {}", r.name, note));
}

std::shared_ptr<const Image> ImageStore::finest(const Request& r, Diagnostics& diagnostics) {
  if (r.given) return r.given;
  const auto [it, is_new] = finest_.try_emplace({r.path.string(), r.options_text}, nullptr);
  if (is_new)
    if (std::optional<ImageResult> result = read(r, diagnostics)) {
      report(r, result->notes, diagnostics);
      it->second = std::make_shared<const Image>(std::move(*result->image));
    }
  return it->second;
}

TextureImage ImageStore::in_memory(const Request& r, Diagnostics& diagnostics) {
  const std::shared_ptr<const Image> image = finest(r, diagnostics);
  if (!image) return {};
  return TextureImage(image, r.levels ? coarser_levels(*image, *r.levels) : std::vector<Image>());
}

namespace {

uint64_t hash_text(std::string_view text, uint64_t seed) {
  uint64_t h = hash_combine(seed, text.size());
  for (const char c : text) h = hash_combine(h, static_cast<unsigned char>(c));
  return h;
}

// Named by all that its content depends on: which file, of what size, changed when, read and filtered how.
std::string tile_file_name(const fs::path& path, std::string_view options, std::optional<ImageWrap> levels) {
  constexpr int kVersion = 2;  // of what the files hold
  std::error_code failed;
  const fs::path canonical = fs::weakly_canonical(path, failed);
  const auto changed = fs::last_write_time(path, failed).time_since_epoch().count();
  const std::string identity =
      fmt::format("{}\n{}\n{}\n{}\n{}\n{}", kVersion, canonical.string(), fs::file_size(path, failed), changed, options,
                  levels ? static_cast<int>(*levels) : -1);
  return fmt::format("{:.40}-{:016x}{:016x}.tif", path.stem().string(), hash_text(identity, 1), hash_text(identity, 2));
}

}  // namespace

bool ImageStore::convert(const Request& r, const fs::path& to, Diagnostics& diagnostics) const {
  const std::optional<ImageResult> read_result = read(r, diagnostics);
  if (!read_result) return false;
  const Image* const finest = &*read_result->image;
  std::optional<Image> coarse;
  const Image* last = nullptr;
  const auto next = [&]() -> const Image* {
    if (!last) return last = finest;
    if (!r.levels || (last->width() == 1 && last->height() == 1)) return nullptr;
    coarse = coarser_level(*last, *r.levels);
    return last = &*coarse;
  };
  std::error_code failed;
  fs::create_directories(to.parent_path(), failed);
  const std::string problem =
      failed ? failed.message() : write_tiled_levels(to, {read_result->encoding, read_result->notes}, next);
  if (problem.empty()) return true;
  diagnostics.error(r.loc, fmt::format("cannot write to the texture cache {}: {}", to.parent_path().string(), problem),
                    "the images need more than --texture-memory; --texture-cache names another folder for them");
  return false;
}

TextureImage ImageStore::from_tiles(const Request& r, const fs::path& cache_folder, Diagnostics& diagnostics) {
  std::error_code failed;
  if (!fs::is_regular_file(r.path, failed)) return read(r, diagnostics), TextureImage();
  const fs::path tiles = cache_folder / tile_file_name(r.path, r.options_text, r.levels);
  std::string error;
  const auto open = [&]() -> std::optional<TextureImage> {
    auto image = table_.cache->open(tiles, error);
    if (!image) return {};
    report(r, image->info().notes, diagnostics);
    return TextureImage(std::move(image));
  };
  const bool was_there = fs::exists(tiles, failed);
  if (!was_there && !convert(r, tiles, diagnostics)) return {};
  if (auto image = open()) return *image;
  // A file that another version left, or that was damaged.
  if (was_there && !convert(r, tiles, diagnostics)) return {};
  if (auto image = open()) return *image;
  diagnostics.error(r.loc, fmt::format("cannot read {} of the texture cache: {}", tiles.string(), error));
  return {};
}

}  // namespace etd
