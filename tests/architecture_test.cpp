// Keeps the plan of docs/architecture.md true: includes point down the floors, each outside library is named in one
// place only, files stay short, and no file knows the machine it was written on. It reads the checkout, not the
// program.
#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "places.h"

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = etd::source_path("");
constexpr int kMaxFileLines = 400;
constexpr int kUsualHeaderLines = 150;

// Floors of the house from the ground up; 2a and 2b of the page are 2 and 3 here, so later ones are one higher.
const std::map<std::string, int, std::less<>> kFloors = {
    {"core", 0},      {"params", 0},         {"samplers", 1}, {"spectrum", 1}, {"io", 1},
    {"bsdfs", 2},     {"shapes", 2},         {"textures", 2}, {"filters", 2},  {"phase", 2},
    {"materials", 3}, {"lights", 3},         {"media", 3},    {"cameras", 3},  {"accel", 4},
    {"film", 4},      {"light_sampling", 4}, {"scene", 5},    {"denoise", 6},  {"integrators", 6},
    {"metrics", 6},   {"render", 7},         {"formats", 8},  {"lab", 9},      {"verify", 9}};

// The arrows between two rooms of one floor that are allowed: from the first to the second, never back.
const std::set<std::pair<std::string, std::string>> kSideways = {
    {"bsdfs", "phase"}, {"params", "core"}, {"io", "spectrum"}, {"denoise", "metrics"}, {"lab", "verify"}};

// Headers of an outside library may be included where this says: all that begin like the first, only under the second.
constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kLibraries = {
    {{"embree", "src/accel/embree/"},
     {"OpenImageIO/", "src/io/codecs/"},
     {"OpenEXR/", "src/io/codecs/"},
     {"Imath/", "src/io/codecs/"},
     {"zlib.h", "src/io/"},
     {"CLI/", "apps/cli/"},
     {"gtest/", "tests/"},
     {"gmock/", "tests/"},
     {"benchmark/", "bench/"}}};

bool begins_with(std::string_view text, std::string_view start) { return text.substr(0, start.size()) == start; }

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

// The folder under src/ that a path relative to src/ lies in, "" for a file in no folder.
std::string room_of(std::string_view path) {
  const size_t slash = path.find('/');
  return slash == std::string_view::npos ? "" : std::string(path.substr(0, slash));
}

// What is wrong with `file` (relative to the checkout) including `target` in quotes ("room/name.h"); empty when nothing
// is.
std::string arrow_problem(const std::string& file, const std::string& target) {
  const std::string to = room_of(target);
  const auto to_floor = kFloors.find(to);
  if (to_floor == kFloors.end()) {
    return begins_with(file, "src/") ? "'" + target + "' is in no room of the architecture page" : "";
  }
  if (!begins_with(file, "src/")) return "";  // programs and tests stand above all floors
  const std::string from = room_of(file.substr(4));
  const auto from_floor = kFloors.find(from);
  if (from_floor == kFloors.end()) return "this file is in no room of the architecture page";
  if (from == to || from_floor->second > to_floor->second || kSideways.count({from, to}) > 0) return "";
  const char* direction = from_floor->second < to_floor->second ? " points up the floors" : " points sideways";
  return "the arrow from " + from + " to " + to + direction;
}

// What is wrong with `file` including <target>; empty when nothing is.
std::string library_problem(const std::string& file, const std::string& target) {
  for (const auto& [library, place] : kLibraries) {
    if (begins_with(target, library) && !begins_with(file, place)) {
      return "<" + target + "> may only be included under " + std::string(place);
    }
  }
  return "";
}

// The name that an #include line names with this pair of delimiters; empty when the line is none.
std::string included_name(const std::string& line, char open, char close) {
  const size_t hash = line.find_first_not_of(" \t");
  if (hash == std::string::npos || line[hash] != '#') return "";
  const size_t word = line.find_first_not_of(" \t", hash + 1);
  if (word == std::string::npos || line.compare(word, 7, "include") != 0) return "";
  const size_t begin = line.find_first_not_of(" \t", word + 7);
  if (begin == std::string::npos || line[begin] != open) return "";
  const size_t end = line.find(close, begin + 1);
  return end == std::string::npos ? "" : line.substr(begin + 1, end - begin - 1);
}

std::string slurp(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::vector<std::string> lines_of(const fs::path& path) {
  std::istringstream in(slurp(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// All C++ files under these folders of the checkout, relative to it.
std::vector<std::string> source_files(const std::vector<std::string>& folders) {
  std::vector<std::string> files;
  for (const std::string& folder : folders) {
    if (!fs::exists(kRoot / folder)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension == ".h" || extension == ".cpp") files.push_back(fs::relative(entry.path(), kRoot).generic_string());
    }
  }
  return files;
}

TEST(Architecture, IncludesPointDownTheFloors) {
  const std::vector<std::string> files = source_files({"src", "apps"});
  ASSERT_FALSE(files.empty());
  for (const std::string& file : files) {
    const std::vector<std::string> lines = lines_of(kRoot / file);
    for (size_t i = 0; i < lines.size(); ++i) {
      const std::string target = included_name(lines[i], '"', '"');
      if (target.empty()) continue;
      EXPECT_EQ(arrow_problem(file, target), "") << file << ":" << i + 1;
      const bool found = fs::exists(kRoot / "src" / target) ||
                         (!begins_with(file, "src/") && fs::exists((kRoot / file).parent_path() / target));
      EXPECT_TRUE(found) << file << ":" << i + 1 << ": \"" << target << "\" is not relative to src/";
    }
  }
}

TEST(Architecture, OutsideLibrariesStayInTheirRooms) {
  for (const std::string& file : source_files({"src", "apps", "tests", "bench"})) {
    const std::vector<std::string> lines = lines_of(kRoot / file);
    for (size_t i = 0; i < lines.size(); ++i) {
      const std::string target = included_name(lines[i], '<', '>');
      EXPECT_EQ(library_problem(file, target), "") << file << ":" << i + 1;
    }
  }
}

TEST(Architecture, FilesHoldOneConcept) {
  for (const std::string& file : source_files({"src", "apps"})) {
    const size_t lines = lines_of(kRoot / file).size();
    EXPECT_LE(lines, static_cast<size_t>(kMaxFileLines)) << file << " holds more than one concept";
    if (ends_with(file, ".h") && lines > static_cast<size_t>(kUsualHeaderLines)) {
      std::printf("note: %s has %zu lines; headers aim for %d\n", file.c_str(), lines, kUsualHeaderLines);
    }
  }
}

// Written in halves, because this file is searched too.
constexpr std::array<std::string_view, 4> kMachinePaths = {
    "/ho"
    "me/",
    "/wo"
    "rk/",
    "/ro"
    "ot/",
    "/Us"
    "ers/"};

// The first path of somebody's machine in `text`, empty when there is none. What goes on from the name of another
// folder is not one.
std::string machine_path_in(std::string_view text) {
  for (const std::string_view path : kMachinePaths) {
    for (size_t at = text.find(path); at != std::string_view::npos; at = text.find(path, at + 1)) {
      const char before = at == 0 ? ' ' : text[at - 1];
      const bool goes_on = std::isalnum(static_cast<unsigned char>(before)) != 0 ||
                           std::string_view("._-~})$*").find(before) != std::string_view::npos;
      if (!goes_on) return std::string(path);
    }
  }
  return "";
}

TEST(Architecture, NoFileKnowsAMachine) {
  const std::string command = "git -C '" + kRoot.string() + "' ls-files -z 2>/dev/null";
  const std::unique_ptr<FILE, int (*)(FILE*)> git(popen(command.c_str(), "r"), pclose);
  ASSERT_NE(git, nullptr);
  std::string names;
  for (int c = std::fgetc(git.get()); c != EOF; c = std::fgetc(git.get())) names += static_cast<char>(c);
  if (names.empty()) GTEST_SKIP() << "this is no git checkout, so nothing says which files belong to the project";
  std::istringstream in(names);
  for (std::string name; std::getline(in, name, '\0');) {
    const std::string text = slurp(kRoot / name);
    if (text.find('\0') != std::string::npos) continue;  // a picture or other binary file
    EXPECT_EQ(machine_path_in(text), "") << name;
  }
}

TEST(Architecture, TheCheckItselfCatchesEachKindOfWrongArrow) {
  EXPECT_EQ(arrow_problem("src/params/param.h", "core/vec.h"), "");
  EXPECT_EQ(arrow_problem("src/materials/diffuse.cpp", "bsdfs/lambert.h"), "");
  EXPECT_EQ(arrow_problem("src/scene/compile.cpp", "accel/embree/accel.h"), "");
  EXPECT_EQ(arrow_problem("apps/cli/main.cpp", "formats/pbrt/reader.h"), "");
  EXPECT_EQ(arrow_problem("src/core/vec.h", "params/param.h"), "the arrow from core to params points sideways");
  EXPECT_EQ(arrow_problem("src/bsdfs/ggx.h", "textures/texture.h"), "the arrow from bsdfs to textures points sideways");
  EXPECT_EQ(arrow_problem("src/lights/area.h", "materials/material.h"),
            "the arrow from lights to materials points sideways");
  EXPECT_EQ(arrow_problem("src/film/film.h", "render/driver.h"), "the arrow from film to render points up the floors");
  EXPECT_NE(arrow_problem("src/attic/old.h", "core/vec.h"), "");
  EXPECT_NE(arrow_problem("src/film/film.h", "attic/old.h"), "");
  EXPECT_NE(arrow_problem("src/film/film.h", "film_buffer.h"), "");
  EXPECT_EQ(library_problem("src/accel/embree/accel.cpp", "embree3/rtcore.h"), "");
  EXPECT_NE(library_problem("src/scene/scene.h", "embree3/rtcore.h"), "");
  EXPECT_NE(library_problem("src/film/film.cpp", "OpenImageIO/imageio.h"), "");
  EXPECT_EQ(included_name("  #  include \"core/vec.h\"  // why", '"', '"'), "core/vec.h");
  EXPECT_EQ(included_name("#include <vector>", '"', '"'), "");
  EXPECT_EQ(machine_path_in("see docs/wo"
                            "rk/ and $HOME/ho"
                            "me/"),
            "");
  EXPECT_NE(machine_path_in("open(\"/wo"
                            "rk/scene.pbrt\")"),
            "");
}

}  // namespace
