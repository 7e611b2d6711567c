#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The processor time of ncdds, the gateway to DDS, with all of its topics and ten clients.

  bench/dds_cost.py [BUILD_DIR] [ROUNDS] [SECONDS]      default build/release, 5 rounds of 10 s for each kind

A control executes a program on the real clock. One gateway lives through all rounds, and in each of them come in turn: nobody; ten monitors (ncmon: status of 50 Hz, alarms, all signals);
ten clients of the services with a watch list of 16 devices at 50 Hz each (ncctl watch); both together; ten clients that ask for the status again as soon as they are answered (ncctl pipe). The share of a core is the processor time of all threads of ncdds in
a window that begins when the clients are there; shown are the median of the rounds and the largest.

Goals: at most 5 % of a core with ten clients, and 1,000 requests answered in a second, one line for each. They are reported but do not decide the exit status, since the times depend on the computer and on what else it does.
Exit status: 0, 1 when something does not run, 77 (skipped) where the programs are not built.
"""
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time

root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
build = os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else os.path.join(root, "build/release")
rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 5
seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 10
CLIENTS, GOAL = 10, 5.0
PROGRAM = "G90 G54 G17\n#1=0\nWHILE [#1 LT 100000] DO1\nG1 X20. Y10. F3000.\nG3 X20. Y30. J10.\nG1 X0. Y0.\n#1=#1+1\nEND1\nM30\n"
domain = str(1 + os.getpid() % 100)
share = f"cost-{os.getpid()}"


def program(name):
    return os.path.join(build, "bin", name)


def monitor():
    return [program("ncmon"), "--json", "--view", "signals", "--control", share, "--domain", domain]


def watcher():
    return [program("ncctl"), "--domain", domain, "--control", share, "watch", "--rate", "50", *[f"D{n}" for n in range(16)]]


def asker():
    words = [program("ncctl"), "--domain", domain, "--control", share, "pipe"]
    return ["bash", "-c", """exec "$@" < <(yes '{"service":"status"}' 2>/dev/null)""", "-", *words]


def processor_ns(pid):
    total = 0
    for thread in os.listdir(f"/proc/{pid}/task"):
        try:
            with open(f"/proc/{pid}/task/{thread}/schedstat", encoding="ascii") as file:
                total += int(file.read().split()[0])
        except FileNotFoundError:  # it has ended just now; what it has used is lost, and they are few
            pass
    return total


def measure(gateway, folder, commands):
    """Share of a core in percent, and lines that have reached the clients in a second."""
    clients, files = [], []
    try:
        for number, command in enumerate(commands):
            files.append(open(os.path.join(folder, f"client-{number}"), "wb"))
            clients.append(subprocess.Popen(command, stdout=files[-1], stderr=subprocess.STDOUT))
        end = time.monotonic() + 60
        while any(os.path.getsize(file.name) < 2000 for file in files):  # each has got some lines
            failed = [client for client in clients if client.poll() is not None]
            if failed or time.monotonic() > end:
                with open(files[clients.index(failed[0])].name if failed else files[0].name, encoding="utf-8") as text:
                    sys.exit("a client has failed: " + text.read()[-500:])
            time.sleep(0.05)
        time.sleep(1)
        lines = [count_lines(file.name) for file in files]
        used, begin = processor_ns(gateway.pid), time.monotonic()
        time.sleep(seconds)
        used, took = processor_ns(gateway.pid) - used, time.monotonic() - begin
        got = sum(count_lines(file.name) - before for file, before in zip(files, lines))
    finally:
        for client in clients:
            client.terminate()
        for client in clients:
            client.wait()
        for file in files:
            file.close()
    return used / took / 1e7, got / took


def count_lines(name):
    with open(name, "rb") as file:
        return file.read().count(b"\n")


def main():
    for name in ("ncrtd", "ncdds", "ncmon", "ncctl"):
        if not os.path.exists(program(name)):
            print(f"skipped: {program(name)} is not there: build it first (cyclonedds-dev, cyclonedds-tools)")
            return 77
    print(f"load of the computer at the beginning: {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
    kinds = {"nobody": [], "ten monitors": [monitor] * CLIENTS, "ten watch lists": [watcher] * CLIENTS, "both": [monitor, watcher] * CLIENTS, "ten clients that ask": [asker] * CLIENTS}
    with tempfile.TemporaryDirectory() as folder:
        os.mkdir(os.path.join(folder, "programs"))
        with open(os.path.join(folder, "programs/part.nc"), "w", encoding="ascii") as file:
            file.write(PROGRAM)
        with open(os.path.join(root, "etc/machine.toml"), encoding="utf-8") as file:
            text = file.read()
        for key, value in {"programs": f'"{folder}/programs"', "socket": f'"{folder}/control.sock"', "changes": f'"{folder}/changes"', "history": f'"{folder}/history"', "policy": '"other"',
                           "lock_memory": "false", "check": '"off"'}.items():
            text = re.sub(rf"^{key} = (\"[^\"]*\"|\w+)", f"{key} = {value}", text, count=1, flags=re.M)
        with open(os.path.join(folder, "machine.toml"), "w", encoding="utf-8") as file:
            file.write(text)
        with open(os.path.join(root, "etc/mill.il"), encoding="utf-8") as source, open(os.path.join(folder, "mill.il"), "w", encoding="utf-8") as file:
            file.write(source.read())
        control = subprocess.Popen([program("ncrtd"), "--machine", os.path.join(folder, "machine.toml"), "serve", "--share", share], stdout=subprocess.DEVNULL)
        gateway = subprocess.Popen([program("ncdds"), "--share", share, "--domain", domain, "--services", os.path.join(folder, "control.sock")], stderr=subprocess.DEVNULL)
        try:
            until = time.monotonic() + 30
            while not os.path.exists(os.path.join(folder, "control.sock")):
                if control.poll() is not None or time.monotonic() > until:
                    sys.exit("ncrtd does not start")
                time.sleep(0.05)
            for words in (["mode", "auto"], ["select", "part.nc"], ["start"]):
                subprocess.run([program("ncctl"), "--socket", os.path.join(folder, "control.sock"), *words], check=True, stdout=subprocess.DEVNULL)
            rows = {kind: [] for kind in kinds}
            for _ in range(rounds):
                for kind, clients in kinds.items():
                    rows[kind].append(measure(gateway, folder, [client() for client in clients]))
        finally:
            for process in (gateway, control):
                process.terminate()
                process.wait()
    for kind, row in rows.items():
        share_of_core = [used for used, _ in row]
        print(f"{kind}: {statistics.median(share_of_core):.2f} % of a core, at most {max(share_of_core):.2f}; {statistics.median(got for _, got in row):.0f} lines in a second reach the clients")
    worst = max(used for kind in ("ten monitors", "ten watch lists") for used, _ in rows[kind])
    print(f"ten clients of either kind at most {GOAL:.0f} % of a core: {'yes' if worst <= GOAL else 'NO'} ({worst:.2f})")
    return 0


if __name__ == "__main__":
    sys.exit(main())
