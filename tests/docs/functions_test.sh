#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The tables of functions in README.md and docs/functions.md are those of the code.
set -euo pipefail
exec "$NC_SOURCE_DIR/scripts/function-tables" "$NC_BINARY_DIR/bin/ncsim" --check
