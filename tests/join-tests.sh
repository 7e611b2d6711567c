#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Writes several test files into one, which the build compiles in their place: what they share of headers and templates is then compiled once.
#   tests/join-tests.sh OUT FILE...
# Each file keeps what is its own: its `namespace {` goes into a namespace with the file's name, so that two files may use one name for different
# things. The layout of scripts/format, which is checked, gives the first and the last line of that block their form. Messages of the compiler,
# of GoogleTest and of a debugger name the files themselves.
set -euo pipefail
out=$1
shift
{
  for file in "$@"; do
    printf '#line 1 "%s"\n' "$file"
    sed -e "s|^namespace {\$|namespace in_$(basename "$file" .cpp) { namespace {|" -e 's|^}  // namespace$|} }  // namespace|' "$file"
  done
} >"$out"
