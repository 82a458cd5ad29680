#!/usr/bin/env bash
# Builds the dashboard into web/dist. Usage: web/build.sh [--check]
#   --check   also checks types, lint rules and format, and runs the unit tests
set -euo pipefail
cd "$(dirname "$0")"

check=0
for argument in "$@"; do
  case "$argument" in
    --check) check=1 ;;
    *) echo "web/build.sh: unknown argument '$argument' (known: --check)" >&2; exit 2 ;;
  esac
done

# npm writes node_modules/.package-lock.json last: it is there, and newer than the lock, only after a complete install.
if [ ! -e node_modules/.package-lock.json ] || [ package-lock.json -nt node_modules/.package-lock.json ] \
  || [ package.json -nt node_modules/.package-lock.json ]; then
  npm ci --no-fund --no-audit
  touch node_modules/.package-lock.json
fi

# The check makes the types and checks the program as the build does.
if [ "$check" -eq 1 ]; then
  npm run --silent check
  npm run --silent bundle
else
  npm run --silent build
fi
