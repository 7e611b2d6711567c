#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The power fails in a part, and the control is killed (SIGKILL). The next one goes on with the part where it was, by ncctl: nothing moves before the operator
# has said so, a changed program is refused, and the part comes to the end of its path.
. "$(dirname "${BASH_SOURCE[0]}")/../services/ncctl_process.sh"

mkdir "$work/programs"
sed -e "s#^programs = .*#programs = \"$work/programs\"\nvariables = \"$work/variables\"\noffsets = \"$work/offsets\"\nretain_every_s = 0.05#" -e '/^retain_every_s = 1/d' \
  -e "s#^socket = \"\"#socket = \"$work/mill.sock\"#" -e "s#^changes = \"\"#changes = \"$work/changes\"#" -e "s#^history = \"\"#history = \"$work/history\"#" \
  -e 's#^policy = "fifo"#policy = "other"#' -e 's#^lock_memory = true#lock_memory = false#' -e 's/^overrun = .*/overrun = "count"/' "$source/etc/machine.toml" >"$work/machine.toml"
printf '[power]\nstop_s = 20.0\nsettle_s = 0.05\nplace = "%s/place"\n' "$work" >>"$work/machine.toml"
cp "$source/etc/mill.il" "$work/"
export NC_SOCKET=$work/mill.sock

begin() {
  "$ncrtd" --machine "$work/machine.toml" serve --share "restart-$$" >"$work/serve.out" 2>"$work/serve.err" &
  server=$!
  until_true "$ncctl" status
}
killed() {
  kill -9 "$server"
  wait "$server" 2>/dev/null
  server=
}
# state JSON-EXPRESSION: of restart.status
state() { "$ncctl" --json restart | python3 -c "import json, sys; s = json.load(sys.stdin); print($1)"; }
phase_is() { [ "$(state 's["phase"]')" = "$1" ]; }
ready() { "$ncctl" --json status | python3 -c 'import json, sys; s = json.load(sys.stdin); sys.exit(s["resetting"] or s["alarms"] + s["warnings"] != 0)'; }
machine() { "$ncctl" --json status | python3 -c 'import json, sys; print(*("%.4f" % a["machine"] for a in json.load(sys.stdin)["systems"][0]["axes"]))'; }
stopped() { "$ncctl" --json status | python3 -c 'import json, sys; sys.exit(json.load(sys.stdin)["systems"][0]["state"] != "stopped")'; }
line_is() { [ "$("$ncctl" --json status | python3 -c 'import json, sys; print(json.load(sys.stdin)["systems"][0]["line"])')" = "$1" ]; }

cat >"$work/programs/part.nc" <<'PROGRAM'
G90 G54 G17 G21
S900 M3
G0 X5. Y5.
N40 G1 X10. F900. M8
N50 G91 X3. F60.
N60 Y2. F900.
N70 G90 X1.
M9
M30
PROGRAM

begin
expect 0 "$ncctl" select part.nc
expect 2 "$ncctl" restart find --last-stop
said err "no stop of a program before its end is known"
expect 1 "$ncctl" restart find
expect 1 "$ncctl" restart find --line 3 --block 4
expect 1 "$ncctl" restart find --block 4 --passing 2
expect 1 "$ncctl" restart find --line 0
expect 1 "$ncctl" restart find --sequence none
expect 1 "$ncctl" restart find --line 3 --file ../etc/passwd
expect 2 "$ncctl" restart find --line 3 --file other.nc
expect 2 "$ncctl" restart confirm
expect 2 "$ncctl" restart cancel
expect 2 "$ncctl" restart approach X
expect 0 "$ncctl" restart
said out "no place has been looked for"
expect 0 "$ncctl" start
until_true line_is 5
expect 0 "$ncctl" force plc.power_fail_n 0
until_true test -s "$work/place"
until_true grep -q '^cause power' "$work/place"
killed

begin
until_true says 'R25' "$ncctl" alarms
expect 0 "$ncctl" reset
until_true ready
expect 0 "$ncctl" mode auto
expect 0 "$ncctl" select part.nc
stood=$(machine)
expect 0 "$ncctl" restart find --power-off
until_true phase_is found
[ "$(state 's["line"]')" = 5 ] || { fail "another block"; "$ncctl" restart; }
expect 0 "$ncctl" start
until_true phase_is stands
expect 2 "$ncctl" start
said err "not there: give it out by MDI, or confirm it"
[ "$(machine)" = "$stood" ] || fail "the axes have moved: $stood, $(machine)"
expect 0 "$ncctl" mode mdi
expect 0 "$ncctl" mdi --start 'S900 M3'
until_true says 'M3 +done' "$ncctl" restart
expect 0 "$ncctl" restart confirm
until_true stopped
expect 0 "$ncctl" mode auto
expect 2 "$ncctl" start
said err "an axis is not where the program goes on"
expect 0 "$ncctl" mode manual
for axis in Z X Y; do expect 0 "$ncctl" restart approach "$axis" --velocity 20; done
[ "$(state 'any(a["away"] for a in s["axes"])')" = False ] || { fail "an axis is away"; "$ncctl" restart; }
expect 0 "$ncctl" mode auto
expect 0 "$ncctl" start
until_true phase_is ended
until_true says '^ *X +1 ' "$ncctl" status
[ "$(state 's["text"]')" = "the program has gone on" ] || fail "it has not gone on"

# A reset is a stop, too, which outlives the kill; behind it the program is changed.
until_true says '^ready|^no program|idle' "$ncctl" status
expect 0 "$ncctl" start
until_true line_is 5
expect 0 "$ncctl" reset
until_true grep -q '^cause reset' "$work/place.stops"
killed
begin
expect 0 "$ncctl" select part.nc
expect 0 "$ncctl" restart find --last-stop
until_true phase_is found
expect 0 "$ncctl" restart cancel

# A later run is killed without a word: the stop that is kept is not that of this run.
expect 0 "$ncctl" start
until_true line_is 5
until_true grep -q '^cause outdated' "$work/place.stops"
killed
begin
expect 0 "$ncctl" select part.nc
expect 2 "$ncctl" restart find --last-stop
said err "it is not known: the control has ended in a later run of part.nc"
expect 2 "$ncctl" restart find --power-off
expect 0 "$ncctl" start
until_true line_is 5
expect 0 "$ncctl" reset
until_true grep -q '^cause reset' "$work/place.stops"
sed -i 's/Y2\./Y3./' "$work/programs/part.nc"
expect 0 "$ncctl" select part.nc
expect 2 "$ncctl" restart find --last-stop
said err "has been changed since"
exit $((failures > 0))
