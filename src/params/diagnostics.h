// The collector of everything that is wrong with an input. Readers and compile() never stop at the first problem: they
// report here and go on with a harmless stand-in, and the caller asks has_errors() once at the end.
#pragma once

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "params/source.h"

namespace etd {

enum class Severity { kNote, kWarning, kUnsupported, kError };

struct Diagnostic {
  Severity severity;
  SourceLoc loc;
  std::string message;  // what is wrong, one line
  std::string hint;     // what would be valid, may be empty
};

class Diagnostics {
 public:
  explicit Diagnostics(bool allow_unsupported = false) : allow_unsupported_(allow_unsupported) {}

  Sources& sources() { return sources_; }
  const Sources& sources() const { return sources_; }

  // The same message at the same place is kept once: models may look at a parameter more than once.
  void error(SourceLoc loc, std::string message, std::string hint = {});
  void warning(SourceLoc loc, std::string message, std::string hint = {});
  // Something the user should know once per cause: a repeated message is kept once.
  void note(SourceLoc loc, std::string message);
  // A use of something that the language has and Etendue does not have yet. An error, unless unsupported uses are
  // allowed: then a warning that names the substitute ("a diffuse material of the same reflectance").
  void unsupported(SourceLoc loc, std::string what, std::string substitute);

  bool has_errors() const { return errors_ > 0; }
  int error_count() const { return errors_; }
  bool allow_unsupported() const { return allow_unsupported_; }
  // What stands in for unsupported uses, "medium \"fog\": empty space", each pair once.
  const std::set<std::string>& substitutes() const { return substitutes_; }
  std::span<const Diagnostic> all() const { return list_; }

  // "file:line:column: error: message", the source line with a caret, and the hint. Long lines are cut around the
  // caret. Ends with a newline.
  std::string format(const Diagnostic& d) const;
  // All of them in the order of file, line and column, then one line that counts them ("2 errors, 1 warning") when
  // there are errors or warnings: what a program prints to stderr.
  std::string format_all() const;

 private:
  // Keeps the diagnostic unless it was said before.
  void add(Diagnostic diagnostic);

  Sources sources_;
  std::vector<Diagnostic> list_;
  std::set<std::string> said_;
  int errors_ = 0;
  bool allow_unsupported_ = false;
  std::set<std::string> substitutes_;
};

// The candidate nearest to `word` by edit distance (optimal string alignment, case-insensitive), or empty when none is
// near enough to be a slip of the fingers (more than a third of its letters away).
std::string_view nearest_name(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace etd
