#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# docs/services.md, the manual page of ncctl and its completion are those of the table in the code; the completion is a script that bash takes.
set -euo pipefail
"$NC_SOURCE_DIR/scripts/service-tables" "$NC_BINARY_DIR/bin/ncctl" --check
completed() { COMP_WORDS=(ncctl "$@"); COMP_CWORD=$#; COMPREPLY=(); _ncctl; echo "${COMPREPLY[*]:-}"; }
source "$NC_SOURCE_DIR/packaging/completion/ncctl"
[ "$(completed sta)" = "start status" ] || { echo "FAILED: sta: $(completed sta)"; exit 1; }
[ "$(completed --json programs re)" = "recheck rename" ] || { echo "FAILED: programs re: $(completed --json programs re)"; exit 1; }
[ "$(completed --socket /x mode m)" = "mdi manual" ] || { echo "FAILED: mode m: $(completed --socket /x mode m)"; exit 1; }
# Each command is completed with the options that it has, and they are those that --help shows: the one comes from the table, the other from the parser of the command line.
commands=$(sed -n "s/^    '\([a-z ]*[a-z]\) \{0,1\}'\*\{0,1\}) used=.*/\1/p" "$NC_SOURCE_DIR/packaging/completion/ncctl")
[ "$(wc -l <<<"$commands")" -gt 50 ] || { echo "FAILED: only $(wc -l <<<"$commands") commands"; exit 1; }
access='--client --control --domain --help --json --network --security --socket --version'
while read -r command; do
  # shellcheck disable=SC2086
  shown=$("$NC_BINARY_DIR/bin/ncctl" $command --help | grep -oE '^ +(-h,)?--[a-z-]+' | grep -oE -- '--[a-z-]+' | grep -v -- '--help' | sort || true)
  # shellcheck disable=SC2086
  given=$(completed $command -- | tr ' ' '\n' | sort)
  [ "$given" = "$(tr ' ' '\n' <<<"$access $shown" | grep . | sort)" ] || { echo "FAILED: options of $command:" $given; exit 1; }
done <<<"$commands"
# What stands behind an option with a value is its value, and no word of the command.
[ "$(completed tools --socket /x set --len)" = "--length --length-wear" ] || { echo "FAILED: $(completed tools --socket /x set --len)"; exit 1; }
[ "$(completed history --kind a)" = "alarm action" ] || { echo "FAILED: --kind a: $(completed history --kind a)"; exit 1; }
[ "$(completed history --count "")" = "" ] || { echo "FAILED: --count: $(completed history --count "")"; exit 1; }
[ "$(completed history --count 5 co)" = "counters" ] || { echo "FAILED: history co: $(completed history --count 5 co)"; exit 1; }
[ "$(completed programs protect a.nc o)" = "on off" ] || { echo "FAILED: protect: $(completed programs protect a.nc o)"; exit 1; }
[ "$(completed ladder swap "$NC_SOURCE_DIR/etc/mill.i")" = "$NC_SOURCE_DIR/etc/mill.il" ] || { echo "FAILED: ladder swap"; exit 1; }
# Without a control there are no names, and nothing is said.
[ "$(completed --socket /nobody select "" 2>&1)" = "" ] || { echo "FAILED: names without a control"; exit 1; }
