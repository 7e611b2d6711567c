#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The packaged unit of ncdds with its drop-in for DDS Security, as far as it shows without a running systemd: systemd reads both without a word, and what a secured
ncdds does with the options of the drop-in, while clients are served and its keys are renewed, is what the sandbox of the unit lets it do.

The gateway runs under strace, and each of its calls is held against the directives: system calls, families of sockets, addresses, files that are written, memory that can be
written and executed, namespaces, real-time priorities. The interface is lo in place of that of the drop-in, so multicast is not tried. Exit status 77 = skipped: see
secured_plant.py, or strace or systemd-analyze is not there or may not be used.
"""
import ipaddress
import os
import re
import shutil
import signal
import subprocess
import sys

from dds_environment import check, root, skip, until
from secure_services_test import PROGRAMS, ServicePlant, ncctl
from secured_plant import Process, program, run

UNITS = os.path.join(root, "packaging", "systemd")
# MemoryDenyWriteExecute= forbids the first three, RestrictNamespaces= the fourth, RestrictRealtime= the fifth, LockPersonality= the last one.
FORBIDDEN = [(r"mmap\(.*PROT_WRITE[^,]*PROT_EXEC", "memory that can be written and executed"), (r"(mprotect|pkey_mprotect)\(.*PROT_EXEC", "memory that becomes executable"),
             (r"shmat\(.*SHM_EXEC", "shared memory that can be executed"), (r"(clone3?|unshare|setns)\(.*CLONE_NEW", "a namespace"),
             (r"sched_set(scheduler|attr)\(.*SCHED_(FIFO|RR|DEADLINE)", "a real-time priority"), (r"personality\((?!0xffffffff)", "another personality")]


class Directives:
    """What the unit and its drop-in say: an empty value takes back what came before it, as systemd has it."""

    def __init__(self, *files):
        self.values = {}
        for file in files:
            with open(file, encoding="utf-8") as lines:
                for name, value in re.findall(r"^(\w+)=(.*)$", lines.read(), re.M):
                    self.values[name] = [*self.values.get(name, []), value] if value else []

    def words(self, name):
        return [word for value in self.values.get(name, []) for word in value.split()]

    def networks(self):
        local = {"localhost": ["127.0.0.0/8", "::1/128"]}
        return [ipaddress.ip_network(address) for word in self.words("IPAddressAllow") for address in local.get(word, [word])]

    def options(self):
        """The words of NCDDS_OPTIONS that hold at last."""
        found = [value for value in self.values["Environment"] if "NCDDS_OPTIONS=" in value]
        return found[-1].strip('"').split("=", 1)[1].split()


def system_calls(group):
    """Those of a group of systemd, with the groups that it holds."""
    done = subprocess.run(["systemd-analyze", "--no-pager", "syscall-filter", group], capture_output=True, text=True)
    calls = set()
    for word in re.findall(r"^ +(@?[a-z0-9_-]+)$", done.stdout, re.M):
        calls |= system_calls(word) if word.startswith("@") else {word}
    return calls


def verify(folder):
    """systemd-analyze finds nothing in the two units, the one of the gateway with its drop-in; and it finds a mistake, so it has read them."""
    os.makedirs(os.path.join(folder, "ncdds.service.d"))
    for name in ("ncdds.service", "ncrtd.service"):
        with open(os.path.join(UNITS, name), encoding="utf-8") as file:
            text = file.read()
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text.replace("/usr/bin/nc", program("nc")))
    drop_in = os.path.join(folder, "ncdds.service.d", "secured.conf")
    shutil.copy(os.path.join(UNITS, "ncdds-secured.conf"), drop_in)

    def said(*what):
        return subprocess.run(["systemd-analyze", "--no-pager", *what], capture_output=True, text=True, env={**os.environ, "SYSTEMD_UNIT_PATH": folder + ":"})

    for unit in ("ncdds.service", "ncrtd.service"):
        done = said("verify", "--man=no", unit)
        check(done.returncode == 0 and done.stderr.strip() == "", f"systemd finds nothing wrong in {unit} {done.stderr.strip()[:300]}")
    exposure = said("security", "--offline=true", "--threshold=20", "ncdds.service")
    check(exposure.returncode == 0, "and its exposure with the drop-in is at most 2.0 of 10 " + "".join(exposure.stdout.splitlines()[-1:]))
    with open(drop_in, "a", encoding="utf-8") as file:
        file.write("IPAddresAllow=10.0.0.0/8\n")
    check("IPAddresAllow" in said("verify", "--man=no", "ncdds.service").stderr, "a mistake in the drop-in is found")


def calls_of(trace):
    """The calls of the trace, each whole: one that another thread has interrupted is put together."""
    begun, calls = {}, []
    with open(trace, encoding="utf-8", errors="replace") as lines:
        for line in lines:
            task, text = line.split(maxsplit=1)
            if text.rstrip().endswith("<unfinished ...>"):
                begun[task] = text.split(" <unfinished")[0]
                continue
            if resumed := re.match(r"<\.\.\. (\w+) resumed>(.*)", text):
                text = begun.pop(task, resumed[1] + "(") + resumed[2]
            if re.match(r"\w+\(", text):
                calls.append(text.rstrip())
    return calls + list(begun.values())


def is_written(call):
    """The path that an open for writing names, "" = it is none."""
    found = re.match(r'(?:open|openat|creat)\((?:AT_FDCWD[^,]*, )?"([^"]*)", ([A-Z_|]+)', call)
    return found[1] if found and re.search("O_WRONLY|O_RDWR|O_CREAT", found[2]) and not re.search(r"= -1 ", call) else ""


def within_sandbox(calls, directives):
    """Everything that is against a directive; and how many calls each rule has looked at."""
    allowed = set()
    for word in directives.words("SystemCallFilter"):
        allowed |= system_calls(word) if word.startswith("@") else {word}
    families, networks = directives.words("RestrictAddressFamilies"), directives.networks()
    wrong, seen = [], {"calls": len(calls), "sockets": 0, "addresses": 0}
    for call in calls:
        name = call.split("(", 1)[0]
        if name not in allowed:
            wrong.append(f"SystemCallFilter: {call[:150]}")
        wrong += [f"{what}: {call[:150]}" for pattern, what in FORBIDDEN if re.match(pattern, call)]
        if path := is_written(call):
            if not path.startswith(("/dev/", "/proc/self/")):
                wrong.append(f"ProtectSystem: {call[:150]}")
        if family := re.match(r"socket\((AF_\w+)", call):
            seen["sockets"] += 1
            if family[1] not in families:
                wrong.append(f"RestrictAddressFamilies: {call[:150]}")
        if name in ("sendto", "sendmsg", "sendmmsg", "connect"):
            for address in re.findall(r'inet_addr\("([0-9.]+)"\)|inet_pton\(AF_INET6, "([0-9a-f:.]+)"', call):
                seen["addresses"] += 1
                if not any(ipaddress.ip_address(address[0] or address[1]) in network for network in networks):
                    wrong.append(f"IPAddressDeny: {call[:200]}")
    return wrong, seen


def serve(plant, directives):
    """A secured gateway with the options of the drop-in, under strace, while clients use it and it gets new keys. Its calls."""
    options = [{"/etc/nc/dds": plant.identity("gateway"), "eth0": "lo"}.get(word, word) for word in directives.options()]
    check("--security" in options and "--commands" in options and "lo" in options, f"the drop-in says {' '.join(directives.options())}")
    trace = os.path.join(plant.folder, "trace")
    gateway = Process(plant.folder, "strace", "-f", "-qq", "-s", "0", "-o", trace, program("ncdds"), "--share", plant.share, "--domain", plant.domain, "--services", plant.socket, *options)
    gateway.wait_for("publishes .*takes commands", "a gateway with these options publishes", patience=120)
    check('"X"' in ncctl(plant, "boss", "--network", "lo", "--json", "status"), "a client sees the status")
    ncctl(plant, "boss", "--network", "lo", "tools", "set", "1", "--length", "12.5")
    ncctl(plant, "boss", "--network", "lo", "mode", "manual")
    Process(plant.folder, program("nc-keys"), "--folder", plant.keys, "renew", "gateway").process.wait()
    children = subprocess.run(["pgrep", "-P", str(gateway.process.pid)], capture_output=True, text=True).stdout.split()
    check(len(children) == 1, "the process of the gateway is found")
    os.kill(int(children[0]), signal.SIGHUP)  # ExecReload=
    gateway.wait_for("the new identity is in use", "the new keys are taken", patience=120)
    check('"X"' in ncctl(plant, "boss", "--network", "lo", "--json", "status"), "and a client is served")
    os.kill(int(children[0]), signal.SIGTERM)
    until(lambda: gateway.process.poll() is not None, "it ends")
    check(gateway.process.returncode == 0, f"in order {gateway.process.returncode}")
    return calls_of(trace)


def may_trace():
    return subprocess.run(["strace", "-qq", "-o", "/dev/null", "true"], capture_output=True).returncode == 0


def secured_unit(plant):
    verify(os.path.join(plant.folder, "units"))
    directives = Directives(os.path.join(UNITS, "ncdds.service"), os.path.join(UNITS, "ncdds-secured.conf"))
    plant.make("init")
    plant.make("identity", "gateway", "--gateway", "--machine", plant.share)
    plant.make("identity", "boss", "--right", "operate,setup,maintain")
    plant.control()
    wrong, seen = within_sandbox(serve(plant, directives), directives)
    check(seen["calls"] > 1000 and seen["sockets"] > 3 and seen["addresses"] > 100, f"{seen['calls']} calls, {seen['sockets']} sockets, {seen['addresses']} addresses that something is sent to")
    check(not wrong, f"nothing that the unit forbids: {len(wrong)} calls\n" + "\n".join(sorted(set(wrong))[:20]))


def main():
    missing = [tool for tool in ("systemd-analyze", "strace", "pgrep") if shutil.which(tool) is None]
    if missing or not may_trace() or os.environ.get("NC_SANITIZE"):
        skip(f"{missing[0]} is not here" if missing else "a process may not be traced here, or is built with a sanitizer, which makes calls of its own")
    return run(secured_unit, PROGRAMS, ServicePlant)


if __name__ == "__main__":
    sys.exit(main())
