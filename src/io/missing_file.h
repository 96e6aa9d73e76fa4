// What to tell people about a file that a scene names and that is not there.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace etd {

// Empty when `name`, seen from one of the folders, is there. Otherwise lines that say where it was looked for and what
// may have been meant: a file of these folders whose path ends alike, be it with slashes for backslashes, without
// folders of another machine, or with letters of another case.
std::string missing_file_hint(const std::vector<std::filesystem::path>& folders, const std::string& name);

}  // namespace etd
