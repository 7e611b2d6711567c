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
