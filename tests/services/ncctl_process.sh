# SPDX-License-Identifier: Apache-2.0
# For the tests that run ncctl against ncrtd serve, as processes: a folder of their own, and what they ask of a command. `server` is the process of ncrtd.
set -u
ncrtd=${NC_BINARY_DIR:?}/bin/ncrtd
ncctl=${NC_BINARY_DIR:?}/bin/ncctl
source=${NC_SOURCE_DIR:?}
[ -x "$ncrtd" ] && [ -x "$ncctl" ] || { echo "ncrtd or ncctl is not built: skipped"; exit 77; }
work=$(mktemp -d)
chmod 755 "$work"
server=
trap '[ -n "$server" ] && kill "$server" 2>/dev/null; wait 2>/dev/null; rm -rf "$work"' EXIT
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }
# expect STATUS COMMAND...: runs the command, whose output is then in $work/out and $work/err.
expect() {
  local wanted=$1; shift
  "$@" >"$work/out" 2>"$work/err" </dev/null
  local got=$?
  [ "$got" = "$wanted" ] || { fail "exit $got instead of $wanted: $*"; cat "$work/out" "$work/err"; }
}
said() { grep -qF -- "$2" "$work/$1" || { fail "no '$2' on $1"; cat "$work/$1"; }; }
# says REGEX COMMAND...: what the command prints has a line with it.
says() {
  local regex=$1; shift
  grep -qE "$regex" <<<"$("$@")"
}
# until_true COMMAND...: waits for it, as long as it takes; the time limit is that of the test.
until_true() { until "$@" >/dev/null 2>&1; do kill -0 "$server" 2>/dev/null || { fail "ncrtd has ended"; return; }; sleep 0.05; done; }
