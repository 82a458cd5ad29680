#!/usr/bin/env bash
# Installs every package that building, testing and running Homeward needs on Debian 12.
# Safe to run again: it asks apt only for what is missing. Runs as root or with sudo.
set -euo pipefail

# One package a line, so that a change shows what was added. docs/dependencies.md says what each is for.
packages=(
  build-essential
  cmake
  ninja-build
  ccache
  mold
  pkg-config
  git
  curl
  ca-certificates
  openssl
  clang-format
  python3
  libboost-dev
  libexpected-dev
  libeigen3-dev
  libopencv-dev
  libopencv-contrib-dev
  libturbojpeg0-dev
  libopengv-dev
  libceres-dev
  libsqlite3-dev
  libsqlitecpp-dev
  nlohmann-json3-dev
  libvalijson-dev
  libspdlog-dev
  libcli11-dev
  libhnswlib-dev
  libhwy-dev
  prometheus-cpp-dev
  libsodium-dev
  libssl-dev
  zlib1g-dev
  libassimp-dev
  libexpat1-dev
  libembree-dev
  libtbb-dev
  libgtest-dev
  libgmock-dev
  librapidcheck-dev
  libbenchmark-dev
  googletest
  g++-aarch64-linux-gnu
  qemu-user
  chromium-headless-shell
  fonts-dejavu-core
)

# A Node that is already here is kept when it is new enough: Debian's own conflicts with other Node packages.
node_major() { node --version 2>/dev/null | sed -E 's/^v([0-9]+).*/\1/'; }
if ! command -v npm >/dev/null 2>&1 || [ "$(node_major || true)" = "" ] || [ "$(node_major)" -lt 18 ]; then
  packages+=(nodejs npm)
fi

missing=()
for package in "${packages[@]}"; do
  if [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)" != installed ]; then
    missing+=("$package")
  fi
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "install-deps: everything is installed"
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null 2>&1; then
    echo "install-deps: run this as root, or install sudo. Missing: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "install-deps: installing ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
