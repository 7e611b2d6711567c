#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# ncrtd as a process in real time, with its threads: signals, data that outlive it, a program that is overwritten while it runs.
. "$(dirname "${BASH_SOURCE[0]}")/ncrtd_process.sh"

# until_listening PID: ncrtd is there and handles SIGINT and SIGTERM; before that a signal kills it, or is lost. The program begins a moment later,
# with a sanitizer on a busy computer more than half a second.
until_listening() {
  local caught i
  for ((i = 0; i < 600; ++i)); do
    caught=$(sed -n 's/^SigCgt:[[:space:]]*//p' "/proc/$1/status" 2>/dev/null)
    if [ "$(basename "$(readlink "/proc/$1/exe" 2>/dev/null)")" = ncrtd ] && [ $((0x${caught:-0} & 0x4002)) -eq $((0x4002)) ]; then
      sleep "${NC_SANITIZE:+2}.5"
      return 0
    fi
    sleep 0.1
  done
  fail "ncrtd does not handle signals"
}

# In real time: two threads, real clock; and a signal is a feed hold, then a clean end.
printf 'G90 G0 X-290.\nG4 P100\nM30\n' >"$work/short.nc"
expect 0 "$ncrtd" --config "$machine" run "$work/short.nc"
said out "wake-up jitter"
printf 'G91\nN1 G1 X0.5 F60.\nX-0.5\nGOTO 1\n' >"$work/long.nc"
"$ncrtd" --config "$machine" run --no-progress "$work/long.nc" >"$work/out" 2>"$work/err" &
child=$!
until_listening "$child"
kill -TERM "$child"
wait "$child"
status=$?
[ "$status" = 143 ] || { fail "SIGTERM: exit $status instead of 143"; cat "$work/out" "$work/err"; }
said out "feed hold"

said out "interrupted  by SIGTERM in line"
said out "cycle time"
said out "execution time"

# M99 of a main program, be it MDI, has no end (M700 13.3.1): it says so, and a signal ends it.
for command in "mdi M99" "mdi --fast M99" "run --fast $work/endless.nc"; do
  printf 'G91 G0 X1.\nX-1.\nM99\n' >"$work/endless.nc"
  # shellcheck disable=SC2086
  "$ncrtd" --config "$machine" $command --no-progress >"$work/out" 2>"$work/err" &
  child=$!
  until_listening "$child"
  for ((i = 0; i < 600; ++i)); do grep -q "begins again" "$work/out" && break; sleep 0.1; done
  kill -TERM "$child"
  wait "$child"
  status=$?
  [ "$status" = 143 ] || { fail "M99: exit $status instead of 143: $command"; cat "$work/out" "$work/err"; }
  [ "$(grep -c "line [13]: begins again from the head" "$work/out")" = 1 ] || { fail "M99 without a word, or with many: $command"; cat "$work/out"; }
done

# The same on virtual time, with the other signal and a plot of what was executed. (An interactive shell ignores
# SIGINT for what it puts into the background; python3 gives it back.)
python3 -c 'import os, signal, sys
signal.signal(signal.SIGINT, signal.SIG_DFL)
os.execv(sys.argv[1], sys.argv[1:])' "$ncrtd" --config "$machine" run --fast --no-progress --plot "$work/cut" "$work/long.nc" >"$work/out" 2>"$work/err" &
child=$!
until_listening "$child"
kill -INT "$child"
wait "$child"
status=$?
[ "$status" = 130 ] || { fail "SIGINT: exit $status instead of 130"; cat "$work/out" "$work/err"; }
said out "interrupted  by SIGINT in line"
said out "path length"
grep -q "<svg" "$work/cut.svg" 2>/dev/null || fail "no SVG of the interrupted run"

# Retained devices: D0 counts the starts of the control, and the third one is an alarm. The file is as it was after a kill.
mkdir "$work/il"
sed -e "s#^programs = .*#programs = \"$work\"#" -e 's#^retain = .*#retain = "count.retain"\nretain_d = [0, 0]#' "$machine" >"$work/il/machine.toml"
printf 'LD SM402\nINC D0\nLD>= D0 K3\nOUT plc.alarm.1\nLD nc.m_strobe\nOUT plc.fin2\nEND\n' >"$work/il/mill.il"
keep() { expect "$1" "$ncrtd" --config "$work/il/machine.toml" run --no-progress "$work/short.nc"; }
keep 0
[ -s "$work/il/count.retain" ] || fail "no file of retained devices"
"$ncrtd" --config "$work/il/machine.toml" run --no-progress "$work/long.nc" >"$work/out" 2>"$work/err" &
child=$!
until_listening "$child"
expect 1 "$ncrtd" --config "$work/il/machine.toml" check --nonsense
cp "$work/il/count.retain" "$work/first"
for ((i = 0; i < 100; ++i)); do  # it is written within a second or so
  cmp -s "$work/first" "$work/il/count.retain" || break
  sleep 0.1
done
kill -KILL "$child"
wait "$child" 2>/dev/null
keep 2
said err "R16 Alarm of the ladder 1"
printf 'garbage' >"$work/il/count.retain"
keep 2
said err "devices of the ladder are those of the last time but one"
printf 'garbage' >"$work/il/count.retain"
printf 'garbage' >"$work/il/count.retain.old"
keep 2  # who stands at the machine must know before anything moves
said err "R19 Retained data lost: devices of the ladder are lost and begin with 0"
[ -e "$work/il/count.retain.damaged" ] || fail "the damaged file is gone"
# On virtual time the file is not read, damaged or not, and a message says so; without such a file there is no message.
printf 'garbage' >"$work/il/count.retain"
expect 0 "$ncrtd" --config "$work/il/machine.toml" run --fast --no-progress "$work/short.nc"
said err "note: virtual time: retained data is neither read nor written ($work/il/count.retain): devices begin with 0"
[ "$(cat "$work/il/count.retain")" = garbage ] || fail "--fast has written retained data"
rm -f "$work"/il/count.retain*
expect 0 "$ncrtd" --config "$work/il/machine.toml" run --fast --no-progress "$work/short.nc"
grep -q "retained data" "$work/err" && fail "a note on files that are not there"
sed -i 's#^retain = .*#retain = "/proc/nowhere/x"#' "$work/il/machine.toml"
keep 1
said err "ladder.retain: there is no folder \"/proc/nowhere\""

# A program is overwritten while it runs: the old one is executed completely, or there is an alarm if it is too large to be copied.
part() { for _ in $(seq 200); do printf 'G91 G1 X-%s F600 (%1000s)\n' "$1" ""; done; echo M30; }
cp "$source"/etc/mill.il "$work/mill.il"
for mb in 16 0; do
  sed "s#^programs = .*#programs = \"$work\"\nprogram_copy_mb = $mb\nlook_ahead = 64#" "$machine" >"$work/copy.toml"
  part 0.1 >"$work/part.nc"
  part 0.2 >"$work/other.nc"
  "$ncrtd" --config "$work/copy.toml" run --no-progress "$work/part.nc" >"$work/out" 2>"$work/err" &
  running=$!
  sleep 0.7
  cp "$work/other.nc" "$work/part.nc"
  wait "$running"
  status=$?
  if [ "$mb" = 16 ]; then
    [ "$status" = 0 ] || { fail "a copied program ends with $status"; cat "$work/err"; }
    said out "path length  20.000 mm"
  else
    [ "$status" = 2 ] || fail "a program that has changed ends with $status"
    said err "P461"
    said err "has changed since it was selected"
  fi
done

[ "$failures" = 0 ] && echo "all good"
exit $((failures > 0))
