// The other side of the viewer's protocol, for tests: listens on the loopback interface, takes packets apart as the
// protocol describes them and keeps the images that they make.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace etd {

struct TevPeerImage {
  int width = 0, height = 0;
  std::map<std::string, std::vector<float>> channels;  // planes of the full size
};

class TevPeer {
 public:
  TevPeer() : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* generic = reinterpret_cast<sockaddr*>(&address);
    if (listener_ < 0 || ::bind(listener_, generic, size) != 0 || ::getsockname(listener_, generic, &size) != 0)
      throw std::runtime_error("no socket for the test");
    port_ = ntohs(address.sin_port);
  }
  ~TevPeer() {
    for (int fd : {connection_, listener_})
      if (fd >= 0) ::close(fd);
  }
  TevPeer(const TevPeer&) = delete;
  TevPeer& operator=(const TevPeer&) = delete;

  std::string port() const { return std::to_string(port_); }
  // Before this, connections are refused.
  void listen() { ::listen(listener_, 1); }
  void accept() { connection_ = ::accept(listener_, nullptr, nullptr); }
  // Ends the connection so that the other side notices at once.
  void slam() {
    const linger now{1, 0};
    ::setsockopt(connection_, SOL_SOCKET, SO_LINGER, &now, sizeof now);
    ::close(connection_);
    connection_ = -1;
  }
  // Reads packets until the other side ends the connection. Throws on anything that is no valid packet.
  void serve() {
    for (std::string packet; read_packet(packet);) take(packet);
  }

  std::map<std::string, TevPeerImage> images;
  int updates = 0, focus_grabs = 0;

 private:
  bool read_exactly(char* to, size_t n, bool may_end) {
    for (size_t have = 0; have < n;) {
      const ssize_t got = ::recv(connection_, to + have, n - have, 0);
      if (got == 0 && have == 0 && may_end) return false;
      if (got <= 0) throw std::runtime_error("the connection ended in the midst of a packet");
      have += static_cast<size_t>(got);
    }
    return true;
  }
  bool read_packet(std::string& packet) {
    uint32_t length = 0;
    if (!read_exactly(reinterpret_cast<char*>(&length), sizeof length, true)) return false;
    if (length < 6 || length > (1u << 28)) throw std::runtime_error("a packet of wrong length");
    packet.resize(length - sizeof length);
    return read_exactly(packet.data(), packet.size(), false);
  }

  template <class T>
  static T next(const std::string& packet, size_t& at) {
    T value;
    if (at + sizeof value > packet.size()) throw std::runtime_error("a packet that is too short");
    std::memcpy(&value, packet.data() + at, sizeof value);
    at += sizeof value;
    return value;
  }
  static std::string next_text(const std::string& packet, size_t& at) {
    const size_t end = packet.find('\0', at);
    if (end == std::string::npos) throw std::runtime_error("text without an end");
    const std::string text = packet.substr(at, end - at);
    at = end + 1;
    return text;
  }
  static std::vector<std::string> next_texts(const std::string& packet, size_t& at, int n) {
    std::vector<std::string> texts;
    for (int i = 0; i < n; ++i) texts.push_back(next_text(packet, at));
    return texts;
  }

  void take(const std::string& packet) {
    size_t at = 0;
    const auto type = next<uint8_t>(packet, at);
    focus_grabs += next<uint8_t>(packet, at);
    const std::string name = next_text(packet, at);
    if (type == 4)
      create(name, packet, at);
    else if (type == 6)
      update(name, packet, at);
    else
      throw std::runtime_error("a packet of unknown type");
    if (at != packet.size()) throw std::runtime_error("a packet that is too long");
  }
  void create(const std::string& name, const std::string& packet, size_t& at) {
    TevPeerImage& image = images[name] = {};
    image.width = next<int32_t>(packet, at);
    image.height = next<int32_t>(packet, at);
    const auto size = static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
    for (const std::string& channel : next_texts(packet, at, next<int32_t>(packet, at)))
      image.channels[channel].resize(size);
  }
  void update(const std::string& name, const std::string& packet, size_t& at) {
    TevPeerImage& image = images.at(name);
    const std::vector<std::string> names = next_texts(packet, at, next<int32_t>(packet, at));
    const int x0 = next<int32_t>(packet, at), y0 = next<int32_t>(packet, at);
    const int width = next<int32_t>(packet, at), height = next<int32_t>(packet, at);
    if (x0 < 0 || y0 < 0 || x0 + width > image.width || y0 + height > image.height)
      throw std::runtime_error("an update outside of the image");
    std::vector<size_t> offsets, strides;
    for (size_t i = 0; i < names.size(); ++i) offsets.push_back(next<uint64_t>(packet, at));
    for (size_t i = 0; i < names.size(); ++i) strides.push_back(next<uint64_t>(packet, at));
    size_t end = at;
    for (size_t c = 0; c < names.size(); ++c)
      for (int i = 0; i < width * height; ++i) {
        size_t from = at + sizeof(float) * (offsets[c] + static_cast<size_t>(i) * strides[c]);
        const int to = (y0 + i / width) * image.width + x0 + i % width;
        image.channels.at(names[c])[static_cast<size_t>(to)] = next<float>(packet, from);
        end = std::max(end, from);
      }
    at = end;
    ++updates;
  }

  int listener_ = -1, connection_ = -1;
  uint16_t port_ = 0;
};

}  // namespace etd
