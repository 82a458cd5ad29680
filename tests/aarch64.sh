#!/usr/bin/env bash
# Compiles the loops made with Highway, and their unit tests, for 64-bit ARM and runs them in qemu's user mode.
# Usage: tests/aarch64.sh [FOLDER]     FOLDER keeps what is compiled; without one it is thrown away
# Exits with 77 (skipped) where there is no cross compiler or no qemu: deploy/install-deps.sh installs both.
set -euo pipefail
cd "$(dirname "$0")/.."

compiler=aarch64-linux-gnu-g++
emulator=qemu-aarch64
googletest=/usr/src/googletest/googletest
for needed in "$compiler" "$emulator"; do
  if ! command -v "$needed" >/dev/null 2>&1; then
    echo "tests/aarch64.sh: skipped: there is no $needed here (deploy/install-deps.sh installs it)"
    exit 77
  fi
done

folder="${1:-}"
if [ -z "$folder" ]; then
  folder="$(mktemp -d)"
  trap 'rm -rf "$folder"' EXIT
fi
mkdir -p "$folder/include"
rm -f "$folder"/*.o
# Headers that are the same on every processor. All of /usr/include would bring in this machine's C library.
for headers in hwy eigen3/Eigen tl; do ln -sfn "/usr/include/$headers" "$folder/include/$(basename "$headers")"; done

# What needs nothing but Eigen and Highway, of which the headers are enough: there is one kind of processor to choose.
sources=(
  src/core/angles.cpp
  src/features/blur_strips.cpp
  src/features/direction_histogram.cpp
  src/features/extremum_rows.cpp
  src/geometry/match_row_loops.cpp
  src/geometry/match_rows.cpp
  src/geometry/tilted_motion.cpp
  src/geometry/tilted_refinement.cpp
  src/matching/dot.cpp
  src/matching/nearest.cpp
  src/matching/nearest_columns.cpp
  src/matching/nearest_portable.cpp
  src/sim/sensor.cpp
  src/tracking/patch_sums.cpp
  tests/unit/features/blur_strips_test.cpp
  tests/unit/features/direction_histogram_test.cpp
  tests/unit/features/extremum_rows_test.cpp
  tests/unit/geometry/match_row_loops_test.cpp
  tests/unit/geometry/match_rows_test.cpp
  tests/unit/matching/dot_test.cpp
  tests/unit/matching/nearest_columns_test.cpp
  tests/unit/matching/nearest_test.cpp
  tests/unit/sim/sensor_test.cpp
  tests/unit/tracking/patch_sums_test.cpp
  "$googletest/src/gtest-all.cc"
  "$googletest/src/gtest_main.cc"
)
# As cmake/HomewardTarget.cmake has them.
flags=(-std=c++20 -O2 -Wall -Wextra -Wpedantic -Wshadow -Werror -Wno-maybe-uninitialized -Wno-array-bounds
       -fno-math-errno -ffp-contract=off -I"$PWD/src" -I"$PWD/tests"
       -isystem "$folder/include" -isystem "$googletest/include" -isystem "$googletest")

compile() {  # compile SOURCE
  local with=("$compiler")
  if command -v ccache >/dev/null 2>&1; then with=(ccache "$compiler"); fi
  "${with[@]}" "${flags[@]}" -c "$1" -o "$folder/$(basename "${1%.*}").o"
}

running=0
for source in "${sources[@]}"; do
  if [ "$running" -ge "$(nproc)" ]; then
    wait -n
    running=$((running - 1))
  fi
  compile "$source" &
  running=$((running + 1))
done
while [ "$running" -gt 0 ]; do
  wait -n
  running=$((running - 1))
done
"$compiler" -static "$folder"/*.o -o "$folder/kernels"
"$emulator" "$folder/kernels"
