// Which part or layer of an image file is meant: EXR files hold many, and taking the first may mean to look at a depth
// as if it were a colour.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace etd {

// Channels of one part whose names agree up to the last dot.
struct PartLayer {
  int part = 0;
  std::string part_name, prefix;
  std::vector<int> channels;       // of the part
  std::vector<std::string> names;  // of these channels, behind the prefix

  // The part's channel of this name in upper or lower case, -1 when there is none.
  int find(std::string_view name) const;
  bool has_rgb() const { return find("R") >= 0 && find("G") >= 0 && find("B") >= 0; }
  bool is_grey() const { return channels.size() == 1 || find("Y") >= 0; }
  // By its own name, that of its part, or both with a dot between.
  bool is_called(std::string_view name) const;
};

// Adds the layers of a part with these channels.
void add_layers(int part, const std::string& part_name, const std::vector<std::string>& channels,
                std::vector<PartLayer>& to);

struct LayerChoice {
  const PartLayer* layer = nullptr;
  std::string error;  // there is none, or more than one: one line that lists them
};
// The layer with R, G and B, without a prefix if there is one, or else the grey one without a prefix, or the only one;
// with `name`, the one of that name, or of that name's part the one by these rules.
LayerChoice choose_layer(const std::vector<PartLayer>& layers, const std::string& name);

}  // namespace etd
