#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Resident memory of `ncsim check` and `ncsim trace` on a large program, of which they must never hold the whole text in memory.

usage: big_file.py [--ncsim PATH] [--mb N | --full] [--folder DIR] [--trace]

Writes a real file of N MB (default 256; --full: 2048), runs it to its end, and reports the time and the peak of the resident
set as the kernel counted it for that process (wait4). --trace also runs `ncsim trace` into /dev/null.
Exit status: 0, 1 when the peak is 64 MB or more or the program did not end, 77 (skipped) where the disk has no room.
"""
import argparse
import os
import shutil
import sys
import tempfile
import time

LIMIT_MB = 64.0


def find_ncsim():
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    for path in (os.environ.get("NCSIM"), os.path.join(os.environ.get("NC_BINARY_DIR", ""), "bin/ncsim"),
                 os.path.join(root, "build/release/bin/ncsim"), shutil.which("ncsim")):
        if path and os.access(path, os.X_OK):
            return path
    sys.exit("ncsim is not built; give --ncsim PATH")


def write_program(path, megabytes):
    """Writes a file of at least `megabytes` MB, one chunk of lines again and again; returns the number of feed lines."""
    chunk_lines = []
    for i in range(20_000):
        chunk_lines.append(f"G1 X{(i * 37) % 9973 / 100:.3f} Y{(i * 61) % 9967 / 100:.3f} Z{-(i % 500) / 100 - 0.001:.3f}\n")
    chunk = "".join(chunk_lines).encode()
    repeats = max(1, -(-megabytes * 1_000_000 // len(chunk)))
    with open(path, "wb") as out:
        out.write(b"G21 G90 G17 G94\nG1 X0. Y0. Z0. F3000.\n")
        for _ in range(repeats):
            out.write(chunk)
        out.write(b"M30\n")
    return repeats * len(chunk_lines)


def run(command, output):
    """Exit code, seconds, peak resident MB of one process."""
    start = time.perf_counter()
    sink = os.open(output, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
    pid = os.posix_spawn(command[0], command, os.environ, file_actions=[(os.POSIX_SPAWN_DUP2, sink, 1)])
    _, status, usage = os.wait4(pid, 0)
    os.close(sink)
    return os.waitstatus_to_exitcode(status), time.perf_counter() - start, usage.ru_maxrss / 1024.0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--ncsim", default=None)
    parser.add_argument("--mb", type=int, default=256)
    parser.add_argument("--full", action="store_true", help="2048 MB")
    parser.add_argument("--folder", default=None, help="where the file is written")
    parser.add_argument("--trace", action="store_true", help="also trace into /dev/null")
    options = parser.parse_args()
    megabytes = 2048 if options.full else options.mb
    ncsim = os.path.abspath(options.ncsim or find_ncsim())
    good = True
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        if shutil.disk_usage(folder).free < (megabytes + 200) * 1_000_000:
            print(f"skipped: {folder} has no room for {megabytes} MB")
            return 77
        program = os.path.join(folder, "big.nc")
        lines = write_program(program, megabytes)
        print(f"{os.path.getsize(program) / 1e6:.0f} MB, {lines} feed lines")
        for command in ["check", "trace"] if options.trace else ["check"]:
            said = os.path.join(folder, "said.txt") if command == "check" else os.devnull
            code, seconds, peak = run([ncsim, command, program], said)
            complete = code == 0
            if command == "check":
                with open(said, encoding="utf-8") as text:
                    complete = complete and f" {lines + 3} blocks" in text.read()
            print(f"{command:6} exit {code}, {seconds:8.2f} s, {lines / seconds / 1e6:6.2f} M lines/s, "
                  f"peak resident {peak:6.1f} MB{'' if complete else ', NOT complete'}")
            good = good and complete and peak < LIMIT_MB
    print(f"limit {LIMIT_MB:.0f} MB: {'held' if good else 'NOT held'}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
