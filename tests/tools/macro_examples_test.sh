#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The shipped macro examples run as they stand: holes on three circles, a tool measured by the skip signal and its length printed.
set -euo pipefail
ncsim=$NC_BINARY_DIR/bin/ncsim
parts=$NC_SOURCE_DIR/examples/parts
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$ncsim" trace "$parts/bolt-circle.nc" >"$work/holes"
deep=$(grep -c '"kind":"line".*"machine":{"X":[-0-9.]*,"Y":[-0-9.]*,"Z":-12}' "$work/holes")
[ "$deep" = 36 ] || { echo "bolt-circle.nc drills $deep holes, not 6 + 12 + 18"; exit 1; }

# The probe touches at Z-63.5 in machine coordinates.
echo '{"skip": [{"signal": 1, "box": {"Z": [-500, -63.5]}}]}' >"$work/button.json"
"$ncsim" check --setup "$work/button.json" --print "$work/printed" "$parts/tool-length.nc"
printf '%%\nH1*L-63.500\n%%\n' | cmp - "$work/printed"

# They run on the shipped machine, which has a button.
for part in bolt-circle tool-length; do
  "$NC_BINARY_DIR/bin/ncrtd" --config "$NC_SOURCE_DIR/etc/machine.toml" run --fast "$parts/$part.nc" >"$work/run" 2>&1 ||
    { cat "$work/run"; exit 1; }
done
grep -q '^print: H1\*L-180\.000$' "$work/run" || { echo "what tool-length.nc prints is not shown"; cat "$work/run"; exit 1; }

# Without anything to touch the macro raises its own alarm.
code=0
"$ncsim" check "$parts/tool-length.nc" >"$work/alarm" || code=$?
[ "$code" = 2 ] && grep -q 'P277.*NO CONTACT' "$work/alarm" || { cat "$work/alarm"; exit 1; }
