#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The manual pages agree with the programs: every option and command of --help is in its page, no page has an option that the program does not
# know, every key that the configuration reader knows is in ncrtd.toml(5), and the version is the present one.
set -euo pipefail
man=$NC_SOURCE_DIR/packaging/man
version=$(sed -n 's/^project(libnc VERSION \([0-9.]*\).*/\1/p' "$NC_SOURCE_DIR/CMakeLists.txt")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0
fail() { echo "FAILED: $*"; status=1; }

for page in "$man"/*.[1-8]; do
  grep -q "^\.TH .*\"libnc $version\"" "$page" || fail "$(basename "$page") is of another version than $version"
done
[[ $(head -n 1 "$NC_SOURCE_DIR/packaging/debian/changelog") == *"libnc ($version-"* ]] || fail "packaging/debian/changelog has another version"

for page in "$man"/*.[18]; do
  name=$(basename "${page%.*}")
  program=$NC_BINARY_DIR/bin/$name
  if [ ! -x "$program" ]; then
    case $name in
      ncsim | ncrtd) fail "$name is not built" ;;
      *) echo "note: $name is not built here" ;;
    esac
    continue
  fi
  "$program" --help >"$work/help"
  commands=$(awk '/^Subcommands:/ {on = 1; next} /^[^ ]/ {on = 0} on && NF {print $1}' "$work/help")
  for command in $commands; do
    if grep -q -- '--machine.*REQUIRED' "$work/help"; then "$program" --machine x "$command" --help; else "$program" "$command" --help; fi
  done >>"$work/help"
  grep -E '^  -' "$work/help" | awk '{print $1}' | tr , '\n' | grep '^-' | sort -u >"$work/options"
  sed -e 's/\\-/-/g' -e 's/\\f[A-Z]//g' "$page" >"$work/page"
  [ "$(wc -l <"$work/options")" -ge 3 ] || fail "$name --help names no options"
  while read -r option; do
    grep -qE -- "(^|[^a-z-])$option([^a-z-]|\$)" "$work/page" || fail "$name: $option is not in $(basename "$page")"
  done <"$work/options"
  for command in $commands; do
    grep -qx "\.B $command" "$work/page" || fail "$name: the command $command is not in $(basename "$page")"
  done
  awk '/^\.SH/ {on = $2 == "OPTIONS"} on && tag && /^\.B/ {print} {tag = $1 == ".TP"}' "$work/page" |
    grep -oE -- '--?[a-z][a-z-]*' | sort -u >"$work/described"
  undescribed=$(comm -13 "$work/options" "$work/described")
  [ -z "$undescribed" ] || fail "$(basename "$page") describes what $name does not know: $undescribed"
  echo "$name: $(wc -l <"$work/options") options, $(wc -w <<<"$commands") commands"
done

# The names that the readers of the configuration are asked for, tables and keys, and the keys of the files in etc/.
sed -e 's/\\-/-/g' "$man/ncrtd.toml.5" >"$work/page"
grep -rhoE '(reader|root|sim|solid)(\.|->)(string|strings|number|numbers|integer|boolean|choice|table|tables|require|find)\("[a-z_]+"' \
  --include='*.cpp' "$NC_SOURCE_DIR/runtime" | sed 's/.*"\([a-z_]*\)"/\1/' | sort -u >"$work/keys"
[ "$(wc -l <"$work/keys")" -ge 60 ] || fail "only $(wc -l <"$work/keys") keys found in the readers of the configuration"
# The keys of [parameters] are a dialect's own (docs/parameters.md).
awk 'FNR == 1 { skip = 0 } /^\[/ { skip = $0 == "[parameters]" } !skip' "$NC_SOURCE_DIR"/etc/*.toml | sed -nE 's/^([a-z_]{3,}) = .*/\1/p' | sort -u >>"$work/keys"
while read -r key; do
  grep -qE -- "(^|[^a-z_])$key([^a-z_]|\$)" "$work/page" || fail "the key $key is not in ncrtd.toml.5"
done <"$work/keys"
echo "ncrtd.toml.5: $(sort -u "$work/keys" | wc -l) keys"

if command -v groff >/dev/null; then
  for page in "$man"/*.[1-8]; do
    warnings=$(groff -man -Tutf8 -ww -z "$page" 2>&1) || true
    [ -z "$warnings" ] || fail "$warnings"
  done
fi
exit $status
