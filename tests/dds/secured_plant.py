# SPDX-License-Identifier: Apache-2.0
"""ncrtd, a secured ncdds and peers in C (secure_peer.c) with Debian's plug-ins of DDS Security, as the tests of a secured domain have them.

run() does what the main part of each of these tests is. Exit status 77 = skipped: the programs are not built, or the plug-ins or openssl are not there.
"""
import glob
import os
import re
import signal
import subprocess
import tempfile
import time

from dds_environment import PATIENCE, SKIPPED, build, check, machine_text

SILENCE = 4.0  # s in which nothing may come to somebody who may not have it; an allowed peer has it within 1 s


def program(name):
    return os.path.join(build, "bin", name)


def library(name):
    return os.path.join(build, "tests", f"lib{name}.so")


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

    def last(self, count):
        """The last lines without those that come all the time."""
        return [line for line in self.text().splitlines() if not re.match("status scan|[0-9.]+ .* fsm: ", line)][-count:]

    def lines(self, pattern):
        return [match for line in self.text().splitlines() if (match := re.search(pattern, line))]

    def wait_for(self, pattern, text, patience=PATIENCE):
        end = time.monotonic() + patience
        while time.monotonic() < end:
            if found := self.lines(pattern):
                print("ok:", text, flush=True)
                return found[-1]
            time.sleep(0.02)
        raise AssertionError(f"not within {patience} s: {text}\n" + "\n".join(self.last(15)))

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

    def __init__(self, plant, identity, *roles, hostile=False, trusting=False, clock_behind=0):
        environment = {"SECURE_PEER_AC": os.path.join(plant.plugins, "libdds_security_ac.so")}
        if trusting or clock_behind:
            environment["LD_PRELOAD"] = library("trusting")
            environment["SECURE_PEER_TRUSTS"] = str(int(trusting))
            environment["SECURE_PEER_BEHIND"] = str(clock_behind)
        super().__init__(plant.folder, program("secure_peer"), plant.domain, plant.share, plant.hostile if hostile or trusting else plant.plugins,
                         identity or "-", *roles, environment=environment)
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
        self.hostile = os.path.join(folder, "hostile")
        os.mkdir(self.hostile)
        for name in ("auth", "crypto"):
            os.symlink(os.path.join(plugins, f"libdds_security_{name}.so"), os.path.join(self.hostile, f"libdds_security_{name}.so"))
        os.symlink(library("hostile_ac"), os.path.join(self.hostile, "libdds_security_ac.so"))
        with open(os.path.join(folder, "machine.toml"), "w", encoding="ascii") as file:
            file.write(machine_text("Secured"))

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


def in_time(seconds):
    """For nc-keys --until."""
    return time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(time.time() + seconds))


def check_time(end, text):
    if time.monotonic() > end:
        raise AssertionError(text)


def plugins_or_reason(programs):
    """The folder of the plug-ins and why not: what these programs and the test need."""
    for name in programs:
        if not os.path.exists(program(name)):
            return None, f"{name} is not built"
    if "thread" in os.environ.get("NC_SANITIZE", ""):
        return None, "Cyclone DDS is not built for the thread sanitizer"
    plugins = glob.glob("/usr/lib/*/libddsc0debian/libdds_security_auth.so")
    if not plugins:
        return None, "the plug-ins of DDS Security are not here (Debian: libddsc0debian)"
    if subprocess.run(["sh", "-c", "command -v openssl"], capture_output=True).returncode != 0:
        return None, "openssl is not here"
    return os.path.dirname(plugins[0]), ""


def run(test, programs, kind=None):
    """Runs a test with a plant (of this kind), whose processes it ends; the exit status. A failure shows the last lines of each process."""
    plugins, reason = plugins_or_reason(programs)
    if not plugins:
        print("skipped:", reason)
        return SKIPPED
    with tempfile.TemporaryDirectory() as folder:
        try:
            test((kind or Plant)(folder, plugins))
        except AssertionError as error:
            print("FAILED:", error)
            for process in Process.all:
                print(process.log, *process.last(12), sep="\n  ")
            return 1
        finally:
            for process in Process.all:
                process.end()
    return 0
