// Helps tests that run the program itself.
#pragma once

#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <string>

#include "temp_folder.h"

namespace etd {

inline constexpr const char* kScene = R"(
Film "rgb" "integer xresolution" 24 "integer yresolution" 16 "string filename" "somewhere/picture.exr"
Sampler "independent" "integer pixelsamples" 4
LookAt 0 0 -3  0 0 0  0 1 0
Camera "perspective" "float fov" 60
WorldBegin
LightSource "infinite" "rgb L" [ 0.5 0.6 0.7 ]
Material "diffuse" "rgb reflectance" [ 0.5 0.6 0.7 ]
Shape "sphere"
)";

struct Finished {
  int exit_code = -1;  // or minus the signal that ended it
  std::string out, err;
};

// The program in a folder of its own.
class Cli : public ::testing::Test {
 protected:
  pid_t start(const std::string& arguments) const { return start_shell("exec \"$ETENDUE\" " + arguments); }
  // A line of shell in which $ETENDUE is the program.
  pid_t start_shell(const std::string& line) const {
    const std::string command = "cd '" + folder_.path().string() + "' && ETENDUE='" ETENDUE_BINARY "' && exec >'" +
                                log_.path().string() + "/out' 2>'" + log_.path().string() + "/err' && " + line;
    const char* argv[] = {"sh", "-c", command.c_str(), nullptr};
    pid_t pid = -1;
    EXPECT_EQ(posix_spawn(&pid, "/bin/sh", nullptr, nullptr, const_cast<char* const*>(argv), environ), 0);
    return pid;
  }
  Finished finish(pid_t pid) const {
    int status = 0;
    EXPECT_EQ(waitpid(pid, &status, 0), pid);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), text(log_.path() / "out"),
            text(log_.path() / "err")};
  }
  Finished run(const std::string& arguments) const { return finish(start(arguments)); }
  Finished run_shell(const std::string& line) const { return finish(start_shell(line)); }
  static std::string text(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_.path() / name); }

  TempFolder folder_, log_;
};

inline bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace etd
