#!/bin/sh
# Switches on each planted fault in turn and prints the first test that catches it, as rows of a table:
#   tests/faults/run.sh BUILD [NAME...]     all faults of that build folder, or only these
# The test that docs/verification.md names is tried first, then those of the catalogue. Exit code 1 when a fault is caught
# by no test.
set -eu

build=$1
shift
log=$build/faults.log
sound=$build/sound.txt
page=$(dirname "$0")/../../docs/verification.md
missed=0
: >"$sound"

first_failure() { # FAULT FILTER: the first test that fails; after a crash or 300 s the one that ran
  ETENDUE_FAULT=$1 timeout 300 "$build/bin/etendue_tests" --gtest_filter="$2" --gtest_fail_fast >"$log" 2>&1 </dev/null || true
  awk '/^\[ RUN      \]/ { running = $4 }
       /^\[       OK \]|^\[  SKIPPED \]/ { running = "" }
       /^\[  FAILED  \]/ { exit }
       END { if (running) print running }' "$log"
}

known_to_catch() { # NAME: the test in the table
  awk -F'`' -v row="| $1 |" 'index($0, row) == 1 { print $2 }' "$page"
}

is_sound() { # TEST: does it pass without a fault?
  ! grep -qxF "$1" "$sound" || return 0
  [ -z "$(first_failure 0 "$1")" ] && echo "$1" >>"$sound"
}

wanted() { # NAME [CHOSEN...]
  name=$1
  shift
  [ $# -gt 0 ] || return 0
  for chosen in "$@"; do [ "$chosen" != "$name" ] || return 0; done
  return 1
}

while IFS='|' read -r number name what filter; do
  wanted "$name" "$@" || continue
  caught=
  known=$(known_to_catch "$name")
  [ -z "$known" ] || caught=$(first_failure "$number" "$known")
  [ -n "$caught" ] || caught=$(first_failure "$number" "$filter")
  # A test that fails without the fault as well has caught nothing.
  if [ -z "$caught" ] || ! is_sound "$caught"; then
    printf '| %s | %s | **not caught** by %s |\n' "$name" "$what" "$filter"
    missed=$((missed + 1))
  else
    # shellcheck disable=SC2016 # backquotes for Markdown
    printf '| %s | %s | `%s` |\n' "$name" "$what" "$caught"
  fi
done <"$build/faults.txt"

if [ "$missed" -ne 0 ]; then
  printf '%s of the planted faults are not caught\n' "$missed" >&2
  exit 1
fi
