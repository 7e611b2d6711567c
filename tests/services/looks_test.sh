#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What a screen is told by ncrtd and ncctl as processes: the program of the block in execution, the mark of a forced device, who has changed a row, texts that a terminal would obey, and
# a file of changes that was damaged.
. "$(dirname "${BASH_SOURCE[0]}")/ncctl_process.sh"

mkdir "$work/programs"
sed -e "s#^programs = .*#programs = \"$work/programs\"#" -e "s#^socket = \"\"#socket = \"$work/mill.sock\"#" -e "s#^changes = \"\"#changes = \"$work/changes\"#" -e "s#^history = \"\"#history = \"$work/history\"#" \
  -e 's/^# *\(variables\|offsets\) =/\1 =/' \
  -e 's#^policy = "fifo"#policy = "other"#' -e 's#^lock_memory = true#lock_memory = false#' -e 's#^overrun = .*#overrun = "count"#' -e 's#^check = .*#check = "off"#' "$source/etc/machine.toml" >"$work/machine.toml"
cp "$source/etc/mill.il" "$work/mill.il"
export NC_SOCKET=$work/mill.sock
begin() {
  "$ncrtd" --machine "$work/machine.toml" serve --share "looks-$$" >"$work/serve.out" 2>"$work/serve.err" &
  server=$!
  until_true "$ncctl" status
}
finish() {
  kill "$server"
  wait "$server"
  server=
}
# value PYTHON COMMAND...: the expression of the reply `r` of a command.
value() {
  local expression=$1; shift
  "$ncctl" --json "$@" | python3 -c "import json, sys; r = json.load(sys.stdin); print($expression)"
}
is() {
  local wanted=$1 got; shift
  got=$(value "$@")
  [ "$got" = "$wanted" ] || fail "'$got' and not '$wanted': $*"
}
begin

# A parameter that was not set before stays set, and the undo goes on to what was changed before it.
expect 0 "$ncctl" parameters set 8013 2
expect 0 "$ncctl" parameters set 8019 5
expect 0 "$ncctl" parameters set 8013 3
printf '[parameters]\n8013 = 4\n8020 = 7\n' >"$work/some.toml"
expect 0 "$ncctl" parameters import "$work/some.toml"
expect 0 "$ncctl" parameters undo
said out 'parameter 8020'
said out 'was not set before, and what is set stays set'
is '3' '[p["value"] for p in r["parameters"] if p["key"] == "8013"][0]' parameters list
expect 0 "$ncctl" parameters undo
is '2' '[p["value"] for p in r["parameters"] if p["key"] == "8013"][0]' parameters list
expect 0 "$ncctl" parameters undo
said out 'parameter 8019'
expect 2 "$ncctl" parameters set 1078 --axis X 1
said err 'all axes'

# The mark of what is forced.
rung=$(grep -n '^OUT M' "$work/mill.il" | head -n 1)
device=$(sed 's/.*OUT \(M[0-9]*\).*/\1/' <<<"$rung")
expect 0 "$ncctl" force "$device" 1
until_true says "$device 1 forced" "$ncctl" ladder rungs --from "${rung%%:*}" --count 1
expect 0 "$ncctl" watch "$device" --for 0.1
said out '1 forced'
expect 0 "$ncctl" --json watch "$device" --for 0.1
said out '"forced":[0]'
expect 0 "$ncctl" release
until_true says "$device [01]\$|$device [01] +" "$ncctl" ladder rungs --from "${rung%%:*}" --count 1

# Who has changed a row last.
expect 0 "$ncctl" tools set 7 --length 44.5
expect 0 "$ncctl" variables set 501 --value 3
is "$(id -un)" 'r["tools"][0]["changed_by"]' tools list --from 7 --count 1
is 'True' 'r["tools"][0]["changed_ns"] > 10**18 and "" == r["tools"][1]["changed_by"]' tools list --from 7 --count 2
is "$(id -un)" 'r["variables"][0]["changed_by"]' variables list --from 501 --count 1
expect 0 "$ncctl" mode mdi
expect 0 "$ncctl" mdi --start '#501=9'
until_true says '^501 +9 ' "$ncctl" variables list
is 'MDI blocks True' 'r["variables"][0]["changed_by"] + " " + str(r["variables"][0]["changed_ns"] > 10**18)' variables list --from 501 --count 1

# The block in execution is named from the first block of a called program on, also where the place of another one is used again.
expect 0 "$ncctl" mode auto
for n in 3001 3002; do printf 'G4 X9%s.\nM99\n' "$n" >"$work/programs/O$n.nc"; done
printf 'G4 X.1\nM98 P3002\nM30\n' >"$work/programs/one.nc"
printf 'G4 X.1\nM98 P3001\nM30\n' >"$work/programs/two.nc"
in_call() { [ "$(value '(lambda s: s["state"] == "running" and s["block"] not in ("", "G4 X.1"))(r["systems"][0])' status)" = True ]; }
for pair in one:3002 two:3001 one:3002; do
  expect 0 "$ncctl" select "${pair%%:*}.nc"
  expect 0 "$ncctl" start
  until_true in_call
  is "${pair%%:*}.nc O${pair##*:}.nc G4 X9${pair##*:}." '(lambda s: s["program"] + " " + s["file"] + " " + s["block"])(r["systems"][0])' status
  expect 0 "$ncctl" reset
done

# What a terminal obeys comes to no terminal: C1 controls, and what turns the direction of a text.
printf 'G4 X100. (\302\23331m \342\200\256x)\nM30\n' >"$work/programs/evil.nc"
expect 0 "$ncctl" select evil.nc
expect 0 "$ncctl" start
until_true says 'G4 X100' "$ncctl" status
"$ncctl" status >"$work/out"
"$ncctl" --json status >>"$work/out"
grep -q 'G4 X100.' "$work/out" || { fail "evil.nc does not run"; cat "$work/out"; }
expect 0 "$ncctl" reset
expect 0 "$ncctl" mode mdi
expect 0 "$ncctl" mdi $'G4 X.1 (\302\23331m \342\200\256x)'
"$ncctl" history >>"$work/out"
"$ncctl" --json history >>"$work/out"
! LC_ALL=C grep -q -e $'\302\233' -e $'\342\200\256' "$work/out" || { fail "a terminal gets what it obeys"; cat -v "$work/out"; }

# ncctl pipe has a bound, and words that are no characters are wrong usage.
{ head -c 3000000 /dev/zero | tr '\0' ' '; printf '{"service":"rights"}\n{"service":"rights"}\n'; } | "$ncctl" pipe >"$work/out"
[ "$(head -n 1 "$work/out" | grep -c 'a line has at most')" = 1 ] && [ "$(sed -n 2p "$work/out" | grep -c '"ok":true')" = 1 ] || { fail "the bound of a line"; cut -c -200 "$work/out"; }
expect 1 "$ncctl" history --user $'M\374ller'
said err 'UTF-8'

# A file of changes in which there is something else is kept aside and told, and what can be read of it goes on. What a power cut leaves of a line is nothing of this kind.
expect 0 "$ncctl" tools set 8 --length 2
finish
printf '{"after":"1","before":"0","cli' >>"$work/changes"
begin
! grep -q damaged "$work/serve.err" || { fail "a line that was cut off is no damage"; cat "$work/serve.err"; }
says 'tool 7 length' "$ncctl" changes || fail "the changes are gone"
finish
{ head -c 5000 /dev/urandom; cat "$work/changes"; } >"$work/other" && cat "$work/other" >"$work/changes"
begin
grep -q 'changes.damaged-1' "$work/serve.err" || { fail "the damage is not told"; cat "$work/serve.err"; }
[ -s "$work/changes.damaged-1" ] || fail "the damaged file is not kept"
says 'tool 7 length' "$ncctl" changes || fail "what can be read is gone"
until_true says 'damaged' "$ncctl" history --kind system --count 5
expect 0 "$ncctl" undo
finish
begin
! grep -q damaged "$work/serve.err" || { fail "it is told again"; cat "$work/serve.err"; }
finish
exit $((failures > 0))
