// Shows the picture in tev, an image viewer that listens on the network while it runs. Only the part of its protocol
// that is needed: make an image, replace its pixels.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "io/image_write.h"

namespace etd {

struct TevAddress {
  std::string host, port;
};

// "HOST", "HOST:PORT", and with brackets "[HOST]:PORT" for IPv6; without a port tev's own, 14158. Nothing when host or
// port is empty or the port is no number up to 65535.
std::optional<TevAddress> parse_tev_address(std::string_view text);

class TevViewer {
 public:
  // Connects, which takes a few seconds at most. error() says why it failed.
  explicit TevViewer(const TevAddress& address);
  ~TevViewer();
  TevViewer(const TevViewer&) = delete;
  TevViewer& operator=(const TevViewer&) = delete;

  const std::string& error() const { return error_; }
  // Sends all channels of the image under this name: the first time as a new image of the full size, black outside of
  // the crop. Returns what went wrong, or an empty string; then the viewer is lost. Waits for a viewer that takes
  // nothing for ten seconds at most.
  std::string show(const std::string& name, const LayeredImage& image);
  // The program wants to end: from now on everything together may take ten seconds, and two without that anything is
  // taken. Called by any thread.
  void hurry();
  // Another picture begins: there is time again.
  void take_time() { hurried_at_ = 0; }

 private:
  using Clock = std::chrono::steady_clock;
  std::string send(const std::string& packet);
  bool out_of_patience(Clock::time_point last_taken) const;

  TevAddress address_;
  int socket_ = -1;
  bool created_ = false;
  std::atomic<Clock::rep> hurried_at_{0};  // since the clock's epoch; 0: it was not
  std::string error_;
};

}  // namespace etd
