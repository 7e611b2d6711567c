# SPDX-License-Identifier: Apache-2.0
# Builds for arm64 on an amd64 computer, in a chroot with a Debian 12 that has the compiler and the libraries for it: so this computer gets no packages
# of another architecture. For scripts/cross-packages and scripts/prove-target. It is sourced after lib.sh and chroot.sh, as root.

cross=$top/build/cross-arm64/chroot

# make_cross: makes the chroot unless it is there already with all of its packages.
make_cross() {
  local wanted
  wanted=$(packages_in "$top/scripts/packages-cross-arm64.txt" | tr '\n' ' ')
  [ "$(cat "$cross/made" 2>/dev/null)" != "$wanted" ] || return 0
  leave_chroot "$cross" "$([ ! -e "$cross/bootstrapped" ] || echo keep)"    # an attempt that was ended in its middle begins anew
  make_chroot "$cross"
  touch "$cross/bootstrapped"
  in_chroot "$cross" "dpkg --add-architecture arm64 && apt-get update -q && apt-get install -y -q --no-install-recommends $wanted"
  leave_chroot "$cross" keep
  printf '%s\n' "$wanted" >"$cross/made"
}

# in_cross COMMAND: runs a shell command in the chroot.
in_cross() { in_mounted_chroot "$cross" "$1"; }

# cross_packages FOLDER: builds the packages from the files of the working tree that git knows, or would take, and puts them into the folder. A file that
# has not changed keeps its time, and is not compiled again.
cross_packages() {
  local sources=$cross/src targets="nc_shared nc_static ncrtd ncsim ncctl dds_programs" file
  mkdir -p "$sources"
  (cd "$sources" && find . -path ./build -prune -o -type f -print0) | while IFS= read -r -d '' file; do [ -e "$top/$file" ] || rm -f "$sources/$file"; done
  (cd "$top" && git ls-files -z --cached --others --exclude-standard | while IFS= read -r -d '' file; do [ ! -e "$file" ] || printf '%s\0' "$file"; done |
    tar -c --null -T -) | tar -x -C "$sources"
  in_cross "set -e; cd /src
    cmake --preset release -DCMAKE_TOOLCHAIN_FILE=/src/cmake/aarch64-linux-gnu.cmake -DBUILD_TESTING=OFF -DNC_BENCH=OFF
    cmake --build --preset release -j $jobs --target $targets
    rm -rf build/packages; cd build/release
    export DEB_HOST_ARCH=arm64 DEB_HOST_GNU_TYPE=aarch64-linux-gnu DEB_HOST_MULTIARCH=aarch64-linux-gnu    # for dpkg-shlibdeps
    cpack -B ../packages"
  mkdir -p "$1"
  rm -f "$1"/*.deb
  cp "$sources"/build/packages/*.deb "$1/"
}
