# SPDX-License-Identifier: Apache-2.0
"""The recorder at the bus, and the comparison of what it has seen with what ncsim says of the program."""
import csv
import json
import math
import pathlib
import subprocess

from machine import INTERFACE, LAG_S, MACHINE, PROGRAMS, Failed, run

MICROMETRE = 1e-3
SYNC_S = 0.040  # sync_us of machine.toml


class Recorder:
    """candump, from before the control begins: then the n-th position of a node belongs to the n-th SYNC behind its start (NMT), however late it is."""

    def __init__(self):
        self.file = pathlib.Path("/run/bus.log")
        self.out = open(self.file, "w")
        self.process = subprocess.Popen(["candump", "-L", INTERFACE], stdout=self.out)

    def end(self):
        self.process.terminate()
        self.process.wait()
        self.out.close()
        frames = []
        for line in self.file.read_text().splitlines():
            name, _, data = line.split()[2].partition("#")
            if len(name) == 3:
                frames.append((int(name, 16), bytes.fromhex(data)))
        return frames


def signed(data):
    return int.from_bytes(data[2:6], "little", signed=True)


def by_sync(frames, drives):
    """For each SYNC behind the start of the last node: set-points that the control gave behind it, positions that the drives had at it, in mm."""
    syncs, targets, places, first = -1, [{} for _ in drives], [[] for _ in drives], [None for _ in drives]
    for name, data in frames:
        if name == 0x80:
            syncs += 1
        for n, drive in enumerate(drives):
            if name == 0 and data[0] == 1 and data[1] in (0, drive.node):
                first[n], places[n] = syncs + 1, []
            elif name == 0x200 + drive.node:
                targets[n][syncs] = signed(data) / drive.per_mm + drive.zero
            elif name == 0x180 + drive.node and first[n] is not None:
                places[n].append(signed(data) / drive.per_mm + drive.zero)
    begin = max(max(first), max(min(each) for each in targets))
    end = min(syncs, *(first[n] + len(places[n]) - 1 for n in range(len(drives))), *(max(each) for each in targets))
    at = range(begin, end + 1)
    return [[each[k] for each in targets] for k in at], [[places[n][k - first[n]] for n in range(len(drives))] for k in at]


def apart(a, b):
    return max(abs(p - q) for p, q in zip(a, b))


def rows_of(program, start):
    """The machine's places in each cycle, by ncsim."""
    setup = pathlib.Path("/run/setup.json")
    setup.write_text(json.dumps({"start": dict(zip("XYZ", start))}))
    words = ("--machine", MACHINE, "--setup", setup, PROGRAMS / program)
    rows = [[float(value) for value in row[1:4]] for row in csv.reader(run("ncsim", "motion", *words).splitlines()[1:])]
    trace = [json.loads(line) for line in run("ncsim", "trace", *words).splitlines()]
    stops, last = [], None
    for event in trace:
        if event["t"] == "move":
            last = [event["machine"][axis] for axis in "XYZ"]
        elif event["t"] in ("dwell", "end") and last is not None and last not in stops[-1:]:
            stops.append(last)
    return rows, stops


def compare(frames, drives, program, start):
    """What the comparison says, in words; a difference is a Failed."""
    targets, places = by_sync(frames, drives)
    rows, stops = rows_of(program, start)
    half = max(0.5 / abs(drive.per_mm) for drive in drives)  # the drives count in whole increments
    # 1. Each set-point is one of the rows, in their order: the control goes where the trace goes.
    at, met, worst = 0, [], 0.0
    for k, target in enumerate(targets):
        found = next((i for i in range(at, len(rows)) if apart(rows[i], target) <= MICROMETRE + half), None)
        if found is None:
            near = min(rows, key=lambda row: apart(row, target))
            raise Failed(f"set-point {k} of {len(targets)}, {target}, is not in the motion behind row {at} of {len(rows)}; {apart(near, target) * 1000:.1f} um from {near}")
        at = found
        met.append(rows[at])
        worst = max(worst, apart(rows[at], target))
    if at < len(rows) - 1 and apart(rows[at], rows[-1]) > MICROMETRE:
        raise Failed(f"the set-points end in row {at} of {len(rows)}")
    # 2. Each place of the plants is what their lag makes of these rows: a set-point is taken with the next SYNC, acts in the period behind it, and the
    #    position loop follows it with its time constant.
    rest, expected, far = math.exp(-SYNC_S / LAG_S), list(places[0]), 0.0
    for k in range(2, len(met)):
        expected = [row + (place - row) * rest for row, place in zip(met[k - 2], expected)]
        away = apart(expected, places[k])
        far = max(far, away)
        if away > MICROMETRE + 2 * half:
            raise Failed(f"SYNC {k}: the plants are at {places[k]}, expected behind the trace {expected}: {away * 1000:.1f} um")
    # 3. Where the program rests the plants are where its trace says.
    k = 0
    for stop in stops:
        k = next((j for j in range(k, len(places)) if apart(places[j], stop) <= MICROMETRE + half), None)
        if k is None:
            raise Failed(f"the plants never come to {stop}, where the trace rests")
    lag = max(apart(row, place) for row, place in zip(met, places))
    return (f"{len(targets)} SYNCs, set-points {worst * 1000:.2f} um from the motion of ncsim at most, plants {far * 1000:.2f} um from it with their lag "
            f"(up to {lag:.3f} mm), {len(stops)} rests of the trace met")
