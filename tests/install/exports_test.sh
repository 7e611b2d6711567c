#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# libnc.so exports only nc_*, exports every function that the headers declare NC_API, and needs no C++ run-time library.
set -euo pipefail
if [ -n "${NC_SANITIZE:-}" ]; then
  echo "skipped: a sanitized library has the sanitizer's symbols too"
  exit 77
fi
library=$NC_BINARY_DIR/libnc/libnc.so
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
nm -D --defined-only "$library" | awk '$2 != "A" {sub(/@.*/, "", $3); print $3}' | sort -u >"$work/shown"
# Declarations may run over several lines: join them, then take the name before the first parenthesis.
cat "$NC_SOURCE_DIR"/libnc/include/nc/*.h | tr '\n' ' ' | grep -oE 'NC_API [^;{]*\(' |
  grep -oE 'nc_[a-z0-9_]+ *\(' | tr -d ' (' | sort -u >"$work/declared"
status=0
if grep -v '^nc_' "$work/shown"; then echo "FAILED: the symbols above are visible and not of the C API"; status=1; fi
missing=$(comm -13 "$work/shown" "$work/declared")
if [ -n "$missing" ]; then echo "FAILED: declared in a header, not in the library:"; echo "$missing"; status=1; fi
if readelf -d "$library" | grep NEEDED | grep -vE 'lib(m|c|gcc_s)\.so'; then
  echo "FAILED: libnc.so needs the libraries above"; status=1
fi
echo "$(wc -l <"$work/shown") functions visible, $(wc -l <"$work/declared") declared"
exit $status
