#include "params/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <tuple>
#include <utility>

#include "core/hash.h"

namespace etd {

namespace {

constexpr size_t kExcerptBytes = 100;
// Longer messages and lines of hints carry a piece of the input that is no name.
constexpr size_t kMessageBytes = 300, kHintBytes = 2000, kHintLines = 20;

std::string_view severity_label(Severity severity) {
  switch (severity) {
    case Severity::kNote:
      return "note";
    case Severity::kWarning:
      return "warning";
    case Severity::kUnsupported:
      return "error";
    case Severity::kError:
      return "error";
  }
  return "error";
}

// Bytes of the well-formed UTF-8 character that `s` begins with, 0 when it begins with none.
size_t utf8_length(std::string_view s) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(s[i]); };
  const size_t n = byte(0) < 0x80   ? 1
                   : byte(0) < 0xc2 ? 0
                   : byte(0) < 0xe0 ? 2
                   : byte(0) < 0xf0 ? 3
                   : byte(0) < 0xf5 ? 4
                                    : 0;
  if (n > s.size()) return 0;
  for (size_t i = 1; i < n; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  return n;
}

struct Printable {
  std::string text;
  size_t columns = 0;
};

// The text with one column per character: tabs become spaces, other control bytes and broken UTF-8 question marks.
Printable printable(std::string_view s) {
  Printable p;
  while (!s.empty()) {
    const size_t n = utf8_length(s);
    const unsigned char c = static_cast<unsigned char>(s[0]);
    if (c == '\t')
      p.text += ' ';
    else if (n == 0 || c < 0x20 || c == 0x7f)
      p.text += '?';
    else
      p.text += s.substr(0, n);
    ++p.columns;
    s.remove_prefix(std::max<size_t>(n, 1));
  }
  return p;
}

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

// The source line and a line of markers below it. A long line is cut to a window around the marked place.
std::string excerpt(std::string_view line, const SourceLoc& loc) {
  const size_t at = std::min<size_t>(static_cast<size_t>(std::max(loc.column, 1)) - 1, line.size());
  const size_t marked_end = std::min(line.size(), at + static_cast<size_t>(std::max(loc.length, 1)));
  size_t begin = 0, end = line.size();
  if (line.size() > kExcerptBytes) {
    begin = at > kExcerptBytes / 2 ? at - kExcerptBytes / 2 : 0;
    end = std::min(line.size(), begin + kExcerptBytes);
    begin = end - kExcerptBytes;
    while (begin < at && is_continuation(line[begin])) ++begin;
    while (end < line.size() && is_continuation(line[end])) ++end;
  }
  const std::string_view head_cut = begin > 0 ? "..." : "", tail_cut = end < line.size() ? "..." : "";
  const Printable head = printable(line.substr(begin, at - begin));
  const Printable marked = printable(line.substr(at, std::min(marked_end, end) - at));
  const Printable tail = printable(line.substr(std::min(marked_end, end), end - std::min(marked_end, end)));
  const size_t tildes = marked.columns > 1 ? marked.columns - 1 : 0;
  return fmt::format("{:5} | {}{}{}{}{}\n      | {}^{}\n", loc.line, head_cut, head.text, marked.text, tail.text,
                     tail_cut, std::string(head_cut.size() + head.columns, ' '), std::string(tildes, '~'));
}

// The text without its middle, if it is longer than `most` bytes: names stand in front, what is wrong with them behind.
std::string shortened(std::string_view text, size_t most) {
  if (text.size() <= most) return std::string(text);
  size_t head = most * 2 / 3, tail = text.size() - most / 3;
  while (head > 0 && is_continuation(text[head])) --head;
  while (tail < text.size() && is_continuation(text[tail])) ++tail;
  return fmt::format("{}...{}", text.substr(0, head), text.substr(tail));
}

std::string counted(size_t n, std::string_view what) { return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s"); }

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

constexpr size_t kLongestWord = 64;

// Optimal string alignment: insertions, deletions, substitutions and swaps of neighbours, each counting one. Looks no
// further than `most`: what is larger may be any larger number. `a` has at most kLongestWord letters.
size_t edit_distance(std::string_view a, std::string_view b, size_t most) {
  const size_t beyond = most + 1;
  if (std::max(a.size(), b.size()) - std::min(a.size(), b.size()) > most) return beyond;
  // Cells further than `most` from the diagonal are beyond it.
  using Row = std::array<uint8_t, 2 * kLongestWord>;
  Row rows[3];
  Row *before = &rows[0], *previous = &rows[1], *row = &rows[2];
  const auto cell = [beyond](size_t distance) { return static_cast<uint8_t>(std::min(distance, beyond)); };
  for (size_t j = 0; j <= b.size(); ++j) (*previous)[j] = cell(j);
  for (size_t i = 1; i <= a.size(); ++i) {
    const size_t first = i > most ? i - most : 1, last = std::min(b.size(), i + most);
    (*row)[first - 1] = cell(first == 1 ? i : beyond);
    if (last < b.size()) (*row)[last + 1] = cell(beyond);
    for (size_t j = first; j <= last; ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      size_t least =
          static_cast<size_t>(std::min({(*previous)[j] + 1, (*row)[j - 1] + 1, (*previous)[j - 1] + (same ? 0 : 1)}));
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
        least = std::min(least, static_cast<size_t>((*before)[j - 2]) + 1);
      (*row)[j] = cell(least);
    }
    std::swap(before, previous);
    std::swap(previous, row);
  }
  return (*previous)[b.size()];
}

}  // namespace

Diagnostic* Diagnostics::add(Diagnostic d) {
  const SourceLoc place = d.severity == Severity::kNote ? SourceLoc{} : d.loc;
  const uint64_t where = hash_combine(static_cast<uint64_t>(place.file), static_cast<uint64_t>(place.line),
                                      static_cast<uint64_t>(place.column));
  if (!said_.insert(hash_combine(where, std::hash<std::string>()(d.message))).second) return nullptr;
  if (counts_[static_cast<size_t>(d.severity)]++ >= limits_.messages) return nullptr;
  d.message = shortened(d.message, kMessageBytes);
  set_hint(d, std::exchange(d.hint, {}));
  return &list_.emplace_back(std::move(d));
}

void Diagnostics::set_hint(Diagnostic& d, std::string_view hint) {
  d.hint.clear();
  for (size_t lines = 0; !hint.empty() && lines < kHintLines; ++lines) {
    const size_t end = std::min(hint.find('\n'), hint.size());
    d.hint += shortened(hint.substr(0, end), kHintBytes) + (end < hint.size() ? "\n" : "");
    hint.remove_prefix(std::min(end + 1, hint.size()));
  }
  if (!hint.empty()) d.hint += "...";
}

void Diagnostics::error(SourceLoc loc, std::string message, std::string hint) {
  add({Severity::kError, loc, std::move(message), std::move(hint)});
}

void Diagnostics::warning(SourceLoc loc, std::string message, std::string hint) {
  add({Severity::kWarning, loc, std::move(message), std::move(hint)});
}

void Diagnostics::note(SourceLoc loc, std::string message) { add({Severity::kNote, loc, std::move(message), {}}); }

void Diagnostics::unsupported(SourceLoc loc, std::string what, std::string substitute) {
  const std::string_view prefix = allow_unsupported_ ? "rendered with: " : "--allow-unsupported renders with: ";
  if (allow_unsupported_) substitutes_.insert(fmt::format("{}: {}", what, substitute));
  add({allow_unsupported_ ? Severity::kWarning : Severity::kUnsupported, loc, std::move(what) + " is not supported yet",
       std::string(prefix) + substitute});
}

std::string Diagnostics::format(const Diagnostic& d) const {
  std::string out;
  // A scene that was read with other diagnostics, or made in code, has places that are unknown here.
  const bool known = d.loc.file >= 0 && d.loc.file < sources_.count();
  if (known) {
    out += sources_.name(d.loc.file) + ":";
    if (d.loc.line > 0) out += fmt::format("{}:{}:", d.loc.line, std::max(d.loc.column, 1));
    out += " ";
  }
  out += fmt::format("{}: {}\n", severity_label(d.severity), printable(d.message).text);
  if (known && d.loc.line > 0) out += excerpt(sources_.line(d.loc.file, d.loc.line), d.loc);
  for (std::string_view rest = d.hint; !rest.empty();) {
    const size_t end = std::min(rest.find('\n'), rest.size());
    out += fmt::format("   {}\n", printable(rest.substr(0, end)).text);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return out;
}

std::string Diagnostics::format_all() const {
  std::vector<const Diagnostic*> order;
  for (const Diagnostic& d : list_) order.push_back(&d);
  std::stable_sort(order.begin(), order.end(), [](const Diagnostic* a, const Diagnostic* b) {
    return std::tie(a->loc.file, a->loc.line, a->loc.column) < std::tie(b->loc.file, b->loc.line, b->loc.column);
  });
  std::string out;
  for (const Diagnostic* d : order) out += format(*d);
  const bool all_shown = *std::max_element(counts_.begin(), counts_.end()) <= limits_.messages;
  std::string counts;
  const auto add_count = [&](size_t n, std::string_view what) {
    if (n > 0) counts += (counts.empty() ? "" : ", ") + counted(n, what);
  };
  add_count(static_cast<size_t>(error_count()), "error");
  if (count(Severity::kUnsupported) > 0)
    counts += fmt::format(" ({})", counted(count(Severity::kUnsupported), "unsupported use"));
  add_count(count(Severity::kWarning), "warning");
  if (!all_shown) add_count(count(Severity::kNote), "note");
  if (!all_shown) counts += "; not all are shown: " + limit_text(limits_, &Limits::messages);
  return counts.empty() ? out : out + counts + "\n";
}

std::string_view nearest_name(std::string_view word, std::span<const std::string_view> candidates) {
  std::string_view best;
  if (word.size() > kLongestWord) return best;
  size_t best_distance = word.size() / 3 + 1;
  for (const std::string_view candidate : candidates) {
    if (best_distance == 0) break;
    const size_t distance = edit_distance(word, candidate, best_distance - 1);
    if (distance < best_distance) best = candidate, best_distance = distance;
  }
  return best;
}

}  // namespace etd
