#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# ncrtd and ncctl on a disk that is full, as processes: what each service that writes answers, that nothing is lost or half written, also behind a kill, and that all of it works
# again when there is room. The disk is a tmpfs of its own; first it has no byte left, then no room for one more file. What writes a file at all stands in docs/services.md,
# "A full disk", with its test.
if [ -z "${NC_OWN_MOUNTS:-}" ]; then
  export NC_OWN_MOUNTS=1
  unshare -m true 2>/dev/null && exec unshare -m "$BASH" "$0" "$@"
  unshare -rm true 2>/dev/null && exec unshare -rm "$BASH" "$0" "$@"
  echo "no file system can be mounted here: skipped"
  exit 77
fi
. "$(dirname "${BASH_SOURCE[0]}")/ncctl_process.sh"
disk=$work/disk
mkdir "$disk"
mount -t tmpfs -o size=8m none "$disk" || { echo "no file system can be mounted here: skipped"; exit 77; }
trap '[ -n "$server" ] && kill -9 "$server" 2>/dev/null; wait 2>/dev/null; umount "$disk"; rm -rf "$work"' EXIT

mkdir "$disk/programs"
sed -e "s#^programs = .*#programs = \"$disk/programs\"\nvariables = \"$disk/variables\"\noffsets = \"$disk/offsets\"\nretain_every_s = 0.05#" \
  -e '/^variables = ""/d' -e '/^offsets = ""/d' -e '/^retain_every_s = 1/d' -e "s#^retain = .*#retain = \"$disk/devices\"#" \
  -e "s#^socket = \"\"#socket = \"$work/mill.sock\"#" -e "s#^changes = \"\"#changes = \"$disk/changes\"#" -e "s#^history = \"\"#history = \"$disk/history\"#" \
  -e 's#^policy = .*#policy = "other"#' -e 's#^lock_memory = .*#lock_memory = false#' -e 's#^overrun = .*#overrun = "count"#' -e "s#^place = \"\"#place = \"$disk/place\"#" "$source/etc/machine.toml" >"$work/machine.toml"
cp "$source/etc/mill.il" "$work/"
export NC_SOCKET=$work/mill.sock
begin() {
  "$ncrtd" --machine "$work/machine.toml" serve --share "full-$$" >"$work/serve.out" 2>"$work/serve.err" &
  server=$!
  until_true "$ncctl" status
}
# What a power cut leaves: nothing is written at the end.
cut() {
  kill -9 "$server"
  wait "$server" 2>/dev/null
  server=
}
# The last block of a file that is written line by line may have room still.
fill_changes() { for ((n = 0; n < 200; ++n)); do "$ncctl" tools set 5 --length $n | grep -q 'not written down yet' && break; done; }
fill() { cat /dev/zero >"$disk/ballast" 2>/dev/null; [ "$(stat -f -c %f "$disk")" = 0 ] || fail "the disk is not full"; }
number_of_changes() { "$ncctl" --json changes | python3 -c 'import json, sys; print(len(json.load(sys.stdin)["changes"]))'; }
alarm_is_there() { "$ncctl" --json alarms | grep -qF "$1"; }
no_alarm() { "$ncctl" reset >/dev/null; ! "$ncctl" --json alarms | grep -qE 'R19|R20'; }
# What was there when the disk became full.
is_as_before() {
  [ "$("$ncctl" programs get old.nc -)" = "$old" ] || fail "$1: the program is another one"
  [ "$(find "$disk/programs" -mindepth 1 | wc -l)" = 1 ] || { fail "$1: a half of something is there"; ls -la "$disk/programs"; }
  cmp -s "$work/keep.toml" "$disk/keep.toml" || fail "$1: the export that was there is lost"
}

begin
"$ncctl" --json alarms | grep -q R20 && fail "R20 from the start"
old=$(printf 'G90 G0 X1.\nM30')
printf '%s\n' "$old" >"$work/old.nc"
expect 0 "$ncctl" programs put "$work/old.nc"
expect 0 "$ncctl" tools set 3 --length 81.25 --name 'face mill' --pocket 7
expect 0 "$ncctl" variables set 501 --value 2.5
expect 0 "$ncctl" tables export "$disk/keep.toml"
cp "$disk/keep.toml" "$work/keep.toml"
sleep 0.3
known=$(number_of_changes)

# ---- a program that is too long for the machine, or for its disk, is refused by its size: no byte of it is read or sent ----
announced() { printf '{"service":"programs.begin","args":{"name":"huge.nc","size":%s,"sha256":"%064d"}}\n' "$1" 0 | "$ncctl" pipe; }
expect 2 announced 10000000000
said out "a program may have 4294967296 bytes, not 10000000000"
expect 2 announced 2000000000
said out "the disk is full"
truncate -s 10G "$work/huge.nc"
expect 2 "$ncctl" programs put "$work/huge.nc"
said err "a program may have 4294967296 bytes, not 10737418240"
is_as_before "a huge program"

# ---- no byte is left ----
fill
head -c 30000 /dev/zero | tr '\0' 'G' >"$work/new.nc"
expect 2 "$ncctl" programs put "$work/new.nc"
said err "the disk is full"
expect 2 "$ncctl" programs put --replace --name old.nc "$work/new.nc"
said err "the disk is full"
is_as_before "put"
fill_changes
known=$(($(number_of_changes) - 1))
for change in 'tools set 3 --length 90' 'tools set 4 --name drill' 'tools set 4 --pocket 8' 'life set 2 --group 7 --tool 31' 'offsets set 1 X 5' 'variables set 502 --value 7' 'variables set 501 --name DEPTH' 'parameters set 1078 1' 'undo'; do
  expect 0 "$ncctl" $change
  said out "not written down yet: $disk/changes: the disk is full; it waits for room"
done
expect 0 "$ncctl" changes
said out "parameter 1078"
[ "$(number_of_changes)" = $((known + 10)) ] || fail "not all changes are remembered"
for what in 'common variables' 'offsets and parameters' 'names and pockets of tools'; do until_true alarm_is_there "$what cannot be written: $disk"; done
expect 2 "$ncctl" start
# What needs no room works: a protection, a new name, and most of all to delete something.
expect 0 "$ncctl" programs protect old.nc on
expect 0 "$ncctl" programs protect old.nc off
expect 0 "$ncctl" programs rename old.nc other.nc
expect 0 "$ncctl" programs rename other.nc old.nc
expect 0 "$ncctl" programs recheck old.nc
expect 0 "$ncctl" history
expect 0 "$ncctl" force D10 5
expect 0 "$ncctl" release
# Files of the client.
expect 5 "$ncctl" tables export "$disk/keep.toml"
said err "No space left"
expect 5 "$ncctl" parameters export "$disk/keep.toml"
expect 5 "$ncctl" programs get old.nc "$disk/keep.toml"
expect 5 "$ncctl" trace record nc.feed --samples 100 --file "$disk/keep.toml"
expect 5 "$ncctl" tables export "$disk/another.toml"
[ -e "$disk/another.toml" ] && fail "a half of an export is there"
is_as_before "export"
# A control that ends there, and one that begins there.
cut
begin
is_as_before "begin"
until_true alarm_is_there "cannot be written: $disk"
expect 0 "$ncctl" tools list
grep -qE '^3 +81\.25 +0 +0 +0 +7 +face mill +[a-z]' "$work/out" || { fail "the tool is not as it was last written"; sed -n 1,6p "$work/out"; }
expect 0 "$ncctl" variables list
said out "501"
[ "$(number_of_changes)" = "$known" ] || fail "there are $(number_of_changes) changes and not $known"
expect 0 "$ncctl" tools set 3 --length 91
said out "not written down yet"
# With room again all of it is written, also what has waited.
rm "$disk/ballast"
expect 0 "$ncctl" changes
until_true no_alarm
expect 0 "$ncctl" variables set 502 --value 9
[ "$(cat "$work/out")" = "" ] || { fail "something is said"; cat "$work/out"; }
expect 0 "$ncctl" programs put "$work/new.nc"
expect 0 "$ncctl" programs delete new.nc
expect 0 "$ncctl" tables export "$disk/keep.toml"
cp "$disk/keep.toml" "$work/keep.toml"
sleep 11  # a history that could not be written is tried again each 10 s
cut
begin
[ "$(number_of_changes)" = $((known + 4)) ] || { fail "there are $(number_of_changes) changes"; "$ncctl" changes; }
expect 0 "$ncctl" tools list
grep -qE '^3 +91 +0 +0 +0 +7 +face mill +[a-z]' "$work/out" || { fail "what was set without room is lost"; sed -n 1,6p "$work/out"; }
expect 0 "$ncctl" history --kind change
said out "tool 3 length"
"$ncctl" --json alarms | grep -qE 'R19|R20' && fail "an alarm is left"
"$ncctl" --json history | grep -q '"damaged"' && fail "a full disk is no damage of the history"

# ---- no room for one more file ----
fill_files() { for ((n = 0; n < 100000; ++n)); do : >"$disk/empty.$n" || break; done 2>/dev/null; }
mount -o remount,nr_inodes=$(($(stat -f -c %c "$disk") - $(stat -f -c %d "$disk") + 20)) "$disk" || fail "the disk takes no bound"
fill_files
expect 2 "$ncctl" programs put "$work/new.nc"
said err "the disk is full"
is_as_before "put without a file"
expect 0 "$ncctl" tools set 3 --length 92 --name 'face mill 63'
until_true alarm_is_there "names and pockets of tools cannot be written: $disk"
until_true alarm_is_there "offsets and parameters cannot be written: $disk"
expect 0 "$ncctl" tables export "$work/elsewhere.toml"
cut
begin
is_as_before "begin without a file"
expect 0 "$ncctl" tools list
grep -qE '^3 +91 +0 +0 +0 +7 +face mill +[a-z]' "$work/out" || { fail "the tool is not as it was last written"; sed -n 1,6p "$work/out"; }
rm "$disk"/empty.*
until_true no_alarm
expect 0 "$ncctl" tools set 3 --length 93
expect 0 "$ncctl" programs put "$work/new.nc"
sleep 1
cut
begin
expect 0 "$ncctl" tools list
grep -qE '^3 +93 +0 +0 +0 +7 +face mill +[a-z]' "$work/out" || { fail "what was set behind it is lost"; sed -n 1,6p "$work/out"; }
[ $failures = 0 ] || { cat "$work/serve.err"; exit 1; }
