// Image files made byte by byte, as other programs write them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

namespace etd {

struct ExrChannel {
  std::string name;
  std::function<float(int, int)> value;  // by pixel of the display window's coordinates
  int sampling = 1;
};
struct ExrPart {
  std::string name;
  std::array<int, 4> data, display;  // first and last column and row: x0, y0, x1, y1
  std::vector<ExrChannel> channels;
  std::string more_attributes;
};

inline std::string little(uint64_t value, int bytes) {
  std::string out;
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 255u);
  return out;
}
inline std::string float_bytes(float value) {
  uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return little(bits, 4);
}
inline std::string exr_attribute(const std::string& name, const std::string& type, const std::string& value) {
  return name + '\0' + type + '\0' + little(value.size(), 4) + value;
}

// An uncompressed EXR of floats ("OpenEXR File Layout"); of several parts in the second form of the format.
inline std::string exr_bytes(std::vector<ExrPart> parts) {
  const bool many = parts.size() > 1;
  std::string out("\x76\x2f\x31\x01", 4), zero(1, '\0');
  out += little(2u | (many ? 0x1000u : 0u), 4);
  std::vector<std::string> chunks;
  for (size_t i = 0; i < parts.size(); ++i) {
    ExrPart& part = parts[i];
    std::sort(part.channels.begin(), part.channels.end(),
              [](const ExrChannel& a, const ExrChannel& b) { return a.name < b.name; });
    std::string channels;
    for (const ExrChannel& c : part.channels) {
      const auto sampling = static_cast<uint64_t>(c.sampling);
      channels += c.name + '\0' + little(2, 4) + little(0, 4) + little(sampling, 4) + little(sampling, 4);
    }
    const auto box = [](const std::array<int, 4>& b) {
      std::string bytes;
      for (const int v : b) bytes += little(static_cast<uint32_t>(v), 4);
      return bytes;
    };
    out += exr_attribute("channels", "chlist", channels + zero) + exr_attribute("compression", "compression", zero) +
           exr_attribute("dataWindow", "box2i", box(part.data)) +
           exr_attribute("displayWindow", "box2i", box(part.display)) + exr_attribute("lineOrder", "lineOrder", zero) +
           exr_attribute("pixelAspectRatio", "float", float_bytes(1)) +
           exr_attribute("screenWindowCenter", "v2f", float_bytes(0) + float_bytes(0)) +
           exr_attribute("screenWindowWidth", "float", float_bytes(1)) + part.more_attributes;
    const auto [x0, y0, x1, y1] = part.data;
    if (many)
      out += exr_attribute("name", "string", part.name) + exr_attribute("type", "string", "scanlineimage") +
             exr_attribute("chunkCount", "int", little(static_cast<uint64_t>(y1 - y0 + 1), 4));
    out += zero;
    for (int y = y0; y <= y1; ++y) {
      std::string row;
      for (const ExrChannel& c : part.channels)
        for (int x = x0; x <= x1; ++x)
          if (x % c.sampling == 0 && y % c.sampling == 0) row += float_bytes(c.value(x, y));
      chunks.push_back((many ? little(i, 4) : "") + little(static_cast<uint32_t>(y), 4) + little(row.size(), 4) + row);
    }
  }
  if (many) out += zero;
  uint64_t at = out.size() + 8 * chunks.size();
  for (const std::string& chunk : chunks) {
    out += little(at, 8);
    at += chunk.size();
  }
  for (const std::string& chunk : chunks) out += chunk;
  return out;
}

// A PNG of one pixel with these bytes, and more chunks ("gAMA" and its data) in front of it.
inline std::string png_bytes(std::array<uint8_t, 3> rgb, const std::vector<std::pair<std::string, std::string>>& more,
                             int bits = 8) {
  const auto big = [](uint32_t value) {
    std::string bytes = little(value, 4);
    std::reverse(bytes.begin(), bytes.end());
    return bytes;
  };
  const auto chunk = [&](const std::string& type, const std::string& data) {
    uint32_t crc = ~0u;
    for (const char c : type + data) {
      crc ^= static_cast<unsigned char>(c);
      for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1u ? 0xedb88320u : 0u);
    }
    return big(static_cast<uint32_t>(data.size())) + type + data + big(~crc);
  };
  std::string row(1, '\0');  // no prediction
  for (const uint8_t v : rgb)
    for (int k = 0; k < bits / 8; ++k) row += static_cast<char>(v);
  uint32_t a = 1, b = 0;
  for (const char c : row) a = (a + static_cast<unsigned char>(c)) % 65521, b = (b + a) % 65521;
  const std::string stored =
      std::string("\x78\x01\x01", 3) + little(row.size(), 2) + little(~row.size(), 2) + row + big(b << 16 | a);
  std::string out =
      "\x89PNG\r\n\x1a\n" + chunk("IHDR", big(1) + big(1) + static_cast<char>(bits) + std::string("\x02\0\0\0", 4));
  for (const auto& [type, data] : more) out += chunk(type, data);
  return out + chunk("IDAT", stored) + chunk("IEND", "");
}

}  // namespace etd
