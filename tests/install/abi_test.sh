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
breaks 'a member of a struct that begins with its size has a larger type' inputs.h 's/^  bool feed_hold; /  uint32_t feed_hold; /'
breaks 'a member with another sign' item.h 's/^  uint64_t serial;/  int64_t serial;/'
breaks 'a member with another name' inputs.h 's/^  bool fin2;/  bool fin_two;/'
breaks 'a member in the padding of a struct that begins with its size' vendor.h 's/^(  uint8_t call; .*)$/\1\n  uint8_t later;/'
breaks 'a struct that grows inside of one with a size' config.h 's/^(  double in_position; .*)$/\1\n  double later;/'
breaks 'a struct that grows at its end, of which another has an array' inputs.h 's/^(  double distance; .*)$/\1\n  double later;/'
breaks 'a member in the padding of a struct without size' inputs.h 's/^(  bool unmeasured; .*)$/\1\n  bool later;/'
breaks 'a reserved member that becomes shorter' config.h 's/^  double reserved\[6\];/  double later, reserved[5];/'
breaks 'a member of a union has another type' item.h 's/^    nc_gate gate;/    nc_mark gate;/'
breaks 'a struct in a union grows' item.h 's/^(\} nc_move;)/  double later[40];\n\1/'
breaks 'a struct in a union grows within its room' item.h 's/^(\} nc_gate;)/  double later;\n\1/'
breaks 'a callback that a struct holds has another parameter' vendor.h 's/(nc_inverse_kinematics\)\(void\* user, const nc_axes\* machine, nc_axes\* joint)/\1, int later/'
breaks 'a callback that a function takes has another result' program.h 's/typedef long \(\*nc_read_at\)/typedef int (*nc_read_at)/'
breaks 'a member that becomes a bit field' run.h 's/^  uint8_t strobe; /  uint8_t strobe : 4; /'
passes 'an enumerator more' types.h 's/^(  NC_E_READ = -5)/\1,\n  NC_E_LATER = -6/'
passes 'a function more' types.h 's/^(NC_API const char\* nc_status_text)/NC_API int nc_later(int what);\n\1/'
passes 'an enumerator more of a type that a struct has as a byte' item.h 's/^(  NC_ITEM_END = 6)( .*)$/\1,\2\n  NC_ITEM_LATER = 7/'
passes 'a struct with size that grows at its end' run.h 's/^(  uint64_t handle_dropped;.*)$/\1\n  double later;/'

if [ -z "${NC_SANITIZE:-}" ] && command -v readelf >/dev/null; then
  number=$(sed -n 's/^set(NC_ABI \([0-9]*\)).*/\1/p' "$NC_SOURCE_DIR/libnc/cmake/abi.cmake")
  library=$NC_BINARY_DIR/libnc/libnc.so
  # Read to its end: a reader that leaves earlier makes readelf fail, and with it the line.
  grep -q "SONAME.*\[libnc.so.$number\]" <<<"$(readelf -d "$library")" || { echo "FAILED: the SONAME is not libnc.so.$number"; status=1; }
  [ "$(readelf -W --dyn-syms "$library" | grep -c "nc_create@@NC_$number\$")" = 1 ] || { echo "FAILED: symbols have no version NC_$number"; status=1; }
fi
exit $status
