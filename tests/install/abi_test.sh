#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The public headers still give the binary interface that is kept in the tree, the library has its number, and the check finds changes that break a
# program, and accepts others.
set -euo pipefail
check=$NC_SOURCE_DIR/scripts/abi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0
"$check" --check || exit $?

# with LABEL FILE SED-EXPRESSION: makes headers with one difference.
with() {
  rm -rf "$work/include"
  cp -r "$NC_SOURCE_DIR/libnc/include" "$work/include"
  sed -i -E "$3" "$work/include/nc/$2"
  ! cmp -s "$work/include/nc/$2" "$NC_SOURCE_DIR/libnc/include/nc/$2" || { echo "FAILED: $1: the headers are the same"; status=1; }
}
breaks() {
  with "$@"
  if "$check" --check "$work/include" >"$work/out" 2>&1; then echo "FAILED: not seen: $1"; status=1; fi
  grep -q 'the binary interface differs' "$work/out" || { echo "FAILED: $1:"; cat "$work/out"; status=1; }
}
passes() {
  with "$@"
  "$check" --check "$work/include" >"$work/out" 2>&1 || { echo "FAILED: $1:"; cat "$work/out"; status=1; }
}
breaks 'a member in the middle' inputs.h 's/^(  bool fin2;.*)$/  double later;\n\1/'
breaks 'a member that is gone' inputs.h '/^  bool follow_up;/d'
breaks 'a member of another type' config.h 's/^  double cycle_s;/  float cycle_s;/'
breaks 'a struct without size that grows' types.h 's/^(  uint16_t file; .*)$/\1\n  uint32_t later;/'
breaks 'a function that is gone' run.h 's/^NC_API nc_status nc_recalculate/static inline nc_status nc_recalculate/'
breaks 'a function with another parameter' run.h 's/^(NC_API nc_status nc_feed\(nc_control\*[^,]*)/\1, int later/'
breaks 'another number of a status' types.h 's/^  NC_E_READ = -5/  NC_E_READ = -6/'
breaks 'another number of an enumerator that is given as a byte' item.h 's/^  NC_ITEM_SYNC = 3/  NC_ITEM_SYNC = 33/'
breaks 'another value of a constant' types.h 's/^#define NC_MAX_TEXT 128/#define NC_MAX_TEXT 129/'
passes 'an enumerator more' types.h 's/^(  NC_E_READ = -5)/\1,\n  NC_E_LATER = -6/'
passes 'a function more' types.h 's/^(NC_API const char\* nc_status_text)/NC_API int nc_later(int what);\n\1/'
passes 'a struct with size that grows at its end' run.h 's/^(  uint64_t handle_dropped;.*)$/\1\n  double later;/'

if [ -z "${NC_SANITIZE:-}" ] && command -v readelf >/dev/null; then
  number=$(sed -n 's/^set(NC_ABI \([0-9]*\)).*/\1/p' "$NC_SOURCE_DIR/libnc/cmake/abi.cmake")
  library=$NC_BINARY_DIR/libnc/libnc.so
  # Read to its end: a reader that leaves earlier makes readelf fail, and with it the line.
  grep -q "SONAME.*\[libnc.so.$number\]" <<<"$(readelf -d "$library")" || { echo "FAILED: the SONAME is not libnc.so.$number"; status=1; }
  [ "$(readelf -W --dyn-syms "$library" | grep -c "nc_create@@NC_$number\$")" = 1 ] || { echo "FAILED: symbols have no version NC_$number"; status=1; }
fi
exit $status
