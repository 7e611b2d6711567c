#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Two processes never drive one machine: the second one names the process that has it, and ends with status 3 before it touches anything.
set -u
ncrtd=${NC_BINARY_DIR:?}/bin/ncrtd
[ -x "$ncrtd" ] || { echo "ncrtd is not built: skipped"; exit 77; }
work=$(mktemp -d)
children=()
trap 'kill -KILL "${children[@]}" 2>/dev/null; wait 2>/dev/null; rm -rf "$work"' EXIT
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

# machine NAME [UNIT [HOST]]: a machine without shared memory; with a unit, its output is one of Modbus (nobody answers there).
machine() {
  cat >"$work/$1.toml" <<EOF
[machine]
name = "$1"
programs = "."
[scheduling]
policy = "other"
lock_memory = false
overrun = "count"
[share]
enabled = false
[[axis]]
name = "X"
max_velocity = 100.0
max_acceleration = 1000.0
EOF
  [ $# -lt 2 ] || cat >>"$work/$1.toml" <<EOF
[[modbus]]
name = "io"
host = "${3:-127.0.0.1}"
port = 1
unit = $2
[[point]]
name = "valve"
direction = "output"
modbus = { link = "io", table = "coil", address = 0 }
EOF
}
# serve NAME: starts ncrtd in the background and waits until it is up; its process is in $pid.
serve() {
  "$ncrtd" --config "$work/$1.toml" serve >"$work/$1.out" 2>&1 &
  pid=$!
  children+=("$pid")
  for _ in $(seq 600); do
    grep -q '^up:' "$work/$1.out" && return 0
    kill -0 "$pid" 2>/dev/null || break
    sleep 0.05
  done
  fail "$1 does not come up"; cat "$work/$1.out"
}
# refused WHO TEXT COMMAND...: exit status 3, TEXT and the process that has it on standard error, nothing brought up.
refused() {
  local who=$1 text=$2 got; shift 2
  timeout 60 "$@" >"$work/out" 2>"$work/err"
  got=$?
  [ "$got" = 3 ] || { fail "exit $got instead of 3: $*"; cat "$work/out" "$work/err"; }
  grep -qF "$text" "$work/err" || { fail "no '$text'"; cat "$work/err"; }
  grep -qF "process $who (ncrtd)" "$work/err" || { fail "no process $who"; cat "$work/err"; }
  grep -q '^up:' "$work/out" && fail "it came up: $*"
}
allowed() {
  timeout 60 "$@" >"$work/out" 2>"$work/err" || { fail "exit $?: $*"; cat "$work/out" "$work/err"; }
}

machine a 1
printf 'G0 X1.\nM30\n' >"$work/part.nc"
ln -s "$work/a.toml" "$work/link.toml"
ln "$work/a.toml" "$work/hard.toml"
serve a
first=$pid
for name in a link hard; do
  refused "$first" "the configuration" "$ncrtd" --config "$work/$name.toml" serve
done
(cd "$work" && refused "$first" "the configuration" "$ncrtd" --config ./a.toml run --no-progress part.nc; exit $failures) || failures=$((failures + 1))
refused "$first" "the configuration" "$ncrtd" --config "$work/a.toml" run --fast "$work/part.nc"   # its links run in real time
machine b 1 localhost
refused "$first" "Modbus unit 1 of localhost port 1" "$ncrtd" --config "$work/b.toml" mdi --no-progress "G0 X1."
allowed "$ncrtd" --config "$work/a.toml" check                                                    # looks, and drives nothing
machine c 2
allowed "$ncrtd" --config "$work/c.toml" mdi --no-progress "G0 X1."                               # another unit
# However a process ends, its machine is free afterwards.
kill -KILL "$first"
wait "$first" 2>/dev/null
serve b
kill -TERM "$pid"
wait "$pid" || fail "SIGTERM: exit $?"
serve a
# On virtual time a machine without a bus has no outputs.
machine d
serve d
allowed "$ncrtd" --config "$work/d.toml" run --fast --no-progress "$work/part.nc"
refused "$pid" "the configuration" "$ncrtd" --config "$work/d.toml" run --no-progress "$work/part.nc"
[ "$failures" = 0 ] && echo "all good"
exit $((failures > 0))
