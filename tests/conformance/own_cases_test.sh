#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Our own conformance cases (cases/*.json), written from the manuals by somebody who had not read the code, in the format of the shared ones and run by the
# same runner. Each of them passes. Exit status 77 (skipped) if the runner is not present.
set -u
runner=$NC_SHARED_DIR/conformance/conform.py
ncsim=$NC_BINARY_DIR/bin/ncsim
if [ ! -f "$runner" ]; then
  echo "skipped: the runner of the conformance cases is not beside this source tree"
  exit 77
fi
command -v python3 >/dev/null || { echo "skipped: no python3"; exit 77; }
[ -x "$ncsim" ] || { echo "ncsim is not built in $NC_BINARY_DIR/bin"; exit 1; }
exec python3 "$runner" --ncsim "$ncsim" "$NC_SOURCE_DIR"/tests/conformance/cases/*.json
