#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The ladder is swapped while a part is made, by ncctl; and ncrtd is killed (SIGKILL) around swaps: the next start takes the file of the configuration, with the retained devices, and nothing is damaged.
. "$(dirname "${BASH_SOURCE[0]}")/ncctl_process.sh"
swapper=
trap '[ -n "$swapper" ] && kill "$swapper" 2>/dev/null; [ -n "$server" ] && kill -9 "$server" 2>/dev/null; wait 2>/dev/null; rm -rf "$work"' EXIT

mkdir "$work/programs"
sed -e "s#^programs = .*#programs = \"$work/programs\"#" -e "s#^socket = \"\"#socket = \"$work/mill.sock\"#" -e "s#^changes = \"\"#changes = \"$work/changes\"#" -e "s#^history = \"\"#history = \"$work/history\"#" \
  -e "s#^retain = .*#retain = \"$work/devices\"#" -e 's#^retain_every_s = .*#retain_every_s = 0.02#' \
  -e 's#^policy = "fifo"#policy = "other"#' -e 's#^lock_memory = true#lock_memory = false#' -e 's#^overrun = .*#overrun = "count"#' "$source/etc/machine.toml" >"$work/machine.toml"
cp "$source/etc/mill.il" "$work/mill.il"
{ sed '/^END$/d' "$source/etc/mill.il"; printf 'LD SM400\nSET L7\nLDP SM413\nINC D700\nEND\n'; } >"$work/next.il"
{ sed '/^END$/d' "$source/etc/mill.il"; printf 'LD SM400\nOUT nowhere\nLD M1\nAND\nOUT M2\nEND\n'; } >"$work/bad.il"
lines=$(($(wc -l <"$work/bad.il")))
export NC_SOCKET=$work/mill.sock
begin() {
  "$ncrtd" --machine "$work/machine.toml" serve --share "swap-$$" >"$work/serve.out" 2>"$work/serve.err" &
  server=$!
  until_true "$ncctl" status
}
begin

expect 2 "$ncctl" ladder swap "$work/bad.il"
said err "ncctl: bad.il:$((lines - 4)): OUT nowhere: no such device 'nowhere'"
said err "ncctl: bad.il:$((lines - 2)): AND: operands: bit"
expect 1 "$ncctl" ladder swap "$work/none.il"
printf 'END ; M\374ller\n' >"$work/latin.il"
expect 1 "$ncctl" ladder swap "$work/latin.il"
said err "UTF-8"

# A part with a tool change, while its ladder is swapped again and again.
printf 'G54 G90 M3 S1000\nG0 X5. Y5.\nT2 M6\nG1 Z-1. F600. M8\nX30.\nM9\nG0 Z10. M5\nM30\n' >"$work/programs/part.nc"
expect 0 "$ncctl" select part.nc
expect 0 "$ncctl" start
swaps=0
until says 'part.nc: completed' "$ncctl" history --kind run; do
  expect 0 "$ncctl" ladder swap "$work/next.il"
  expect 0 "$ncctl" ladder swap "$work/mill.il" --name own.il
  swaps=$((swaps + 2))
  [ "$failures" = 0 ] || break
done
[ "$swaps" -ge 4 ] || fail "only $swaps swaps while the part was made"
expect 0 "$ncctl" alarms
! grep -qE "R1[0-9]" "$work/out" || { fail "an alarm"; cat "$work/out"; }
expect 0 "$ncctl" changes --count 1
said out "ladder.swap"
said out "$(id -un)"
expect 0 "$ncctl" history --kind change --count 1
said out "ladder.swap"
"$ncctl" ladder swap - --name typed.il <"$work/next.il" >"$work/out" 2>&1 || { fail "a program from standard input"; cat "$work/out"; }

# Values again and again.
expect 0 "$ncctl" ladder swap "$work/next.il"
said out "$work/mill.il"
expect 0 "$ncctl" watch L7 D700 nc.alarm --rate 50 --for 0.5
[ "$(head -n 1 "$work/out")" = $'scan\tL7\tD700\tnc.alarm' ] || { fail "not the names"; head -n 2 "$work/out"; }
[ "$(wc -l <"$work/out")" -ge 2 ] || fail "watch has printed $(wc -l <"$work/out") lines"
sed 1d "$work/out" | grep -v '^# ' | grep -vqE $'^[0-9]+\t1\t[0-9]+\t0$' && { fail "not the values"; cat "$work/out"; }
expect 0 "$ncctl" --json watch D700 --rate 50 --for 0.2
python3 -c 'import json, sys; u = [json.loads(l) for l in open(sys.argv[1])]; assert u and all(len(x["values"]) == 1 for x in u), u' "$work/out" || fail "no updates as JSON"
expect 2 "$ncctl" watch nowhere
said err "nowhere"

# What was retained is on the disk before the kill; swaps go on until it comes.
until_true test -s "$work/devices"
sleep 0.2
for round in 1 2 3 4; do
  (while "$ncctl" ladder swap "$work/next.il" && "$ncctl" ladder swap "$work/mill.il"; do :; done) >/dev/null 2>&1 &
  swapper=$!
  sleep "0.$((RANDOM % 5))$((RANDOM % 10))"
  kill -9 "$server"
  wait "$server" 2>/dev/null
  wait "$swapper" 2>/dev/null
  swapper=
  begin
  ! grep -qiE 'damaged|lost|R19' "$work/serve.out" "$work/serve.err" || { fail "round $round"; cat "$work/serve.out" "$work/serve.err"; }
  expect 0 "$ncctl" --json ladder rungs --from 0 --count 1
  python3 -c 'import json, sys; r = json.load(open(sys.argv[1])); assert r["file"] == sys.argv[2] and r["swaps"] == 0, r' "$work/out" "$work/mill.il" || fail "round $round: not the program of the configuration"
  expect 0 "$ncctl" ladder devices L7
  grep -qE '^L7 +bit +1 ' "$work/out" || { fail "round $round: L7 is not retained"; cat "$work/out"; }
  expect 0 "$ncctl" changes
  said out "ladder.swap"
done
kill "$server"
wait "$server"
[ $? = 0 ] || { fail "ncrtd ended with an error"; cat "$work/serve.err"; }
server=
[ "$failures" = 0 ] || { cat "$work/serve.out" "$work/serve.err"; exit 1; }
echo "all good"
