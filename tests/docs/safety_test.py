#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Each row of the table of docs/safety.md names tests that exist, and each alarm of the control that stops or bars something has a row."""
import os
import pathlib
import re
import sys
import unittest

SOURCE = pathlib.Path(os.environ.get("NC_SOURCE_DIR", pathlib.Path(__file__).resolve().parents[2]))
TEST = re.compile(r"TEST(?:_F|_P)?\((\w+), (\w+)\)")
NAMED = re.compile(r"`(\w+)\.(\w*)(\.\.\.|\*)?`")
# Causes that the control must have an answer to, as the first words of their rows.
CAUSES = ["emergency stop", "door", "feeder late", "scan overrun", "bus of the machine lost", "following error", "limit switch", "ladder fault", "scans stop (watchdog)",
          "power fail input", "fault of a drive"]


def rows(text):
    table = text[text.index("| cause |"):]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in table[:table.index("\n\n")].split("\n")]


def unknown(rows_, tests):
    """The tests that rows name and that are not there, and rows that name none."""
    wrong, before = [], False
    for row in rows_:
        named = NAMED.findall(row[-1])
        if not named and not (row[-1] == "the same" and before):
            wrong.append(f"{row[0]}: no test")
        before = bool(named) or before
        wrong += [f"{row[0]}: {suite}.{name}" for suite, name, _ in named if not any(s == suite and t.startswith(name) for s, t in tests)]
    return wrong


class Safety(unittest.TestCase):
    def setUp(self):
        self.text = (SOURCE / "docs/safety.md").read_text(encoding="utf-8")
        head, _, *self.rows = rows(self.text)
        self.columns = len(head)

    def test_each_row_is_whole_and_its_tests_exist(self):
        tests = {found for path in (SOURCE / "tests").rglob("*.cpp") for found in TEST.findall(path.read_text(encoding="utf-8"))}
        self.assertEqual([row[0] for row in self.rows if len(row) != self.columns], [])
        self.assertEqual(unknown(self.rows, tests), [])

    def test_each_cause_and_each_alarm_has_a_row(self):
        self.assertEqual([cause for cause in CAUSES if not any(row[0].startswith(cause) for row in self.rows)], [])
        alarms = set(re.findall(r'"(R\d\d)"', (SOURCE / "runtime/alarms.hpp").read_text(encoding="utf-8")))
        self.assertGreater(len(alarms), 15)
        said = " ".join(row[5] for row in self.rows)
        self.assertEqual(sorted(alarm for alarm in alarms if alarm not in said), [])

    def test_what_is_found(self):
        tests = {("A", "OneTwo")}
        self.assertEqual(unknown([["x", "`A.One...`"], ["y", "the same"], ["z", "`A.Two...`, `B.*`"], ["w", ""]], tests), ["z: A.Two", "z: B.", "w: no test"])


if __name__ == "__main__":
    sys.exit(not unittest.main(exit=False).result.wasSuccessful())
