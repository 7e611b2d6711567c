#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# ncctl against ncrtd serve, as processes: a part from its file to its end, tables, exit statuses, rights of other users, a client that is killed.
. "$(dirname "${BASH_SOURCE[0]}")/ncctl_process.sh"

mkdir "$work/programs"
# The machine has no ladder, so that nothing but the services operates it; group 0 stands for one that a peer may have.
sed -e "s#^programs = .*#programs = \"$work/programs\"#" -e "s#^socket = \"\"#socket = \"$work/mill.sock\"#" -e "s#^changes = \"\"#changes = \"$work/changes\"#" -e "s#^history = \"\"#history = \"$work/history\"#" \
  -e 's#^policy = "fifo"#policy = "other"#' -e 's#^lock_memory = true#lock_memory = false#' -e 's#^operate = .*#operate = ["daemon"]#' -e 's#^view = .*#view = ["games"]#' \
  "$source/etc/machine.toml" >"$work/machine.toml"
cp "$source/etc/mill.il" "$work/"
export NC_SOCKET=$work/mill.sock
expect 6 "$ncctl" status
said err "no control runs there"
"$ncrtd" --machine "$work/machine.toml" serve --share "ncctl-$$" >"$work/serve.out" 2>"$work/serve.err" &
server=$!
until_true "$ncctl" status
expect 0 "$ncctl" rights
said out "maintain"
expect 0 "$ncctl" --json status
python3 -c 'import json, sys; s = json.load(open(sys.argv[1])); assert s["mode"] == "auto" and s["systems"][0]["axes"]' "$work/out" || fail "the status is no JSON"
expect 0 "$ncctl" watch --rate 50 --for 0.1
[ "$(wc -l <"$work/out")" -ge 2 ] || fail "watch has printed $(wc -l <"$work/out") lines"

# Tables.
expect 0 "$ncctl" tools set 3 --length 81.25 --radius-wear -0.02
expect 0 "$ncctl" tools list
grep -qE '^3 +81\.25 +0 +0 +-0\.02 +0  ' "$work/out" || { fail "tool 3 is not in the list"; cat "$work/out"; }
[ "$(wc -l <"$work/out")" -ge 100 ] || fail "the list of tools is not whole"
expect 0 "$ncctl" tools set 4 --name 'Schaftfräser Ø10' --pocket 7
expect 0 "$ncctl" tools list
grep -qE '^4 +138 +0 +0 +0 +7 +Schaftfräser Ø10  ' "$work/out" || { fail "name and pocket of tool 4 are not in the list"; cat "$work/out"; }
expect 2 "$ncctl" tools set 5 --pocket 7
said err 'pocket 7 has tool 4 (Schaftfräser Ø10)'
expect 1 "$ncctl" tools set 5 --name $'two\nlines'
expect 0 "$ncctl" undo
expect 0 "$ncctl" offsets set 1 X -- -12.5
expect 0 "$ncctl" offsets list
said out "X -12.5"
expect 0 "$ncctl" variables set 501 --value 2.5
expect 0 "$ncctl" variables list
said out "501"
expect 0 "$ncctl" parameters list
expect 0 "$ncctl" changes
said out "tool 3 length"
said out "$(id -un)"
expect 0 "$ncctl" changes --of 'tool 3' --count 1
said out "tool 3 length"
expect 0 "$ncctl" life set 2 --group 7 --tool 31 --flags 16 --life 500
expect 0 "$ncctl" life list
said out "mounts"
expect 0 "$ncctl" undo
expect 2 "$ncctl" tools set 999 --length 1
expect 1 "$ncctl" tools set 3
expect 1 "$ncctl" tools set three --length 1
expect 1 "$ncctl" nonsense

# Undo, and tables as a file.
expect 0 "$ncctl" tables export "$work/tables.toml"
grep -qF '3 = { length = 81.25, length_wear = 0, radius = 0, radius_wear = -0.02, name = "", pocket = 0 }' "$work/tables.toml" || { fail "tool 3 is not exported"; head "$work/tables.toml"; }
expect 0 "$ncctl" tables export --table variables
[ "$(head -n 1 "$work/out")" = '[variables]' ] || { fail "not only the variables"; cat "$work/out"; }
expect 0 "$ncctl" tools set 3 --length 90
expect 0 "$ncctl" undo
said out "tool 3 length"
expect 0 "$ncctl" tools set 3 --length 91 --radius 4
expect 0 "$ncctl" tables import "$work/tables.toml"
said out "changed: 2 tool offsets"
expect 0 "$ncctl" tables export "$work/again.toml"
cmp -s "$work/tables.toml" "$work/again.toml" || fail "the tables are not those of the file"
expect 0 "$ncctl" undo
expect 0 "$ncctl" undo --change "$("$ncctl" --json changes | python3 -c 'import json, sys; print(next(c["number"] for c in json.load(sys.stdin)["changes"] if "radius" in c["what"] and c["service"] == "tools.set" and c["undone_by"] == 0))')"
printf '[tool_offsets]\n1 = 5\n2 = { lenght = 3 }\n' >"$work/wrong.toml"
expect 1 "$ncctl" tables import "$work/wrong.toml"
said err "line 3"
printf '[tool_offsets]\n# M\374ller\n1 = 5\n' >"$work/latin.toml"
expect 1 "$ncctl" tables import "$work/latin.toml"
said err "UTF-8"
expect 1 "$ncctl" tables import "$work/none.toml"
expect 1 "$ncctl" tables export --table all
printf '[tool_offsets]\n1 = 5\n' | "$ncctl" tables import - >"$work/out" || fail "tables from standard input"

# Parameters as a file.
expect 0 "$ncctl" parameters export "$work/parameters.toml"
[ "$(head -n 1 "$work/parameters.toml")" = '[parameters]' ] || { fail "no parameters"; cat "$work/parameters.toml"; }
expect 0 "$ncctl" parameters import "$work/parameters.toml"
said out "none of them another one than before"
printf '[parameters]\n1078 = 77\n' >"$work/wrong.toml"
expect 2 "$ncctl" parameters import "$work/wrong.toml"
said err "line 2"

# Signals, as CSV.
expect 2 "$ncctl" trace save
expect 0 "$ncctl" trace record nc.feed D0 nc.mode_auto --samples 700
[ "$(head -n 1 "$work/out")" = 'scan,time_s,nc.feed,D0,nc.mode_auto' ] || { fail "not the head of the CSV"; head -n 3 "$work/out"; }
python3 -c '
import csv, sys
rows = list(csv.reader(open(sys.argv[1])))[1:]
assert len(rows) == 700, len(rows)
assert [int(r[0]) for r in rows] == list(range(int(rows[0][0]), int(rows[0][0]) + 700))
assert float(rows[0][1]) == 0 and all(float(a[1]) < float(b[1]) for a, b in zip(rows, rows[1:]))
assert {r[4] for r in rows} == {"1"}
' "$work/out" || fail "the CSV is not what was recorded"
"$ncctl" trace record nc.mode_mdi M100 --trigger nc.mode_mdi --samples 100 --before 20 --file "$work/trace.csv" 2>"$work/err" &
record=$!
until_true says 'state +waiting' "$ncctl" trace status
expect 2 "$ncctl" trace arm D0
said err "going on"
until_true says 'recorded +100' "$ncctl" trace status
expect 0 "$ncctl" mode mdi
wait "$record" || { fail "the recording with a trigger"; cat "$work/err"; }
[ "$(sed -n '21p;22p' "$work/trace.csv" | cut -d, -f3 | tr '\n' ' ')" = '0 1 ' ] || { fail "the trigger is in another row"; sed -n '20,24p' "$work/trace.csv"; }
expect 0 "$ncctl" mode auto
expect 0 "$ncctl" trace save "$work/saved.csv"
cmp -s "$work/trace.csv" "$work/saved.csv" || fail "saved is another one than recorded"
"$ncctl" trace record nc.alarm --trigger nc.alarm --samples 50 >"$work/out" 2>"$work/err" &
record=$!
until_true says 'recorded +50' "$ncctl" trace status
kill -INT "$record"
wait "$record" || { fail "a recording that is ended by a signal"; cat "$work/err"; }
[ "$(wc -l <"$work/out")" = 51 ] || { fail "what it had until then is not written"; cat "$work/out"; }
expect 1 "$ncctl" trace record nc.feed nc.feed
expect 2 "$ncctl" trace record no.such.signal
expect 1 "$ncctl" trace record
expect 0 "$ncctl" trace signals
said out "nc.feed"

# What cannot be written is no success, with one exit status for every command.
for command in status 'tools list' history services rights 'ladder rungs' 'parameters list' 'tables export' 'parameters export' 'watch --for 0.1' 'trace signals' '--json status' '--help'; do
  # shellcheck disable=SC2086
  "$ncctl" $command >/dev/full 2>"$work/err"
  got=$?
  [ "$got" = 5 ] || { fail "exit $got instead of 5 on a full disk: $command"; cat "$work/err"; }
  [ "$(wc -l <"$work/err")" = 1 ] || { fail "not one line of one failure: $command"; cat "$work/err"; }
  # shellcheck disable=SC2086
  "$ncctl" $command >&- 2>"$work/err"
  got=$?
  [ "$got" = 5 ] || { fail "exit $got instead of 5 with a closed output: $command"; cat "$work/err"; }
done
expect 5 "$ncctl" tables export "$work/no-such-folder/tables.toml"

# With --json every error is one object on standard output, wherever on the line --json stands and whatever the line lacks; the exit status is that of the same line without it.
one_error() {
  local wanted=$1 name=$2; shift 2
  expect "$wanted" "$ncctl" "$@"
  python3 -c '
import json, sys
lines = open(sys.argv[1]).read().splitlines()
error = json.loads(lines[0])
assert len(lines) == 1 and error["ok"] is False and error["error"] == sys.argv[2] and error["text"], lines' "$work/out" "$name" || { fail "no object with the error $name: $*"; cat "$work/out"; }
  [ ! -s "$work/err" ] || { fail "the error is said on standard error, too: $*"; cat "$work/err"; }
}
one_error 1 usage --json
one_error 1 usage --json nonsense
one_error 1 usage nonsense --json
one_error 1 usage tools --json
one_error 1 usage tools set --json
one_error 1 usage tools set three --length 1 --json
one_error 1 usage --json tools set 3 --length
one_error 1 usage --json tools set 3 --lenght 4
one_error 1 usage --json --socket a --control b status
one_error 1 usage --json history --since someday
one_error 1 usage --json tables import "$work/none.toml"
one_error 1 malformed --json tools set 3
one_error 2 'not found' --json tools set 999 --length 1
one_error 6 'no connection' --json --socket "$work/none.sock" status
one_error 1 usage tools set three --length 1 --json=true
expect 1 "$ncctl" tools set three --length 1 --json=false
[ ! -s "$work/out" ] || { fail "--json=false"; cat "$work/out"; }
expect 1 "$ncctl" --socket a --control b mdi -- --json
[ ! -s "$work/out" ] || { fail "a block that is called --json is no option"; cat "$work/out"; }
expect 0 "$ncctl" --json --help
said out "--control"

# A part, from its file to its end.
expect 0 "$ncctl" programs put "$source/examples/parts/flange.nc"
cmp -s "$source/examples/parts/flange.nc" "$work/programs/flange.nc" || fail "the program is another one after put"
expect 2 "$ncctl" programs put "$source/examples/parts/flange.nc"
expect 0 "$ncctl" programs put "$source/examples/parts/flange.nc" --replace
# The completion asks the control for names of programs, wherever the line says that it is.
cp "$source/examples/parts/flange.nc" "$work/programs/flat part.nc"
completed() { COMP_WORDS=("$ncctl" "$@"); COMP_CWORD=$#; COMPREPLY=(); _ncctl; echo "${COMPREPLY[*]:-}"; }
. "$source/packaging/completion/ncctl"
completes() {
  local wanted=$1; shift
  [ "$(completed "$@")" = "$wanted" ] || fail "completion of $*: '$(completed "$@")' instead of '$wanted'"
}
completes 'flange.nc flat\ part.nc' select fl
completes 'flange.nc' programs get --json flan
completes 'flange.nc flat\ part.nc' programs delete ''
completes 'flat\ part.nc' programs rename flat
completes '' programs rename flange.nc fl
completes '' --socket "$work/none.sock" select fl
NC_SOCKET=$work/none.sock completes 'flange.nc' --socket "$work/mill.sock" select flan
rm "$work/programs/flat part.nc"
# What has no end, or waits for somebody who writes, is no program.
mkfifo "$work/pipe.nc"
expect 1 timeout 20 "$ncctl" programs put /dev/zero --name zero.nc
expect 1 timeout 20 "$ncctl" programs put "$work/pipe.nc"
said err "no regular file"
# One that is interrupted says that it was not sent, and leaves nothing.
head -c 60000000 /dev/zero | tr '\0' '\n' >"$work/slow.nc"
"$ncctl" programs put "$work/slow.nc" >"$work/out" 2>"$work/err" &
sender=$!
until compgen -G "$work/programs/.nc-upload-*" >/dev/null || ! kill -0 "$sender" 2>/dev/null; do sleep 0.01; done
kill "$sender"
wait "$sender"
got=$?
[ "$got" = 5 ] || { fail "exit $got instead of 5 of an upload that is interrupted"; cat "$work/err"; }
said err "was not sent"
until ! compgen -G "$work/programs/.nc-upload-*" >/dev/null; do sleep 0.01; done
expect 0 "$ncctl" programs get flange.nc "$work/back.nc"
cmp -s "$source/examples/parts/flange.nc" "$work/back.nc" || fail "the program is another one after get"
expect 2 "$ncctl" programs get none.nc "$work/none.nc"
[ ! -e "$work/none.nc" ] || fail "a program that is not there has left a file"
expect 0 "$ncctl" programs list
said out "flange.nc"
expect 1 "$ncctl" programs rename flange.nc ../flange.nc
expect 1 "$ncctl" programs delete $'M\xfcller.nc'
expect 0 "$ncctl" programs protect flange.nc on
expect 2 "$ncctl" programs delete flange.nc
said err "protected"
expect 0 "$ncctl" programs protect flange.nc off
expect 2 "$ncctl" start
expect 0 "$ncctl" select flange.nc
until_true says '^state +passed' "$ncctl" programs check flange.nc
expect 0 "$ncctl" programs check flange.nc
said out "NO PART IN THE CLAMP"
said out "asks the machine"
expect 0 "$ncctl" programs list
grep -qE 'flange.nc.*passed' "$work/out" || { fail "the list does not show the check"; cat "$work/out"; }
printf 'G0 X1.\nG7.7\nM30\n' >"$work/wrong.nc"
expect 0 "$ncctl" programs put "$work/wrong.nc"
expect 0 "$ncctl" select wrong.nc
said out "wrong.nc line 2"
expect 2 "$ncctl" start
said err "refused by its check"
expect 2 "$ncctl" programs check none.nc
expect 0 "$ncctl" programs recheck flange.nc --seconds 5
printf 'G0 X1.\nM30\n' >"$work/programs/o0777.NC"
expect 0 "$ncctl" select O777
until_true says '^state +passed' "$ncctl" programs check o0777.NC
expect 0 "$ncctl" programs list
grep -qE '^o0777.NC .* yes +passed' "$work/out" || { fail "the program is not selected by its number"; cat "$work/out"; }
expect 2 "$ncctl" select O778
printf 'G54 G90 G1 X-50. F3000.\nG4 X60.\nM30\n' >"$work/long.nc"
expect 0 "$ncctl" programs put "$work/long.nc"
expect 0 "$ncctl" select long.nc
expect 0 "$ncctl" start
expect 2 "$ncctl" tools set 3 --length 1
said err "a program is in execution"
expect 2 "$ncctl" programs delete long.nc
expect 2 "$ncctl" mode manual
expect 0 "$ncctl" hold
expect 0 "$ncctl" reset
expect 0 "$ncctl" mode manual
expect 0 "$ncctl" jog --for 0.2 -- X -5

# A feed hold amid a block: an axis is moved by hand, and led back to the path, before the program goes on.
expect 0 "$ncctl" mode auto
printf 'G54 G90 G91 G1 X-60. F600.\nM30\n' >"$work/hold.nc"
expect 0 "$ncctl" programs put "$work/hold.nc"
expect 0 "$ncctl" select hold.nc
until_true "$ncctl" start
until_true says 'running' "$ncctl" status
expect 0 "$ncctl" hold
expect 2 "$ncctl" mode mdi
said err "amid a block"
expect 0 "$ncctl" restart
said out "a feed hold: cycle start goes on from where the path has stopped"
expect 0 "$ncctl" mode manual
expect 0 "$ncctl" jog --for 0.3 -- Y -5
until_true says '^Y .* away' "$ncctl" restart
expect 0 "$ncctl" mode auto
expect 2 "$ncctl" start
said err "an axis is not where the program goes on"
expect 0 "$ncctl" mode manual
expect 0 "$ncctl" restart approach Y --velocity 20
if says ' away$' "$ncctl" restart; then fail "an axis is away behind its return"; "$ncctl" restart; fi
expect 0 "$ncctl" mode auto
expect 0 "$ncctl" start
expect 0 "$ncctl" hold
expect 0 "$ncctl" reset
expect 0 "$ncctl" mode manual
expect 2 "$ncctl" mdi "G0 X1."
expect 0 "$ncctl" mode mdi
expect 0 "$ncctl" mdi --start "G90 G53 G0 X-1."
expect 0 "$ncctl" override feed 50
expect 1 "$ncctl" override feed 100000
expect 0 "$ncctl" override rapid 25
expect 1 "$ncctl" override rapid 101
expect 0 "$ncctl" single on
expect 0 "$ncctl" single off
expect 0 "$ncctl" optional on
expect 0 "$ncctl" optional off
expect 1 "$ncctl" optional perhaps
expect 0 "$ncctl" restart status
expect 0 "$ncctl" machine
said out "X"
expect 0 "$ncctl" services
said out "control.take"
until_true "$ncctl" parameters set 1078 0  # when the block of MDI has come to its end
expect 0 "$ncctl" parameters set 1078 1
expect 0 "$ncctl" parameters undo
expect 0 "$ncctl" parameters export
grep -qE '^"?1078"? = 0$' "$work/out" || { fail "a parameter is not taken back"; cat "$work/out"; }
expect 0 "$ncctl" trace arm nc.alarm --trigger nc.alarm
expect 0 "$ncctl" trace status
grep -qE '^state +waiting' "$work/out" || { fail "a recording does not wait for its trigger"; cat "$work/out"; }
expect 0 "$ncctl" trace stop
expect 0 "$ncctl" trace status
grep -qE '^state +stopped' "$work/out" || { fail "a recording is not stopped"; cat "$work/out"; }
expect 0 "$ncctl" ladder write M100 1
expect 0 "$ncctl" force M100 1
until_true says '^forced M100 = 1$' "$ncctl" status  # the status is up to 10 ms old
expect 0 "$ncctl" release
expect 0 "$ncctl" alarms
expect 0 "$ncctl" history
grep -qE "mode manual: (done|accepted)" "$work/out" || { fail "the mode is not in the history"; cat "$work/out"; }
grep -qE "run .*long.nc: interrupted" "$work/out" || { fail "the run is not in the history"; cat "$work/out"; }
expect 0 "$ncctl" history --kind action --user "$(id -un)" --since 1h --count 3
[ "$(wc -l <"$work/out")" = 3 ] || { fail "not three entries"; cat "$work/out"; }
expect 0 "$ncctl" history --since 2200-01-01
[ ! -s "$work/out" ] || { fail "entries of the future"; cat "$work/out"; }
expect 0 "$ncctl" --json history --all
python3 -c 'import json, sys; e = json.load(open(sys.argv[1]))["entries"]; assert e[-1]["code"] == "begin" and len(e) > 15, e' "$work/out" || fail "the history is not whole"
expect 0 "$ncctl" history counters
said out "running"
expect 0 "$ncctl" history programs
expect 1 "$ncctl" history --since 31-02-2026
expect 1 "$ncctl" history --kind song
expect 1 "$ncctl" history --count 0

# Two that want control, over connections that stay.
mkfifo "$work/one"
"$ncctl" pipe <"$work/one" >"$work/one.out" &
pipe=$!
exec 7>"$work/one"
echo '{"service": "control.take", "args": {"lease_ms": 60000}}' >&7
until_true grep -q '"ok":true' "$work/one.out"
expect 4 "$ncctl" mode auto
said err "has control"
kill -KILL "$pipe"
wait "$pipe" 2>/dev/null
exec 7>&-
until_true "$ncctl" mode auto
expect 0 "$ncctl" pipe

# A line is refused where the socket would refuse it as a request: nothing in it is left out, and a right that it names limits it.
piped() { "$ncctl" pipe <<<"$1" >"$work/out" 2>"$work/err"; }
pipe_refuses() {
  piped "$2"
  local got=$?
  [ "$got" = "$1" ] || { fail "pipe: exit $got instead of $1: $2"; cat "$work/out" "$work/err"; }
  said out "$3"
}
length=$("$ncctl" --json tools list | python3 -c 'import json, sys; print([t["length"] for t in json.load(sys.stdin)["tools"] if t["number"] == 3][0])')
set_3='"service": "tools.set", "args": {"number": 3, "length": 55}'
pipe_refuses 3 "{$set_3, \"right\": \"view\"}" 'tools.set needs the right to set up, and this request has come with that to view'
pipe_refuses 3 "{$set_3, \"right\": \"maintain\"}" '"no right"'
pipe_refuses 1 "{$set_3, \"right\": \"everything\"}" 'right must be view, operate, set up or maintain'
pipe_refuses 1 "{$set_3, \"right\": 1}" 'right must be the name of a right'
pipe_refuses 1 "{$set_3, \"x\": 1}" 'the request has no member \"x\"'
pipe_refuses 1 "{$set_3, \"service\": \"status\"}" 'has a member twice'
pipe_refuses 1 '{"service": "tools.set", "args": {"number": 3, "length": 54, "length": 55}}' 'has a member twice'
pipe_refuses 1 '{"service": "tools.set", "args": [3, 55]}' 'args must be an object'
pipe_refuses 1 '{"service": "tools.set", "args": {"number": 3, "length": 1e999}}' 'has a number that is too large'
pipe_refuses 1 '{"service": ' 'is no JSON'
pipe_refuses 1 '{"args": {}}' 'service must be the name of a service'
pipe_refuses 1 '["status"]' 'is no object'
[ "$("$ncctl" --json tools list | python3 -c 'import json, sys; print([t["length"] for t in json.load(sys.stdin)["tools"] if t["number"] == 3][0])')" = "$length" ] || fail "a refused line has set tool 3"
piped "{$set_3, \"right\": \"set up\"}" || fail "a line with the right that its service needs is refused"
expect 0 "$ncctl" undo

# Who does not get the replies is told so, and nothing more is asked.
printf '%s\n' '{"service": "status"}' "{$set_3}" | "$ncctl" pipe >/dev/full 2>"$work/err"
[ "${PIPESTATUS[1]}" = 5 ] || fail "a pipe whose output is full: exit ${PIPESTATUS[1]}"
said err "the output cannot be written: No space left on device"
[ "$("$ncctl" --json tools list | python3 -c 'import json, sys; print([t["length"] for t in json.load(sys.stdin)["tools"] if t["number"] == 3][0])')" = "$length" ] || fail "a pipe has gone on without its output"

# Other users: one of the group that views, one of the group that operates, one of none.
if [ "$(id -u)" = 0 ] && command -v setpriv >/dev/null && getent group games >/dev/null && getent group daemon >/dev/null; then
  as() { local groups=$1; shift; setpriv --reuid 65534 --regid 65534 $groups "$@"; }
  chmod 755 "$NC_BINARY_DIR" 2>/dev/null || true
  if as --clear-groups "$ncctl" --version >/dev/null 2>&1; then
    expect 3 as --clear-groups "$ncctl" status
    said err "none of the rights"
    expect 0 as "--groups $(getent group games | cut -d: -f3)" "$ncctl" status
    expect 3 as "--groups $(getent group games | cut -d: -f3)" "$ncctl" start
    expect 3 as "--groups $(getent group games | cut -d: -f3)" "$ncctl" tools set 3 --length 1
    expect 3 as "--groups $(getent group games | cut -d: -f3)" "$ncctl" tables import "$work/tables.toml"
    expect 3 as "--groups $(getent group games | cut -d: -f3)" "$ncctl" undo
    expect 3 as "--groups $(getent group games | cut -d: -f3)" "$ncctl" trace record nc.feed
    expect 0 as "--groups $(getent group games | cut -d: -f3)" "$ncctl" trace save
    expect 0 as "--groups $(getent group daemon | cut -d: -f3)" "$ncctl" mode mdi
    expect 3 as "--groups $(getent group daemon | cut -d: -f3)" "$ncctl" force M100 1
    expect 3 as "--groups $(getent group daemon | cut -d: -f3)" "$ncctl" programs put "$work/long.nc" --replace
  else
    echo "note: another user cannot run $ncctl here: the rights of other users are not tried"
  fi
else
  echo "note: not root: the rights of other users are not tried"
fi

# Each command that the completion knows is executed in one of these tests, with success.
sed -n "s/^    '\([a-z ]*[a-z]\) \{0,1\}'\*\{0,1\}) used=.*/\1/p" "$source/packaging/completion/ncctl" >"$work/commands"
[ "$(wc -l <"$work/commands")" -gt 50 ] || fail "only $(wc -l <"$work/commands") commands"
while read -r command; do
  grep -qE "expect 0 \"?\\\$ncctl\"?( --json)? $command( |\$)" "$source"/tests/services/*.sh "$source"/tests/restart/*.sh || fail "no test executes ncctl $command"
done <"$work/commands"

kill "$server"
wait "$server"
[ $? = 0 ] || { fail "ncrtd ended with an error"; cat "$work/serve.err"; }
server=
[ ! -e "$work/mill.sock" ] || fail "the socket is still there"
[ "$(ls -A "$work/programs" | grep -c '^\.nc-upload')" = 0 ] || fail "an upload was left behind"
[ "$failures" = 0 ] || { cat "$work/serve.out" "$work/serve.err"; exit 1; }
echo "all good"
