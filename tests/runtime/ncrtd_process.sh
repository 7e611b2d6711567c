# SPDX-License-Identifier: Apache-2.0
# For the tests that run ncrtd as a process: a folder of its own with a machine of its own, and what they ask of a run.
set -u
ncrtd=${NC_BINARY_DIR:?}/bin/ncrtd
source=${NC_SOURCE_DIR:?}
[ -x "$ncrtd" ] || { echo "ncrtd is not built: skipped"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

fail() { echo "FAILED: $*"; failures=$((failures + 1)); }
# expect STATUS COMMAND...: runs the command, whose output is then in $work/out and $work/err.
expect() {
  local wanted=$1; shift
  "$@" >"$work/out" 2>"$work/err"
  local got=$?
  [ "$got" = "$wanted" ] || { fail "exit $got instead of $wanted: $*"; cat "$work/out" "$work/err"; }
}
said() { grep -qF -- "$2" "$work/$1" || { fail "no '$2' on $1"; cat "$work/$1"; }; }

# Only one process at a time may run a machine, so this test has its own.
mkdir "$work/own"
cp -r "$source/etc" "$source/examples" "$work/own"
machine=$work/own/etc/machine.toml
