// Helps tests that run the program itself.
#pragma once

#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <wordexp.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "places.h"
#include "program.h"
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

#ifdef __has_feature
inline constexpr bool kSanitized = __has_feature(address_sanitizer);
#else
inline constexpr bool kSanitized = false;
#endif

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
    const std::string command = "cd '" + folder_.path().string() + "' && ETENDUE='" + program_path().string() +
                                "' && exec >'" + log_.path().string() + "/out' 2>'" + log_.path().string() +
                                "/err' && " + line;
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
  // Runs what main() does in a copy of this process: loading the program's libraries takes longer than most commands.
  // Threads are not copied, and sanitizers want to see how a process ends; then the program itself is started.
  Finished run(const std::string& arguments) const {
    if (kSanitized || thread_count() > threads_at_first_) return finish(start(arguments));
    std::fflush(nullptr);
    const pid_t pid = ::fork();
    if (pid == 0) run_here(arguments);
    return finish(pid);
  }
  Finished run_shell(const std::string& line) const { return finish(start_shell(line)); }
  static std::string text(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_.path() / name); }

  TempFolder folder_, log_;

 private:
  static long thread_count() {
    const std::filesystem::directory_iterator threads("/proc/self/task");
    return std::distance(begin(threads), end(threads));
  }
  // Ends this process.
  [[noreturn]] void run_here(const std::string& arguments) const {
    std::filesystem::current_path(folder_.path());
    const bool opened = std::freopen((log_.path() / "out").c_str(), "w", stdout) != nullptr &&
                        std::freopen((log_.path() / "err").c_str(), "w", stderr) != nullptr;
    std::vector<std::string> words{"etendue"};
    wordexp_t expanded;
    if (!opened || ::wordexp(arguments.c_str(), &expanded, WRDE_NOCMD) != 0) std::_Exit(127);
    words.insert(words.end(), expanded.we_wordv, expanded.we_wordv + expanded.we_wordc);
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const int code = cli::run_program(static_cast<int>(words.size()), argv.data());
    std::fflush(nullptr);
    std::_Exit(code);
  }

  static inline const long threads_at_first_ = thread_count();
};

inline bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace etd
