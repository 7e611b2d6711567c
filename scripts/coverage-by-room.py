#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Adds up gcovr's summary for each room (docs/architecture.md): the lines and branches that the tests have executed."""
import json
import pathlib
import sys


def room_of(name):
    parts = pathlib.PurePosixPath(name).parts
    return "/".join(parts[:3]) if parts[0] == "libnc" else parts[0]


def main():
    rooms = {}
    for entry in json.load(open(sys.argv[1], encoding="utf-8"))["files"]:
        for room in (room_of(entry["filename"]), "all"):
            sums = rooms.setdefault(room, [0, 0, 0, 0])
            for i, key in enumerate(("line_covered", "line_total", "branch_covered", "branch_total")):
                sums[i] += entry[key]
    for room, (lines, of_lines, branches, of_branches) in sorted(rooms.items(), key=lambda item: (item[0] == "all", item[0])):
        share = 100 * lines / max(1, of_lines)
        print(f"{room:24} lines {share:5.1f} % of {of_lines:6}   branches {100 * branches / max(1, of_branches):5.1f} % of {of_branches:6}")


main()
