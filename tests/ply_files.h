// PLY files that tests write.
#pragma once

#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <string>

namespace etd {

// The values of one binary file, in the byte order asked for.
class Bytes {
 public:
  explicit Bytes(bool big_endian) : big_endian_(big_endian) {}
  template <class T>
  Bytes& add(std::initializer_list<T> values) {
    for (const T value : values) {
      char raw[sizeof(T)];
      std::memcpy(raw, &value, sizeof(T));
      if (big_endian_) std::reverse(raw, raw + sizeof(T));
      bytes_.append(raw, sizeof(T));
    }
    return *this;
  }
  const std::string& str() const { return bytes_; }

 private:
  std::string bytes_;
  bool big_endian_;
};

inline constexpr const char* kTriangleHeader =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
inline constexpr const char* kTriangleVertices = "0 0 0\n1 0 0\n0 1 0\n";

}  // namespace etd
