#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Each family that the library knows has a machine in etc/ with an example part, which ./run --dialect takes, and the part runs to its end there.
set -euo pipefail
. "$NC_SOURCE_DIR/scripts/lib.sh"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
ncsim=$NC_BINARY_DIR/bin/ncsim
names=$("$ncsim" dialects | tail -n +2 | cut -f 1)
[ "$(wc -w <<<"$names")" -ge 5 ] || die "ncsim dialects names: $names"
for name in $names; do
  machine=$(machine_of_dialect "$name")
  [ -n "$machine" ] || die "no machine in etc/ is for ./run --dialect $name; there are$(dialects_of_machines)"
  part=$(example_of_machine "$machine")
  [ -f "$part" ] || die "$machine: its example part $part is missing"
  "$NC_BINARY_DIR/bin/ncrtd" --machine "$machine" run --fast --quiet "$part" >"$work/out" 2>&1 || die "$part on $machine: $(tail -n 3 "$work/out")"
  case $(dialects_of_machines) in *" $name"*) ;; *) die "$name is not listed:$(dialects_of_machines)" ;; esac
done
[ -z "$(machine_of_dialect no-such-family)" ] || die "a machine for a family that is not there"
set +e
out=$("$NC_SOURCE_DIR/run" --dialect nonsense 2>&1)
[ $? -ne 0 ] && grep -q -- "--dialect nonsense: no machine in etc/ is of this family; there are .*series8" <<<"$out" || die "run: $out"
out=$("$NC_SOURCE_DIR/run" --dialect iso --machine "$NC_SOURCE_DIR/etc/router.toml" 2>&1)
[ $? -ne 0 ] && grep -q -- "--dialect is for a machine of etc/" <<<"$out" || die "run: $out"
exit 0
