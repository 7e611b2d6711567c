#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""ncrtd, a secured ncdds and peers in C (secure_peer.c) with Debian's plug-ins of DDS Security: who may see and command, and who may not.

Exit status 77 = skipped: the programs are not built, or the plug-ins or openssl are not there.
"""
import glob
import os
import re
import signal
import subprocess
import sys
import tempfile
import time

SKIPPED = 77
PATIENCE = 30.0  # s for anything to come; only a failure takes so long
SILENCE = 4.0  # s in which nothing may come to somebody who may not have it; an allowed peer has it within 1 s
root = os.environ.get("NC_SOURCE_DIR") or os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
build = os.environ.get("NC_BINARY_DIR") or os.path.join(root, "build/release")
TAKE_CONTROL, FEED_OVERRIDE = 0, 6
DONE, REJECTED = 1, 2
MACHINE = """
[machine]
name = "Secured"
programs = "."
[scheduling]
policy = "other"
lock_memory = false
overrun = "count"
[[axis]]
name = "X"
max_velocity = 200.0
max_acceleration = 2000.0
"""


def check(condition, text):
    if not condition:
        raise AssertionError(text)
    print("ok:", text, flush=True)


def program(name):
    return os.path.join(build, "bin", name)


class Process:
    """A program whose output goes into a file."""

    def __init__(self, folder, *command, environment=None):
        Process.count += 1
        self.log = os.path.join(folder, f"{Process.count}-{os.path.basename(command[0])}.log")
        with open(self.log, "wb") as out:
            self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=out, stderr=subprocess.STDOUT, text=True,
                                            env={**{k: v for k, v in os.environ.items() if k != "CYCLONEDDS_URI"}, **(environment or {})})
        Process.all.append(self)

    count = 0
    all = []

    def text(self):
        with open(self.log, encoding="utf-8", errors="replace") as file:
            return file.read()

    def lines(self, pattern):
        return [match for line in self.text().splitlines() if (match := re.search(pattern, line))]

    def wait_for(self, pattern, text, patience=PATIENCE):
        end = time.monotonic() + patience
        while time.monotonic() < end:
            if found := self.lines(pattern):
                print("ok:", text, flush=True)
                return found[-1]
            time.sleep(0.02)
        raise AssertionError(f"not within {patience} s: {text}\n" + "\n".join(self.text().splitlines()[-15:]))

    def say(self, line):
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()

    def end(self, how=signal.SIGTERM):
        if self.process.poll() is None:
            self.process.send_signal(how)
        try:
            self.process.communicate(timeout=20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.communicate()
        return self.process.returncode


class Peer(Process):
    """secure_peer with an identity; None = without security."""

    def __init__(self, plant, identity, *roles, environment=None):
        super().__init__(plant.folder, program("secure_peer"), plant.domain, plant.share, plant.plugins, identity or "-", *roles, environment=environment)
        self.sent = 0

    def command(self, kind, number=0, value=0.0):
        """Sends a command; returns its number."""
        self.sent += 1
        self.say(f"{self.sent} {kind} {number} {value}")
        return self.sent

    def answered(self, seq, state, text):
        return self.wait_for(rf"^answer \S+ {seq} state {state} ", text)

    def statuses(self):
        """(scan, feed override, time in ms, writer) of each status that has come."""
        return [(int(m[1]), float(m[2]), float(m[3]), m[4]) for m in self.lines(r"^status scan (\d+) feed ([\d.]+) t ([\d.]+) writer (\w+)")]

    def leave(self):
        self.process.stdin.close()
        self.process.stdin = None
        self.process.wait(timeout=20)
        return self.process.returncode


class Plant:
    def __init__(self, folder, plugins):
        self.folder, self.plugins = folder, plugins
        self.share = f"secured-{os.getpid()}"
        self.domain = str(1 + os.getpid() % 100)
        self.keys = os.path.join(folder, "keys")
        with open(os.path.join(folder, "machine.toml"), "w", encoding="ascii") as file:
            file.write(MACHINE)

    def make(self, *arguments, keys=None):
        done = subprocess.run([program("nc-keys"), "--folder", keys or self.keys, *arguments], capture_output=True, text=True)
        check(done.returncode == 0, f"nc-keys {' '.join(arguments)} {done.stderr.strip()}")

    def identity(self, name, keys=None):
        return os.path.join(keys or self.keys, "identities", name)

    def control(self):
        return Process(self.folder, program("ncrtd"), "--config", os.path.join(self.folder, "machine.toml"), "serve", "--share", self.share, "--commands")

    def gateway(self, identity, *options, environment=None):
        return Process(self.folder, program("ncdds"), "--share", self.share, "--domain", self.domain, "--commands", "--security", identity, *options,
                       environment=environment)


def hears_nothing(peer, text):
    time.sleep(SILENCE)
    check(not peer.statuses(), text)


def feed_override(viewer):
    """The feed override that a viewer sees in a status that comes now."""
    before = len(viewer.statuses())
    end = time.monotonic() + PATIENCE
    while len(viewer.statuses()) <= before + 1:
        check_time(end, "no status comes any more")
        time.sleep(0.02)
    return viewer.statuses()[-1][1]


def check_time(end, text):
    if time.monotonic() > end:
        raise AssertionError(text)


def allowed(plant):
    """Who has the rights sees and commands; what a command does is in the status."""
    viewer = Peer(plant, plant.identity("viewer"), "read")
    viewer.wait_for("^status scan", "a viewer sees the status")
    operator = Peer(plant, plant.identity("operator"), "read", "command")
    operator.wait_for("^heard by 1", "the gateway hears the operator")
    operator.answered(operator.command(TAKE_CONTROL), DONE, "the operator takes control")
    operator.answered(operator.command(FEED_OVERRIDE, value=0.5), DONE, "the operator sets the feed override")
    check(feed_override(viewer) == 0.5, "and the viewer sees it")
    return viewer, operator


def not_allowed(plant, viewer):
    """Who may see and not command, who is of another authority, who has no security at all."""
    curious = Peer(plant, plant.identity("viewer"), "read", "command")
    curious.wait_for("^refused nc_Command Not Allowed By Security", "a viewer's own DDS refuses the writer of commands")
    for right in ("setup", "maintain"):
        other = Peer(plant, plant.identity(right), "command")
        other.wait_for("^refused nc_Command Not Allowed By Security", f"neither does the right {right} command by this topic")
        check(other.leave() == 0, "the peer ends in order")
    foreign_keys = os.path.join(plant.folder, "foreign")
    plant.make("init", "--name", "nc", keys=foreign_keys)
    plant.make("identity", "operator", "--right", "operate", keys=foreign_keys)
    strangers = {"of another authority": Peer(plant, plant.identity("operator", foreign_keys), "read", "command"),
                 "without security": Peer(plant, None, "read", "command")}
    for who, stranger in strangers.items():
        stranger.wait_for("^made nc_Command$", f"somebody {who} makes a writer of commands")
        stranger.command(TAKE_CONTROL)
        stranger.command(FEED_OVERRIDE, value=0.1)
    time.sleep(SILENCE)
    for who, stranger in strangers.items():
        check(not stranger.statuses(), f"somebody {who} sees no status")
        check(not stranger.lines("^answer") and not stranger.lines("^heard by [1-9]"), f"somebody {who} is not heard and gets no answer")
    check(feed_override(viewer) == 0.5, "and the feed override is as it was")
    for peer in (curious, *strangers.values()):
        check(peer.leave() == 0, "the peer ends in order")


def main():
    for name in ("ncrtd", "ncdds", "ncmon", "nc-keys", "secure_peer"):
        if not os.path.exists(program(name)):
            print(f"skipped: {name} is not built")
            return SKIPPED
    if "thread" in os.environ.get("NC_SANITIZE", ""):
        print("skipped: Cyclone DDS is not built for the thread sanitizer")
        return SKIPPED
    plugins = glob.glob("/usr/lib/*/libddsc0debian/libdds_security_auth.so")
    if not plugins:
        print("skipped: the plug-ins of DDS Security are not here (Debian: libddsc0debian)")
        return SKIPPED
    if subprocess.run(["sh", "-c", "command -v openssl"], capture_output=True).returncode != 0:
        print("skipped: openssl is not here")
        return SKIPPED
    with tempfile.TemporaryDirectory() as folder:
        plant = Plant(folder, os.path.dirname(plugins[0]))
        try:
            plant.make("init")
            plant.make("identity", "gateway", "--gateway")
            for name, right in (("viewer", "view"), ("operator", "operate"), ("setup", "setup"), ("maintain", "maintain")):
                plant.make("identity", name, "--right", right)
            plant.control()
            gateway = plant.gateway(plant.identity("gateway"))
            gateway.wait_for("publishes .*takes commands", "the secured gateway publishes and takes commands")
            viewer, _ = allowed(plant)
            not_allowed(plant, viewer)
        except AssertionError as error:
            print("FAILED:", error)
            for process in Process.all:
                print(process.log, *process.text().splitlines()[-8:], sep="\n  ")
            return 1
        finally:
            for process in Process.all:
                process.end()
    return 0


if __name__ == "__main__":
    sys.exit(main())
