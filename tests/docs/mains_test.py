#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tools/*_main.cpp hold no logic: each declares its options, calls one function of a library and gives back what that returns. So it defines main() and nothing
else, decides once at most (whether the command line can be used), and stays short."""
import os
import pathlib
import re
import sys
import unittest

SOURCE = pathlib.Path(os.environ.get("NC_SOURCE_DIR", pathlib.Path(__file__).resolve().parents[2]))
MOST_LINES = 80
TEXT = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.S)  # comments and strings
# At the beginning of a line: a function that is not main, a type, a namespace that is opened, a variable of the file.
DEFINED = re.compile(r"^(?:(?!int main\()(?:static |inline |constexpr |const )*[\w:<>,]+[ *&]+[\w:]+ ?(?:\(|=|\{|;)|(?:class|struct|enum|union|template|namespace)\b)", re.M)
ALLOWED = re.compile(r"^using namespace [\w:]+;", re.M)


def faults_of(text):
    """What a main file has beside its main()."""
    code = ALLOWED.sub("", TEXT.sub("", text))
    faults = [f"defines something: {match.group().strip()}" for match in DEFINED.finditer(code)]
    faults += [f"has a loop or a choice: {word}" for word in re.findall(r"\b(?:while|do|switch|goto)\b", code)]
    if len(re.findall(r"\bif\b", code)) > 1:
        faults.append("decides more than once")
    if text.count("\n") > MOST_LINES:
        faults.append(f"has more than {MOST_LINES} lines")
    return faults


class Mains(unittest.TestCase):
    def test_of_this_tree(self):
        mains = sorted((SOURCE / "tools").glob("*_main.cpp"))
        self.assertGreaterEqual(len(mains), 5)
        self.assertEqual([f"{path.name}: {fault}" for path in mains for fault in faults_of(path.read_text(encoding="utf-8"))], [])

    def test_what_is_found(self):
        good = '// if\n#include "a.hpp"\nusing namespace nc;\n\nint main(int argc, char** argv) try {\n  return run(argc, argv);\n} catch (...) {\n  return 1;\n}\n'
        self.assertEqual(faults_of(good), [])
        for bad in ("static int count = 0;\n", "bool ready(int n) {\n}\n", "namespace {\n}\n", "struct Options {\n};\n", "std::string text_of(int n);\n"):
            with self.subTest(bad=bad):
                self.assertNotEqual(faults_of(bad + good), [])
        for bad in ("if (argc > 1) if (argc < 3) ", "while (wait()) ", "switch (argc) "):
            with self.subTest(bad=bad):
                self.assertNotEqual(faults_of(good.replace("return run", bad + "return run")), [])
        self.assertNotEqual(faults_of(good + "\n" * MOST_LINES), [])


if __name__ == "__main__":
    sys.exit(not unittest.main(exit=False).result.wasSuccessful())
