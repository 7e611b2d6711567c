#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs every shared conformance case with the ncsim of this build. The list of known failures may only shrink: the test
# fails for a new failure, and for a case on the list that passes. Exit status 77 (skipped) if the cases are not present.
set -u
cases=$NC_SHARED_DIR/conformance
ncsim=$NC_BINARY_DIR/bin/ncsim
if [ ! -f "$cases/conform.py" ]; then
  echo "skipped: the shared conformance cases are not beside this source tree"
  exit 77
fi
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
[ -x "$ncsim" ] || { echo "ncsim is not built in $NC_BINARY_DIR/bin"; exit 1; }
exec python3 "$cases/conform.py" --known "$NC_SOURCE_DIR/tests/conformance/known-failures.txt" \
  --ncsim "$ncsim" "$cases"/*.json
