// A scene that is read once, the ways in which it is looked at, and all that was found wrong with them.
#pragma once

#include <optional>
#include <vector>

#include "arguments.h"
#include "load_bar.h"
#include "render/session.h"
#include "scene/compile.h"
#include "views.h"

namespace etd::cli {

class LoadedScene {
 public:
  // `args` must outlive it. `quiet`: nothing is told of the loading.
  LoadedScene(const SceneArguments& args, const std::vector<View>& views, bool quiet);

  // Finds what is wrong with any camera before the first picture is begun, by way of a world without anything in it;
  // gives views without outputs the file that their film names.
  void check_views(std::vector<View>& views);
  // The scene as one view sees it, or nothing when there are errors; views are prepared in their order. Says what has
  // been found since the last call. Throws LoadingStopped when `stop`, if there is one, becomes true.
  std::optional<PreparedRender> prepare(size_t view, const std::atomic<bool>* stop);

  double seconds() const { return seconds_; }  // that reading took

 private:
  const RenderOverrides& overrides_;
  LoadBar bar_;
  SceneDescription description_;
  std::vector<ViewDescription> views_;
  SceneFiles files_;
  Diagnostics diagnostics_;
  size_t printed_ = 0;
  double seconds_ = 0;
};

// The film's file, where the view has no output.
void name_output(const PreparedRender& prepared, View& view);

}  // namespace etd::cli
