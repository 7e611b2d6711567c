#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The shipped machine whose axes are homed runs a part: it homes first and says so. What keeps it from homing is an alarm with axis and reason.
set -euo pipefail
ncrtd=$NC_BINARY_DIR/bin/ncrtd
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mill=$work/mill.toml
sed "s#^programs = .*#programs = \"$work\"#" "$NC_SOURCE_DIR/etc/homed_mill.toml" >"$mill"
printf 'G90 G53 G0 X-100. Y-50.\nG53 G0 Z-20.\nM30\n' >"$work/part.nc"

"$ncrtd" --config "$NC_SOURCE_DIR/etc/homed_mill.toml" check >"$work/check" 2>&1 || { cat "$work/check"; exit 1; }
"$ncrtd" --config "$mill" run --fast "$work/part.nc" >"$work/run" 2>&1 || { cat "$work/run"; exit 1; }
grep -q 'the machine is homed first' "$work/run" || { cat "$work/run"; exit 1; }

sed -i 's/^dog = \[5.0, 20.0\]/dog = [500.0, 520.0]/' "$mill"
code=0
"$ncrtd" --config "$mill" run --fast "$work/part.nc" >"$work/run" 2>&1 || code=$?
[ "$code" != 0 ] && grep -q 'R22 Limit switch in +, axis X' "$work/run" || { echo "status $code"; cat "$work/run"; exit 1; }
echo "homed, and refused to go on where a dog is missing"
