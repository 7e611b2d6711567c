#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The services over a secured DDS: who may use the topic of which right, in whose name, and what a renewal of the gateway's keys leaves as it was.

Peers are secure_peer.c with Debian's plug-ins of DDS Security. Exit status 77 = skipped: see secured_plant.py.
"""
import base64
import hashlib
import json
import os
import re
import subprocess
import sys
import time

from dds_environment import PATIENCE, check, machine_text, services_text, until
from secured_plant import SILENCE, Peer, Plant, Process, check_time, in_time, program, run

LADDER = "LD nc.m_strobe\nOUT plc.fin2\nLD M100\nOUT M101\nEND\n"
TOPICS = ["nc_ServiceView", "nc_ServiceOperate", "nc_ServiceSetUp", "nc_ServiceMaintain"]
PROGRAMS = ("ncrtd", "ncdds", "ncctl", "nc-keys", "secure_peer")
RIGHTS = ["view", "operate", "setup", "maintain"]
DONE, REFUSED, UPDATE = 0, 1, 2  # ServiceStatus
# A request that needs the right of each topic, and does something.
REQUESTS = [("status", {}), ("control.take", {"lease_ms": 100}), ("tools.set", {"number": 1, "length": 12.5}), ("ladder.write", {"device": "M100", "value": 1})]


class Client(Peer):
    """secure_peer as a client of the services."""

    def __init__(self, plant, identity, name, **how):
        super().__init__(plant, identity, f"service={name}", **how)
        self.asked = 0
        self._read, self._body, self._replies = 0, "", {0: []}

    def heard(self, topic, text):
        self.wait_for(f"^{topic} heard by 1$", text)

    def send(self, topic, service, **arguments):
        self.asked += 1
        self.say(f"{topic} {self.asked} {service} {json.dumps(arguments)}")
        return self.asked

    def replies(self, number):
        """(status, refusal, session, body, time in ms) of each reply to a request, put together from its parts; number 0: the updates."""
        with open(self.log, "rb") as file:
            file.seek(self._read)
            new = file.read()
        whole = new[: new.rfind(b"\n") + 1]
        self._read += len(whole)
        for line in whole.decode().splitlines():
            if m := re.match(r'reply (\d+) status (\d) refusal "(.*?)" session (\d+) part (\d+) last (\d) t ([\d.]+) (.*)$', line):
                self._body = m[8] if m[5] == "1" else self._body + m[8]
                if m[6] == "1":
                    self._replies.setdefault(int(m[1]), []).append((int(m[2]), m[3], int(m[4]), json.loads(self._body), float(m[7])))
        return self._replies.get(number, [])

    def answer(self, number):
        end = time.monotonic() + PATIENCE
        while not (found := self.replies(number)):
            check_time(end, f"request {number} has no answer\n" + "\n".join(self.last(12)))
            time.sleep(0.01)
        return found[0]

    def call(self, topic, service, **arguments):
        """The reply; it must not be a refusal."""
        status, refusal, _, body, _ = self.answer(self.send(topic, service, **arguments))
        if status != DONE:
            raise AssertionError(f"{service}: {refusal}: {body}")
        return body

    def updates(self):
        """(scan, time in ms) of the updates of watch lists."""
        return [(update[3]["scan"], update[4]) for update in self.replies(0)]


class ServicePlant(Plant):
    def __init__(self, folder, plugins):
        super().__init__(folder, plugins)
        self.socket = os.path.join(folder, "control.sock")
        os.mkdir(os.path.join(folder, "programs"))
        with open(os.path.join(folder, "machine.toml"), "w", encoding="ascii") as file:
            file.write(machine_text("Secured", programs="programs", services=services_text(self.socket), more='[share]\ncommands = true\n[ladder]\nprogram = "own.il"\n'))
        with open(os.path.join(folder, "own.il"), "w", encoding="ascii") as file:
            file.write(LADDER)

    def gateway(self, identity, *options, environment=None):
        return super().gateway(identity, "--services", self.socket, *options, environment=environment)


def walk(plant):
    """Each right on each topic: a peer's own DDS refuses the writer exactly where it has not the right; nc_ServiceView is everybody's."""
    for right in RIGHTS:
        client = Client(plant, plant.identity(right), right)
        client.wait_for("^(made|refused) nc_ServiceMaintain", f"a client with the right {right}")
        for topic, name, (service, arguments) in zip(TOPICS, RIGHTS, REQUESTS):
            has = name in ("view", right)
            made = bool(client.lines(f"^made {topic}$"))
            check(made == has and bool(client.lines(f"^refused {topic} Not Allowed By Security")) != has, f"{'makes' if has else 'is refused'} a writer of {topic}")
            if has:
                client.heard(topic, "which the gateway hears")
                refusal = client.answer(client.send(topic, service, **arguments))[1]
                check(refusal in (("no right",) if service == "ladder.write" else ("", "no control")), f"{service} on it: {refusal or 'done'}")
            # On the topic that it has, it cannot do what another right is needed for.
            own = TOPICS[RIGHTS.index(right)]
            status, refusal, *_ = client.answer(client.send(own, service, **arguments))
            enough = has and service != "ladder.write"  # a device can move the machine: that needs the right to operate as well
            check((status, refusal) == (REFUSED, "no right") if not enough else refusal in ("", "no control"), f"{service} on {own}: {refusal or 'done'}")
        check_rights(lambda: client.call("nc_ServiceView", "rights"), right, "the reply of rights")
        check_rights(lambda: client.call("nc_ServiceView", "rights.limit", rights=["view", "operate", "set up", "maintain"]), right, "that of rights.limit")
        client.leave()


# Arguments with which a request is well formed, where a value of its type is not enough.
VALUES = {"number": 1.0, "whole": 1, "flag": True, "text": "X", "name": "none.nc", "data": "AAAA", "list": ["XX"]}
ARGUMENTS = {"mode": {"mode": "auto"}, "programs.begin": {"sha256": 64 * "0"}, "tools.set": {"length": 1}, "life.set": {"used": 1}, "variables.set": {"value": 1},
             "restart.find": {"line": 1}, "tables.import": {"toml": "[tool_offsets]\n1 = 1\n"}, "parameters.import": {"toml": "[parameters]\n1078 = 1\n"}}
ON_ITS_OWN = ("rights.limit", "watch.begin")  # the one takes rights from all that come behind it, the other one sends updates


def walk_services(plant):
    """Each service on each topic that each right has: what the topic's right is not enough for is refused, and the refusal names the right that it takes."""
    refused = 0
    for right in RIGHTS:
        client = Client(plant, plant.identity(right), f"{right}@walks")
        topics = {topic: name for topic, name in zip(TOPICS, RIGHTS) if name in ("view", right)}
        for topic in topics:
            client.heard(topic, f"{right} is heard on {topic}")
        services = [s for s in client.call(TOPICS[0], "services")["services"] if s["name"] not in ON_ITS_OWN]
        for topic, name in topics.items():
            wrong = []
            for service in services:
                arguments = {member["name"]: VALUES[member["type"]] for member in service["request"] if member["required"]}
                _, refusal, _, text, _ = client.answer(client.send(topic, service["name"], **{**arguments, **ARGUMENTS.get(service["name"], {})}))
                rights = {service["right"], service["and_right"] or service["right"]}
                allowed = rights <= {"view", "set up" if name == "setup" else name}
                good = refusal != "no right" if allowed else refusal == "no right" and all(r in text["text"] for r in rights)
                wrong += [] if good else [(service["name"], refusal, text)]
                refused += not allowed
            check(len(services) > 60 and not wrong, f"each of {len(services)} services on {topic} with the right {right} is let or refused as the table says {wrong[:3]}")
        client.leave()
    check(refused > 200, f"{refused} of them are refused")


def check_rights(reply, right, what):
    """Names what the identity may, and nothing that only others may."""
    named = [name.replace(" ", "") for name in reply()["rights"]]
    check(named == [r for r in RIGHTS if r in ("view", right)], f"{what} names {named} to who has {right}")


NO_RIGHT, NOBODY, WRONG_USAGE, FAILED = 3, 6, 1, 5  # exit statuses of ncctl


def ncctl(plant, identity, *words, status=0, patience=60):
    """ncctl over DDS with an identity, None = without security; what it prints."""
    security = ("--security", plant.identity(identity)) if identity else ()
    done = subprocess.run([program("ncctl"), "--domain", plant.domain, "--control", plant.share, *security, *words], capture_output=True, text=True, timeout=patience,
                          env={k: v for k, v in os.environ.items() if k not in ("CYCLONEDDS_URI", "NC_SOCKET")})
    check(done.returncode == status, f"{identity or 'somebody without security'}: ncctl {' '.join(words)}: exit status {done.returncode} {done.stderr.strip()[:150]}")
    return done.stdout if status == 0 else done.stderr


def by_ncctl(plant):
    """The shipped client: status, a signal trace to CSV, and what each identity may not."""
    check("Secured" in ncctl(plant, "view", "machine"), "a viewer sees the machine")
    for right in RIGHTS:
        check_rights(lambda: json.loads(ncctl(plant, right, "--json", "rights")), right, "ncctl rights")  # noqa: B023
    check(json.loads(ncctl(plant, "boss", "--json", "rights"))["rights"] == ["view", "operate", "set up", "maintain"], "and all four to who has all")
    rows = [line.split(",") for line in ncctl(plant, "maintain", "trace", "record", "nc.ready", "M100", "--samples", "3000").splitlines()]
    check(rows[0] == ["scan", "time_s", "nc.ready", "M100"] and len(rows) == 3001, f"a recording of {len(rows) - 1} scans")
    check([int(row[0]) for row in rows[1:]] == list(range(int(rows[1][0]), int(rows[1][0]) + 3000)), "in which no scan is missing")
    out = os.path.join(plant.folder, "saved.csv")
    ncctl(plant, "view", "trace", "save", out)
    with open(out, encoding="ascii") as file:
        check([line.rstrip().split(",") for line in file] == rows, "a viewer reads the same recording afterwards")
    for right in ("view", "operate", "setup"):
        check("do not have the right to maintain" in ncctl(plant, right, "trace", "record", "nc.ready", "--samples", "10", status=NO_RIGHT), "and is told why")
    for words, right in ((("jog", "X", "1", "--for", "0.1"), "operate"), (("start",), "operate"), (("force", "M100", "1"), "maintain and operate")):
        check(f"the right to {right}\n" in ncctl(plant, "view", *words, status=NO_RIGHT), "and is told which right that needs, and not what control needs")
    with open(os.path.join(plant.folder, "next.il"), "w", encoding="ascii") as file:
        file.write("LD SM400\nOUT M77\nEND\n")
    for words in (("ladder", "write", "M100", "1"), ("force", "M100", "1"), ("release", "--device", "M100"), ("ladder", "swap", os.path.join(plant.folder, "next.il"))):
        for right in ("operate", "maintain"):
            check("right to maintain and operate" in ncctl(plant, right, *words, status=NO_RIGHT), f"who has only the right to {right} has not the right to it")
        if words[1] != "swap":
            ncctl(plant, "boss", *words)
    check("right to operate" in ncctl(plant, "maintain", "start", status=NO_RIGHT), "who maintains starts nothing, in control or not")
    ncctl(plant, "setup", "tools", "set", "2", "--length", "7.5")
    check(json.loads(ncctl(plant, "view", "--json", "changes", "--count", "1"))["changes"][0]["user"] == "dds:setup", "what is set stands in the changes in the name of the identity")
    ncctl(plant, "operate", "mode", "auto")
    ncctl(plant, None, "status", status=NOBODY)
    ncctl(plant, "revoked", "status", status=FAILED)
    long = "(" + 200 * "x" + ")\n"
    path = os.path.join(plant.folder, "by-ncctl.nc")
    with open(path, "w", encoding="ascii") as file:
        file.write(3000 * long + "M30\n")
    ncctl(plant, "boss", "programs", "put", path)
    ncctl(plant, "view", "programs", "get", "by-ncctl.nc", out)
    with open(path, "rb") as sent, open(out, "rb") as got:
        check(sent.read() == got.read(), "a program of 600 KB goes there and back")


def hostile(plant, viewer):
    """Whose DDS does not obey is not heard: a viewer on the topics of others, and somebody in the name of another."""
    tool = viewer.call("nc_ServiceView", "tools.list", count=5)
    peers = {"a viewer whose DDS does not obey": Client(plant, plant.identity("view"), "view@hostile", hostile=True),
             "who has another's name, whose DDS does not obey,": Client(plant, plant.identity("setup"), "boss", hostile=True),
             "somebody without security": Client(plant, None, "boss"),
             "who is revoked": Client(plant, plant.identity("revoked"), "revoked")}
    hears = {"a viewer whose DDS does not obey": TOPICS[:1], "who has another's name, whose DDS does not obey,": [TOPICS[0], TOPICS[2]]}
    for who, peer in peers.items():
        peer.wait_for("^made nc_ServiceMaintain|^refused nc_ServiceMaintain", f"{who} is there")
        for topic in hears.get(who, []):
            peer.heard(topic, f"and heard on {topic}")
    for who, peer in peers.items():
        for topic in TOPICS:
            for service, arguments in (("tools.set", {"number": 1, "length": 99.0}), ("control.take", {"lease_ms": 60000}), ("status", {})):
                peer.send(topic, service, **arguments)
    time.sleep(SILENCE)
    for who, peer in peers.items():
        seen = {n for n in range(1, peer.asked + 1) if peer.replies(n)}
        allowed = {3} if "viewer" in who else set()  # status on nc_ServiceView
        done = {n for n in seen if peer.replies(n)[0][0] == DONE}
        check(not peer.lines("|".join(f"^{topic} heard by [1-9]" for topic in TOPICS if topic not in hears.get(who, []))), f"{who} is heard nowhere else")
        check(done == allowed and seen <= {1, 2, 3}, f"{who}: of {peer.asked} requests {len(done)} are done, {len(seen) - len(done)} refused, and the others not heard")
    check(viewer.call("nc_ServiceView", "tools.list", count=5) == tool, "no tool is changed")
    check(viewer.call("nc_ServiceView", "rights")["control"] == "", "and nobody has control")
    for peer in peers.values():
        peer.end()
    boss = Client(plant, plant.identity("boss"), "boss")
    for topic in TOPICS:
        boss.heard(topic, f"who has the name is heard on {topic}")
    until(lambda: boss.answer(boss.send("nc_ServiceSetUp", "tools.set", number=1, length=50.0))[1] != "busy", "has it as soon as the gateway has seen that the other one is gone")
    change = boss.call("nc_ServiceView", "changes", count=1)["changes"][0]
    check((change["user"], change["client"]) == ("dds:boss", "dds:boss"), "is served, and stands in the changes")
    other = Client(plant, plant.identity("setup"), "boss@two")
    other.wait_for("^refused nc_ServiceReply Not Allowed By Security", "his own DDS lets nobody else read what is for him")
    other.end()
    return boss


def renew(plant, gateway, meanwhile):
    """Gives the gateway a new certificate; does something all the time until it is in use, and a little longer."""
    used = len(gateway.lines("the new identity is in use"))
    Process(plant.folder, program("nc-keys"), "--folder", plant.keys, "renew", "gateway", "--days", "2")
    end = time.monotonic() + PATIENCE
    rest = 30
    while rest > 0:
        meanwhile()
        time.sleep(0.02)
        if len(gateway.lines("the new identity is in use")) > used:
            rest -= 1
        check_time(end, "the new identity is not taken\n" + gateway.text())


def renewal(plant, viewer, boss, gateway):
    """Two renewals while an axis is jogged, a watch list is pushed and a program comes in pieces."""
    boss.call("nc_ServiceOperate", "control.take", lease_ms=60000)
    boss.call("nc_ServiceOperate", "mode", mode="manual")
    text = b"G90\n" + b"G1 X1. F100.\n" * 12000 + b"M30\n"
    upload = boss.call("nc_ServiceSetUp", "programs.begin", name="long.nc", size=len(text), sha256=hashlib.sha256(text).hexdigest())["upload"]
    viewer.call("nc_ServiceView", "watch.begin", devices=["M100"], interval_ms=20)
    until(lambda: len(viewer.updates()) > 5, "updates of a watch list come")
    session, first, since = boss.replies(boss.asked)[0][2], boss.asked + 1, viewer.updates()[-1][1]
    states, jogs, at = [], [], 0

    def meanwhile():
        nonlocal at
        jogs.append(boss.send("nc_ServiceOperate", "jog", axis="X", velocity=2.0))
        if len(jogs) % 10 == 0 and at < len(text) and all(boss.replies(n) for n in range(first, boss.asked - 2)):  # at most four are open
            piece = text[at : at + 1500]
            boss.send("nc_ServiceSetUp", "programs.data", upload=upload, begin=at, data=base64.b64encode(piece).decode("ascii"))
            at += len(piece)
        states.append(viewer.send("nc_ServiceView", "status"))

    for _ in range(2):
        renew(plant, gateway, meanwhile)
        check(0 < at < len(text), f"a renewal after {at} of {len(text)} bytes, {boss.asked - first + 1} requests and {len(states)} looks at the axis")
    last = boss.asked
    end = time.monotonic() + PATIENCE
    while not boss.replies(last):
        check_time(end, "the last request has no answer")
        time.sleep(0.02)
    answers = [boss.replies(n) for n in range(first, last + 1)]
    # More than eight requests may be open on a busy computer; a jog that is refused for that is repeated all the same.
    wrong = [(n, a) for n, a in enumerate(answers, first) if len(a) != 1 or a[0][2] != session or (a[0][0] != DONE and (n not in jogs or a[0][1] != "busy"))]
    check(not wrong, f"each of {len(answers)} requests is done and has one answer, in the same session {wrong[:3]} ({sum(a[0][0] != DONE for a in answers)} jogs were busy)")
    looks = [viewer.answer(n) for n in states]  # of these more than eight may be open, too
    check(all(a[0] == DONE or a[1] == "busy" for a in looks), f"{sum(a[0] != DONE for a in looks)} of {len(looks)} looks at the axis were busy")
    moved = [a[3]["systems"][0]["state"] == "manual" for a in looks[5:] if a[0] == DONE]
    # A jog rests after 200 ms without a request, which happens on a busy computer, and goes on with the next one.
    check(len(moved) > 0 and 10 * moved.count(False) < len(looks), f"the axis has moved in {moved.count(True)} of {len(moved)} looks")
    updates = [u for u in viewer.updates() if u[1] >= since]
    gap = max(b[1] - a[1] for a, b in zip(updates, updates[1:]))
    # On a busy computer a scan may last longer than from one update to the next: that has then the same scan.
    late = [(a[0], b[0]) for a, b in zip(updates, updates[1:]) if b[0] < a[0]]
    check(not late and gap < 1000, f"{len(updates)} updates of the watch list in their order {late[:3]}; the longest gap was {gap:.0f} ms")
    while at < len(text):
        piece = text[at : at + 3000]
        boss.call("nc_ServiceSetUp", "programs.data", upload=upload, begin=at, data=base64.b64encode(piece).decode("ascii"))
        at += len(piece)
    boss.call("nc_ServiceSetUp", "programs.finish", upload=upload)
    with open(os.path.join(plant.folder, "programs/long.nc"), "rb") as file:
        check(file.read() == text, "and the program that has come over two renewals is whole")


def ends(plant, viewer, boss, gateway):
    """A client that is killed after a renewal, having sent nothing since; and one that is revoked."""
    check(viewer.call("nc_ServiceView", "rights")["control"] == "dds:boss", "the operator has control")
    renew(plant, gateway, lambda: None)
    boss.process.kill()
    until(lambda: viewer.call("nc_ServiceView", "rights")["control"] == "", "killed after a renewal, it has it no more, long before its lease is over")
    guest = Client(plant, plant.identity("guest"), "guest")
    guest.heard("nc_ServiceView", "a guest")
    guest.heard("nc_ServiceOperate", "who operates")
    guest.call("nc_ServiceOperate", "control.take", lease_ms=60000)
    check(viewer.call("nc_ServiceView", "rights")["control"] == "dds:guest", "has control")
    plant.make("revoke", "guest")
    until(lambda: viewer.call("nc_ServiceView", "rights")["control"] == "", "and has it no more when he is revoked")


def ends_in_the_middle(plant):
    """The identity of ncctl ends while it works: it says so then, and does not wait for a reply until its patience is over."""
    patience = 30  # of ncctl, for a reply
    valid = 25
    ends = time.time() + valid
    plant.make("identity", "short", "--right", "view", "--until", in_time(valid))
    told = ncctl(plant, "short", "watch", "M100", "--rate", "1", "--for", "600", status=FAILED, patience=valid + patience + 30)
    late = time.time() - ends
    check("has expired at" in told and "internal error" not in told, f"it says when it has ended: {told.strip()}")
    check(late < patience - 5, f"and says it {late:.1f} s behind the end")


def second_gateway(plant):
    """A gateway that cannot give commands passes the services on, and its warning says so: without DDS Security every user of the computer operates by them."""
    for options, passes in ((("--services", plant.socket), True), (("--no-services",), False)):
        second = Process(plant.folder, program("ncdds"), "--share", plant.share, "--domain", str(int(plant.domain) + 101), "--commands", *options)
        second.wait_for("no commands: process [0-9]+ already gives the commands", "a second gateway without DDS Security gives no commands")
        second.wait_for("publishes ", "and publishes")
        said = bool(second.lines("no commands: .*; the services, and what they command, are passed on all the same$"))
        check(said == passes, f"it says {'that' if passes else 'nothing of'} services are passed on")
        check(second.end() == 0, "it ends in order")


def secured_services(plant):
    plant.make("init")
    plant.make("identity", "gateway", "--gateway", "--machine", plant.share)
    for right in RIGHTS:
        plant.make("identity", right, "--right", right, "--machine", plant.share)
    plant.make("identity", "boss", "--right", "operate,setup,maintain")
    for name in ("revoked", "guest"):
        plant.make("identity", name, "--right", "operate")
    plant.make("revoke", "revoked")
    plant.control()
    gateway = plant.gateway(plant.identity("gateway"))
    gateway.wait_for("publishes .*takes commands", "the secured gateway publishes")
    walk(plant)
    walk_services(plant)
    by_ncctl(plant)
    second_gateway(plant)
    ends_in_the_middle(plant)
    viewer = Client(plant, plant.identity("view"), "view@watches")
    viewer.heard("nc_ServiceView", "a viewer")
    boss = hostile(plant, viewer)
    renewal(plant, viewer, boss, gateway)
    ends(plant, viewer, boss, gateway)
    check(viewer.leave() == 0 and gateway.end() == 0, "a peer and the gateway end in order")


if __name__ == "__main__":
    sys.exit(run(secured_services, PROGRAMS, ServicePlant))
