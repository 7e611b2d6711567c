#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A control that counts in #500 and in a D of its ladder is killed (SIGKILL) at random moments: the data that the next one
# finds are complete, and not older than those that the one before had found.
set -u
ncrtd=${NC_BINARY_DIR:?}/bin/ncrtd
source=${NC_SOURCE_DIR:?}
[ -x "$ncrtd" ] || { echo "ncrtd is not built: skipped"; exit 77; }
work=$(mktemp -d)
pid=0
trap '[ "$pid" = 0 ] || kill -9 "$pid" 2>/dev/null; rm -rf "$work"' EXIT
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

sed -e "s#^programs = .*#programs = \"$work\"\nprint = \"$work/print\"\nvariables = \"$work/variables\"\noffsets = \"$work/offsets\"\nretain_every_s = 0.02#" \
    -e 's#^policy = .*#policy = "other"#' -e 's#^lock_memory = .*#lock_memory = false#' -e 's#^overrun = .*#overrun = "count"#' \
    -e '/^print = ""/d' -e '/^variables = ""/d' -e '/^retain_every_s = 1/d' -e "s#^retain = .*#retain = \"$work/devices\"#" \
    -e 's/^# retain_d = .*/retain_d = [1000, 1000]/' "$source/etc/machine.toml" >"$work/machine.toml"
{ sed '/^END$/d' "$source/etc/mill.il"; printf 'LD SM400\nINC D1000\nEND\n'; } >"$work/mill.il"
# The first two numbers printed are what the control has found: #500, and D1000 by #100110.
cat >"$work/count.nc" <<'PROGRAM'
#100100=1 #100101=1000 #100102=102
#100=#100110
POPEN
DPRNT[A#500[80]B#100[80]]
PCLOS
N1 #500=#500+1
G4 X0.002
GOTO 1
PROGRAM
"$ncrtd" --config "$work/machine.toml" check >"$work/out" 2>&1 || { cat "$work/out"; exit 1; }

most_before=0
last=0 rounds=${1:-12} moved=0 seen=0
for ((round = 0; round < rounds; ++round)); do
  rm -f "$work/print"
  "$ncrtd" --config "$work/machine.toml" run --no-progress "$work/count.nc" >"$work/out" 2>&1 &
  pid=$!
  for ((n = 0; n < 500; ++n)); do
    [ -s "$work/print" ] && grep -q 'A *[0-9]' "$work/print" && break
    sleep 0.02
  done
  sleep "0.$((RANDOM % 4))$((RANDOM % 10))"
  kill -9 "$pid" 2>/dev/null
  wait "$pid" 2>/dev/null
  pid=0
  grep -q 'R19\|lost' "$work/out" && { fail "round $round: lost"; cat "$work/out"; }
  found=$(tr -d '%\r\022\024' <"$work/print" | sed -n 's/^A *\([0-9]*\)B.*/\1/p' | head -1)
  devices=$(tr -d '%\r\022\024' <"$work/print" | sed -n 's/^A.*B *\(-\{0,1\}[0-9]*\).*/\1/p' | head -1)
  [ -n "$found" ] || { fail "round $round: nothing was printed"; cat "$work/out" "$work/print"; continue; }
  [ "$found" -ge "$last" ] || fail "round $round: #500 was $last, and is $found"
  [ "$found" -gt "$last" ] && moved=$((moved + 1))
  [ "${devices:-0}" -ne 0 ] && seen=$((seen + 1))
  last=$found
done
# Blocks that were only read ahead have no effect: of a program that counts every 50 ms in #500 and in a tool offset, a kill leaves what has been
# executed, and nothing of the hundreds of blocks after that.
printf 'POPEN\nDPRNT[A#500[80]B#10005[80]]\nPCLOS\nN1 #500=#500+1\nG10 L10 P5 R#500\nG4 X0.05\nGOTO 1\n' >"$work/slow.nc"
rm -f "$work/variables"* "$work/offsets"*
counted=$last last=0 went_on=0
for ((round = 0; round < 5; ++round)); do
  rm -f "$work/print"
  "$ncrtd" --config "$work/machine.toml" run --no-progress "$work/slow.nc" >"$work/out" 2>&1 &
  pid=$!
  for ((n = 0; n < 500; ++n)); do
    [ -s "$work/print" ] && grep -q 'A *[0-9]' "$work/print" && break
    sleep 0.02
  done
  began=$(date +%s%N)
  sleep 0.4
  kill -9 "$pid" 2>/dev/null
  wait "$pid" 2>/dev/null
  pid=0
  most=$((last + most_before))
  most_before=$((($(date +%s%N) - began) / 50000000 + 4))
  found=$(tr -d '%\r\022\024' <"$work/print" | sed -n 's/^A *\([0-9]*\)B.*/\1/p' | head -1)
  tool=$(tr -d '%\r\022\024' <"$work/print" | sed -n 's/^A.*B *\([0-9]*\).*/\1/p' | head -1)
  [ -n "$found" ] || { fail "slow round $round: nothing was printed"; cat "$work/out" "$work/print"; continue; }
  { [ "$found" -ge "$last" ] && [ "$found" -le "$most" ]; } || fail "slow round $round: #500 is $found, was $last, at most $most have been executed"
  # The two files are written one after the other.
  { [ "${tool:-0}" -ge $((found - 2)) ] && [ "${tool:-0}" -le $((found + 2)) ]; } || fail "slow round $round: the tool offset is ${tool:-0}, #500 is $found"
  [ "$found" -gt "$last" ] && went_on=$((went_on + 1))
  last=$found
done
[ "$went_on" -ge 3 ] || fail "the slow number went on in $went_on rounds only"

[ "$moved" -ge $((rounds / 2)) ] || fail "the number went on in $moved of $rounds rounds only"
[ "$seen" -ge $((rounds / 2)) ] || fail "D1000 came back in $seen of $rounds rounds only"
ls "$work"/*.damaged >/dev/null 2>&1 && fail "a damaged file was left"
[ "$failures" = 0 ] && echo "counted to $counted over $rounds kills"
exit $((failures > 0))
