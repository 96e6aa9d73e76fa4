// These say where the project and its program lie. Only places.cpp is compiled with the paths, so that a compiler cache
// knows the other tests in every folder.
#pragma once

#include <filesystem>
#include <string>

namespace etd {

// A file of the project, such as "tests/scenes/closed/sky.pbrt".
std::filesystem::path source_path(const std::string& relative);

std::filesystem::path program_path();

}  // namespace etd
