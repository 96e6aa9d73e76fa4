// The protocol, as the viewer's project documents it: packets over TCP in little-endian order, each beginning with its
// own length in bytes (uint32, itself included) and its type (a byte). Strings end with a zero byte.
#include "render/tev.h"

#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <span>

namespace etd {
namespace {

static_assert(std::endian::native == std::endian::little, "packets are written in the machine's order");

enum class PacketType : uint8_t { kCreateImage = 4, kUpdateImage = 6 };  // the third version of updating

constexpr int kConnectMilliseconds = 5000;
constexpr std::chrono::seconds kPatience{10}, kPatienceAtTheEnd{2};
constexpr size_t kPixelsInPacket = 1 << 16;

class Packet {
 public:
  Packet(PacketType type, bool grab_focus, const std::string& image_name) {
    add<uint32_t>(0);
    add(static_cast<uint8_t>(type));
    add<uint8_t>(grab_focus);
    add(image_name);
  }
  template <class T>
  void add(T value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void add(const std::string& text) { bytes_.append(text.c_str(), text.size() + 1); }
  void add(std::span<const float> values) {
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }
  const std::string& bytes() {
    const auto length = static_cast<uint32_t>(bytes_.size());
    std::memcpy(bytes_.data(), &length, sizeof length);
    return bytes_;
  }

 private:
  std::string bytes_;
};

Packet create_packet(const std::string& name, const LayeredImage& image) {
  Packet packet(PacketType::kCreateImage, true, name);
  packet.add(int32_t{image.full_width});
  packet.add(int32_t{image.full_height});
  packet.add(static_cast<int32_t>(image.channels.size()));
  for (const std::string& channel : image.channels) packet.add(channel);
  return packet;
}

// Rows begin ... end - 1 of the image. Channels lie interleaved: each has its first index and the step to the next.
Packet update_packet(const std::string& name, const LayeredImage& image, int begin, int end) {
  const size_t channels = image.channels.size();
  Packet packet(PacketType::kUpdateImage, false, name);
  packet.add(static_cast<int32_t>(channels));
  for (const std::string& channel : image.channels) packet.add(channel);
  for (const int32_t v : {image.x, image.y + begin, image.width, end - begin}) packet.add(v);
  for (size_t c = 0; c < channels; ++c) packet.add(static_cast<int64_t>(c));
  for (size_t c = 0; c < channels; ++c) packet.add(static_cast<int64_t>(channels));
  const size_t row = static_cast<size_t>(image.width) * channels;
  packet.add(std::span(image.pixels).subspan(static_cast<size_t>(begin) * row, static_cast<size_t>(end - begin) * row));
  return packet;
}

// Connects a new socket to one address of the host. Returns it, or -1 with errno.
int connect_to(const addrinfo& address) {
  const int fd = ::socket(address.ai_family, address.ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, address.ai_protocol);
  if (fd < 0) return -1;
  int failure = ::connect(fd, address.ai_addr, address.ai_addrlen) == 0 ? 0 : errno;
  if (failure == EINPROGRESS) {
    pollfd waiting{fd, POLLOUT, 0};
    int ready = -1;
    do ready = ::poll(&waiting, 1, kConnectMilliseconds);
    while (ready < 0 && errno == EINTR);
    socklen_t size = sizeof failure;
    if (ready == 0)
      failure = ETIMEDOUT;
    else if (ready < 0 || ::getsockopt(fd, SOL_SOCKET, SO_ERROR, &failure, &size) != 0)
      failure = errno;
  }
  if (failure == 0) return fd;
  ::close(fd);
  errno = failure;
  return -1;
}

}  // namespace

std::optional<TevAddress> parse_tev_address(std::string_view text) {
  TevAddress address{std::string(text), "14158"};
  const size_t colon = text.rfind(':');
  const bool brackets = !text.empty() && text.front() == '[';
  // Several colons without brackets are an IPv6 address alone.
  const bool has_port = brackets ? colon != std::string_view::npos && colon > 0 && text[colon - 1] == ']'
                                 : colon != std::string_view::npos && text.find(':') == colon;
  if (has_port) {
    address.host = text.substr(0, colon);
    address.port = text.substr(colon + 1);
  }
  if (brackets) {
    if (address.host.back() != ']') return {};
    address.host = address.host.substr(1, address.host.size() - 2);
  }
  uint16_t number = 0;
  const char* end = address.port.data() + address.port.size();
  const auto [stop, error] = std::from_chars(address.port.data(), end, number);
  if (address.host.empty() || error != std::errc() || stop != end || number == 0) return {};
  return address;
}

TevViewer::TevViewer(const TevAddress& address) : address_(address) {
  addrinfo hints = {};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int failed = ::getaddrinfo(address.host.c_str(), address.port.c_str(), &hints, &found);
  if (failed != 0) {
    error_ = fmt::format("cannot find the host {}: {}", address.host, ::gai_strerror(failed));
    return;
  }
  int failure = 0;
  for (const addrinfo* a = found; a && socket_ < 0; a = a->ai_next) {
    socket_ = connect_to(*a);
    if (socket_ < 0) failure = errno;
  }
  ::freeaddrinfo(found);
  if (socket_ < 0)
    error_ = fmt::format("cannot reach the viewer tev at {}, port {}: {}", address.host, address.port,
                         std::strerror(failure));
}

TevViewer::~TevViewer() {
  if (socket_ >= 0) ::close(socket_);
}

std::string TevViewer::show(const std::string& name, const LayeredImage& image) {
  if (!created_) {
    if (std::string problem = send(create_packet(name, image).bytes()); !problem.empty()) return problem;
    created_ = true;
  }
  const int rows = std::max(1, static_cast<int>(kPixelsInPacket / static_cast<size_t>(image.width)));
  for (int y = 0; y < image.height; y += rows) {
    std::string problem = send(update_packet(name, image, y, std::min(y + rows, image.height)).bytes());
    if (!problem.empty()) return problem;
  }
  return {};
}

void TevViewer::hurry() { hurried_at_ = Clock::now().time_since_epoch().count(); }

bool TevViewer::out_of_patience(Clock::time_point last_taken) const {
  const Clock::time_point now = Clock::now();
  const Clock::rep hurried = hurried_at_;
  if (hurried == 0) return now - last_taken > kPatience;
  const Clock::time_point since{Clock::duration(hurried)};
  return now - since > kPatience || now - std::max(last_taken, since) > kPatienceAtTheEnd;
}

std::string TevViewer::send(const std::string& packet) {
  Clock::time_point last_taken = Clock::now();
  for (size_t sent = 0; sent < packet.size();) {
    const ssize_t n = ::send(socket_, packet.data() + sent, packet.size() - sent, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (n > 0) {
      sent += static_cast<size_t>(n);
      last_taken = Clock::now();
    } else if (n < 0 && errno == EINTR) {
      continue;
    } else if (n < 0 && errno != EAGAIN && errno != EWOULDBLOCK) {
      return fmt::format("the viewer tev at {} is lost: {}", address_.host, std::strerror(errno));
    } else {
      constexpr int kLookAroundMilliseconds = 100;  // whether there is a hurry by now
      pollfd waiting{socket_, POLLOUT, 0};
      ::poll(&waiting, 1, kLookAroundMilliseconds);
    }
    if (out_of_patience(last_taken)) return fmt::format("the viewer tev at {} takes no data", address_.host);
  }
  return {};
}

}  // namespace etd
