#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The services over DDS: ncrtd, ncdds and clients of another make (PyPI cyclonedds). Exit status 77 = skipped."""
import json
import os
import signal
import subprocess
import sys
import tempfile
import time

root = os.environ.get("NC_SOURCE_DIR") or os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(root, "tests/dds"))
sys.path.insert(0, os.path.join(root, "dds"))
from dds_environment import BINDING, build, check, environment, machine_text, services_text, start, until  # noqa: E402

start(__file__, ("ncrtd", "ncdds", "ncctl"))

import nc_dds  # noqa: E402
from cyclonedds.domain import DomainParticipant  # noqa: E402

MORE = """
[share]
commands = true
[[point]]
name = "pallet"
type = "word"
direction = "input"
initial = 7
[work_offsets]
G54 = { X = 0.0, Y = 0.0 }
[ladder]
program = "own.il"
"""
LADDER = "LD nc.m_strobe\nOUT plc.fin2\nLD SM400\nDMOV pallet D0\nLD M100\nOUT M101\nEND\n"
TOPIC_OF_RIGHT = {"view": "nc_ServiceView", "operate": "nc_ServiceOperate", "set up": "nc_ServiceSetUp", "maintain": "nc_ServiceMaintain"}


class Plant:
    """The processes under test."""

    def __init__(self, folder):
        self.folder = folder
        self.share = f"services-{os.getpid()}"
        self.domain = 101 + os.getpid() % 100
        self.socket = os.path.join(folder, "control.sock")
        self.all = []

    def start(self, *command):
        child = subprocess.Popen([os.path.join(build, "bin", command[0]), *command[1:]], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.all.append(child)
        return child

    def control(self):
        return self.start("ncrtd", "--config", os.path.join(self.folder, "machine.toml"), "serve", "--share", self.share)

    def gateway(self, *options):
        return self.start("ncdds", "--share", self.share, "--domain", str(self.domain), "--services", self.socket, *options)

    def client(self, name, patience=30.0):
        return nc_dds.Services(DomainParticipant(self.domain), self.share, name, patience)

    def end(self):
        for child in self.all:
            if child.poll() is None:
                child.send_signal(signal.SIGCONT)
                child.terminate()
        for child in self.all:
            try:
                child.communicate(timeout=20)
            except subprocess.TimeoutExpired:
                child.kill()
                child.communicate()


def outcome(client, service, topic=None, args="", **arguments):
    """"" = done, else the name of the refusal, and its text."""
    try:
        client.answer(client.send(service, topic, args, **arguments), service)
    except nc_dds.ServiceRefused as refusal:
        return refusal.error, refusal.text
    return "", ""


def arguments_of(service):
    """A value for each member that a request must have, so that only the right decides."""
    values = {"number": 1, "whole": 1, "flag": True, "text": "X", "name": "none.nc", "data": "AAAA", "list": ["XX"]}
    args = {member["name"]: values[member["type"]] for member in service["request"] if member["required"]}
    special = {"rights.limit": {"rights": list(TOPIC_OF_RIGHT)}, "mode": {"mode": "auto"}, "tools.set": {"length": 1.0}, "life.set": {"used": 1}, "restart.find": {"line": 1},
               "variables.set": {"value": 1}, "tables.import": {"toml": "[tool_offsets]\n1 = 1\n"}, "parameters.import": {"toml": "[parameters]\n1078 = 1\n"},
               "programs.begin": {"sha256": "0" * 64}}
    return args | special.get(service["name"], {})


def walk(client):
    """Each service on each topic: refused for its right exactly where the topic has not that one."""
    services = client.call("services")["services"]
    check({s["name"]: TOPIC_OF_RIGHT[s["right"]] for s in services} == nc_dds.SERVICE_TOPICS, f"{len(services)} services on the topics of their rights")
    refused = 0
    for topic in TOPIC_OF_RIGHT.values():
        for service in services:
            error, text = outcome(client, service["name"], topic, **arguments_of(service))
            if (error == "no right") != (TOPIC_OF_RIGHT[service["right"]] not in ("nc_ServiceView", topic)):
                raise AssertionError(f"{service['name']} on {topic}: {error} {text}")
            if error in ("no connection", "unknown service") or (error == "malformed" and service["name"] not in ("programs.data", "programs.finish")):
                raise AssertionError(f"{service['name']}: {error} {text}")
            if error == "no right":
                refused += 1
                assert f"the right to {service['right']}" in text, text
    check(refused == sum(3 for s in services if s["right"] != "view"), f"{refused} of {4 * len(services)} cells refused")


def correlation(client):
    """Eight requests at once, one of a long reply: each gets its own. A ninth one is busy, and the next ones go on."""
    for number in range(1, 9):
        client.call("variables.set", number=500 + number, value=number)
    numbers = {client.send("variables.list", **{"from": 500 + i, "count": 1}): i for i in range(1, 9)}
    for number, i in reversed(numbers.items()):
        check(client.answer(number)["variables"][0]["value"] == i, f"request {number} has its own reply")
    many = [client.send("tools.list", count=500) for _ in range(40)]
    holds = [client.send("hold") for _ in range(3)]
    errors = []
    for number in many:
        try:
            client.answer(number)
            errors.append("")
        except nc_dds.ServiceRefused as refusal:
            errors.append(refusal.error)
    check(set(errors) <= {"", "busy"} and errors[:8] == [""] * 8 and "busy" in errors, f"{errors.count('busy')} of 40 at once are busy, the others answered")
    for number in holds:
        client.answer(number)
    check(True, "but holds have room behind them")
    check(outcome(client, "status") == ("", ""), "and the client goes on")


def garbage(client):
    for args in ("{", "[]", "7", "null", '{"a":1}}', '{},"right":"maintain"', '{} ,"id":3', '{"name":"x","name":"y"}', "{}{}", "\x7f", '{"a":' + "[" * 5000 + "]" * 5000 + "}", '{"count":"\\ud800"}'):
        error, text = outcome(client, "tools.list", args=args)
        check(error == "malformed", f"{args[:30]!r}: {text}")
    check(outcome(client, "nonsense")[0] == "unknown service" and outcome(client, 'a","right":"maintain')[0] == "unknown service", "names that are no service")
    check(outcome(client, "hold", "nc_ServiceView", args='{},"right":"operate"')[0] == "malformed", "arguments do not add a right")
    check(outcome(client, "tables.import", toml="[tool_offsets]\n1 = 1\n" + "#" * 380000)[0] == "" and outcome(client, "tables.import", toml="#" * 400000)[0] == "malformed", "long arguments come whole, too long ones are refused")
    for raw, member in (('{"from":1e999}', "from"), ('{"from":"1"}', "from"), ('{"count":null}', "count"), ('{"count":1.5}', "count"), ('{"more":1}', "more")):
        error, text = outcome(client, "tools.list", args=raw)
        check(error == "malformed" and member in text, f"{raw}: {text}")
    wrong_members(client)
    check(outcome(client, "status") == ("", ""), "and it goes on")


def wrong_members(client):
    """Each member of each service with values of other types: refused, naming the member, as on the socket."""
    walked = 0
    for service in client.call("services")["services"]:
        good = arguments_of(service)
        for member in service["request"]:
            for wrong in (None, {}, [None], 1e308 if member["type"] not in ("number", "whole") else "1", "a\0b" if member["type"] != "flag" else 2):
                args = good | {member["name"]: wrong}
                error, text = outcome(client, service["name"], TOPIC_OF_RIGHT[service["right"]], **args)
                if error != "malformed" or member["name"] not in text:
                    raise AssertionError(f"{service['name']} {json.dumps(args)[:200]}: {error} {text}")
                walked += 1
            if member["required"]:
                error, text = outcome(client, service["name"], TOPIC_OF_RIGHT[service["right"]], **{k: v for k, v in good.items() if k != member["name"]})
                if error != "malformed" or member["name"] not in text:
                    raise AssertionError(f"{service['name']} without {member['name']}: {error} {text}")
    print(f"ok: {walked} wrong values of members are refused by name", flush=True)


def programs(plant, client):
    text = b"(" + bytes(range(0x20, 0x28)) + b")\nG90 G54\n" + b"".join(b"G1 X%d. F3000.\n" % (i % 7) for i in range(60000)) + b"M30\n"
    client.upload("long.nc", text)
    with open(os.path.join(plant.folder, "programs/long.nc"), "rb") as file:
        check(file.read() == text, f"a program of {len(text)} bytes in {-(-len(text) // nc_dds.CHUNK_BYTES)} pieces")
    check(client.download("long.nc") == text, "and back")
    check(outcome(client, "programs.begin", name="long.nc", size=3, sha256="0" * 64)[0] != "", "it is not replaced unless told")
    client.upload("part.nc", b"G90 G54\nG1 X20. F6000.\nX0.\nM30\n")
    client.call("control.take", lease_ms=60000)
    client.call("mode", mode="auto")
    client.call("select", name="part.nc")
    runs = client.call("status")["systems"][0]["runs"]
    client.call("start")
    until(lambda: client.call("status")["systems"][0]["runs"] == runs + 1, "it runs to its end")
    changes = client.call("changes", count=1)["changes"][0]
    check(changes["user"] == "dds:anna" and changes["client"] == "dds:anna", f"what was changed has its name: {changes['what']}")
    until(lambda: any(e["user"] == "dds:anna" and e["service"] == "start" for e in client.call("history.list", kind="action")["entries"]), "so has the start in the history")


def watches(client):
    begun = client.call("watch.begin", devices=["D0", "M100"], interval_ms=20)
    updates = [client.watch_update(begun["watch"]) for _ in range(10)]
    check(all(u["values"] == [7, 0] for u in updates) and len({u["scan"] for u in updates}) == 10, "updates come without a request")
    client.call("ladder.write", device="M100", value=1)
    until(lambda: client.watch_update(begun["watch"])["values"][1] == 1, "and show what is written")
    client.call("watch.end", watch=begun["watch"])


def two_clients(plant, anna):
    """Control is one, and so is a name."""
    berta = plant.client("berta")
    check(outcome(berta, "mode", mode="manual")[0] == "no control" and outcome(berta, "control.take")[0] == "no control", "another client has no control")
    check(outcome(berta, "hold")[0] == "", "but holds")
    anna.call("tools.set", number=3, length=50)
    berta.call("tools.set", number=4, length=60)
    anna.call("undo")
    tools = {t["number"]: t["length"] for t in berta.call("tools.list")["tools"]}
    check(tools[3] != 50 and tools[4] == 60, "undo takes back what this client has changed")
    false = plant.client("anna", patience=3)
    false._number = 1000000
    check(outcome(false, "status")[0] == "busy", "the name of another client is refused")
    check(outcome(anna, "status") == ("", ""), "and its owner goes on")
    anna.call("control.release")
    return berta


def unread(plant, anna):
    """Nothing is done for who does not read the replies under his name; who does so gets the name."""
    participant = DomainParticipant(plant.domain)
    blind = nc_dds.Services(participant, plant.share, "emil")
    blind._reader = None  # the reader of the replies ends
    before = anna.call("tools.list", count=9)
    for _ in range(3):
        blind.send("tools.set", number=5, length=70)
    time.sleep(1.0)
    check(anna.call("tools.list", count=9) == before, "nothing is done for a client that does not read its replies")
    emil = plant.client("emil", patience=5)
    check(outcome(emil, "tools.set", number=5, length=71) == ("", ""), "another participant that reads them gets the name at once")
    tool = next(t for t in anna.call("tools.list", count=9)["tools"] if t["number"] == 5)
    check(tool["length"] == 71, "and what was not done before is not done then")


CHILD = """
import sys, time
sys.path.insert(0, {folder!r})
import nc_dds
from cyclonedds.domain import DomainParticipant
me = nc_dds.Services(DomainParticipant({domain}), {share!r}, {name!r})
{does}
print("ready", flush=True)
while True:
    {repeats}
    time.sleep(0.05)
"""


def child(plant, name, does, repeats="pass"):
    text = CHILD.format(folder=os.path.join(root, "dds"), domain=plant.domain, share=plant.share, name=name, does=does, repeats=repeats)
    process = subprocess.Popen([sys.executable, "-c", text], stdout=subprocess.PIPE, text=True)
    plant.all.append(process)
    check(process.stdout.readline() == "ready\n", f"{name} is there")
    return process


def vanished(plant, anna):
    """A client that is killed: its jog, its control, its watch lists and its upload end with it."""
    begun = 'me.call("control.take", lease_ms=60000)\nme.call("mode", mode="manual")\nme.call("watch.begin", devices=["D0"])\nme.call("programs.begin", name="half.nc", size=100, sha256="0" * 64)'
    process = child(plant, "carla", begun, 'me.call("jog", axis="X", velocity=5.0)')
    until(lambda: anna.call("status")["systems"][0]["state"] == "manual", "the axis is jogged")
    check(anna.call("rights")["control"] == "dds:carla", "by who has control")
    process.kill()
    until(lambda: anna.call("status")["systems"][0]["state"] != "manual", "the jog ends with its client")
    until(lambda: anna.call("rights")["control"] == "", "and so does control, before its lease")
    until(lambda: [n for n in os.listdir(os.path.join(plant.folder, "programs")) if "half" in n or n.startswith(".")] == [], "and the upload")


def slow_reader(plant, anna):
    """Clients that have stopped hold nobody up, not even when they are given up: a writer waits for a second for each of them at its end."""
    begun = f'all = [me] + [nc_dds.Services(me._participant, {plant.share!r}, f"dora-{{i}}") for i in range(8)]\nfor one in all: one.call("watch.begin", devices=["D0"], interval_ms=20)'
    process = child(plant, "dora", begun, 'for one in all: one.look(); one.send("tools.list", count=500)')
    time.sleep(0.5)
    process.send_signal(signal.SIGSTOP)
    worst = 0.0
    for _ in range(400):
        begin = time.monotonic()
        anna.call("tools.list", count=500)
        worst = max(worst, time.monotonic() - begin)
        time.sleep(0.01)
    check(worst < 5.0, f"400 requests beside nine clients that have stopped, the slowest took {worst * 1000:.0f} ms")
    process.send_signal(signal.SIGCONT)
    process.kill()


def crowd(plant, anna):
    """One participant with more names than there are places, then one with many names whose replies it does not read: others are answered all the same."""
    session = anna.session
    many = DomainParticipant(plant.domain)
    names = [nc_dds.Services(many, plant.share, f"greta-{i}", 10.0) for i in range(24)]
    first = names[0]
    check(outcome(first, "control.take", lease_ms=60000) == ("", ""), "the first of many clients has control")
    check([outcome(one, "status") for one in names[1:8]] == [("", "")] * 7, "and seven more names of its participant are answered")
    for one in names[8:]:  # some find a place, the others wait for one
        one.send("status")
    later = [plant.client(f"hans-{i}", 15.0) for i in range(3)]
    check([outcome(one, "status") for one in later] == [("", "")] * 3, "each newcomer finds a place")
    check(anna.call("rights")["control"] == "dds:greta-0", "whoever has control keeps its place, silent longer than all others")
    check(anna.session == session, "and so does who has one place only")
    first.call("control.release")
    blind = nc_dds.Services(many, plant.share, "inge", 2.0)
    blind._reader = None
    for i in range(60):
        blind.name = f"inge-{i}"
        blind.send("status")
    begin = time.monotonic()
    check(outcome(plant.client("jan", 15.0), "status") == ("", ""), f"names whose replies nobody reads keep nobody out: {time.monotonic() - begin:.1f} s")
    check(outcome(anna, "status") == ("", "") and anna.session == session, "nor do they take a place")


EACH_WITH_ONE = """
all = [me]
while len(all) < 20:
    one = nc_dds.Services(DomainParticipant({domain}), {share!r}, f"kurt-{{len(all)}}", 3.0)
    try:
        one.call("status")
    except nc_dds.ServiceRefused:
        break
    all.append(one)
"""


def no_users(plant, anna):
    """What docs/security.md says of DDS without security: one user with as many participants as there are places keeps others out, but nobody who has a place or is on the socket."""
    process = child(plant, "kurt", EACH_WITH_ONE.format(domain=plant.domain, share=plant.share))
    ludwig = plant.client("ludwig", 3.0)
    check(outcome(ludwig, "status")[0] == "no connection", "with all places taken a newcomer gets no answer")
    check(outcome(anna, "status") == ("", ""), "who has a place keeps it")
    done = subprocess.run([os.path.join(build, "bin/ncctl"), "--socket", plant.socket, "status"], capture_output=True, text=True)
    check(done.returncode == 0, "and the socket has places of its own")
    process.kill()
    until(lambda: outcome(ludwig, "status") == ("", ""), "when they are gone the newcomer is answered")


def restarted(plant, anna, gateway, control):
    """The gateway, then the control, is killed and comes back."""
    session = anna.session
    gateway.kill()
    gateway.wait()
    gateway = plant.gateway("--commands")
    anna.patience = 2
    until(lambda: outcome(anna, "status")[0] == "", "a new gateway answers the same client")
    check(anna.session != session, "which sees that what it had begun has ended")
    session = anna.session
    control.kill()
    control.wait()
    until(lambda: outcome(anna, "status")[0] in ("failed", "no right"), "without a control requests are refused")
    control = plant.control()
    until(lambda: outcome(anna, "hold")[0] == "", "a new control answers")
    check(anna.session != session, "and the client sees that what it had begun has ended")
    anna.patience = 30
    return gateway, control


def traces(plant, anna):
    """The tool records over DDS: as CSV with the columns of ncctl, as Arrow with the same values."""

    def tool(python, *options):
        command = [python, os.path.join(root, "dds/nc_trace.py"), "--machine", plant.share, "--domain", str(plant.domain), *options]
        return subprocess.run(command, capture_output=True, text=True, cwd=plant.folder, timeout=120)

    def local(name):
        subprocess.run([os.path.join(build, "bin/ncctl"), "--socket", plant.socket, "trace", "save", name], cwd=plant.folder, check=True, capture_output=True)
        with open(os.path.join(plant.folder, name), encoding="ascii") as file:
            return file.read()

    done = tool(sys.executable, "D0", "nc.m_strobe", "--samples", "1200", "--out", "over.csv")
    check(done.returncode == 0, f"a trace over DDS {done.stderr}")
    with open(os.path.join(plant.folder, "over.csv"), encoding="ascii") as file:
        text = file.read()
    check(text == local("local.csv") and len(text.splitlines()) == 1201, "1200 scans as CSV, the same as by ncctl")
    check(anna.call("trace.status")["client"].startswith("dds:trace-"), "with the name of its client")
    done = tool(sys.executable, "nonsense", "--out", "none.csv")
    check(done.returncode == 1 and "not found" in done.stderr, f"a signal that is not there: {done.stderr.strip()}")
    if subprocess.run([sys.executable, "-c", "import pyarrow"], capture_output=True).returncode != 0:
        done = tool(sys.executable, "--last", "--out", "none.arrow")
        check(done.returncode == 1 and "pip install pyarrow" in done.stderr, "without pyarrow Arrow is refused by name")
    python, why = environment(os.path.join(root, "build", "venv-arrow"), [BINDING, "pyarrow"], "import cyclonedds, pyarrow")
    if not python:
        return print("left out: no pyarrow can be had here:", why, flush=True)
    done = tool(python, "--last", "--out", "last.arrow")
    check(done.returncode == 0, f"as Arrow {done.stderr}")
    read = "import pyarrow.ipc, sys; t = pyarrow.ipc.open_file(sys.argv[1]).read_all(); print(t.schema.metadata[b'cycle_us'].decode(), *[str(f.type) for f in t.schema]); " \
        "print(','.join(t.column_names)); [print(f'{s},{x:.9f},' + ','.join(map(str, v))) for s, x, *v in zip(*[c.to_pylist() for c in t.columns])]"
    table = subprocess.run([python, "-c", read, os.path.join(plant.folder, "last.arrow")], capture_output=True, text=True, check=True).stdout
    head, rest = table.split("\n", 1)
    return check(head == "1000 uint64 double int32 int32" and rest == text, "with the same values and their types")


def changes(client):
    """The number of the newest change: it counts up by one for each."""
    return client.call("changes", count=1)["changes"][0]["number"]


def second_gateway(plant, anna, gateway):
    """Of two gateways one answers each client; none asks twice."""
    other = plant.gateway("--commands")
    time.sleep(1)
    before = changes(anna)
    for i in range(20):
        anna.call("variables.set", number=510, value=i)
    check(changes(anna) == before + 20, "with two gateways each request is done once")
    emma = plant.client("emma")
    for i in range(20):
        emma.call("variables.set", number=510, value=i)
    check(changes(anna) == before + 40, "also those of a new client")
    late_gateway(plant, gateway, other, anna)
    other.terminate()
    other.wait()
    emma.patience = 2
    until(lambda: outcome(emma, "status")[0] == "", "and when one ends the other one answers")


def late_gateway(plant, gateway, late, anna):
    """A gateway that comes to more requests at once than a client may have open, all answered by the other one long ago, refuses none of them."""
    egon, erna = plant.client("egon"), plant.client("erna")
    gateway.send_signal(signal.SIGSTOP)
    egon.call("status")  # so this client belongs to the late one
    gateway.send_signal(signal.SIGCONT)
    late.send_signal(signal.SIGSTOP)
    for client in (anna, erna):  # one that the late one has seen before, and one that it has not
        client._answers.clear()  # such as the refusal of who took the same name
        for _ in range(20):
            client.call("status")
    late.send_signal(signal.SIGCONT)
    for _ in range(20):  # in each turn the late one takes up to 16 requests, so it has come to all of them when it has answered these
        egon.call("status")
    for client in (anna, erna):
        client.look()
        check(client._answers == {}, f"a gateway that comes late leaves {client.name} to the other one {list(client._answers.values())[:1]}")


def view_only(plant):
    """Without --commands there is only view, and the refusal says why."""
    gateway = plant.gateway()
    client = plant.client("frida")
    check(client.call("status")["scan"] > 0 and client.call("rights")["rights"] == ["view"], "a gateway without --commands lets view")
    for service in client.call("services")["services"]:
        error, text = outcome(client, service["name"], TOPIC_OF_RIGHT[service["right"]], **arguments_of(service))
        if (error == "no right") != (service["right"] != "view") or (error == "no right" and "ncdds --commands" not in text):
            raise AssertionError(f"{service['name']}: {error} {text}")
    print("ok: and nothing else, saying why", flush=True)
    gateway.terminate()
    gateway.wait()


def later_control(plant):
    """A client that comes before the gateway has seen a control that takes commands has its rights from then on."""
    share = f"{plant.share}-later"
    gateway = plant.start("ncdds", "--share", share, "--domain", str(plant.domain), "--services", plant.socket, "--commands")
    client = nc_dds.Services(DomainParticipant(plant.domain), share, "lena")
    check(client.call("rights")["rights"] == ["view"] and outcome(client, "variables.set", number=511, value=1)[0] == "no right", "without a control that takes commands a client views only")
    other = os.path.join(plant.folder, "later.toml")
    with open(os.path.join(plant.folder, "machine.toml"), encoding="ascii") as file:
        text = file.read().replace(plant.socket, os.path.join(plant.folder, "later.sock"))
    with open(other, "w", encoding="ascii") as file:
        file.write("".join(line for line in text.splitlines(True) if not line.startswith(("variables =", "offsets =", "changes =", "history ="))))
    control = plant.start("ncrtd", "--config", other, "serve", "--share", share)
    until(lambda: outcome(client, "variables.set", number=511, value=1) == ("", ""), "with one it sets a variable, over the connection that it has")
    check(client.call("rights")["rights"] == list(TOPIC_OF_RIGHT), "and has all rights")
    for process in (gateway, control):
        process.terminate()
        process.wait()


def main():
    with tempfile.TemporaryDirectory(prefix="nc-dds-services-") as folder:
        plant = Plant(folder)
        os.mkdir(os.path.join(folder, "programs"))
        with open(os.path.join(folder, "machine.toml"), "w", encoding="ascii") as file:
            file.write(machine_text("Test", "XY", programs="programs", machine='variables = "variables"\noffsets = "offsets"\n', services=services_text(plant.socket), more=MORE))
        with open(os.path.join(folder, "own.il"), "w", encoding="ascii") as file:
            file.write(LADDER)
        try:
            control = plant.control()
            until(lambda: os.path.exists(plant.socket), "the control is there")
            view_only(plant)
            later_control(plant)
            gateway = plant.gateway("--commands")
            anna = plant.client("anna")
            until(lambda: outcome(anna, "status")[0] == "", "the gateway answers")
            correlation(anna)
            garbage(anna)
            walk(plant.client("walker"))
            programs(plant, anna)
            watches(anna)
            two_clients(plant, anna)
            unread(plant, anna)
            vanished(plant, anna)
            slow_reader(plant, anna)
            crowd(plant, anna)
            no_users(plant, anna)
            traces(plant, anna)
            second_gateway(plant, anna, gateway)
            gateway, control = restarted(plant, anna, gateway, control)
        finally:
            plant.end()


main()
