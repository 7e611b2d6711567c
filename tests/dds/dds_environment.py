# SPDX-License-Identifier: Apache-2.0
"""A Python with the binding of Cyclone DDS for a test, and what tests of it share.

start() makes a virtual environment in build/ and starts the test once more in it; there it returns. Exit status 77 = skipped: no packages can be had here,
or the programs are not built.
"""
import fcntl
import os
import subprocess
import sys
import time

SKIPPED = 77
BINDING = "cyclonedds==11.0.1"
PATIENCE = 30.0  # s for anything to come; only a failure takes so long
root = os.environ.get("NC_SOURCE_DIR") or os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
build = os.environ.get("NC_BINARY_DIR") or os.path.join(root, "build/release")


def skip(text):
    print("skipped:", text)
    sys.exit(SKIPPED)


def environment(folder, packages, probe):
    """The Python of a virtual environment with these packages, "" and the reason when it cannot be made."""
    python = os.path.join(folder, "bin", "python")
    os.makedirs(os.path.dirname(folder), exist_ok=True)
    with open(folder + ".lock", "w", encoding="ascii") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if os.path.exists(python) and subprocess.run([python, "-c", probe], capture_output=True).returncode == 0:
            return python, ""
        for command in ([sys.executable, "-m", "venv", "--clear", folder], [python, "-m", "pip", "install", "-q", "--retries", "1", "--timeout", "20", *packages]):
            done = subprocess.run(command, capture_output=True, text=True)
            if done.returncode != 0:
                return "", f"{' '.join(command[1:4])}: {(done.stderr or done.stdout).strip()[-300:]}"
    return python, ""


def start(script, programs, name="venv-dds", packages=(BINDING,), probe="import cyclonedds"):
    if os.environ.get("NC_DDS_INSIDE") is not None:
        return
    for program in programs:
        if not os.path.exists(os.path.join(build, "bin", program)):
            skip(f"{program} is not built")
    if "thread" in os.environ.get("NC_SANITIZE", ""):
        skip("Cyclone DDS is not built for the thread sanitizer")
    python, why = environment(os.path.join(root, "build", name), packages, probe)
    if not python:
        skip(why)
    sys.exit(subprocess.run([python, os.path.abspath(script)], env={**os.environ, "NC_DDS_INSIDE": "1"}).returncode)


def machine_text(name, axes="X", programs=".", machine="", services="", more=""):
    """The file of a simulated machine that any computer can run. `machine` and `services` are more lines of these sections."""
    text = f'[machine]\nname = "{name}"\nprograms = "{programs}"\n{machine}[scheduling]\npolicy = "other"\nlock_memory = false\noverrun = "count"\n'
    if services:
        text += f"[services]\n{services}"
    for axis in axes:
        text += f'[[axis]]\nname = "{axis}"\nmax_velocity = 200.0\nmax_acceleration = 2000.0\n'
        if axis == "X":
            text += "soft_limits = [-500.0, 500.0]\n"
    return text + more


def services_text(socket):
    """The lines of [services] for a control whose files and socket have names, and whose programs are begun unchecked."""
    return f'socket = "{socket}"\nchanges = "changes"\nhistory = "history"\ncheck = "off"\n'


def check(condition, text):
    if not condition:
        raise AssertionError(text)
    print("ok:", text, flush=True)


def until(function, text, patience=PATIENCE):
    """Calls a function until its result is true; returns that result."""
    end = time.monotonic() + patience
    while True:
        if answer := function():
            print("ok:", text, flush=True)
            return answer
        if time.monotonic() > end:
            raise AssertionError(f"not within {patience} s: {text}")
        time.sleep(0.02)
