#!/usr/bin/env bash
# Installs what is missing, builds everything and runs every test, from nothing, on Debian 12 (as root or with sudo).
# Usage: tests/run.sh [--quick]      --quick leaves the sanitizer builds out
set -euo pipefail
cd "$(dirname "$0")/.."

quick=0
for argument in "$@"; do
  case "$argument" in
    --quick) quick=1 ;;
    *) echo "tests/run.sh: unknown argument '$argument' (known: --quick)" >&2; exit 2 ;;
  esac
done

say() { printf '\n== %s (%s)\n' "$1" "$(date +%H:%M:%S)"; }
jobs="$(nproc)"

say "Packages"
deploy/install-deps.sh

say "Format"
git ls-files '*.cpp' '*.hpp' | xargs clang-format --dry-run -Werror \
  || { echo "Mend with: git ls-files '*.cpp' '*.hpp' | xargs clang-format -i" >&2; exit 1; }

say "Dashboard"
web/build.sh --check

configure() {  # configure PRESET [OPTION...]
  local preset="$1"; shift
  cmake --preset "$preset" -Wno-dev "$@" >"build/configure-$preset.log" 2>&1 \
    || { cat "build/configure-$preset.log" >&2; return 1; }
}
build() {  # build PRESET [TARGET...]
  local preset="$1"; shift
  cmake --build --preset "$preset" -j "$jobs" ${1:+--target "$@"}
}
mkdir -p build

if [ "$quick" -eq 0 ]; then
  say "Server tests under the thread sanitizer"
  configure tsan
  build tsan server_tests
  TSAN_OPTIONS="suppressions=$PWD/tests/support/tsan.supp history_size=4" \
    ctest --preset tsan -R '^server/' -j "$jobs" --no-tests=error

  say "Unit tests for the address and undefined behaviour sanitizers"
  configure asan
  build asan unit_tests
  unit_tests="$PWD/build/asan"
fi

# Each test is built and run once: the unit tests with the sanitizers, all others as people run the programs.
say "All tests"
configure release -DHOMEWARD_UNIT_TESTS_IN="${unit_tests:-}"
build release
ctest --preset release -j "$jobs" --no-tests=error
