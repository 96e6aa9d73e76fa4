#include "views.h"

#include <fmt/format.h>

namespace etd::cli {

std::vector<View> pair_views(const CLI::App& command, const CLI::Option* camera,
                             const std::vector<std::string>& cameras, const CLI::Option* output,
                             const std::vector<std::string>& outputs) {
  if (cameras.size() < 2) return {{cameras.empty() ? std::string() : cameras[0], outputs}};
  std::vector<View> views;
  size_t next = 0;
  for (const CLI::Option* option : command.parse_order()) {
    if (option == camera) views.push_back({cameras.at(views.size()), {}});
    if (option != output) continue;
    if (views.empty())
      throw CLI::ValidationError("--output",
                                 "\"" + outputs.at(next) +
                                     "\" stands before the first --camera; of several cameras, each has the "
                                     "outputs behind it");
    views.back().outputs.push_back(outputs.at(next++));
  }
  return views;
}

std::string outputs_text(const std::vector<View>& views, size_t first) {
  std::vector<std::string> names;
  for (size_t i = first; i < views.size(); ++i) {
    if (views[i].outputs.empty()) names.push_back(views[i].camera);
    names.insert(names.end(), views[i].outputs.begin(), views[i].outputs.end());
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace etd::cli
