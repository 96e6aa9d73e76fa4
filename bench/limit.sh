#!/bin/sh
# How far is the renderer from the least that a path tracer must do? Renders bench/cornell-limit.pbrt, then runs a bare loop
# over the same box (limit.cpp beside the project, in ../shared/bench or $ETENDUE_SHARED/bench) and prints both and their ratio.
# Usage: bench/limit.sh PROGRAM   (./dev bench limit calls it)
set -eu

program=$1
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
shared=${ETENDUE_SHARED:-$root/../shared}
spp=64
size=512
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$program" render "$root/bench/cornell-limit.pbrt" -o "$work/cornell.exr" --size "${size}x$size" --spp "$spp" \
  --threads "$(nproc)" --quiet --stats "$work/stats.json" >&2

number() { # KEY: the number behind this key of the statistics
  tr -d ' \n' <"$work/stats.json" | sed -n "s/.*\"$1\":\([-+.0-9eE]*\).*/\1/p"
}
seconds=$(number render)
paths=$(number paths)
rays=$(awk -v a="$(number camera)" -v b="$(number indirect)" -v c="$(number shadow)" 'BEGIN { printf "%.0f", a + b + c }')
awk -v s="$seconds" -v p="$paths" -v r="$rays" -v m="$(number peak_bytes)" \
  'BEGIN { printf "etendue: %.2f s, %.2f Mpaths/s, %.2f Mrays/s, peak %.0f MB\n", s, p / s * 1e-6, r / s * 1e-6, m * 1e-6 }'

if [ ! -e "$shared/bench/limit.cpp" ]; then
  echo "limit: not measured, there is no $shared/bench/limit.cpp"
  exit 0
fi
"${CXX:-g++}" -O3 -march=native -ffast-math -w "$shared/bench/limit.cpp" -lembree3 -ltbb -o "$work/limit"
limit=$("$work/limit" "$spp" "$size")
echo "$limit"
echo "$limit" | sed 's/.* \([0-9.]*\) Mpaths.*/\1/' |
  awk -v s="$seconds" -v p="$paths" '{ printf "etendue / limit: %.2f of the paths per second\n", p / s * 1e-6 / $1 }'
