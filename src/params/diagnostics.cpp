#include "params/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace etd {

namespace {

constexpr size_t kExcerptBytes = 100;

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

std::string counted(int n, std::string_view what) { return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s"); }

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Optimal string alignment: insertions, deletions, substitutions and swaps of neighbours, each counting one.
size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<size_t> before(b.size() + 1), previous(b.size() + 1), row(b.size() + 1);
  std::iota(previous.begin(), previous.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({previous[j] + 1, row[j - 1] + 1, previous[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, previous);
    std::swap(previous, row);
  }
  return previous[b.size()];
}

}  // namespace

void Diagnostics::add(Diagnostic d) {
  const SourceLoc place = d.severity == Severity::kNote ? SourceLoc{} : d.loc;
  if (!said_.insert(fmt::format("{}:{}:{}:{}", place.file, place.line, place.column, d.message)).second) return;
  errors_ += d.severity == Severity::kError || d.severity == Severity::kUnsupported;
  list_.push_back(std::move(d));
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
  if (d.loc.file >= 0) {
    out += sources_.name(d.loc.file) + ":";
    if (d.loc.line > 0) out += fmt::format("{}:{}:", d.loc.line, std::max(d.loc.column, 1));
    out += " ";
  }
  out += fmt::format("{}: {}\n", severity_label(d.severity), printable(d.message).text);
  if (d.loc.file >= 0 && d.loc.line > 0) out += excerpt(sources_.line(d.loc.file, d.loc.line), d.loc);
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
  int unsupported_uses = 0, warnings = 0;
  for (const Diagnostic* d : order) {
    out += format(*d);
    unsupported_uses += d->severity == Severity::kUnsupported;
    warnings += d->severity == Severity::kWarning;
  }
  std::string count;
  if (errors_ > 0) count = counted(errors_, "error");
  if (unsupported_uses > 0) count += fmt::format(" ({})", counted(unsupported_uses, "unsupported use"));
  if (warnings > 0) count += (count.empty() ? "" : ", ") + counted(warnings, "warning");
  return count.empty() ? out : out + count + "\n";
}

std::string_view nearest_name(std::string_view word, std::span<const std::string_view> candidates) {
  std::string_view best;
  size_t best_distance = word.size() / 3 + 1;
  for (const std::string_view candidate : candidates) {
    const size_t distance = edit_distance(word, candidate);
    if (distance < best_distance) best = candidate, best_distance = distance;
  }
  return best;
}

}  // namespace etd
