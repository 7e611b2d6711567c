#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What .ci/report says about a run of ctest: how many cases passed, which failed, and what of their output is shown."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
from xml.sax.saxutils import escape, quoteattr

SOURCE = pathlib.Path(os.environ.get("NC_SOURCE_DIR", pathlib.Path(__file__).resolve().parents[2]))


def run(name):
    return f"[ RUN      ] {name}\n"


def ok(name):
    return f"{run(name)}[       OK ] {name} (3 ms)\n"


def fails(name, text):
    return f"{run(name)}{text}\n[  FAILED  ] {name} (3 ms)\n"


def skips(name):
    return f"{run(name)}a.cpp:12: Skipped\n[  SKIPPED ] {name} (0 ms)\n"


class Report(unittest.TestCase):
    def report(self, tests, status):
        """The lines of the report and the listed names, of tests (name, status, element, output)."""
        text = '<?xml version="1.0" encoding="UTF-8"?>\n<testsuite>\n'
        for name, state, element, output in tests:
            text += f'<testcase name={quoteattr(name)} time="1.25" status="{state}">{element}<system-out>{escape(output)}</system-out></testcase>\n'
        with tempfile.TemporaryDirectory() as folder:
            xml, names = pathlib.Path(folder, "ctest.xml"), pathlib.Path(folder, "names")
            xml.write_text(text + "</testsuite>\n", encoding="utf-8")
            names.write_text("fuzz of before\n", encoding="utf-8")
            done = subprocess.run([sys.executable, SOURCE / ".ci/report", xml, names], capture_output=True, text=True, check=False)
            self.assertEqual(done.stderr, "")
            self.assertEqual(done.returncode, status, done.stdout)
            listed = names.read_text(encoding="utf-8").splitlines()[1:]
            self.reasons = [line.strip() for line in listed if line.startswith("    ")]
            return done.stdout.splitlines(), [line for line in listed if not line.startswith("    ")]

    def test_one_process_each(self):
        lines, names = self.report([("a.X.Y", "run", "", "fine"), ("a.script", "fail", '<failure message="Timeout"/>', "first\nlast"),
                                    ("a.other", "notrun", '<skipped message="SKIP_RETURN_CODE=77"/>', "no such package"),
                                    ("a.gone", "notrun", '<skipped message="Unable to find executable"/>', "")], 1)
        self.assertEqual(lines[-1], "1 passed, 2 failed, 1 skipped")
        self.assertEqual(lines[:3], ["----- FAILED a.script (Timeout, 1.2 s)", "first", "last"])
        self.assertEqual(names, ["a.script", "a.gone"])
        self.assertEqual(self.reasons, ["first", "last"])

    def test_a_failed_case_says_why(self):
        output = run("S.A") + "noise\nfile.cpp:7: Failure\nExpected: 1\n" + "more\n" * 20 + "[  FAILED  ] S.A (3 ms)\n"
        self.report([("room.pack_1", "fail", "", output)], 1)
        self.assertEqual(self.reasons[:2], ["file.cpp:7: Failure", "Expected: 1"])

    def test_all_is_well(self):
        lines, names = self.report([("a.X.Y", "run", "", "fine")], 0)
        self.assertEqual((lines, names), (["1 passed, 0 failed, 0 skipped"], []))

    def test_a_pack_counts_its_cases(self):
        output = ("[==========] Running 4 tests from 1 test suite.\n" + ok("S.A") + "printed without a line feed" + ok("All/S.B/0")
                  + skips("S.C") + fails("S.D", "wrong") + "[  PASSED  ] 2 tests.\n[  SKIPPED ] 1 test, listed below:\n[  SKIPPED ] S.C\n"
                  + "[  FAILED  ] 1 test, listed below:\n[  FAILED  ] S.D\n\n 1 FAILED TEST\n")
        lines, names = self.report([("room.pack_2", "fail", '<failure message=""/>', output)], 1)
        self.assertEqual(lines, ["----- FAILED room.S.D (1.2 s)", "[ RUN      ] S.D", "wrong", "[  FAILED  ] S.D (3 ms)",
                                 "2 passed, 1 failed, 1 skipped"])
        self.assertEqual(names, ["room.S.D"])

    def test_parameters_of_a_failed_case(self):
        output = run("All/S.A/Optimal") + "wrong\n[  FAILED  ] All/S.A/Optimal, where GetParam() = true (12 ms)\n" + ok("S.B")
        lines, names = self.report([("room.pack_1", "fail", "", output)], 1)
        self.assertEqual((lines[-1], names), ("1 passed, 1 failed, 0 skipped", ["room.All/S.A/Optimal"]))

    def test_a_pack_that_ends_in_a_case(self):
        """The finding of a sanitizer ends the process: the case is named, what comes behind it was not run and does not count as passed."""
        stack = "\n".join(f"    #{i} somewhere" for i in range(200))
        output = ok("S.A") + run("S.B") + "noise\n" * 100 + "==7==ERROR: AddressSanitizer: heap-use-after-free\n" + stack
        lines, names = self.report([("room.pack_1", "fail", '<failure message="SEGFAULT"/>', output)], 1)
        self.assertEqual(lines[:2], ["----- FAILED room.S.B (SEGFAULT, 1.2 s)", "==7==ERROR: AddressSanitizer: heap-use-after-free"])
        self.assertEqual(len(lines), 62)
        self.assertEqual((lines[-1], names), ("1 passed, 1 failed, 0 skipped", ["room.S.B"]))

    def test_a_pack_that_fails_behind_its_cases(self):
        """Leaks are found when the process ends."""
        output = ok("S.A") + "[  PASSED  ] 1 test.\n==7==ERROR: LeakSanitizer: detected memory leaks\n"
        lines, names = self.report([("room.pack_1", "fail", "", output)], 1)
        self.assertEqual((lines[-1], names), ("1 passed, 1 failed, 0 skipped", ["room.pack_1"]))

    def test_a_long_output_is_cut_in_the_middle(self):
        lines, _ = self.report([("a.script", "fail", "", "\n".join(str(i) for i in range(1000)))], 1)
        self.assertEqual(len(lines), 62)
        self.assertEqual((lines[1], lines[-2]), ("0", "999"))
        self.assertIn("... 941 lines left out ...", lines)

    def test_what_xml_does_not_allow(self):
        lines, _ = self.report([("a.script", "fail", "", "bell \x07 end")], 1)
        self.assertEqual(lines[1], "bell ? end")

    def test_nothing_ran(self):
        lines, _ = self.report([], 1)
        self.assertEqual(lines, ["0 passed, 0 failed, 0 skipped"])


if __name__ == "__main__":
    unittest.main()
