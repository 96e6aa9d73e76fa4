// The tokens of a scene across its files: an included file's tokens stand in for the directive that names it.
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "formats/pbrt/repeats.h"
#include "formats/pbrt/tokenizer.h"

namespace etd::pbrt {

class TokenStream {
 public:
  // Relative names of included files start in `folder`.
  TokenStream(std::filesystem::path folder, Diagnostics& diagnostics)
      : folder_(std::move(folder)), diagnostics_(diagnostics) {}

  // Goes on with this text, then returns to where it was. Returns the index of the new source.
  int32_t push_text(std::string text, const std::string& name);
  // Goes on with the main file and returns its source; -1, and reported, when it cannot be read.
  int32_t push_main(const std::filesystem::path& file);
  // Goes on with a file named in a scene, looked for beside the main file and then beside the naming one. False when it
  // was reported as missing, unreadable or including itself. The end of an `isolated` file is an end of the stream
  // until pop_isolated().
  bool push_included(const std::string& name, const SourceLoc& loc, bool isolated);
  void pop_isolated();

  std::optional<Token> next();
  const std::optional<Token>& peek();
  // Appends the numbers that come next (Tokenizer::take); none of them while a token has been looked at already.
  template <class T>
  void take(std::vector<T>& values, size_t most = std::numeric_limits<size_t>::max()) {
    if (!peeked_ && !files_.empty()) files_.back().tokenizer.take(values, most);
  }
  void set_quiet(bool quiet) { quiet_ = quiet; }

  Repeats repeats;

 private:
  struct File {
    Tokenizer tokenizer;
    std::filesystem::path path;  // as it was named; empty: no file
    std::filesystem::path canonical;
    bool isolated = false;
  };

  // `missing`: what to tell when there is no such file.
  int32_t push_file(const std::filesystem::path& path, const SourceLoc& loc, bool isolated,
                    const std::function<std::string()>& missing);
  void push(int32_t source, std::filesystem::path path, std::filesystem::path canonical, bool isolated);
  void pop();
  bool closes_a_loop(const std::filesystem::path& canonical, const SourceLoc& loc);

  std::filesystem::path folder_;
  Diagnostics& diagnostics_;
  std::vector<File> files_;
  std::set<std::filesystem::path> open_;           // canonical paths of files_
  std::map<std::filesystem::path, int32_t> read_;  // sources by path: a file included often is read once
  std::optional<Token> peeked_;
  bool quiet_ = false;
};

}  // namespace etd::pbrt
