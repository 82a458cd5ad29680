#!/usr/bin/env bash
# From nothing to a simulated wheelchair that drives where you click, on Debian 12 (as root or with sudo).
# Usage: deploy/demo.sh [--headless [--to ROOM,ROOM]] [--port 8080] [--data DIR] [--fresh]
#   --headless  run one mission to its end without a browser; exit 0 when it arrived, 1 when not
#   --to        where --headless drives, one room after the other (kitchen)
#   --fresh     forget the last demo's tour, map and accounts
set -euo pipefail
cd "$(dirname "$0")/.."

case " $* " in
  *" --help "* | *" -h "*) sed -n '2,6s/^# //p' "$0"; exit 0 ;;
esac

deploy/install-deps.sh
web/build.sh
mkdir -p build
echo "demo: building (the first time takes some minutes)"
cmake --preset release -Wno-dev >build/configure-release.log 2>&1 || { cat build/configure-release.log >&2; exit 1; }
cmake --build --preset release -j "$(nproc)" --target homeward homeward-server homeward-agent homeward-simulated-agent
exec python3 deploy/demo.py --bin build/release/bin --web web/dist "$@"
