#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What ten clients of the services add to a scan in instructions and simulated cache misses, which do not depend on what else the computer does.

  bench/service_instructions.py [BUILD_DIR] [SECONDS]      default build/release, 20 s

A control whose scan comes every 10 ms executes a program of lines and arcs under valgrind, which counts in nc::rt::Scan::run_once() alone: without clients, with ten
watch lists of 16 devices every 20 ms, and with ten clients that ask for the status. What the clients' threads do to the caches of the scan is not in it
(service_cost.py measures times). Exit status: 0, 1 when something does not run, 77 (skipped) without ncrtd or valgrind.
"""
import glob
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

import service_cost as cost

seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 20
SHOWN = {"Ir": "instructions", "I1mr": "misses of the first cache: code", "D1mr": "reads", "D1mw": "writes", "DLmr": "of the last cache: reads"}


def counted(folder):
    """Events of the scan's thread, and its scans."""
    for name in glob.glob(os.path.join(folder, "counts-*")):
        with open(name, encoding="utf-8") as file:
            text = file.read()
        function = re.search(r"fn=\((\d+)\) nc::rt::Scan::read_inputs\(\)", text)  # a name stands once, and then its number
        scans = function and re.search(rf"cfn=\({function[1]}\).*\n(?:.*\n)?calls=(\d+)", text)
        if scans:
            events, totals = (re.search(rf"^{key}: (.*)", text, re.M)[1].split() for key in ("events", "totals"))
            return dict(zip(events, map(int, totals))), int(scans[1])
    sys.exit("valgrind has counted no scan")


def run(client):
    with tempfile.TemporaryDirectory() as folder:
        cost.configuration(folder)
        path = os.path.join(folder, "machine.toml")
        with open(path, encoding="utf-8") as file:
            text = re.sub(r"^cycle_us = \d+", "cycle_us = 10000", file.read(), flags=re.M)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        server = subprocess.Popen(["valgrind", "--tool=callgrind", "--cache-sim=yes", "--separate-threads=yes", "--collect-atstart=no", "--toggle-collect=nc::rt::Scan::run_once()",
                                   f"--callgrind-out-file={folder}/counts", cost.ncrtd, "--machine", path, "serve", "--share", f"counted-{os.getpid()}"],
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        operator, socket = None, os.path.join(folder, "control.sock")
        while operator is None:
            if server.poll() is not None:
                sys.exit(server.stdout.read())
            try:
                operator = cost.Client(socket)
            except OSError:  # nobody listens there yet
                time.sleep(0.1)
        operator.call("control.take", lease_ms=60000)
        operator.call("mode", mode="auto", lifespan_ms=10000)
        operator.call("select", name="part.nc", lifespan_ms=10000)
        operator.call("start", lifespan_ms=10000)
        until, done = time.monotonic() + seconds, []
        threads = [threading.Thread(target=client, args=(socket, until, done)) for _ in range(cost.CLIENTS if client else 0)]
        for thread in threads:
            thread.start()
        time.sleep(seconds)
        for thread in threads:
            thread.join()
        server.send_signal(signal.SIGTERM)
        server.communicate(timeout=120)
        return counted(folder)


def main():
    if not os.path.exists(cost.ncrtd) or shutil.which("valgrind") is None:
        print("skipped: ncrtd or valgrind is not there")
        return 77
    for name, client in {"without clients": None, "ten watch lists at 50 Hz": cost.watch, "ten clients that ask for the status": cost.ask}.items():
        events, scans = run(client)
        print(f"{name}, {scans} scans: " + ", ".join(f"{events[event] / scans:.1f} {text}" for event, text in SHOWN.items()), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
