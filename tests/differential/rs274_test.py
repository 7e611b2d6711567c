#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Moves of `ncsim trace` against LinuxCNC's interpreter (rs274, Debian linuxcnc-uspace) on generated programs.

With --dialect m700 the programs use what both families mean the same by: G0 G1 G2 G3 (centre and radius form, helices, several turns), G17-G19, G20 G21,
G53, G54-G59 with G10 L2, G90 G91, G92, G81 G82 G85 with G98 G99. Two words differ and are written for each: P of an arc that ends
elsewhere than it starts counts extra turns here and all turns there, P of a dwell is in ms here and in s there. Kinds, end points, arc centres, direction, turns and feed must agree.
rs274 prints four decimals, so the generated numbers have at most four, and end points and centres are compared to 1e-6; only the
centres of radius arcs, which are no such numbers, are compared to the last digit printed.

With --dialect iso both read the same text: that of before, and programs with what else the family has of RS-274 (IsoMaker): letters of
either case, blanks in words, expressions, parameters by number and by name, G59.1-G59.3, G10 L2 P0 and L20, G92.1, G43 and G49, G53 with G0 and G1, G73 G74 G83 G84 G86 G87, G90.1 G91.1,
G93. What a cycle does to the spindle, and its dwells, stand between the moves and must agree, too.

Last comes the board of bench/check_vs_rs274.py, plain, pecked and reamed holes in rows, in both dialects: path, feeds, and the time that they take with rapid
traverse at 10 m/min.

Exit status 77 (skipped) where rs274 is absent.
"""
import json
import math
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../bench"))
from check_vs_rs274 import write_board  # noqa: E402

PROGRAMS = 80
BLOCKS = 60
BOARD = 100_000     # holes
EXACT = 1e-6        # mm; numbers that rs274 can print
PRINTED = 6e-5      # half of its last digit, and a little
AXES = "XYZ"
PLANES = {"G17": (0, 1), "G18": (2, 0), "G19": (1, 2)}   # first and second axis
CENTRE = "IJK"


def text(value):
    return f"{value:.4f}".rstrip("0").rstrip(".") + ("" if "." in f"{value:.4f}".rstrip("0").rstrip(".") else ".")


class Maker:
    """Writes one program in both dialects, and keeps where it is in workpiece coordinates."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.lines = {"m700": [], "rs274": []}
        self.at = [0.0, 0.0, 0.0]       # program units
        self.plane = "G17"
        self.absolute = True
        self.unit = 1.0                 # mm per program unit
        self.offset = {f"G{n}": [0.0] * 3 for n in range(54, 60)}   # mm
        self.shift = [0.0] * 3
        self.system = "G54"

    def number(self, reach):
        return round(self.random.uniform(-reach, reach), 4)

    def put(self, line, rs274=None):
        self.lines["m700"].append(line)
        self.lines["rs274"].append(rs274 if rs274 is not None else line)

    def word(self, axis, target):
        """The word that goes to `target` on an axis in the distance mode in force."""
        value = target if self.absolute else round(target - self.at[axis], 4)
        return AXES[axis] + text(value)

    def go(self, target):
        self.at = list(target)

    def zero(self):
        return [a + b for a, b in zip(self.offset[self.system], self.shift)]

    def change_zero(self, change):
        """Carries the position over a change of the coordinate system."""
        before = self.zero()
        change()
        self.at = [a + (b - c) / self.unit for a, b, c in zip(self.at, before, self.zero())]

    # ---- blocks ----

    def straight(self):
        code = self.random.choice(["G0", "G1", "G1"])
        target = list(self.at)
        axes = [a for a in range(3) if self.random.random() < 0.6] or [0]
        for a in axes:
            target[a] = round(self.at[a] + self.number(20), 4)
        feed = f" F{self.random.randint(10, 900)}" if code == "G1" and self.random.random() < 0.3 else ""
        self.put(code + "".join(" " + self.word(a, target[a]) for a in axes) + feed)
        self.go(target)

    def arc(self):
        first, second = PLANES[self.plane]
        third = 3 - first - second
        code = self.random.choice(["G2", "G3"])
        target = list(self.at)
        words, both = [], [None, None]
        # Behind a whole circle an arc by its radius may be the second block of a pair (M700 13.9).
        if self.random.random() < 0.4 and not re.fullmatch(r"G[23]( [IJK]-?[\d.]+)+( P\d+)?", self.lines["rs274"][-1]):      # radius form
            target[first] = round(self.at[first] + self.number(10) + 0.5, 4)
            target[second] = round(self.at[second] + self.number(10) + 0.5, 4)
            half = math.hypot(target[first] - self.at[first], target[second] - self.at[second]) / 2
            if half < 0.2:
                return
            radius = round(half * self.random.uniform(1.05, 3), 4)
            words = [self.word(first, target[first]), self.word(second, target[second]),
                     "R" + ("-" if self.random.random() < 0.5 else "") + text(radius)]
        else:
            centre = [self.number(10), self.number(10)]
            if math.hypot(*centre) < 0.5:
                return
            radius = math.hypot(*centre)
            angle = math.atan2(-centre[1], -centre[0])
            closed = self.random.random() >= 0.8
            if not closed:
                angle += self.random.uniform(0.1, 6.1)
                target[first] = round(self.at[first] + centre[0] + radius * math.cos(angle), 4)
                target[second] = round(self.at[second] + centre[1] + radius * math.sin(angle), 4)
                words = [self.word(first, target[first]), self.word(second, target[second])]
            words += [CENTRE[first] + text(centre[0]), CENTRE[second] + text(centre[1])]
            turns = self.random.choice([0, 0, 0, 1, 2])
            if turns:
                both = [f"P{turns}", f"P{turns if closed else turns + 1}"]
        if self.random.random() < 0.3:
            target[third] = round(self.at[third] + self.number(5), 4)
            words.append(self.word(third, target[third]))
        line = code + "".join(" " + w for w in words)
        self.put(line + (" " + both[0] if both[0] else ""), line + (" " + both[1] if both[1] else ""))
        self.go(target)

    def modes(self):
        kind = self.random.randrange(6)
        if kind == 0:
            self.plane = self.random.choice(list(PLANES))
            self.put(self.plane)
        elif kind == 1:
            self.absolute = not self.absolute
            self.put("G90" if self.absolute else "G91")
        elif kind == 2:
            system = self.random.choice(list(self.offset))
            self.change_zero(lambda: setattr(self, "system", system))
            self.put(system)
        elif kind == 3:
            n = self.random.randint(1, 6)
            values = [round(self.number(50), 4) for _ in range(3)]
            self.put("G90 G10 L2 P%d " % n + " ".join(AXES[a] + text(values[a]) for a in range(3)))
            self.absolute = True
            self.change_zero(lambda: self.offset.__setitem__(f"G{53 + n}", [v * self.unit for v in values]))
        elif kind == 4:
            axis = self.random.randrange(3)
            value = self.number(30)
            self.put(f"G92 {AXES[axis]}{text(value)}")
            self.change_zero(lambda: self.shift.__setitem__(axis, self.shift[axis] + (self.at[axis] - value) * self.unit))
        else:
            axis = self.random.randrange(3)
            value = self.number(40)
            self.absolute = True
            self.put(f"G90 G0 G53 {AXES[axis]}{text(value)}")
            self.at[axis] = value - self.zero()[axis] / self.unit

    def cycle(self):
        self.put("G17")
        self.plane = "G17"
        level = self.random.choice(["G98", "G99"])
        code = self.random.choice(["G81", "G82", "G85"])
        dwell = [" P500", " P0.5"] if code == "G82" else ["", ""]
        absolute = self.absolute
        depth, reach = round(self.random.uniform(2, 9), 4), round(self.random.uniform(1, 4), 4)
        top = self.at[2]
        r, z = round(top - reach, 4), round(top - reach - depth, 4)
        x, y = self.number(20), self.number(20)
        if absolute:
            words = f"X{text(x)} Y{text(y)} Z{text(z)} R{text(r)}"
            self.at[0], self.at[1] = x, y
            count = ""
        else:
            words = f"X{text(x)} Y{text(y)} Z{text(-depth)} R{text(-reach)}"
            repeat = self.random.choice([1, 2, 3])
            count = f" L{repeat}" if level == "G98" and repeat > 1 else ""
            times = repeat if count else 1
            self.at[0], self.at[1] = self.at[0] + times * x, self.at[1] + times * y
        line = f"{level} {code} {words}{count}"
        self.put(line + dwell[0] + " F200", line + dwell[1] + " F200")
        if absolute and self.random.random() < 0.5:
            x = self.number(20)
            self.put("X" + text(x), "X" + text(x))
            self.at[0] = x
        self.at[2] = top if level == "G98" else (r if absolute else top - reach)
        self.put("G80")

    def make(self):
        self.put("G21 G90 G17 G94 G54")
        if self.random.random() < 0.25:
            self.put("G20")
            self.unit = 25.4
        self.put("G0 X0 Y0 Z0")
        self.put("G1 F100")
        for _ in range(BLOCKS):
            kind = self.random.random()
            if kind < 0.35:
                self.straight()
            elif kind < 0.7:
                self.arc()
            elif kind < 0.93:
                self.modes()
            else:
                self.cycle()
        self.put("M2")
        return {name: "\n".join(lines) + "\n" for name, lines in self.lines.items()}


TOOLS = {1: 10.5, 2: 20.25, 3: 3.0}     # lengths, in mm
TOOL_TABLE = "".join(f"T{n} P{n} D1 Z{length / 25.4:.10f}\n" for n, length in TOOLS.items())   # rs274 takes it in inches
SETUP = {"offsets": {str(n): {"length": length} for n, length in TOOLS.items()}}


class IsoMaker(Maker):
    """Programs of the iso family alone."""

    def __init__(self, seed):
        super().__init__(seed)
        self.offset.update({f"G59.{n}": [0.0] * 3 for n in (1, 2, 3)})
        self.length = 0.0
        self.absolute_centres = False
        self.inverse_time = False
        self.names = 0

    def put(self, line, rs274=None):
        line = rs274 if rs274 is not None else line
        if self.inverse_time and re.search(r"\b(G1|G2|G3)\b", line):
            line = re.sub(r" F\d+", "", line) + f" F{self.random.randint(1, 30)}"
        if self.random.random() < 0.2:
            line = line.lower()
        if self.random.random() < 0.2:
            line = "".join(c + (" " if self.random.random() < 0.3 else "") for c in line)
        if self.random.random() < 0.1:
            line += " ; (" + line
        self.lines["rs274"].append(line)

    def zero(self):
        zero = super().zero()
        return [zero[0], zero[1], zero[2] + self.length]

    def word(self, axis, target):
        """The number itself, or an expression or parameter that has the same value to the last bit."""
        value = target if self.absolute else round(target - self.at[axis], 4)
        kind = self.random.random()
        if kind < 0.7:
            return super().word(axis, target)
        if kind < 0.8:
            return f"{AXES[axis]}[{text(value * 2)}/2]"
        if kind < 0.9:
            self.put(f"#{self.random.randint(34, 400)}=0 #{402 + axis}={text(value)}")
            return f"{AXES[axis]}#{402 + axis}"
        self.names += 1    # fewer than its turns are in a block
        self.put(f"#<name_{self.names % 20}>=[{text(value)}]")
        return f"{AXES[axis]}#<Name_{self.names % 20}>"

    def arc(self):
        first, second = PLANES[self.plane]
        start = list(self.at)
        before = len(self.lines["rs274"])
        super().arc()
        if not self.absolute_centres or len(self.lines["rs274"]) == before:
            return
        line = self.lines["rs274"][-1]
        plain = re.sub(r"\s", "", line.split(";")[0]).upper()
        if "R" in plain:
            return
        for axis in (first, second):
            plain = re.sub(CENTRE[axis] + r"(-?[\d.]+)", lambda m, a=axis: CENTRE[a] + f"{start[a] + float(m.group(1)):.8f}", plain)
        self.lines["rs274"][-1] = plain

    def modes(self):
        kind = self.random.randrange(14)
        if kind < 6:
            return super().modes()
        if kind == 6:
            system = self.random.choice(["G59.1", "G59.2", "G59.3"])
            self.change_zero(lambda: setattr(self, "system", system))
            self.put(system)
        elif kind == 7:
            values = [round(self.number(50), 4) for _ in range(3)]
            self.put("G10 L2 P0 " + " ".join(AXES[a] + text(values[a]) for a in range(3)))
            self.change_zero(lambda: self.offset.__setitem__(self.system, [v * self.unit for v in values]))
        elif kind == 8:
            axis, value, n = self.random.randrange(3), self.number(20), self.random.randint(1, 9)
            system = f"G{53 + n}" if n < 7 else f"G59.{n - 6}"
            self.put(f"G10 L20 P{n} {AXES[axis]}{text(value)}")
            here = self.at[axis] * self.unit + self.offset[self.system][axis]      # shift and length are the same in all of them
            changed = list(self.offset[system])
            changed[axis] = here - value * self.unit
            self.change_zero(lambda: self.offset.__setitem__(system, changed))
        elif kind == 9:
            self.put("G92.1")
            self.change_zero(lambda: setattr(self, "shift", [0.0] * 3))
        elif kind == 10:
            tool = self.random.choice([0, 1, 2, 3])
            self.put(f"G43 H{tool}" if tool else "G49")
            self.change_zero(lambda: setattr(self, "length", TOOLS.get(tool, 0.0)))
        elif kind == 11:
            axis, value = self.random.randrange(3), self.number(40)
            self.absolute = True
            self.put(f"G90 G53 G1 {AXES[axis]}{text(value)}")
            self.at[axis] = value - self.zero()[axis] / self.unit
        elif kind == 12:
            self.absolute_centres = not self.absolute_centres
            self.put("G90.1" if self.absolute_centres else "G91.1")
        else:
            self.inverse_time = not self.inverse_time
            self.put("G93" if self.inverse_time else "G94 F150")
        return None

    def cycle(self):
        if self.inverse_time:
            return
        if self.random.random() < 0.5:
            return super().cycle()
        self.put("G17")
        self.plane = "G17"
        level = self.random.choice(["G98", "G99"])
        code = self.random.choice(["G73", "G74", "G83", "G84", "G86", "G87"])
        top = self.at[2]
        r = round(top - self.number(3), 4)       # above and below the tool
        depth = 0 if code != "G87" and self.random.random() < 0.15 else self.random.uniform(1, 6)
        z = round(r - depth, 4)  # LinuxCNC takes a bottom that is R
        x, y = self.number(20), self.number(20)
        self.absolute = True
        words = f"X{text(x)} Y{text(y)} Z{text(z)} R{text(r)} F200"
        if code in ("G73", "G83"):
            words += f" Q{text(self.random.uniform(0.5, 3))}"
        else:
            self.put("M5")
            self.put("S500 M4" if code == "G74" or (code == "G86" and self.random.random() < 0.5) else "S500 M3")
            words += f" P{text(self.random.uniform(0, 2))}" if code != "G87" else f" I{text(self.number(2))} J{text(self.number(2))} K{text((r + z) / 2)}"
        self.put(f"G90 {level} {code} {words}")
        self.put("G80")
        self.at = [x, y, max(top, r) if level == "G98" else r]
        return None


SPINDLE = {"START_SPINDLE_CLOCKWISE": "M3", "START_SPINDLE_COUNTERCLOCKWISE": "M4", "STOP_SPINDLE_TURNING": "M5"}


def without_stops(moves):
    """A stop right before the spindle turns again counts for nothing."""
    return [m for m, after in zip(moves, moves[1:] + [None]) if not (m[0] == "M5" and after is not None and after[0] in ("M3", "M4"))]


# ---- the two interpreters: lists of (kind, end, centre or None, turns signed by direction, feed), machine coordinates in mm ----

def ncsim_moves(ncsim, dialect, setup, path):
    offsets = ["--setup", setup] if setup else []
    done = subprocess.run([ncsim, "trace", "--dialect", dialect, *offsets, path], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"ncsim: exit {done.returncode}: {done.stdout[-400:]}{done.stderr[-400:]}")
    moves = []
    for line in done.stdout.splitlines():
        event = json.loads(line)
        if event["t"] == "dwell" and "seconds" in event:
            moves.append(("dwell", [event["seconds"], 0, 0], None, None, None, event["line"]))
        if event["t"] == "aux" and event["code"] == "M" and event["value"] in (3, 4, 5):
            moves.append((f"M{event['value']:.0f}", [0.0] * 3, None, None, None, event["line"]))
        if event["t"] != "move":
            continue
        end = [event["machine"][a] for a in AXES]
        centre = turns = None
        if event["kind"] in ("arc", "helix"):
            first, second = PLANES[{"XY": "G17", "ZX": "G18", "YZ": "G19"}[event["plane"]]]
            centre = [event["machine_center"][AXES[first]], event["machine_center"][AXES[second]]]
            turns = (event["turns"] + 1) * (1 if event["dir"] == "ccw" else -1)
        moves.append(("arc" if centre else event["kind"], end, centre, turns, event["feed"], event["line"]))
    return moves


def rs274_moves(rs274, path, folder):
    with open(os.path.join(folder, "tool.tbl"), "w", encoding="ascii") as table:
        table.write(TOOL_TABLE)
    done = subprocess.run([rs274, "-g", "-t", "tool.tbl", path], capture_output=True, text=True, check=False, cwd=folder, stdin=subprocess.DEVNULL)
    if done.returncode != 0:
        raise RuntimeError(f"rs274: exit {done.returncode}: {done.stdout[-400:]}{done.stderr[-400:]}")
    moves = []
    offset = {"G5X": [0.0] * 3, "G92": [0.0] * 3, "tool": [0.0] * 3}
    at, unit, plane, feed = [0.0] * 3, 1.0, "XY", 0.0
    for line in done.stdout.splitlines():
        call = re.search(r"([A-Z0-9_]+)\((.*)\)", line)
        if not call:
            continue
        name, words = call.group(1), [w.strip() for w in call.group(2).split(",")]
        if name == "USE_LENGTH_UNITS":
            unit = 25.4 if "INCH" in words[0] else 1.0
        elif name == "SELECT_PLANE":
            plane = words[0][-2:]
        elif name in SPINDLE:
            if moves and moves[-1][0] == "M5" and SPINDLE[name] != "M5":
                moves.pop()     # it stops the spindle before it turns it the other way
            moves.append((SPINDLE[name], [0.0] * 3, None, None, None, 0))
        elif name == "CHANGE_TOOL" and moves and moves[-1][0] == "M5":
            moves.pop()         # of M6
        elif name == "DWELL":
            moves.append(("dwell", [float(words[0]), 0, 0], None, None, None, 0))
        elif name == "PROGRAM_END":
            break
        elif name == "SET_FEED_RATE":
            feed = float(words[0]) * unit
        elif name == "SET_G5X_OFFSET":
            offset["G5X"] = [float(w) * unit for w in words[1:4]]
        elif name == "SET_G92_OFFSET":
            offset["G92"] = [float(w) * unit for w in words[0:3]]
        elif name == "USE_TOOL_LENGTH_OFFSET":
            offset["tool"] = [float(w) * unit for w in words[0].split()]
        elif name in ("STRAIGHT_TRAVERSE", "STRAIGHT_FEED", "ARC_FEED"):
            zero = [a + b + c for a, b, c in zip(offset["G5X"], offset["G92"], offset["tool"])]
            values = [float(w) * unit for w in words]
            centre = turns = None
            if name == "ARC_FEED":
                first, second = PLANES[{"XY": "G17", "XZ": "G18", "YZ": "G19"}[plane]]
                end = [0.0] * 3
                end[first], end[second], end[3 - first - second] = values[0], values[1], values[5]
                centre = [values[2] + zero[first], values[3] + zero[second]]
                turns = int(words[4])
            else:
                end = values[0:3]
            end = [a + b for a, b in zip(end, zero)]
            kind = "arc" if centre else "rapid" if name == "STRAIGHT_TRAVERSE" else "line"
            if centre or max(abs(a - b) for a, b in zip(end, at)) > 1e-4:
                moves.append((kind, end, centre, turns, feed if kind != "rapid" else None, 0))
            at = end
    return moves


def seconds(moves):
    """How long the moves and dwells take one behind the other, with rapid traverse at 10 m/min; no arcs."""
    total, at = 0.0, [0.0] * 3
    for kind, end, _, _, feed, _ in moves:
        if kind == "dwell":
            total += end[0]
        elif kind in ("rapid", "line"):
            total += math.dist(at, end) / (feed if kind == "line" else 10_000.0) * 60
            at = end
    return total


def compare(ours, theirs, tolerance, radius_lines):
    """The first difference as a sentence, or None."""
    while theirs and theirs[-1][0] == "M5" and (not ours or ours[-1][0] != "M5"):
        theirs.pop()     # M2 of rs274
    ours = without_stops(ours)
    for i, (a, b) in enumerate(zip(ours, theirs)):
        where = f"move {i + 1} (line {a[5]})"
        if a[0] != b[0]:
            return f"{where}: {a[0]}, rs274 {b[0]}"
        if max(abs(x - y) for x, y in zip(a[1], b[1])) > tolerance:
            return f"{where}: ends at {a[1]}, rs274 {b[1]}"
        if a[2]:
            allowed = PRINTED * (tolerance / EXACT) if a[5] in radius_lines else tolerance
            if max(abs(x - y) for x, y in zip(a[2], b[2])) > max(allowed, tolerance):
                return f"{where}: centre {a[2]}, rs274 {b[2]}"
            if a[3] != b[3]:
                return f"{where}: turns {a[3]}, rs274 {b[3]}"
        slowest = b[4] is not None and b[4] <= 2.54 and a[4] is not None and a[4] <= 2.54   # rs274 raises what is below 0.1 units per minute
        if slowest:
            continue
        if (a[4] is None) != (b[4] is None) or (a[4] is not None and abs(a[4] - b[4]) > 1e-3 + 1e-5 * a[4]):
            return f"{where}: feed {a[4]}, rs274 {b[4]}"
    if len(ours) != len(theirs):
        return f"{len(ours)} moves, rs274 {len(theirs)}"
    return None


class Run:
    """Compares, counts, and shows the first program that differs."""

    def __init__(self, ncsim, rs274, folder):
        self.ncsim, self.rs274, self.folder = ncsim, rs274, folder
        self.failures = self.moves = self.arcs = self.programs = 0
        self.setup = os.path.join(folder, "setup.json")
        with open(self.setup, "w", encoding="ascii") as out:
            json.dump(SETUP, out)

    def write(self, name, content):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="ascii") as out:
            out.write(content)
        return path

    def real_programs(self):
        """The programs that lie beside the source tree and that rs274 accepts."""
        folder = os.path.join(os.environ.get("NC_SHARED_DIR", ""), "programs")
        for name in sorted(os.listdir(folder)) if os.path.isdir(folder) else []:
            if not name.endswith((".nc", ".ngc")):
                continue
            with open(os.path.join(folder, name), encoding="utf-8") as program:
                content = program.read()
            maker = Maker(0)
            maker.unit = 25.4       # in inch or mm: the coarser of what rs274 prints
            try:
                self.compare(name, "iso", maker, content, content)
            except RuntimeError as refused:
                if not str(refused).startswith("rs274:"):
                    raise
                print(f"{name}: rs274 does not take it")

    def boards(self):
        """A board of holes in each dialect, as each has it: #8013 is the way by which LinuxCNC stops above the last cut of a peck."""
        setup = self.write("board.json", json.dumps({"params": {"1078": 1, "8013": 0.254}}))
        for dialect, holes in (("m700", BOARD), ("iso", BOARD // 10)):
            program = os.path.join(self.folder, "board.ngc")
            write_board(program, holes)
            ours = ncsim_moves(self.ncsim, dialect, setup if dialect == "m700" else "", program)
            theirs = rs274_moves(self.rs274, program, self.folder)
            times = seconds(ours), seconds(theirs)
            difference = compare(ours, theirs, PRINTED if dialect == "iso" else EXACT, set())
            if difference is None and abs(times[0] - times[1]) > 1e-6 * times[1]:
                difference = f"{times[0]:.3f} s, rs274 {times[1]:.3f} s"
            self.programs += 1
            self.moves += len(ours)
            if difference:
                self.failures += 1
            print(f"{dialect}, board of {holes} holes: {len(ours)} moves, {times[0]:.1f} s" + (f": {difference}" if difference else ""))

    def compare(self, what, dialect, maker, text_of_ours, text_of_theirs):
        variables = os.path.join(self.folder, "rs274ngc.var")
        if os.path.exists(variables):
            os.remove(variables)    # offsets must not live on from program to program
        ours = ncsim_moves(self.ncsim, dialect, self.setup if dialect == "iso" else "", self.write("ours.ngc", text_of_ours))
        theirs = rs274_moves(self.rs274, self.write("theirs.ngc", text_of_theirs), self.folder)
        lines = text_of_ours.splitlines()
        radius_lines = {i + 1 for i, line in enumerate(lines) if re.search(r"R", line.split(";")[0].upper())}
        # In inch four printed decimals are 0.00254 mm; where a number has more than four the last digit of what is printed counts.
        tolerance = PRINTED if dialect == "iso" else EXACT
        difference = compare(ours, theirs, tolerance * maker.unit, radius_lines)
        self.programs += 1
        self.moves += len(ours)
        self.arcs += sum(1 for move in ours if move[0] == "arc")
        if difference:
            self.failures += 1
            print(f"{what}: {difference}")
            if self.failures == 1:
                print("\n".join(f"{i + 1:3} {line}" for i, line in enumerate(lines)))


def main():
    rs274 = shutil.which("rs274")
    if rs274 is None:
        print("skipped: rs274 (Debian package linuxcnc-uspace) is not installed")
        return 77
    ncsim = os.path.join(os.environ.get("NC_BINARY_DIR", ""), "bin/ncsim")
    if not os.access(ncsim, os.X_OK):
        ncsim = shutil.which("ncsim")
    if ncsim is None:
        print("skipped: ncsim is not built")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        run = Run(ncsim, rs274, folder)
        for seed in range(PROGRAMS):
            maker = Maker(seed)
            program = maker.make()
            run.compare(f"m700, program {seed}", "m700", maker, program["m700"], program["rs274"])
            run.compare(f"the same in iso, program {seed}", "iso", maker, program["rs274"], program["rs274"])
            maker = IsoMaker(seed)
            program = maker.make()
            run.compare(f"iso, program {seed}", "iso", maker, program["rs274"], program["rs274"])
        run.real_programs()
        run.boards()
    print(f"{run.programs} programs, {run.moves} moves, {run.arcs} arcs: {run.failures} differ")
    return 1 if run.failures else 0


if __name__ == "__main__":
    sys.exit(main())
