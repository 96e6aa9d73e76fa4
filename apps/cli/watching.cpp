#include "watching.h"

#include <fmt/format.h>
#include <unistd.h>

#include "printing.h"

namespace etd::cli {
namespace {

// A file is encoded and written; the viewer only takes the numbers.
constexpr std::chrono::milliseconds kPreviewInterval{3000}, kViewerInterval{1000};

}  // namespace

Watchers::~Watchers() {
  if (viewer_) viewer_->hurry();
}

std::string Watchers::connect() {
  if (options_.tev.empty()) return {};
  const std::optional<TevAddress> address = parse_tev_address(options_.tev);
  if (!address) return fmt::format("\"{}\" is not HOST or HOST:PORT, as in localhost:14158", options_.tev);
  viewer_ = std::make_unique<TevViewer>(*address);
  return viewer_->error();
}

void Watchers::add_stream(FilmStream::Receiver receiver, std::chrono::milliseconds interval) {
  const auto report = [this](const std::string& problem) {
    end_progress();  // it draws itself again on the line after
    tell("etendue: warning: {}; rendering goes on without it\n", problem);
  };
  streams_.push_back(std::make_unique<FilmStream>(std::move(receiver), report, interval));
  observers_.add(*streams_.back());
}

RenderObserver& Watchers::begin(const std::string& name, const std::string& label) {
  observers_ = ObserverList();
  streams_.clear();
  if (viewer_) viewer_->take_time();
  if (!options_.quiet) {
    printer_ = std::make_unique<ProgressPrinter>(stderr, isatty(STDERR_FILENO) != 0, label);
    observers_.add(*printer_);
  }
  if (!options_.preview.empty())
    add_stream(
        [this](const LayeredImage& picture) { return write_output(options_.preview, picture, options_.exposure); },
        kPreviewInterval);
  if (viewer_)
    add_stream([this, name](const LayeredImage& picture) { return viewer_->show(name, picture); }, kViewerInterval);
  return observers_;
}

void Watchers::end_progress() {
  if (printer_) printer_->finish();
}

void Watchers::end(const Film& film) {
  if (viewer_) viewer_->hurry();
  for (const auto& stream : streams_) stream->finish(film);
}

}  // namespace etd::cli
