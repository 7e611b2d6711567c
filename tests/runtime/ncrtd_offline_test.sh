#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# ncrtd as a process that checks and runs programs on virtual time, in one thread: exit states, what it prints, plots, bad configurations.
. "$(dirname "${BASH_SOURCE[0]}")/ncrtd_process.sh"

expect 0 "$ncrtd" --config "$machine" check
said out "no errors"
said out "motion: optimal, as it is configured; look_ahead 4096"
# The option for the file may stand before or after the command, and has two names.
expect 0 "$ncrtd" check --config "$machine"
expect 0 "$ncrtd" check --machine "$machine"
expect 0 "$ncrtd" --machine "$machine" check
said out "no errors"
expect 0 "$ncrtd" run --fast --no-progress "$source/examples/parts/flange.nc" --machine "$machine"
expect 0 "$ncrtd" --version
said out "ncrtd $(sed -n 's/^project(libnc VERSION \([0-9.]*\).*/\1/p' "$source/CMakeLists.txt")"
expect 0 "$ncrtd" --config "$source/etc/modelling-machine.toml" check
# A machine on a bus of drives says how full the bus is, however full; a machine without one has none.
[ "$(grep -c "load of the bus" "$work/out")" = 0 ] || fail "a simulated machine has the load of a bus"
expect 0 "$ncrtd" --config "$source/etc/can_mill.toml" check
said out "load of the bus can0: SYNC 55 + 6 PDOs of 6 bytes, 115 each + heartbeats 2.6 = 747.6 bits with worst-case stuffing, of 1000 bits in 1000 us at 1000000 bit/s: 74.8 %; at most 80 %"
expect 0 "$ncrtd" --config "$source/etc/table_mill.toml" check
said out "%; at most 80 %"
# Warnings of the ladder program are printed, and are no errors.
{ sed '/^END$/d' "$source/etc/mill.il"; printf 'LD M0\nOUT plc.fin1\nEND\n'; } >"$work/mill.il"
sed "s#^programs = .*#programs = \"$work\"#" "$machine" >"$work/twice.toml"
expect 0 "$ncrtd" --config "$work/twice.toml" check
said err "OUT plc.fin1: the same coil as in line"
rm "$work/mill.il"

# The same is true for a parameter for which nothing asks.
cp "$source"/etc/mill.il "$work/mill.il"
sed "s#^programs = .*#programs = \"$work\"#; s#^\[parameters\].*#&\n\"8011\" = 1#" "$machine" >"$work/unused.toml"
expect 0 "$ncrtd" --config "$work/unused.toml" check
said err "nothing in the control asks for this parameter"
[ "$(grep -c "nothing in the control" "$work/err")" = 1 ] || fail "parameters that the control asks for are warned of"
# And for a time constant that makes an axis slower than it could be.
sed "s#^mode = .*#mode = \"trapezoid\"#; s#^programs = .*#programs = \"$work\"#; s#^\[parameters\].*#&\n\"2007\" = 60#" "$machine" >"$work/slow.toml"
expect 0 "$ncrtd" --config "$work/slow.toml" check
said err "parameters.2007: X: #2007 #2008 let cuts go at 9000 mm/min, the axis could go at 30000"
rm "$work/mill.il"

# A whole part on virtual time, with its plots.
expect 0 "$ncrtd" --config "$machine" run --fast --plot "$work/plot" "$source/examples/parts/flange.nc"
said out "cycle time"
said out "execution time"
[[ $(head -c 8 "$work/plot.png" 2>/dev/null) == *PNG* ]] || fail "no PNG"
grep -q "<svg" "$work/plot.svg" 2>/dev/null || fail "no SVG"
# The drawing as in ncsim: other places, colours, and a cross (magenta) where an alarm has stopped the run.
expect 0 "$ncrtd" --config "$machine" run --fast --plot "$work/other" --coordinates machine --color tool --view xy "$source/examples/parts/flange.nc"
cmp -s "$work/plot.svg" "$work/other.svg" && fail "--coordinates and --color change nothing"
grep -q "stroke:rgb(80%,0%,55%)" "$work/plot.svg" && fail "a cross without an alarm"
printf 'G91 G1 X5. F600\nG2 X3. R1.\nM30\n' >"$work/crossed.nc"
expect 2 "$ncrtd" --config "$machine" run --fast --plot "$work/crossed" "$work/crossed.nc"
grep -q "stroke:rgb(80%,0%,55%)" "$work/crossed.svg" || fail "no cross where the alarm is"
expect 1 "$ncrtd" --config "$machine" run --fast --color tool "$source/examples/parts/flange.nc"
said err "--plot"

# Virtual time is deterministic: two runs print the same cycle time and path length.
for n in 1 2; do
  expect 0 "$ncrtd" --config "$machine" run --fast --no-progress "$source/examples/parts/flange.nc"
  sed -n 1,3p "$work/out" >"$work/run$n"
done
cmp -s "$work/run1" "$work/run2" || fail "two runs differ"
[ "$(sed -n 's/^cycle time *\([0-9]*\).*/\1/p' "$work/run1")" -lt 90 ] || fail "the shipped part takes a minute and a half or more"

# With CONTOUR_CHECK the compensated contour of the part is machined as it is; with a way out through the part it is an alarm.
sed 's#^\[parameters\].*#&\nCONTOUR_CHECK = 1#' "$machine" >"$work/own/etc/checked.toml"
expect 0 "$ncrtd" --config "$work/own/etc/checked.toml" run --fast --no-progress "$source/examples/parts/flange.nc"
sed 's/^G03 X-15\. Y-65\. I0\. J-15\.$/G01 X0. Y-40./' "$source/examples/parts/flange.nc" >"$work/own/through.nc"
cmp -s "$work/own/through.nc" "$source/examples/parts/flange.nc" && fail "the part has another way out"
expect 2 "$ncrtd" --config "$work/own/etc/checked.toml" run --fast --no-progress "$work/own/through.nc"
said err "P153"
expect 0 "$ncrtd" --config "$source/etc/modelling-machine.toml" run --fast --no-progress "$source/examples/parts/keytag.nc"
expect 0 "$ncrtd" --config "$source/etc/router.toml" run --fast --no-progress "$source/examples/parts/plate.ngc"
expect 0 "$ncrtd" --config "$source/etc/drill-mill.toml" run --fast --no-progress "$source/examples/parts/bracket.nc"
expect 0 "$ncrtd" --config "$source/etc/knee-mill.toml" run --fast --no-progress "$source/examples/parts/jig-plate.s8"
expect 0 "$ncrtd" --config "$machine" mdi --fast --no-progress "G90 G0 X-10."
expect 2 "$ncrtd" --config "$machine" mdi --fast "G1 X10."
said err "P62"

# The dialect on the command line.
printf '%%\nG00X-1.\nM02\n' >"$work/jis.nc"
expect 0 "$ncrtd" --config "$machine" run --fast --dialect dgshape --no-progress "$work/jis.nc"

# Sub programs in the configured folder; stops are continued; an alarm names its line.
sed "s#^programs = .*#programs = \"$work\"#" "$machine" >"$work/machine.toml"
cp "$source/etc/mill.il" "$work/"
printf 'G91 G0 X1.\nM99\n' >"$work/O77.nc"
printf 'G90 G0 X0.\nM98 P77 L3\nM00\nM30\n' >"$work/main.nc"
expect 0 "$ncrtd" --config "$work/machine.toml" run --fast "$work/main.nc"
said out "stop in line 3"
printf 'G90 G0 X0.\n\nM98 P78\nM30\n' >"$work/main.nc"
expect 2 "$ncrtd" --config "$work/machine.toml" run --fast "$work/main.nc"
said err "P232"
said err "line 3"

# External output: every line in the file, in order, more of them than fit between two looks. M198 in a folder of its own.
mkdir "$work/server"
printf 'A LINE THAT IS NOT RUN\n#100=7\nM99\n' >"$work/server/O79.nc"
sed "s#^programs = .*#programs = \"$work\"\nexternal = \"server\"\nprint = \"printed\"#" "$machine" >"$work/print.toml"
printf 'M198 P79\nPOPEN\n#1=0\nWHILE [#1 LT 200] DO1\nG0 X-[#1/100]\nDPRNT[N#1[30]*V#100[10]]\n#1=#1+1\nEND1\nPCLOS\nM30\n' >"$work/main.nc"
expect 0 "$ncrtd" --config "$work/print.toml" run --fast --no-progress "$work/main.nc"
{ echo %; for n in $(seq 0 199); do echo "N$n*V7"; done; echo %; } >"$work/expected"
cmp "$work/expected" "$work/printed" || fail "what was printed is not what the program prints"
# All printed lines are in the file even if the program ends directly after them, by M30 or by an alarm; a full disk is reported.
for ending in M30 '#3000=1(STOP)'; do
  rm -f "$work/printed"
  printf 'POPEN\n#1=0\nWHILE [#1 LT 300] DO1\nDPRNT[X#1[53]]\n#1=#1+1\nEND1\nPCLOS\n%s\n' "$ending" >"$work/main.nc"
  expect "$([ "$ending" = M30 ] && echo 0 || echo 2)" "$ncrtd" --config "$work/print.toml" run --fast --no-progress "$work/main.nc"
  [ "$(grep -c '^X' "$work/printed")" = 300 ] || fail "$(grep -c '^X' "$work/printed") of 300 printed lines before $ending"
  [ "$(tail -n 1 "$work/printed")" = % ] || fail "PCLOS is not the last line before $ending"
done
sed 's#^print = .*#print = "/dev/full"#' "$work/print.toml" >"$work/full.toml"
printf 'POPEN\nDPRNT[X1]\nPCLOS\nM30\n' >"$work/main.nc"
expect 1 "$ncrtd" --config "$work/full.toml" run --fast --no-progress "$work/main.nc"
said err "No space left"

# Mistakes of the ladder program are reported together with those of the configuration, and with what the computer does not have.
printf 'LD M9999\nOUT M1\nEND\n' >"$work/wrong.il"
sed -e "s#^programs = .*#programs = \"$work/nowhere\"#" -e 's#^program = .*#program = "wrong.il"#' "$machine" >"$work/both.toml"
expect 1 "$ncrtd" --config "$work/both.toml" check
said err 'machine.programs: there is no folder'
said err 'wrong.il:1: LD M9999: no such device'
grep -q 'may follow' "$work/err" && fail "the configuration is whole: it tells which devices there are"
sed -i 's#^cycle_us = .*#cycle_us = -1#' "$work/both.toml"
expect 1 "$ncrtd" --config "$work/both.toml" check
said err 'machine.cycle_us: must be'
said err 'wrong.il:1: LD M9999: no such device'
said err 'may follow'

# Usage and configuration.
expect 1 "$ncrtd"
expect 1 "$ncrtd" --config "$machine"
expect 1 "$ncrtd" --config "$machine" run
expect 1 "$ncrtd" --config "$machine" run --dialect series9 x.nc
said err "--dialect: must be one of m700, dgshape, iso, hx, series8, is series9"
for option in --plot --share --dialect; do
  expect 1 "$ncrtd" --config "$machine" run --fast "$option" "" x.nc
  said err "$option: must"
done
expect 1 "$ncrtd" --config "" check
said err "--machine: must not be empty"
expect 1 "$ncrtd" --config "$machine" mdi --fast ""
said err "BLOCKS: must not be empty"
expect 1 "$ncrtd" --config "$machine" run --fast "$work/none.nc"
said err "none.nc"
expect 1 "$ncrtd" --config "$work/none.toml" check
said err "none.toml: cannot be read"
printf '[machine]\nnmae = 3\n[[axis]]\nname = "X"\nmax_velocity = -1\n[parameters]\nnosuch = 1\n' >"$work/bad.toml"
expect 1 "$ncrtd" --config "$work/bad.toml" check
said err "bad.toml:2: machine.nmae: unknown key"
said err "bad.toml:5: axis[1].max_velocity: must be"
said err "axis[1].max_acceleration: is missing"
printf '[machine]\n[[axis]]\nname = "X"\nmax_velocity = 1\nmax_acceleration = 1\n[parameters]\nnosuch = 1\n' >"$work/bad.toml"
expect 1 "$ncrtd" --config "$work/bad.toml" check
said err "bad.toml:7: parameters.nosuch: the control"

# Output that cannot be written.
printf 'G90 G0 X-290.\nG4 P100\nM30\n' >"$work/short.nc"
if [ -w /dev/full ]; then
  for command in "check" "--help" "run --fast --no-progress $work/short.nc" "run --fast $work/short.nc" "mdi --fast M0"; do
    # shellcheck disable=SC2086
    "$ncrtd" --config "$machine" $command >/dev/full 2>"$work/err"
    status=$?
    [ "$status" = 1 ] || fail "full output: exit $status instead of 1: $command"
    said err "standard output cannot be written"
  done
fi
: >"$work/out"
expect 1 "$ncrtd" --config "$machine" run --fast --plot "$work/none/x" "$work/short.nc"
said err "none/x.svg: cannot be written"
[ -s "$work/out" ] && fail "it ran before it looked at the plot"

# Files that are no programs, and files that look different but are programs.
mkdir "$work/folder"
mkfifo "$work/fifo"
expect 1 "$ncrtd" --config "$machine" run --fast "$work/folder"
said err "is a folder, not a program"
expect 1 timeout 10 "$ncrtd" --config "$machine" run --fast "$work/fifo"
said err "is a pipe"
printf '\xef\xbb\xbfG90 G0 X-290.\nM30\n' >"$work/bom.nc"
expect 0 "$ncrtd" --config "$machine" run --fast "$work/bom.nc"

expect 1 timeout 10 "$ncrtd" --config "$work/fifo" check
said err "fifo: cannot be read: is no file"
expect 1 timeout 10 "$ncrtd" --config /dev/zero check
said err "/dev/zero: cannot be read: is no file"

# Requirements of the configuration that the computer does not fulfil.
sed -e "s#^programs = .*#programs = \"$work/nowhere\"#" -e 's#^cpu = .*#cpu = 999#' "$machine" >"$work/host.toml"
for command in check "run --fast $work/bom.nc"; do
  # shellcheck disable=SC2086
  expect 1 "$ncrtd" --config "$work/host.toml" $command
  said err "machine.programs: there is no folder"
  said err "scheduling.cpu: this computer has the processors 0 to"
done

# Mistakes of the configuration and of the ladder program in one go; what is no program is named, and not waited for.
mkdir "$work/il"
sed -e "s#^programs = .*#programs = \"$work\"#" -e 's#^cycle_us = .*#cycle_us = 7#' "$machine" >"$work/il/machine.toml"
printf 'LD nc.m_strobe\nOUT nowhere\nBMOV D8190 D0 K5\nEND\n' >"$work/il/mill.il"
expect 1 "$ncrtd" --config "$work/il/machine.toml" check
said err "machine.cycle_us: must be"
said err "mill.il:2: OUT nowhere: no such device"
said err "mill.il:3: BMOV D8190 D0 K5: the row is longer"
sed -i 's#^cycle_us = .*#cycle_us = 1000#' "$work/il/machine.toml"
rm "$work/il/mill.il"
mkfifo "$work/il/mill.il"
expect 1 timeout 10 "$ncrtd" --config "$work/il/machine.toml" check
said err "mill.il: is no file"
rm "$work/il/mill.il"; mkdir "$work/il/mill.il"
expect 1 timeout 10 "$ncrtd" --config "$work/il/machine.toml" check
said err "mill.il: is a folder"
rmdir "$work/il/mill.il"; ln -s /dev/zero "$work/il/mill.il"
expect 1 timeout 10 "$ncrtd" --config "$work/il/machine.toml" check
said err "mill.il: is no file"
rm "$work/il/mill.il"; : >"$work/il/mill.il"
expect 1 "$ncrtd" --config "$work/il/machine.toml" check
said err "mill.il: is empty"
printf '; nothing\n\n' >"$work/il/mill.il"
expect 1 "$ncrtd" --config "$work/il/machine.toml" check
said err "mill.il: holds no instruction"
rm "$work/il/mill.il"
expect 1 "$ncrtd" --config "$work/il/machine.toml" check
said err "mill.il: cannot be read"
said err "ladder.program"

[ "$failures" = 0 ] && echo "all good"
exit $((failures > 0))
