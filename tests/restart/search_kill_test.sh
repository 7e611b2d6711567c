#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The control is killed (SIGKILL) while a place in a program is found, and while the program stands there. What the search has written is not what the next
# control begins with; what the program writes behind the place is.
. "$(dirname "${BASH_SOURCE[0]}")/../services/ncctl_process.sh"

mkdir "$work/programs"
sed -e "s#^programs = .*#programs = \"$work/programs\"\nvariables = \"$work/variables\"\noffsets = \"$work/offsets\"\nretain_every_s = 0.05#" -e '/^retain_every_s = 1/d' \
  -e "s#^socket = \"\"#socket = \"$work/mill.sock\"#" -e "s#^changes = \"\"#changes = \"$work/changes\"#" -e "s#^history = \"\"#history = \"$work/history\"#" \
  -e 's#^policy = "fifo"#policy = "other"#' -e 's#^lock_memory = true#lock_memory = false#' -e 's/^overrun = .*/overrun = "count"/' "$source/etc/machine.toml" >"$work/machine.toml"
cp "$source/etc/mill.il" "$work/"
export NC_SOCKET=$work/mill.sock

begin() {
  "$ncrtd" --machine "$work/machine.toml" serve --share "search-$$" >"$work/serve.out" 2>"$work/serve.err" &
  server=$!
  until_true "$ncctl" status
  expect 0 "$ncctl" mode auto
}
killed() {
  kill -9 "$server"
  wait "$server" 2>/dev/null
  server=
}
phase_is() { [ "$("$ncctl" --json restart | python3 -c 'import json, sys; print(json.load(sys.stdin)["phase"])')" = "$1" ]; }
# Long enough for several savings.
saved() { sleep 0.5; }
counted() { "$ncctl" tables export --table variables | sed -n "s/^500 = //p"; }
shifted() { "$ncctl" tables export --table offsets | grep '^"G54"'; }

cat >"$work/programs/part.nc" <<'PROGRAM'
G90 G54 G17 G21
#500=#500+1
G91 G10 L2 P1 X1.
G90 G0 X5. Y5.
N50 X6.
N60 #501=9
M30
PROGRAM

begin
printf "[variables]\n500 = 7.0\n" >"$work/seven.toml"
expect 0 "$ncctl" tables import "$work/seven.toml"
saved
offset=$(shifted)
expect 0 "$ncctl" select part.nc
expect 0 "$ncctl" restart find --sequence 50
until_true phase_is found
[ "$(counted)" = 8 ] || fail "the search has not counted: $(counted)"
[ "$(shifted)" != "$offset" ] || fail "the search has shifted nothing: $offset"
saved
killed

begin
[ "$(counted)" = 7 ] || fail "#500 is $(counted) behind a kill at a place that was found"
[ "$(shifted)" = "$offset" ] || fail "the offset is $(shifted) instead of $offset"
expect 0 "$ncctl" select part.nc
expect 0 "$ncctl" restart find --sequence 50
until_true phase_is found
expect 0 "$ncctl" start
until_true phase_is stands
saved
killed

begin
[ "$(counted)" = 7 ] || fail "#500 is $(counted) behind a kill at the place"
[ "$(shifted)" = "$offset" ] || fail "the offset is $(shifted) instead of $offset"
expect 0 "$ncctl" select part.nc
expect 0 "$ncctl" restart find --sequence 50
until_true phase_is found
expect 0 "$ncctl" start
until_true phase_is stands
expect 0 "$ncctl" restart confirm
expect 0 "$ncctl" mode manual
for axis in X Y; do expect 0 "$ncctl" restart approach "$axis" --velocity 50; done
expect 0 "$ncctl" mode auto
expect 0 "$ncctl" start
until_true phase_is ended
until_true says "^501 = 9" "$ncctl" tables export --table variables
saved
killed

begin
[ "$(counted)" = 8 ] || fail "#500 is $(counted) behind a kill when the program had gone on"
[ "$(shifted)" != "$offset" ] || fail "the offset is the old one, and the program has gone on"
exit $((failures > 0))
