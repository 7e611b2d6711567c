#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Without CYCLONEDDS_URI ncdds and ncmon are reached from this computer's loopback address and from nowhere else: every socket of
the network that they have is bound to 127.0.0.1, and another address of this computer answers that nobody is there. The same where an
HMI in Python has started them, which leaves the text of nc_dds.py in their environment."""
import ast
import glob
import os
import re
import socket
import struct
import subprocess
import sys
import tempfile
import time

build = os.environ["NC_BINARY_DIR"]
PATIENCE = 30.0  # s; only a failure takes so long
DOMAIN = str(101 + os.getpid() % 80)
failures = []


def check(condition, text):
    print("ok:" if condition else "FAILED:", text, flush=True)
    if not condition:
        failures.append(text)


def sockets(pid):
    """(protocol, address, port) of each bound socket of the network that a process has, from /proc."""
    inodes = set()
    for fd in os.listdir(f"/proc/{pid}/fd"):
        try:
            match = re.fullmatch(r"socket:\[(\d+)\]", os.readlink(f"/proc/{pid}/fd/{fd}"))
        except FileNotFoundError:  # closed since
            continue
        if match:
            inodes.add(match[1])
    found = []
    for protocol in ("udp", "udp6", "tcp", "tcp6", "raw", "raw6"):
        try:
            lines = open(f"/proc/{pid}/net/{protocol}", encoding="ascii").read().splitlines()[1:]
        except FileNotFoundError:  # no IPv6 here
            continue
        for line in lines:
            field = line.split()
            if field[9] not in inodes:
                continue
            address, port = field[1].split(":")
            if not protocol.endswith("6"):
                address = socket.inet_ntoa(struct.pack("=I", int(address, 16)))
            found.append((protocol, address, int(port, 16)))
    return found


def bound(pid):
    """Sockets of a program that has come up: those that receive, and the one that sends."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        found = [one for one in sockets(pid) if one[2] != 0]
        if len(found) >= 3:
            return found
        time.sleep(0.05)
    return []


def other_address():
    """An address of this computer that is not the loopback's; None = there is none."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("192.0.2.1", 9))  # nothing is sent: the route decides
            own = probe.getsockname()[0]
        except OSError:
            return None
    return None if own.startswith("127.") else own


def reached(address, port):
    """Whether a datagram reaches a socket; otherwise the kernel answers that the port does not exist."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as client:
        client.connect((address, port))
        client.settimeout(1)
        try:
            client.send(b"hello")
            client.recv(1)
        except ConnectionRefusedError:
            return False
        except TimeoutError:
            return True
    return True


def text_of_python():
    """What nc_dds.py puts into CYCLONEDDS_URI; read, not imported, because the binding need not be there."""
    with open(os.path.join(os.environ["NC_SOURCE_DIR"], "dds/nc_dds.py"), encoding="utf-8") as source:
        for node in ast.parse(source.read()).body:
            if isinstance(node, ast.Assign) and node.targets[0].id == "LOOPBACK":
                return ast.literal_eval(node.value)
    raise LookupError("LOOPBACK")


def run(command, environment):
    return subprocess.Popen([os.path.join(build, "bin", command[0]), *command[1:]], env=environment,
                            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def secured():
    """Options of an ncdds with DDS Security on this computer, and the folder that has its keys; None where there are no keys or plug-ins."""
    folder = tempfile.TemporaryDirectory()
    keys = [os.path.join(build, "bin", "nc-keys"), "--folder", os.path.join(folder.name, "keys")]
    for arguments in (["init"], ["identity", "gateway", "--gateway"]):
        try:
            done = subprocess.run([*keys, *arguments], capture_output=True)
        except FileNotFoundError:
            return None, folder
        if done.returncode != 0:
            return None, folder
    if not glob.glob("/usr/lib/*/libddsc0debian/libdds_security_auth.so"):
        return None, folder
    return ["--security", os.path.join(folder.name, "keys", "identities", "gateway")], folder


def main():
    for program in ("ncdds", "ncmon"):
        if not os.path.exists(os.path.join(build, "bin", program)):
            print("skipped:", program, "is not built")
            return 77
    if "thread" in os.environ.get("NC_SANITIZE", ""):
        print("skipped: Cyclone DDS is not built for the thread sanitizer")
        return 77
    bare = {key: value for key, value in os.environ.items() if key != "CYCLONEDDS_URI"}
    own = other_address()
    security, keys = secured()
    if security is None:
        print("no keys or no plug-ins of DDS Security: not tried with them")
    programs = [["ncdds", "--share", f"nobody-{os.getpid()}", "--domain", DOMAIN, "--commands"],
                ["ncmon", "--json", "--wait", "600", "--domain", DOMAIN]]
    if security is not None:
        programs.append([*programs[0], *security])
    for environment in (bare, {**bare, "CYCLONEDDS_URI": ""}, {**bare, "CYCLONEDDS_URI": text_of_python()}):
        for command in programs:
            child = run(command, environment)
            try:
                found = bound(child.pid)
                check(len(found) >= 3, f"{command[0]} has its sockets")
                strange = [one for one in found if one[1] != "127.0.0.1"]
                check(not strange, f"{command[0]}: all of them are on 127.0.0.1" + (f", but {strange}" if strange else ""))
                if own is None:
                    print("this computer has no other address: not tried")
                for protocol, _, port in found if own else []:
                    check(protocol != "udp" or not reached(own, port), f"{command[0]}: {own}:{port} is nobody's")
            finally:
                child.terminate()
                child.wait()
    # With a configured network the programs use it.
    with tempfile.NamedTemporaryFile("w", suffix=".xml") as file:
        file.write('<CycloneDDS><Domain id="any"><General><Interfaces><NetworkInterface name="lo" multicast="false"/></Interfaces>'
                   "<AllowMulticast>false</AllowMulticast></General>"
                   "<Discovery><ParticipantIndex>auto</ParticipantIndex></Discovery></Domain></CycloneDDS>")
        file.flush()
        child = run(["ncdds", "--share", f"nobody-{os.getpid()}", "--domain", DOMAIN], {**bare, "CYCLONEDDS_URI": "file://" + file.name})
        try:
            check(any(one[1] == "0.0.0.0" for one in bound(child.pid)), "with CYCLONEDDS_URI its configuration alone decides")
        finally:
            child.terminate()
            child.wait()
    keys.cleanup()
    return 1 if failures else 0


sys.exit(main())
