# SPDX-License-Identifier: Apache-2.0
# Functions for packages and quiet builds, shared by ./run, ./test, .ci/run and the scripts in this folder. It is sourced, not run.

top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
if [ "$(id -u)" -eq 0 ]; then as_root=(); else as_root=(sudo); fi
jobs=$(nproc 2>/dev/null || echo 2)
installed_something=no

say() { printf '%s\n' "$*"; }
die() { printf '%s\n' "$*" >&2; exit 1; }

# Machines of etc/ that are made for one family say so by a line "# Example part: FILE", which is taken from their folder.
example_machines() { grep -l '^# Example part: ' "$top"/etc/*.toml; }
# example_of_machine FILE: the part, nothing where the machine names none.
example_of_machine() {
  local part
  part=$(sed -n 's/^# Example part: //p' "$1" | head -n 1)
  [ -z "$part" ] || realpath "$(dirname "$1")/$part"
}
# machine_of_dialect NAME: the first machine of this family, nothing where there is none.
machine_of_dialect() { { example_machines | xargs grep -l "^dialect = \"$1\"" || true; } | head -n 1; }
# The families that have one, each with a space before it.
dialects_of_machines() { example_machines | xargs sed -n 's/^dialect = "\([^"]*\)".*/\1/p' | sed 's/^/ /' | tr -d '\n'; }

# packages_in FILE...: prints the package names of the lists, without comments and blank lines.
packages_in() { sed -e 's/#.*//' -e '/^[[:space:]]*$/d' "$@"; }

# missing_packages FILE...: prints those of the lists that are not installed.
missing_packages() {
  local package
  packages_in "$@" | while read -r package; do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || say "$package"
  done
}

# ensure_packages FILE...: installs the Debian packages of the lists that are missing, and prints their names.
ensure_packages() {
  local missing=()
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    say "This is not a Debian system; needed are the equivalents of: $(packages_in "$@" | tr '\n' ' ')"
    return 0
  fi
  mapfile -t missing < <(missing_packages "$@")
  [ ${#missing[@]} -gt 0 ] || return 0
  say "Installing missing Debian packages: ${missing[*]}"
  if [ ${#as_root[@]} -gt 0 ] && ! command -v sudo >/dev/null; then
    die "Neither root nor sudo. Run as root: apt-get install --no-install-recommends ${missing[*]}"
  fi
  mkdir -p "$top/build"
  local log=$top/build/apt.log apt=(env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=600)
  if ! { "${as_root[@]}" "${apt[@]}" update && \
         "${as_root[@]}" "${apt[@]}" install -y --no-install-recommends "${missing[@]}"; } >"$log" 2>&1 </dev/null; then
    tail -n 25 "$log" >&2
    die "apt-get could not install them (whole log: $log)"
  fi
  installed_something=yes
}

# build_preset PRESET [-DVAR=VALUE...] [-- TARGET...]: configures where needed, and builds, quietly. The build tool by itself configures again
# when a CMake file changes or a source file is added or removed, but not when the presets change.
build_preset() {
  local preset=$1 log=$top/build/$1.log defines=() targets=()
  shift
  while [ $# -gt 0 ] && [ "$1" != -- ]; do defines+=("$1"); shift; done
  [ $# -eq 0 ] || { shift; [ $# -eq 0 ] || targets=(--target "$@"); }
  mkdir -p "$top/build"
  : >"$log"
  if [ ${#defines[@]} -gt 0 ] || [ $installed_something = yes ] || [ ! -f "$top/build/$preset/build.ninja" ] ||
     [ "$top/CMakePresets.json" -nt "$top/build/$preset/build.ninja" ]; then
    (cd "$top" && cmake --preset "$preset" "${defines[@]}") >>"$log" 2>&1 || { build_failed "$log"; return 1; }
  fi
  [ -e "$top/build/$preset/.ninja_log" ] || say "Building preset $preset (log: build/$preset.log) ..."
  (cd "$top" && cmake --build --preset "$preset" -j "$jobs" "${targets[@]}") >>"$log" 2>&1 || { build_failed "$log"; return 1; }
}

# run_ctest PRESET ARGS...: runs the tests of a built preset. The first finding of a sanitizer ends its test; leaks are findings.
run_ctest() {
  local preset=$1
  shift
  (
    cd "$top/build/$preset" || exit 1
    export ASAN_OPTIONS=${ASAN_OPTIONS:-detect_leaks=1:strict_string_checks=1}
    export UBSAN_OPTIONS=${UBSAN_OPTIONS:-print_stacktrace=1}
    export TSAN_OPTIONS=${TSAN_OPTIONS:-halt_on_error=1:second_deadlock_stack=1}
    exec ctest --output-on-failure --no-tests=error --test-output-size-passed 1000000 -j3 --output-junit "$top/build/$preset/ctest.xml" "$@"
  )
}

# told NAME COMMAND...: runs a long part of a script, a function mostly; its output is in $logs/NAME.log, and is shown when it fails. The command is no
# condition of the shell here, in which "set -e" would not count.
told() {
  local begin=$SECONDS name=$1 log=$logs/$1.log status
  shift
  set +e
  (set -e; "$@") >"$log" 2>&1 </dev/null
  status=$?
  set -e
  if [ $status -ne 0 ]; then
    tail -n 25 "$log" >&2
    die "$(basename "$0"): $name failed (whole log: $log)"
  fi
  say "--- $name: $((SECONDS - begin)) s"
}

# build_failed LOG: prints the errors, then the end of the log.
build_failed() {
  { grep -nE 'error:|CMake Error|undefined reference' "$1" | head -n 20; say "--- end of $1"; tail -n 25 "$1"; say "The build failed."; } >&2
}
