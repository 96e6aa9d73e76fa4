// What lets a user watch a render: progress in the terminal, a preview file, a viewer.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/film_stream.h"
#include "render/progress.h"
#include "render/tev.h"

namespace etd::cli {

struct WatchOptions {
  std::string preview;  // a picture file that is rewritten, or empty
  double exposure = 0;  // of the preview, in stops
  std::string tev;      // HOST[:PORT] of the viewer, or empty
  bool quiet = false;   // no progress
};

class Watchers {
 public:
  explicit Watchers(const WatchOptions& options) : options_(options) {}
  // A viewer that takes nothing does not hold the exit.
  ~Watchers();

  // Connects to the viewer. Returns what went wrong, or an empty string.
  std::string connect();
  // From now on everything is shown of a render that begins; `name` is what the viewer calls the image, and `label`,
  // if there is one, what its progress begins with.
  RenderObserver& begin(const std::string& name, const std::string& label = {});
  // Clears the progress display, so that other lines can follow.
  void end_progress();
  // Shows the final image, and waits until everybody has it.
  void end(const Film& film);

 private:
  void add_stream(FilmStream::Receiver receiver, std::chrono::milliseconds interval);

  WatchOptions options_;
  std::unique_ptr<TevViewer> viewer_;
  std::unique_ptr<ProgressPrinter> printer_;
  std::vector<std::unique_ptr<FilmStream>> streams_;
  ObserverList observers_;
};

}  // namespace etd::cli
