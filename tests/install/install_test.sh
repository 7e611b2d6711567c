#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs this build into an empty prefix, and builds a C project against it by find_package and by pkg-config, shared and
# static; then moves the prefix and does it again by pkg-config, because an installed tree may be unpacked anywhere.
set -euo pipefail
if [ -n "${NC_SANITIZE:-}" ]; then
  echo "skipped: a sanitized library needs a sanitized user"
  exit 77
fi
consumer=$NC_SOURCE_DIR/tests/install/consumer
version=$(sed -n 's/^project(libnc VERSION \([0-9.]*\).*/\1/p' "$NC_SOURCE_DIR/CMakeLists.txt")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

check() {  # check PROGRAM [LIBRARY_DIR]: runs and names our version
  local said
  said=$(LD_LIBRARY_PATH=${2:-} "$1")
  case "$said" in
    "$version "[1-9]*) echo "ok: $(basename "$1"): $said" ;;
    *) echo "FAILED: $1 said '$said', expected version $version"; exit 1 ;;
  esac
}

cmake --install "$NC_BINARY_DIR" --prefix "$work/prefix" >"$work/install.log"
for file in bin/ncsim bin/ncrtd share/libnc/etc share/libnc/examples include/nc/nc.h; do
  [ -e "$work/prefix/$file" ] || { echo "FAILED: $file is not installed"; exit 1; }
done

cmake -G Ninja -S "$consumer" -B "$work/cmake" -DCMAKE_PREFIX_PATH="$work/prefix" >"$work/cmake.log" 2>&1 ||
  { cat "$work/cmake.log"; exit 1; }
cmake --build "$work/cmake" >"$work/build.log" 2>&1 || { cat "$work/build.log"; exit 1; }
check "$work/cmake/with_default"
check "$work/cmake/with_static"

mv "$work/prefix" "$work/moved"
pc=$(find "$work/moved" -name libnc.pc -printf '%h')
export PKG_CONFIG_PATH=$pc
cc=${CC:-cc}
read -ra flags <<<"$(pkg-config --cflags --libs libnc)"
"$cc" -std=c11 -Wall -Werror -o "$work/pc_shared" "$consumer/main.c" "${flags[@]}"
check "$work/pc_shared" "$(dirname "$pc")"
read -ra flags <<<"$(pkg-config --static --cflags --libs libnc)"
"$cc" -std=c11 -Wall -Werror -static -o "$work/pc_static" "$consumer/main.c" "${flags[@]}"
check "$work/pc_static"
[ "$(pkg-config --modversion libnc)" = "$version" ] || { echo "FAILED: libnc.pc has another version"; exit 1; }
