#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# cpack makes the Debian packages out of this build: their names, fields, files, owners and modes. Nothing is installed;
# scripts/prove-packages does that.
set -euo pipefail
if [ -n "${NC_SANITIZE:-}" ]; then
  echo "skipped: a sanitized build is not packaged"
  exit 77
fi
for tool in dpkg-deb dpkg-shlibdeps file cpack; do
  command -v "$tool" >/dev/null || { echo "skipped: $tool is missing (scripts/packages-package.txt)"; exit 77; }
done
[ -f "$NC_BINARY_DIR/CPackConfig.cmake" ] || { echo "FAILED: the build has no CPackConfig.cmake"; exit 1; }
version=$(sed -n 's/^project(libnc VERSION \([0-9.]*\).*/\1/p' "$NC_SOURCE_DIR/CMakeLists.txt")
arch=$(dpkg --print-architecture)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0
fail() { echo "FAILED: $*"; status=1; }

(cd "$NC_BINARY_DIR" && cpack -G DEB -B "$work/debs") >"$work/log" 2>&1 || { cat "$work/log"; echo "FAILED: cpack"; exit 1; }
made=$(cd "$work/debs" && ls ./*.deb | sed 's#^\./##' | tr '\n' ' ')
wanted=
for name in libnc-dev libnc1 nc-tools ncrtd; do wanted+="${name}_$version-1_$arch.deb "; done
[ "$made" = "$wanted" ] || { echo "FAILED: made '$made', wanted '$wanted'"; exit 1; }

field() {  # field PACKAGE FIELD REGEX: the whole field
  local value
  value=$(dpkg-deb -f "$work/debs/$1_$version-1_$arch.deb" "$2")
  [[ $value =~ ^$3$ ]] || fail "$1: $2 is '$value', not $3"
}
holds() {  # holds PACKAGE MODE PATH...: files (globs) with this mode
  local package=$1 mode=$2 path
  shift 2
  for path in "$@"; do
    awk -v mode="$mode" '{print $1 == mode, $6}' "$work/$package.files" | grep -E "^1 \./${path//\*/[^/]*}\$" >/dev/null ||
      fail "$package: no $mode $path"
  done
}
for name in libnc-dev libnc1 nc-tools ncrtd; do
  deb=$work/debs/${name}_$version-1_$arch.deb
  dpkg-deb -c "$deb" >"$work/$name.files"
  mkdir "$work/$name.control"
  dpkg-deb -e "$deb" "$work/$name.control"
  field "$name" Version "$version-1"
  field "$name" Maintainer '[^<]+ <[^@]+@.+>'
  field "$name" Description $'open CNC control - .*\n.*'
  awk '$2 != "root/root" {print}' "$work/$name.files" | grep . && fail "$name: not all is root's"
  awk '$1 !~ /^(drwxr-xr-x|-rw-r--r--|-rwxr-xr-x|lrwxrwxrwx)$/ {print}' "$work/$name.files" | grep . && fail "$name: odd modes"
  grep -E '\./(usr/local|home|root|tmp|var)' "$work/$name.files" && fail "$name: files where a package has none"
  holds "$name" -rw-r--r-- "usr/share/doc/$name/copyright" "usr/share/doc/$name/changelog.gz" "usr/share/doc/$name/changelog.Debian.gz"
done

lib=usr/lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH)
field libnc1 Section libs
field libnc1 Multi-Arch same
field libnc1 Depends 'libc6 \(.*\)'
holds libnc1 -rw-r--r-- "$lib/libnc.so.$version"
holds libnc1 lrwxrwxrwx "$lib/libnc.so.1"
grep -qx 'activate-noawait ldconfig' "$work/libnc1.control/triggers" || fail "libnc1: no ldconfig trigger"
grep -qE '^libnc 1 libnc1 \(>= ' "$work/libnc1.control/shlibs" || fail "libnc1: no shlibs"
[ ! -e "$work/libnc1.control/postinst" ] || fail "libnc1: a maintainer script beside the trigger"

field libnc-dev Section libdevel
field libnc-dev Multi-Arch same
field libnc-dev Depends "libnc1 \\(= $version-1\\)"
holds libnc-dev -rw-r--r-- usr/include/nc/nc.h "$lib/libnc.a" "$lib/pkgconfig/libnc.pc" "$lib/cmake/nc/nc-config.cmake" \
  usr/share/doc/libnc-dev/examples/2_drive.c
holds libnc-dev lrwxrwxrwx "$lib/libnc.so"

field nc-tools Multi-Arch foreign
field nc-tools Depends '.*libc6 \(.*'
field nc-tools Recommends libcairo2
holds nc-tools -rwxr-xr-x usr/bin/ncsim
holds nc-tools -rw-r--r-- 'usr/share/man/man1/ncsim.1.gz'

field ncrtd Depends 'adduser, .*libc6 \(.*'
field ncrtd Recommends 'nc-tools, openssl'
holds ncrtd -rwxr-xr-x usr/bin/ncrtd
holds ncrtd -rwxr-xr-x usr/bin/ncctl
holds ncrtd -rw-r--r-- usr/share/man/man1/ncctl.1.gz usr/share/bash-completion/completions/ncctl
holds ncrtd -rw-r--r-- lib/systemd/system/ncrtd.service usr/share/man/man8/ncrtd.8.gz usr/share/man/man5/ncrtd.toml.5.gz usr/share/nc/parts/flange.nc
for name in packaging ladder signals modbus gpio dds macros parameters system-variables functions; do holds ncrtd -rw-r--r-- "usr/share/doc/ncrtd/$name.md"; done
if [ -x "$NC_BINARY_DIR/bin/ncdds" ]; then
  holds ncrtd -rwxr-xr-x usr/bin/ncdds
  holds ncrtd -rw-r--r-- lib/systemd/system/ncdds.service usr/share/man/man8/ncdds.8.gz
  holds ncrtd -rwxr-xr-x usr/bin/nc-keys
  holds ncrtd -rw-r--r-- usr/share/man/man8/nc-keys.8.gz usr/share/bash-completion/completions/nc-keys usr/share/nc/dds/secured.conf
  holds nc-tools -rwxr-xr-x usr/bin/ncmon
  holds nc-tools -rw-r--r-- usr/share/man/man1/ncmon.1.gz
fi
for script in postinst prerm postrm; do
  sh -n "$work/ncrtd.control/$script" || fail "ncrtd: $script"
  [ "$(stat -c %a "$work/ncrtd.control/$script")" = 755 ] || fail "ncrtd: mode of $script"
  grep -q '@' "$work/ncrtd.control/$script" && fail "ncrtd: a placeholder is left in $script"
done

# Every document that a package names is in it, also those that its configurations and documents name.
for package in libnc-dev nc-tools ncrtd; do dpkg-deb -x "$work/debs/${package}_$version-1_$arch.deb" "$work/$package.tree"; done
documents=0
while read -r name; do
  holds ncrtd -rw-r--r-- "usr/share/doc/ncrtd/$name"
  documents=$((documents + 1))
done < <(grep -rhoE 'docs/[a-z-]+\.md' "$work/ncrtd.tree/etc/nc" | sed 's#docs/##' | sort -u)
for package in libnc-dev nc-tools ncrtd; do
  while read -r name; do
    holds "$package" -rw-r--r-- "usr/share/doc/$package/$name"
    documents=$((documents + 1))
  done < <(find "$work/$package.tree/usr/share/doc/$package" -name '*.md' -exec grep -hoE '\]\([a-z-]+\.md' {} + | sed 's/..//' | sort -u)
done
[ $documents -ge 10 ] || fail "only $documents documents are named"
# The gateway is reached only from this computer until somebody configures a network (docs/dds.md).
unit=$work/ncrtd.tree/lib/systemd/system/ncdds.service
for line in IPAddressDeny=any IPAddressAllow=localhost; do
  [ ! -f "$unit" ] || grep -qx "$line" "$unit" || fail "ncdds.service: no $line"
done

# Programs and library are hardened: position-independent, relocations read-only and all of them at the start, no executable stack,
# the stack protected, and the checked functions of the C library used.
for package in libnc1 nc-tools ncrtd; do dpkg-deb -x "$work/debs/${package}_$version-1_$arch.deb" "$work/all"; done
binaries=("$work"/all/usr/bin/* "$work/all/$lib/libnc.so.$version")
[ ${#binaries[@]} -ge 3 ] || fail "only ${#binaries[@]} binaries"
for binary in "${binaries[@]}"; do
  name=$(basename "$binary")
  if [ "$name" = nc-keys ]; then    # a script
    [ "$("$binary" --version)" = "nc-keys $version" ] || fail "nc-keys has no version"
    continue
  fi
  grep -qE 'Type: +DYN' <<<"$(readelf -hW "$binary")" || fail "$name: not position-independent"
  readelf -lW "$binary" >"$work/segments"
  grep -q GNU_RELRO "$work/segments" || fail "$name: no relro"
  grep -qE 'GNU_STACK.*RWE' "$work/segments" && fail "$name: an executable stack"
  grep -qE 'BIND_NOW|FLAGS_1.*NOW' <<<"$(readelf -dW "$binary")" || fail "$name: symbols are looked up late"
  readelf --dyn-syms -W "$binary" >"$work/symbols"
  grep -q '__stack_chk_fail' "$work/symbols" || fail "$name: no stack protector"
  grep -qE '__[a-z]+_chk(@|$)' "$work/symbols" || fail "$name: no fortified functions"
done

# Every configuration of the source is a configuration file, and finds its part programs.
(cd "$NC_SOURCE_DIR/etc" && ls ./*.toml ./*.il 2>/dev/null) | sed 's#^\.#/etc/nc#' | sort >"$work/wanted"
sort "$work/ncrtd.control/conffiles" | diff "$work/wanted" - || fail "ncrtd: conffiles"
while read -r file; do holds ncrtd -rw-r--r-- "${file#/}"; done <"$work/wanted"
dpkg-deb -x "$work/debs/ncrtd_$version-1_$arch.deb" "$work/tree"
sed -i "s#\"/usr/share/nc/parts\"#\"$work/tree/usr/share/nc/parts\"#" "$work"/tree/etc/nc/*.toml
for file in "$work"/tree/etc/nc/*.toml; do
  grep -q "^programs = \"$work/tree" "$file" || fail "$(basename "$file") does not look into /usr/share/nc/parts"
  "$work/tree/usr/bin/ncrtd" --config "$file" check || fail "$(basename "$file")"
done

[ $status -eq 0 ] && echo "ok: $made"
exit $status
