#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Tests the units under a real systemd: start, ready, watchdog, restart after a crash, stop, and what is left.
set -eu
fail() { echo "FAILED: $*"; systemctl status --no-pager ncrtd ncdds 2>&1 | tail -n 30; exit 1; }
show() { systemctl show -p "$2" --value "$1"; }
# until SECONDS COMMAND...
until_true() { n=$(($1 * 10)); shift; while ! "$@" >/dev/null 2>&1; do n=$((n - 1)); [ $n -gt 0 ] || return 1; sleep 0.1; done; }
other_pid() { pid=$(show ncrtd MainPID); [ "$pid" != 0 ] && [ "$pid" != "$1" ] && systemctl -q is-active ncrtd; }

echo "process 1: $(cat /proc/1/comm)"
[ "$(cat /proc/1/comm)" = systemd ] || fail "process 1 is something else"
systemctl start ncrtd || fail "ncrtd does not start"
echo "ncrtd: $(show ncrtd ActiveState), $(show ncrtd StatusText), $(show ncrtd Type), watchdog $(show ncrtd WatchdogUSec)"
[ "$(show ncrtd StatusText)" = ready ] || fail "not ready"
[ "$(stat -c %U:%a /var/lib/nc)" = ncrtd:750 ] || fail "/var/lib/nc: $(stat -c %U:%a /var/lib/nc)"
systemctl start ncdds || fail "ncdds does not start"
until_true 30 ncmon --once --wait 5 || fail "no status"
ncmon --once --wait 20 | head -n 2
# After a crash it is restarted.
first=$(show ncrtd MainPID)
kill -KILL "$first"
until_true 30 other_pid "$first" || fail "ncrtd does not come back after a crash"
echo "after SIGKILL: process $(show ncrtd MainPID) instead of $first, restarts: $(show ncrtd NRestarts)"
until_true 30 ncmon --once --wait 5 || fail "no status after the crash"
# A scan that stands still does not feed the watchdog.
second=$(show ncrtd MainPID)
kill -STOP "$second"
until_true 60 other_pid "$second" || fail "the watchdog does not act"
echo "after SIGSTOP: process $(show ncrtd MainPID) instead of $second, restarts: $(show ncrtd NRestarts)"
gateway=$(show ncdds MainPID)
third=$(show ncrtd MainPID)
kill -KILL "$gateway"
until_true 30 sh -c "[ \"\$(systemctl show -p MainPID --value ncdds)\" != $gateway ] && systemctl -q is-active ncdds" || fail "ncdds does not come back"
[ "$(show ncrtd MainPID)" = "$third" ] || fail "ncrtd has noticed the end of its gateway"
systemctl stop ncrtd || fail "stop"
[ "$(show ncrtd Result)" = success ] || fail "ncrtd did not end in order: $(show ncrtd Result)"
ls -l /var/lib/nc
for kept in retain variables offsets; do [ "$(stat -c %U:%a /var/lib/nc/sim-mill.$kept)" = ncrtd:600 ] || fail "sim-mill.$kept"; done
# With a mistake in the configuration the machine is not touched.
mkdir -p /run/systemd/system/ncrtd.service.d
printf '[Service]\nEnvironment=NC_CONFIG=/etc/nc/none.toml\n' >/run/systemd/system/ncrtd.service.d/bad.conf
systemctl daemon-reload
if systemctl start ncrtd; then fail "a bad configuration starts"; fi
[ "$(show ncrtd Result)" != success ] || fail "a bad configuration is a success"
rm -r /run/systemd/system/ncrtd.service.d
systemctl daemon-reload
systemctl reset-failed ncrtd
systemctl start ncrtd || fail "and does not start again"
systemctl stop ncrtd ncdds
echo "as it should be"
