#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# ncdds and ncmon refuse bad values of their options with a sentence, before they open anything.
set -u
bin=${NC_BINARY_DIR:?}/bin
[ -x "$bin/ncdds" ] && [ -x "$bin/ncmon" ] || { echo "ncdds and ncmon are not built: skipped"; exit 77; }
failures=0
version=$(sed -n 's/^project(libnc VERSION \([0-9.]*\).*/\1/p' "${NC_SOURCE_DIR:?}/CMakeLists.txt")
# refuses TEXT COMMAND...: exit status 1, and TEXT on standard error.
refuses() {
  local text=$1 err; shift
  err=$("$@" 2>&1 >/dev/null)
  local got=$?
  [ "$got" = 1 ] && [[ "$err" == *"$text"* ]] || { echo "FAILED (exit $got, '$err'): $*"; failures=$((failures + 1)); }
}
for program in ncdds ncmon; do
  for value in -1 231 1.5 nan x 0x1 99999999999999999999; do
    refuses "--domain: must be a whole number from 0 to 230, is" "$bin/$program" "--domain=$value"
  done
  refuses "not expected" "$bin/$program" --nosuch
done
for value in 0 101 -5 2.5; do refuses "--rate: must be a whole number from 1 to 100, is $value" "$bin/ncdds" "--rate=$value"; done
for option in --share --machine --ready-file; do refuses "$option: must not be empty" "$bin/ncdds" "$option" ""; done
refuses "which control?" "$bin/ncdds"
for value in nan inf -1 86401 x; do refuses "--wait: must be at least 0 and at most 86400" "$bin/ncmon" "--wait=$value"; done
for value in 0 -1 1000001 nan; do refuses "--latency: must be a whole number from 1 to 1000000, is $value" "$bin/ncmon" "--latency=$value"; done
refuses "--control: must not be empty" "$bin/ncmon" --control ""
# All programs use the same option for the file of a machine; if it is given here, the error names the option for a name.
for option in --machine --config; do
  for value in mill3 etc/machine.toml ""; do refuses "$option: is the file of a machine, which ncmon does not read: the name of a control is --control NAME" "$bin/ncmon" --once "$option" "$value"; done
  grep -q -e "$option" <<<"$("$bin/ncmon" --help)" && { echo "FAILED: ncmon --help names $option"; failures=$((failures + 1)); }
done
refuses "--machine: must not be empty" "$bin/ncdds" --config ""
for program in ncdds ncmon; do
  [ "$("$bin/$program" --version)" = "$program $version" ] || { echo "FAILED: $program --version"; failures=$((failures + 1)); }
done
refuses "" "$bin/ncmon" --once --progress
# A name to which no gateway answers is wrong usage at once, and nothing to wait for.
[ ! -x "$bin/ncctl" ] || for name in 'anna@../x' 'anna@*' $'anna@\001' abcdefghijklmnopqrstuvwxyz01; do
  refuses "the name of a client has letters, digits" "$bin/ncctl" --domain 77 --control none --client "$name" rights
done
exit $((failures != 0))
