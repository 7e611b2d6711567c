#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""ncrtd, a secured ncdds and peers in C (secure_peer.c) with Debian's plug-ins of DDS Security: who may see and command, and who may not.

Exit status 77 = skipped: the programs are not built, or the plug-ins or openssl are not there.
"""
import json
import os
import re
import signal
import socket
import subprocess
import sys
import threading
import time

from dds_environment import PATIENCE, check, until
from secured_plant import SILENCE, Peer, check_time, in_time, program, run

TAKE_CONTROL, FEED_OVERRIDE, WRITE_DEVICE = 0, 6, 15  # CommandKind
DONE, REJECTED = 1, 2  # AckState
PROGRAMS = ("ncrtd", "ncdds", "ncmon", "nc-keys", "secure_peer")


def feed_override(viewer):
    """The feed override that a viewer sees in a status that comes now."""
    before = len(viewer.statuses())
    end = time.monotonic() + PATIENCE
    while len(viewer.statuses()) <= before + 1:
        check_time(end, "no status comes any more")
        time.sleep(0.02)
    return viewer.statuses()[-1][1]


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
    """Who may see and not command, who is of another authority, who has no security at all, and who has signed his permissions himself."""
    curious = Peer(plant, plant.identity("viewer"), "read", "command")
    curious.wait_for("^refused nc_Command Not Allowed By Security", "a viewer's own DDS refuses the writer of commands")
    curious.wait_for("^refused nc_CommandAck Not Allowed By Security", "and the reader of their answers")
    for right in ("setup", "maintain"):
        other = Peer(plant, plant.identity(right), "command")
        other.wait_for("^refused nc_Command Not Allowed By Security", f"neither does the right {right} command by this topic")
        other.leave()
    foreign_keys = os.path.join(plant.folder, "foreign")
    plant.make("init", "--name", "nc", keys=foreign_keys)
    plant.make("identity", "operator", "--right", "operate", keys=foreign_keys)
    peers = {"of another authority": Peer(plant, plant.identity("operator", foreign_keys), "read", "command"),
             "without security": Peer(plant, None, "read", "command"),
             "who is revoked": Peer(plant, plant.identity("revoked"), "read", "command"),
             "expired, whose clock is behind,": Peer(plant, plant.identity("expired"), "read", "command", clock_behind=150),
             "with permissions that he has signed himself": Peer(plant, forged(plant), "read", "command", trusting=True),
             "who may only view, and whose DDS does not obey,": Peer(plant, plant.identity("viewer"), "read", "command", hostile=True)}
    for who, peer in peers.items():
        peer.wait_for("^made nc_Command$", f"somebody {who} makes a writer of commands")
        peer.command(TAKE_CONTROL)
        peer.command(FEED_OVERRIDE, value=0.1)
    time.sleep(SILENCE)
    for who, peer in peers.items():
        check(bool(peer.statuses()) == ("may only view" in who), f"somebody {who} sees {'the' if peer.statuses() else 'no'} status")
        check(not peer.lines("^answer") and not peer.lines("^heard by [1-9]"), f"somebody {who} is not heard and gets no answer")
    check(feed_override(viewer) == 0.5, "and the feed override is as it was")
    for peer in (curious, *peers.values()):
        peer.end()


def forged(plant):
    """The folder of a viewer who has written himself the permissions of an operator, and signed them with his own key."""
    home = os.path.join(plant.folder, "forged")
    subprocess.run(["cp", "-r", plant.identity("viewer"), home], check=True)
    text = os.path.join(plant.folder, "permissions.xml")
    documents = []
    for name in ("operator", "viewer"):
        with open(os.path.join(plant.identity(name), "permissions.p7s"), encoding="utf-8") as file:
            documents.append(re.search(r"<\?xml.*?</dds>", file.read(), re.DOTALL)[0])
    subject = r"<subject_name>.*?</subject_name>"
    xml = re.sub(subject, re.search(subject, documents[1])[0], documents[0])
    with open(text, "w", encoding="utf-8") as file:
        file.write(xml)
    subprocess.run(["openssl", "smime", "-sign", "-text", "-in", text, "-out", os.path.join(home, "permissions.p7s"),
                    "-signer", os.path.join(home, "identity.pem"), "-inkey", os.path.join(home, "key.pem")], check=True)
    return home


def fewer_rights(plant, viewer):
    """Who has fewer rights now, and has kept the permissions that he had."""
    plant.make("identity", "less", "--right", "operate")
    home, kept = plant.identity("less"), os.path.join(plant.folder, "kept.p7s")
    subprocess.run(["cp", os.path.join(home, "permissions.p7s"), kept], check=True)
    plant.make("identity", "less", "--right", "view", "--force")
    subprocess.run(["cp", kept, os.path.join(home, "permissions.p7s")], check=True)
    peers = {"": Peer(plant, home, "read", "command"), ", whose DDS does not obey,": Peer(plant, home, "read", "command", hostile=True)}
    for who, peer in peers.items():
        peer.wait_for("^made nc_Command$|^refused participant", f"who has kept the permissions that he had{who} begins")
        if peer.lines("^made nc_Command$"):  # who is refused ends by himself
            peer.command(TAKE_CONTROL)
            peer.command(FEED_OVERRIDE, value=0.1)
    time.sleep(SILENCE)
    for who, peer in peers.items():
        check(not peer.lines("^answer") and not peer.lines("^heard by [1-9]"), f"he is not heard{who}")
        peer.end()
    check(feed_override(viewer) == 0.5, "and the feed override is as it was")


def operate_only(operator):
    """By nc_Command nobody does what needs the right to maintain."""
    answer = operator.answered(operator.command(WRITE_DEVICE, value=1.0), REJECTED, "an operator does not write devices of the ladder")
    check("nc_ServiceMaintain" in answer.string, "and is told where that is done")


def longest_gap(viewer, since_ms):
    """Longest time in ms between two statuses of a viewer, from a moment on."""
    times = [t for _, _, t, _ in viewer.statuses() if t >= since_ms]
    return max(b - a for a, b in zip(times, times[1:]))


def renewal(plant, viewer, operator, gateway):
    """The gateway gets a new certificate while the status is read and commands come: nothing is missed, answered twice or lost."""
    for round_ in (1, 2):
        since = viewer.statuses()[-1][2]
        writers = {writer for *_, writer in viewer.statuses()}
        used = len(gateway.lines("the new identity is in use"))
        plant.make("renew", "gateway", "--days", "2")
        first = operator.sent + 1
        end = time.monotonic() + PATIENCE
        while len(gateway.lines("the new identity is in use")) == used:
            operator.command(FEED_OVERRIDE, value=0.5)
            check_time(end, "the new identity is not taken\n" + gateway.text())
            time.sleep(0.01)
        for _ in range(50):
            operator.command(FEED_OVERRIDE, value=0.5)
            time.sleep(0.01)
        operator.answered(operator.sent, DONE, f"renewal {round_}: the operator commands and has control all the time")
        answers = [int(m[1]) for m in operator.lines(r"^answer \S+ (\d+) state 1 reason 0 repeated 0 ")]
        sent = list(range(first, operator.sent + 1))
        check([n for n in answers if n >= first] == sent, f"each of {len(sent)} commands has one answer, in their order")
        check({writer for *_, writer in viewer.statuses()} > writers, "the status has a new writer")
        gap = longest_gap(viewer, since)
        check(gap < 1000, f"the viewer has a status at least each second; the longest gap was {gap:.0f} ms")
    check(not operator.lines("repeated 1"), "no command came twice")


def outlives(plant, viewer, operator, gateway):
    """The end of a certificate that was renewed in time is nothing that anybody notices."""
    used = len(gateway.lines("the new identity is in use"))
    end = time.time() + 12
    plant.make("renew", "gateway", "--until", in_time(12))
    until(lambda: len(gateway.lines("the new identity is in use")) > used, "the gateway has a certificate for some seconds")
    plant.make("renew", "gateway", "--days", "2")
    until(lambda: len(gateway.lines("the new identity is in use")) > used + 1, "and then one for two days")
    time.sleep(max(0.0, end + 2 - time.time()))
    before = viewer.statuses()[-1]
    time.sleep(1)
    gap = longest_gap(viewer, before[2] - 5000)
    check(gap < 1000, f"when the one for seconds has ended the status comes as before; the longest gap was {gap:.0f} ms")
    operator.answered(operator.command(FEED_OVERRIDE, value=0.5), DONE, "and the operator has control as before")


def silent_client(plant, gateway):
    """A client that has control and leaves after a renewal, without a command since: its control ends with it."""
    quiet = Peer(plant, plant.identity("operator"), "command")
    quiet.wait_for("^heard by 1", "the gateway hears another client")
    quiet.answered(quiet.command(TAKE_CONTROL), DONE, "it takes control for 30 s")
    used = len(gateway.lines("the new identity is in use"))
    plant.make("renew", "gateway", "--days", "3")
    until(lambda: len(gateway.lines("the new identity is in use")) > used, "the gateway has a new certificate")
    quiet.leave()
    after = Peer(plant, plant.identity("operator"), "command")
    after.wait_for("^heard by 1", "the gateway hears the next one")
    end = time.monotonic() + 15
    while not (done := after.lines("^answer .* has control$")) or "state 1" not in done[-1].string:
        check_time(end, "control is still with a client that is gone")
        after.command(TAKE_CONTROL)
        time.sleep(0.3)
    print("ok: and has control, long before the lease of the other one ends")
    after.leave()


def revoked_live(plant, viewer):
    """A viewer whose certificate is revoked while he looks."""
    guest = Peer(plant, plant.identity("guest"), "read")
    guest.wait_for("^status scan", "a guest sees the status")
    plant.make("revoke", "guest")

    def silent():
        before = len(guest.statuses())
        time.sleep(1.0)
        return len(guest.statuses()) == before

    until(silent, "he sees none any more when he is revoked")
    check(longest_gap(viewer, guest.statuses()[-1][2] - 2000) < 1000, "and the others see it as before")


def ends_while_he_looks(plant):
    """A viewer whose certificate ends."""
    plant.make("identity", "short", "--right", "view", "--until", in_time(8))
    short = Peer(plant, plant.identity("short"), "read")
    short.wait_for("^status scan", "a viewer with a short time sees the status")
    time.sleep(9)
    before = len(short.statuses())
    time.sleep(1.5)
    check(len(short.statuses()) == before, "and none any more after it")


def damaged(plant, viewer, gateway):
    """Files that cannot be used change nothing."""
    path = os.path.join(plant.identity("gateway"), "identity.pem")
    with open(path, encoding="ascii") as file:
        whole = file.read()
    for text, said in ((whole[:100], "is no certificate; goes on with the identity that it has"),
                       (open(os.path.join(plant.identity("viewer"), "identity.pem"), encoding="ascii").read(), "key.pem: is not the key of identity.pem")):
        with open(path + ".new", "w", encoding="ascii") as file:
            file.write(text)
        os.replace(path + ".new", path)
        gateway.process.send_signal(signal.SIGHUP)
        gateway.wait_for(said, f"a damaged certificate is named: {said}")
    check(feed_override(viewer) == 0.5, "and the status comes as before")
    with open(path + ".new", "w", encoding="ascii") as file:
        file.write(whole)
    os.replace(path + ".new", path)


def expired_gateway(plant, viewer, operator, gateway, control):
    """The certificate of the gateway ends: it says so and is silent, the control goes on, and the next certificate brings all of it back."""
    plant.make("renew", "gateway", "--until", in_time(7))
    gateway.wait_for(r"the identity of CN=gateway \(.*\) has expired at .*; publishes nothing until", "the gateway says that its certificate has ended")
    time.sleep(0.5)
    before = viewer.statuses()
    time.sleep(2)
    check(len(viewer.statuses()) == len(before), "and is silent")
    check(control.process.poll() is None and gateway.process.poll() is None, "the control and the gateway live")
    plant.make("renew", "gateway", "--days", "1")
    until(lambda: len(viewer.statuses()) > len(before), "with the next certificate the status comes again")
    scan = viewer.statuses()[-1][0]
    check(scan - before[-1][0] > 1000, f"the control has gone on, {scan - before[-1][0]} scans")
    until(lambda: operator.lines("^heard by")[-1].string == "heard by 1", "the operator is heard again")
    operator.answered(operator.command(TAKE_CONTROL), DONE, "and has control again")


def systemd(path):
    """Listens as systemd does; returns the list of what it is told, which grows."""
    told, listener = [], socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
    listener.bind(path)

    def listen():
        while True:
            told.append(listener.recv(4096).decode())

    threading.Thread(target=listen, daemon=True).start()
    return told


def states(told):
    """What systemctl status has shown: until when the identity is valid, and why nothing was published."""
    check(any(re.fullmatch(r"STATUS=the identity of CN=gateway is valid until \S+Z", text) for text in told), "systemd has been told until when the identity is valid")
    check(any("has expired at" in text for text in told) and "valid until" in told[-1], f"that it had expired, and that it is valid again: {told[-3:]}")


def monitor(plant):
    def run(*options):
        return subprocess.run([program("ncmon"), "--domain", plant.domain, "--once", "--wait", "90" if options else "4", *options], capture_output=True, text=True)

    shown = run("--security", plant.identity("viewer"))
    check(shown.returncode == 0 and "part system 1" in shown.stdout, f"ncmon with an identity shows the control {shown.returncode} {shown.stderr.strip()[:300]}")
    check(run().returncode == 2, "without one it hears nobody")
    for options, text in ((("--security", plant.folder), "identity-ca.pem: No such file"), (("--security", plant.identity("expired")), "has expired at"),
                          (("--network", "lo"), "--network needs --security")):
        done = run(*options)
        check(done.returncode == 1 and text in done.stderr, f"ncmon {options[0]}: {done.stderr.strip()}")


class Screen:
    """ncmon that prints a line of JSON for each status."""

    def __init__(self, plant, identity):
        self.process = subprocess.Popen([program("ncmon"), "--domain", plant.domain, "--security", identity, "--json", "--view", "signals", "--wait", "20"],
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env={k: v for k, v in os.environ.items() if k != "CYCLONEDDS_URI"})
        self.views = []  # (time in s, alive, are there signals) of each line
        self.said = []
        for read in (self._read_views, self._read_said):
            threading.Thread(target=read, daemon=True).start()

    def _read_views(self):
        for line in self.process.stdout:
            view = json.loads(line)
            self.views.append((time.time(), view["alive"], bool(view.get("signals"))))

    def _read_said(self):
        for line in self.process.stderr:
            self.said.append(line.rstrip())

    def says(self, pattern, text):
        until(lambda: any(re.search(pattern, line) for line in self.said), text)

    def shows(self, text, since):
        """A status with signals comes after a moment."""
        until(lambda: any(t > since and alive and signals for t, alive, signals in self.views[-5:]), text)


def screen(plant):
    """A screen lives through the renewal of its own identity, and through the end of it."""
    plant.make("identity", "screen", "--right", "view", "--until", in_time(14))
    first_end = time.time() + 14
    panel = Screen(plant, plant.identity("screen"))
    panel.shows("a screen shows status and signals", 0)
    since = time.time()
    plant.make("renew", "screen", "--days", "1")
    panel.says("^ncmon: the new identity is in use$", "it takes its new identity by itself")
    time.sleep(max(0.0, first_end + 1 - time.time()))
    panel.shows("and shows status and signals when the first one has ended", first_end)
    times = [t for t, *_ in panel.views if t > since]
    gap = max(b - a for a, b in zip(times, times[1:]))
    check(gap < 1 and all(alive for _, alive, _ in panel.views), f"the longest time without a status was {1000 * gap:.0f} ms")
    plant.make("renew", "screen", "--until", in_time(7))
    panel.says("has expired at .*; shows nothing until", "when its identity has ended it says so")
    until(lambda: not panel.views[-1][1], "and that the status is not alive")
    plant.make("renew", "screen", "--days", "1")
    panel.shows("with the next identity it shows status and signals again", time.time())
    panel.process.terminate()
    check(panel.process.wait(timeout=20) == 143, "and ends in order")


def refused(plant):
    """What ncdds does not begin with."""
    network = "<CycloneDDS><Domain id='any'><General><Interfaces><NetworkInterface name='lo'/></Interfaces></General></Domain></CycloneDDS>"
    readable = os.path.join(plant.folder, "readable")
    subprocess.run(["cp", "-r", plant.identity("gateway"), readable], check=True)
    os.chmod(os.path.join(readable, "key.pem"), 0o644)
    for options, uri, text in (((), network, "--commands with the network of CYCLONEDDS_URI needs --security"),
                               (("--network", "lo"), "", "--network needs --security"),
                               (("--network", "lo", "--security", plant.identity("gateway")), network, "both say which network"),
                               (("--security", readable), "", "every user of this computer may read this key"),
                               (("--security", plant.identity("viewer")), "", "writer of nc_MachineInfo: Not Allowed By Security"),
                               (("--security", plant.identity("revoked")), "", "the certificate of CN=revoked is revoked")):
        done = subprocess.run([program("ncdds"), "--share", plant.share, "--domain", plant.domain, "--commands", *options], capture_output=True, text=True,
                              env={**os.environ, "CYCLONEDDS_URI": uri}, timeout=20)
        check(done.returncode == 1 and text in done.stderr, f"ncdds does not begin: {text}")


def secured(plant):
    plant.make("init")
    plant.make("identity", "gateway", "--gateway")
    for name, right in (("viewer", "view"), ("operator", "operate"), ("setup", "setup"), ("maintain", "maintain"), ("revoked", "operate"), ("guest", "view")):
        plant.make("identity", name, "--right", right)
    plant.make("identity", "expired", "--right", "operate", "--until", in_time(2))
    plant.make("revoke", "revoked")
    refused(plant)
    control = plant.control()
    told = systemd(os.path.join(plant.folder, "notify"))
    gateway = plant.gateway(plant.identity("gateway"), environment={"NOTIFY_SOCKET": os.path.join(plant.folder, "notify")})
    gateway.wait_for("publishes .*takes commands", "the secured gateway publishes and takes commands")
    viewer, operator = allowed(plant)
    operate_only(operator)
    not_allowed(plant, viewer)
    fewer_rights(plant, viewer)
    monitor(plant)
    renewal(plant, viewer, operator, gateway)
    outlives(plant, viewer, operator, gateway)
    damaged(plant, viewer, gateway)
    revoked_live(plant, viewer)
    ends_while_he_looks(plant)
    screen(plant)
    expired_gateway(plant, viewer, operator, gateway, control)
    states(told)
    operator.leave()
    silent_client(plant, gateway)
    check(viewer.leave() == 0 and gateway.end() == 0, "a peer and the gateway end in order")


if __name__ == "__main__":
    sys.exit(run(secured, PROGRAMS))
