// The collector of everything that is wrong with an input. Readers and compile() never stop at the first problem: they
// report here and go on with a harmless stand-in, and the caller asks has_errors() once at the end.
#pragma once

#include <array>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <unordered_set>
#include <vector>

#include "params/limits.h"
#include "params/source.h"

namespace etd {

enum class Severity { kNote, kWarning, kUnsupported, kError };

struct Diagnostic {
  Severity severity;
  SourceLoc loc;
  std::string message;  // what is wrong, one line
  std::string hint;     // what would be valid, lines, may be empty
};

class Diagnostics {
 public:
  explicit Diagnostics(bool allow_unsupported = false, const Limits& limits = {})
      : limits_(limits), allow_unsupported_(allow_unsupported) {}

  Sources& sources() { return sources_; }
  const Sources& sources() const { return sources_; }
  // What the input may ask for.
  const Limits& limits() const { return limits_; }

  // The same message at the same place is kept once: models may look at a parameter more than once. Of each kind the
  // first `limits().messages` are kept and the others counted; what is longer than a line is cut.
  void error(SourceLoc loc, std::string message, std::string hint = {});
  // The hint is looked for only when the message is kept: for those that are found among many names.
  template <class FindHint>
  requires std::is_invocable_r_v<std::string, FindHint>
  void error(SourceLoc loc, std::string message, const FindHint& find_hint) {
    if (Diagnostic* d = add({Severity::kError, loc, std::move(message), {}})) set_hint(*d, find_hint());
  }
  void warning(SourceLoc loc, std::string message, std::string hint = {});
  // Something the user should know once per cause: a repeated message is kept once.
  void note(SourceLoc loc, std::string message);
  // A use of something that the language has and Etendue does not have yet. An error, unless unsupported uses are
  // allowed: then a warning that names the substitute ("a diffuse material of the same reflectance").
  void unsupported(SourceLoc loc, std::string what, std::string substitute);

  bool has_errors() const { return error_count() > 0; }
  // Counts errors and unsupported uses, those that are not kept, too.
  int error_count() const { return static_cast<int>(count(Severity::kError) + count(Severity::kUnsupported)); }
  bool allow_unsupported() const { return allow_unsupported_; }
  // What stands in for unsupported uses, "medium \"fog\": empty space", each pair once.
  const std::set<std::string>& substitutes() const { return substitutes_; }
  std::span<const Diagnostic> all() const { return list_; }

  // "file:line:column: error: message", the source line with a caret, and the hint. Long lines are cut around the
  // caret. Ends with a newline.
  std::string format(const Diagnostic& d) const;
  // All that are kept in the order of file, line and column, then one line that counts them ("2 errors, 1 warning")
  // when there are errors or warnings, and tells whether there are more: what a program prints to stderr.
  std::string format_all() const;

 private:
  // Counts the diagnostic unless it was said before, and returns it as kept; null when it is not.
  Diagnostic* add(Diagnostic diagnostic);
  static void set_hint(Diagnostic& diagnostic, std::string_view hint);
  size_t count(Severity severity) const { return counts_[static_cast<size_t>(severity)]; }

  Sources sources_;
  std::vector<Diagnostic> list_;
  std::unordered_set<uint64_t> said_;  // hashes of place and message
  std::array<size_t, 4> counts_{};     // by severity
  Limits limits_;
  bool allow_unsupported_ = false;
  std::set<std::string> substitutes_;
};

// The candidate nearest to `word` by edit distance (optimal string alignment, case-insensitive), or empty when none is
// near enough to be a slip of the fingers (more than a third of its letters away) or the word is longer than 64 bytes,
// which nobody mistypes.
std::string_view nearest_name(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace etd
