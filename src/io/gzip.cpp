#include "io/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <limits>

#include <fmt/format.h>

namespace etd {

// zlib counts in 32 bits, so both sides go in pieces.
constexpr size_t kPiece = size_t{1} << 20;

FileBytes gunzip(std::string_view compressed, const Limits& limits) {
  FileBytes result;
  const uint64_t most = limits.unpacked_from(compressed.size());
  z_stream stream{};
  constexpr int kLargestWindow = 15, kOnlyGzip = 16;
  if (inflateInit2(&stream, kLargestWindow + kOnlyGzip) != Z_OK) return result.error = "cannot start zlib", result;
  // Room for the most that it can be takes no memory until it is used; growing would copy.
  constexpr uint64_t kLargestRatio = 1032;
  result.bytes.reserve(std::min(most, kLargestRatio * compressed.size()) + kPiece);
  size_t taken = 0;
  int status = Z_OK;
  while (status == Z_OK && result.bytes.size() <= most) {
    const size_t given = std::min<size_t>(compressed.size() - taken, std::numeric_limits<uInt>::max());
    const size_t before = result.bytes.size();
    result.bytes.resize(before + kPiece);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(compressed.data() + taken));
    stream.avail_in = static_cast<uInt>(given);
    stream.next_out = reinterpret_cast<Bytef*>(result.bytes.data() + before);
    stream.avail_out = static_cast<uInt>(kPiece);
    status = inflate(&stream, Z_NO_FLUSH);
    taken += given - stream.avail_in;
    result.bytes.resize(before + kPiece - stream.avail_out);
    // Members may follow each other; anything else behind the last one is padding, as for the gzip program.
    if (status == Z_STREAM_END && is_gzip(compressed.substr(taken))) status = inflateReset(&stream);
  }
  inflateEnd(&stream);
  if (result.bytes.size() > most)
    return {{},
            fmt::format("it unpacks to more than {} bytes, {} times its size; {}", most, most / compressed.size(),
                        limit_text(limits, &Limits::unpacked))};
  if (status == Z_STREAM_END) return result;
  result.error = status == Z_BUF_ERROR ? std::string("the compressed data end early")
                                       : fmt::format("the compressed data are damaged near byte {}", taken);
  result.bytes.clear();
  return result;
}

FileBytes read_file_uncompressed(const std::filesystem::path& path, const Limits& limits) {
  FileBytes file = read_file(path);
  return file.error.empty() && is_gzip(file.bytes) ? gunzip(file.bytes, limits) : file;
}

std::string uncompressed_ending(std::filesystem::path path) {
  std::string ending;
  for (int pass = 0; pass < 2 && (pass == 0 || ending == ".gz"); ++pass) {
    ending = path.extension().string();
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    path.replace_extension();
  }
  return ending;
}

}  // namespace etd
