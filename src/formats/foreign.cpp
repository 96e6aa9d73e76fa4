#include "formats/foreign.h"

#include <algorithm>

namespace etd {

namespace {

constexpr std::string_view kImage = "images are named in textures and lights";
constexpr std::string_view kMesh =
    "name it in a Shape (\"plymesh\", \"offmesh\", \"objmesh\"), or render it by itself under its own ending";
constexpr std::string_view kScene = "Etendue reads scenes in the language of pbrt-v4";

struct Beginning {
  std::string_view bytes;
  ForeignFormat format;
};
constexpr Beginning kBeginnings[] = {
    {"\x89PNG", {"a PNG image", kImage}},
    {"\xff\xd8\xff", {"a JPEG image", kImage}},
    {"v/1\x01", {"an OpenEXR image", kImage}},
    {"#?R", {"a Radiance HDR image", kImage}},
    {"PF\n", {"a PFM image", kImage}},
    {"PK\x03\x04", {"a ZIP archive", "unpack it first"}},
    {"glTF", {"a binary glTF scene", kScene}},
    {"BLENDER", {"a Blender file", "export it from Blender in the language of pbrt-v4"}},
    {"#usda", {"a USD scene", kScene}},
    {"PXR-USDC", {"a USD scene", kScene}}};

// Other formats are known by the first word that is no comment.
struct FirstWord {
  std::string_view word;
  ForeignFormat format;
};
constexpr ForeignFormat kUcsd = {"a scene of the UCSD rendering courses", kScene};
constexpr ForeignFormat kObj = {"a Wavefront OBJ mesh", kMesh};
constexpr FirstWord kFirstWords[] = {{"ply", {"a PLY mesh", kMesh}},
                                     {"OFF", {"an OFF mesh", kMesh}},
                                     {"COFF", {"an OFF mesh", kMesh}},
                                     {"NOFF", {"an OFF mesh", kMesh}},
                                     {"solid", {"an STL mesh", "convert it to PLY"}},
                                     {"mtllib", kObj},
                                     {"v", kObj},
                                     {"vn", kObj},
                                     {"o", kObj},
                                     {"g", kObj},
                                     {"newmtl", {"the materials of an OBJ mesh", kMesh}},
                                     {"size", kUcsd},
                                     {"camera", kUcsd},
                                     {"integrator", kUcsd},
                                     {"maxdepth", kUcsd},
                                     {"output", kUcsd}};

struct Ending {
  std::string_view ending, what;
};
constexpr Ending kEndings[] = {{".xml", "scenes of Mitsuba"},
                               {".test", "scenes of the UCSD rendering courses"},
                               {".gltf", "glTF scenes"},
                               {".glb", "glTF scenes"},
                               {".usd", "USD scenes"},
                               {".usda", "USD scenes"},
                               {".usdc", "USD scenes"},
                               {".blend", "Blender files"},
                               {".fbx", "FBX scenes"},
                               {".stl", "STL meshes"},
                               {".mtl", "the materials of OBJ meshes"}};

bool is_space(char c) { return static_cast<unsigned char>(c) <= ' '; }

struct FirstWords {
  std::string_view first;
  char next = 0;  // the character after it and what space follows
};

FirstWords first_words(std::string_view text) {
  size_t at = 0;
  while (at < text.size() && (is_space(text[at]) || text[at] == '#'))
    at = text[at] == '#' ? std::min(text.find('\n', at), text.size()) : at + 1;
  size_t end = at;
  while (end < text.size() && !is_space(text[end])) ++end;
  FirstWords words{text.substr(at, end - at)};
  while (end < text.size() && is_space(text[end])) ++end;
  if (end < text.size()) words.next = text[end];
  return words;
}

}  // namespace

std::string_view foreign_ending(std::string_view ending) {
  for (const Ending& e : kEndings)
    if (e.ending == ending) return e.what;
  return {};
}

ForeignFormat find_foreign_format(std::string_view text) {
  for (const Beginning& b : kBeginnings)
    if (text.substr(0, b.bytes.size()) == b.bytes) return b.format;
  const auto [word, next] = first_words(text);
  for (const FirstWord& w : kFirstWords)
    if (w.word == word && next != '"') return w.format;  // a quote follows directives of pbrt in small letters
  if (word.substr(0, 1) == "<") return {"an XML file, such as a scene of Mitsuba", kScene};
  if (word.substr(0, 1) == "{") return {"a JSON file, such as a glTF scene", kScene};
  return {};
}

}  // namespace etd
