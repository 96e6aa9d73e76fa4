// The images that a scene's textures ask for: each file is read once, into memory if all of them fit, otherwise by way
// of files of tiles in a folder that later renders use again. Images that are in memory already stay there.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "io/named_images.h"
#include "params/declaration.h"
#include "textures/texture.h"

namespace etd {

struct TextureMemory {
  size_t limit = half_of_the_machine();                       // bytes of texels in memory
  std::filesystem::path cache_folder = usual_cache_folder();  // of the files of tiles

  static size_t half_of_the_machine();
  // $XDG_CACHE_HOME/etendue/textures, or ~/.cache/etendue/textures, or a folder among the temporary ones.
  static std::filesystem::path usual_cache_folder();
};

class ImageStore {
 public:
  // `given`: images that are no files.
  ImageStore(TextureTable& table, std::filesystem::path folder, NamedImages given)
      : table_(table), folder_(std::move(folder)), given_(std::move(given)) {}

  // Index of an image of the table, which load() will read; with coarser levels if it says how the image is wrapped for
  // them. An empty encoding is the one that the file says. -1 and an error for an unknown encoding.
  int32_t add(const Param& filename, std::string_view encoding, const std::string& layer,
              std::optional<ImageWrap> levels, Diagnostics& diagnostics);
  // Reads the images that were added since the last call, and reports those that can't be read.
  void load(const TextureMemory& memory, Diagnostics& diagnostics);

 private:
  struct Request {
    std::filesystem::path path;
    ImageOptions options;
    std::string options_text;  // tells them apart
    std::optional<ImageWrap> levels;
    SourceLoc loc;
    std::string name;                    // as the scene writes it
    std::shared_ptr<const Image> given;  // null: it is a file
  };

  // Null and an error when the image can't be read.
  std::shared_ptr<const Image> finest(const Request& r, Diagnostics& diagnostics);
  TextureImage in_memory(const Request& r, Diagnostics& diagnostics);
  TextureImage from_tiles(const Request& r, const std::filesystem::path& cache_folder, Diagnostics& diagnostics);
  std::optional<ImageResult> read(const Request& r, Diagnostics& diagnostics) const;
  void report(const Request& r, const std::vector<std::string>& notes, Diagnostics& diagnostics) const;
  // Makes the file of tiles. False and an error when that fails.
  bool convert(const Request& r, const std::filesystem::path& to, Diagnostics& diagnostics) const;

  TextureTable& table_;
  std::filesystem::path folder_;
  NamedImages given_;
  std::vector<Request> requests_;  // by index in the table
  std::map<std::tuple<std::string, std::string, std::optional<ImageWrap>>, int32_t> index_of_;
  size_t loaded_ = 0;
  std::map<std::pair<std::string, std::string>, std::shared_ptr<const Image>> finest_;  // by path and options
};

}  // namespace etd
