// What is told of loading while it runs, and how it is stopped: a large scene takes long before there is a picture.
#pragma once

#include <exception>
#include <functional>
#include <string_view>

namespace etd {

// Is called now and then, from any thread, with what is being done and the share of that which is done, 0 to 1. False
// stops the loading. An empty one is never called.
using LoadMonitor = std::function<bool(std::string_view what, double share)>;

// Is thrown by what was stopped.
struct LoadingStopped : std::exception {
  const char* what() const noexcept override { return "loading was stopped"; }
};

}  // namespace etd
