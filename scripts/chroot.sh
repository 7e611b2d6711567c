# SPDX-License-Identifier: Apache-2.0
# Makes a fresh Debian 12 in a folder, for scripts/prove-chroot and scripts/prove-packages. It is sourced after lib.sh, as root.
# The chroot gets a copy of this machine's apt configuration, so that it reaches packages in the same way.

# archive_of_bookworm: sets $mirror, the archive from which this machine itself gets bookworm, and $proxy.
archive_of_bookworm() {
  mirror=$(apt-get indextargets --format '$(REPO_URI) $(CODENAME) $(ORIGIN)' 2>/dev/null | awk '$2 == "bookworm" && $3 == "Debian" {print $1; exit}')
  [ -n "$mirror" ] || die "apt on this machine knows no archive with Debian bookworm"
  proxy=$(apt-config shell p Acquire::http::Proxy | sed -n "s/^p='\(.*\)'$/\1/p")
}

# make_chroot ROOT [ARCH]: runs debootstrap unless the system is there already, and mounts /proc and /dev. Sets $proxy. ARCH: where it is another
# architecture than that of this machine; then nothing may be mounted there yet.
make_chroot() {
  local root=$1 foreign=${2:+--foreign --arch=$2} part
  command -v debootstrap >/dev/null || die "install debootstrap first"
  mkdir -p "$root"
  chmod 755 "$root"    # mktemp makes it 700, which only root could enter
  archive_of_bookworm
  if [ ! -x "$root/usr/bin/apt-get" ]; then
    say "debootstrap bookworm ..."
    # shellcheck disable=SC2086
    env ${proxy:+http_proxy="$proxy"} debootstrap $foreign --variant=minbase --include=ca-certificates bookworm "$root" "$mirror" >"$root.log" 2>&1 ||
      { tail -n 20 "$root.log" >&2; die "debootstrap failed"; }
    [ -z "$foreign" ] || second_stage "$root"
  fi
  rm -f "$root.log"
  for part in sources.list sources.list.d apt.conf.d auth.conf.d keyrings trusted.gpg.d preferences.d; do
    [ ! -e "/etc/apt/$part" ] || { rm -rf "${root:?}/etc/apt/$part"; cp -a "/etc/apt/$part" "$root/etc/apt/"; }
  done
  cp -L /etc/resolv.conf /etc/hosts "$root/etc/" 2>/dev/null || true
  cp -a /usr/local/share/ca-certificates/. "$root/usr/local/share/ca-certificates/" 2>/dev/null || true
  chroot "$root" update-ca-certificates >/dev/null 2>&1 || true
  mount_devices "$root"
}

# second_stage ROOT: the part of debootstrap that runs programs of the system. "lxc" tells it that it cannot make devices. dpkg does not wait for the disk
# behind each file: that was most of the time.
second_stage() {
  echo force-unsafe-io >"$1/etc/dpkg/dpkg.cfg.d/nc-chroot"
  [ ! -L "$1/proc" ] || { rm "$1/proc" && mkdir "$1/proc"; }    # in a container debootstrap makes a link of it
  in_mounted_chroot "$1" "container=lxc /debootstrap/debootstrap --second-stage" >>"$1.log" 2>&1 || { tail -n 20 "$1.log" >&2; die "debootstrap failed"; }
}

# mount_devices ROOT: mounts /proc, and a new /dev for the chroot. It must not be a bind mount of this machine's /dev: if the folder were deleted
# while that is mounted, the devices of this machine would be deleted with it.
mount_devices() {
  local dev=$1/dev node name major minor
  mount -t proc proc "$1/proc" && mount -t tmpfs -o mode=755 nc-chroot "$dev" || die "/proc and /dev cannot be mounted in $1"
  for node in null:1:3 zero:1:5 full:1:7 random:1:8 urandom:1:9 tty:5:0; do
    IFS=: read -r name major minor <<<"$node"
    mknod -m 666 "$dev/$name" c "$major" "$minor"
  done
  mkdir -m 1777 "$dev/shm"
  mkdir "$dev/pts"
  mount -t devpts -o newinstance,ptmxmode=0666,mode=620 nc-chroot "$dev/pts" || say "note: no terminals in the chroot"
  ln -s pts/ptmx "$dev/ptmx"
  ln -s /proc/self/fd "$dev/fd"
  for node in stdin:0 stdout:1 stderr:2; do ln -s "/proc/self/fd/${node#*:}" "$dev/${node%:*}"; done
}

# boot_chroot ROOT SCRIPT SECONDS: starts systemd as process 1 of the chroot, in its own namespaces, where it runs SCRIPT (a path in the chroot)
# as a service and powers off. The output of the script goes to SCRIPT.log, its exit status to SCRIPT.status. The chroot must have no mounts.
boot_chroot() {
  local root=$1 script=$2 seconds=$3 group=
  printf '%s\n' '[Unit]' DefaultDependencies=no '[Service]' Type=oneshot "ExecStart=/bin/sh -c '$script >$script.log 2>&1; echo \$\$? >$script.status'" \
    TimeoutStartSec="$seconds" 'ExecStopPost=/bin/systemctl --force --force poweroff' >"$root/etc/systemd/system/nc-prove.service"
  printf '%s\n' '[Unit]' Wants=nc-prove.service >"$root/etc/systemd/system/nc-prove.target"
  rm -f "$root$script.status"
  # A new control group in the unified hierarchy, wherever that is mounted: for the new process 1 it is the root of the hierarchy.
  for group in /sys/fs/cgroup/unified /sys/fs/cgroup; do [ ! -f "$group/cgroup.procs" ] || break; done
  group=$group/nc-prove.$$
  mkdir "$group" || { rm -f "$root"/etc/systemd/system/nc-prove.*; return 1; }
  # shellcheck disable=SC2016
  timeout "$((seconds + 60))" bash -c 'echo $$ >"$1/cgroup.procs"; exec unshare --mount --pid --fork --uts --ipc --cgroup --propagation private bash -c "$2" "$0"' \
    "$root" "$group" '
    set -eu
    . "'"$top"'/scripts/lib.sh"; . "'"$top"'/scripts/chroot.sh"
    mount --bind "$0" "$0"
    mount_devices "$0"
    mount -t tmpfs -o mode=755 nc-run "$0/run"
    mount -t sysfs -o ro nc-sys "$0/sys"
    mount -t cgroup2 nc-cgroup "$0/sys/fs/cgroup"
    exec chroot "$0" env -i container=other PATH=/usr/sbin:/usr/bin:/sbin:/bin /lib/systemd/systemd --system --unit=nc-prove.target --log-target=console \
      --log-level=notice --show-status=no' >"$root$script.boot" 2>&1 </dev/null || true
  rmdir "$group" 2>/dev/null || find "$group" -depth -type d -exec rmdir {} + 2>/dev/null || say "note: $group is left"
  rm -f "$root"/etc/systemd/system/nc-prove.*
  [ -f "$root$script.status" ] && [ "$(cat "$root$script.status")" = 0 ]
}

# leave_chroot ROOT [KEEP]: unmounts everything, and deletes the folder unless KEEP is not empty.
leave_chroot() {
  local place
  for place in "$1/dev/pts" "$1/dev" "$1/proc"; do
    ! mountpoint -q "$place" || umount "$place" || umount -l "$place" || say "note: $place is still mounted"
  done
  [ -n "${2:-}" ] || rm -rf --one-file-system "$1"
}

# in_chroot ROOT COMMAND: runs a shell command in the chroot with a plain environment.
in_chroot() {
  local with=
  chroot "$1" /bin/true 2>/dev/null || with=with_arm64
  $with chroot "$1" env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C DEBIAN_FRONTEND=noninteractive \
    ${proxy:+http_proxy="$proxy"} sh -c "$2" </dev/null
}

# with_arm64 COMMAND...: runs a command that runs programs for arm64, by qemu-aarch64-static of qemu-user-static. Where that package has told the kernel so
# itself nobody needs this. Here the kernel is told for a user namespace (Linux 6.7 and later), which ends with the command; for the rest of this machine nothing changes.
with_arm64() {
  local keeper status=0 begin='\x7fELF\x02\x01\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00\x02\x00\xb7\x00'    # of such a program: 64 bits, an executable or a library, AArch64
  local mask='\xff\xff\xff\xff\xff\xff\xff\x00\xff\xff\xff\xff\xff\xff\xff\xff\xfe\xff\xff\xff'
  command -v qemu-aarch64-static >/dev/null || die "install qemu-user-static first"
  unshare --user --mount --propagation private sleep 7200 &    # the namespaces are there as long as somebody is in them
  keeper=$!
  while [ "$(readlink "/proc/$keeper/ns/user")" = "$(readlink /proc/self/ns/user)" ]; do sleep 0.1; done
  echo 0 0 65536 >"/proc/$keeper/uid_map"
  echo 0 0 65536 >"/proc/$keeper/gid_map"
  # shellcheck disable=SC2016
  nsenter --target "$keeper" --user --mount --setuid 0 --setgid 0 bash -c 'mount -t binfmt_misc nc-binfmt /proc/sys/fs/binfmt_misc &&
    printf %s "$1" >/proc/sys/fs/binfmt_misc/register && shift && exec "$@"' nc-arm64 ":nc-arm64:M::$begin:$mask:$(command -v qemu-aarch64-static):F" "$@" || status=$?
  kill "$keeper"
  wait "$keeper" 2>/dev/null || true
  return $status
}

# in_mounted_chroot ROOT COMMAND: the same in a chroot without its devices, which are there meanwhile.
in_mounted_chroot() {
  local status=0
  leave_chroot "$1" keep    # of an attempt that was ended in its middle
  mount_devices "$1"
  in_chroot "$1" "$2" || status=$?
  leave_chroot "$1" keep
  return $status
}
