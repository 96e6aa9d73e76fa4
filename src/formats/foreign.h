// Files that are no pbrt scene, told by how they begin: a user who names a wrong file should hear what it is.
#pragma once

#include <string_view>

namespace etd {

struct ForeignFormat {
  std::string_view what;  // "a PNG image"; empty: nothing known
  std::string_view hint;
};

ForeignFormat find_foreign_format(std::string_view text);
// What files of this ending (".xml") hold, "scenes of Mitsuba"; empty: nothing known.
std::string_view foreign_ending(std::string_view ending);

}  // namespace etd
