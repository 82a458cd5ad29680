#!/usr/bin/env bash
# clang-tidy for the tidy preset. Clang 14 cannot compile Asio's coroutines with GCC 12's library; those files are left out.
for argument in "$@"; do
  case "$argument" in
    */server/http/http_server.cpp) exit 0 ;;
    --) break ;;
  esac
done
exec clang-tidy --quiet --extra-arg=-Wno-unknown-warning-option --extra-arg=-Wno-unused-command-line-argument "$@"
