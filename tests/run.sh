#!/usr/bin/env bash
# Installs what is missing, builds everything and runs every test, from nothing, on Debian 12 (as root or with sudo).
# With an option less than that: see usage().
set -euo pipefail
cd "$(dirname "$0")/.."

usage() {
  cat <<'TEXT'
usage: tests/run.sh [OPTION]
  without   everything, from nothing: packages, format, dashboard, sanitizer builds, all tests
  --quick   the same without the sanitizer builds
  --changed builds and runs the tests of the modules that differ from origin/main and of those that depend on them,
            and of the contract (tests/changed.py); in build/release, installs and checks nothing else
  --fast    builds and runs the unit tests labelled "fast"; in build/release, installs and checks nothing else
  --help    says this
TEXT
}

what=all
if [ $# -gt 1 ]; then
  echo "tests/run.sh: one option at a time" >&2
  usage >&2
  exit 2
fi
case "${1:-}" in
  "") ;;
  --quick | --changed | --fast) what="${1#--}" ;;
  --help) usage; exit 0 ;;
  *) echo "tests/run.sh: unknown argument '$1'" >&2; usage >&2; exit 2 ;;
esac

say() { printf '\n== %s (%s)\n' "$1" "$(date +%H:%M:%S)"; }
jobs="$(nproc)"
# One of the tests goes in real time and mostly waits (cmake/HomewardTests.cmake).
tests_at_once="$((jobs + 1))"

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

if [ "$what" = fast ]; then
  say "Fast unit tests"
  configure release -DHOMEWARD_UNIT_TESTS_IN= -DHOMEWARD_TESTS_YIELD=OFF
  build release unit_tests
  ctest --preset release -L '^fast$' -j "$jobs" --no-tests=error
  exit
fi

if [ "$what" = changed ]; then
  folders="$(tests/changed.py)"
  say "Tests of: ${folders//$'\n'/ }"
  configure release -DHOMEWARD_UNIT_TESTS_IN= -DHOMEWARD_TESTS_YIELD=OFF
  mapfile -t programs <<<"$folders"
  build release "${programs[@]/%/_tests}"
  ctest --preset release -R "^(${folders//$'\n'/|})/" -L 'unit|contract' -j "$jobs" --no-tests=error
  exit
fi

say "Packages"
deploy/install-deps.sh

say "Format"
git ls-files '*.cpp' '*.hpp' | xargs clang-format --dry-run -Werror \
  || { echo "Mend with: git ls-files '*.cpp' '*.hpp' | xargs clang-format -i" >&2; exit 1; }

say "Dashboard"
web/build.sh --check

if [ "$what" = all ]; then
  say "Server tests under the thread sanitizer"
  configure tsan -DHOMEWARD_TESTS_YIELD=ON
  build tsan server_tests
  TSAN_OPTIONS="suppressions=$PWD/tests/support/tsan.supp history_size=4" \
    ctest --preset tsan -R '^server/' -j "$tests_at_once" --no-tests=error

  say "Unit tests for the address and undefined behaviour sanitizers"
  configure asan -DHOMEWARD_TESTS_YIELD=ON
  build asan unit_tests
  unit_tests="$PWD/build/asan"
fi

# Each test is built and run once: the unit tests with the sanitizers, all others as people run the programs. Benchmarks are
# built, so that they go on to be programs.
say "All tests"
configure release -DHOMEWARD_UNIT_TESTS_IN="${unit_tests:-}" -DHOMEWARD_TESTS_YIELD=ON
build release all benchmarks
ASAN_OPTIONS="malloc_context_size=12${ASAN_OPTIONS:+:$ASAN_OPTIONS}" \
  ctest --preset release -j "$tests_at_once" --no-tests=error
