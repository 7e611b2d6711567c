#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every file that a comment or a document names exists: sources, headers and documents, with or without their folders."""
import os
import pathlib
import re
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(os.environ.get("NC_SOURCE_DIR", pathlib.Path(__file__).resolve().parents[2]))
# A whole name: no pattern ("*_test.cpp", "<name>.hpp", "_bench.cpp") and nothing that goes on behind it.
NAME = re.compile(r"(?<![\w*/.<>{}$-])((?:[\w-]+/)*[A-Za-z0-9][\w-]*\.(?:hpp|cpp|h|md))(?![\w.(*-])")
COMMENT = re.compile(r"//(.*)|/\*(.*)|^\s+\*(.*)")
# Headers of the system and of libraries, and examples of a name.
ELSEWHERE = {"can.h", "config.h"}


def mentions(path, text):
    """(line number, name) of each file that is named in the comments of a source, or anywhere in a document."""
    for number, line in enumerate(text.split("\n"), 1):
        if not path.endswith(".md"):
            comment = COMMENT.search(line)
            if comment is None or line.lstrip().startswith("#include"):
                continue
            line = next(part for part in comment.groups() if part is not None)
        for name in NAME.findall(line):
            yield number, name


def missing(files):
    """files: path -> text of the tree. The mentions of what is not in it, as "path:line: name"."""
    names = {path.rsplit("/", 1)[-1] for path in files}
    ends = {path[i:] for path in files for i in range(len(path)) if i == 0 or path[i - 1] == "/"}
    return [f"{path}:{number}: {name}" for path, text in files.items() if text is not None
            for number, name in mentions(path, text) if name not in (ends if "/" in name else names) and name not in ELSEWHERE]


def tree():
    listed = subprocess.run(["git", "-C", SOURCE, "ls-files"], capture_output=True, text=True, check=False)
    paths = listed.stdout.split() if listed.returncode == 0 else [
        str(path.relative_to(SOURCE)) for path in SOURCE.rglob("*") if path.is_file() and path.relative_to(SOURCE).parts[0] != "build"]
    read = re.compile(r"\.(hpp|cpp|h|c|md)$")
    return {path: (SOURCE / path).read_text(encoding="utf-8") if read.search(path) and path != "CHANGELOG.md" else None for path in paths}


class Names(unittest.TestCase):
    def test_of_this_tree(self):
        files = tree()
        self.assertGreater(sum(1 for path, text in files.items() for _ in mentions(path, text or "")), 200)
        self.assertEqual(missing(files), [])

    def test_what_is_found(self):
        files = {"a/one.hpp": "// see two.hpp and a/one.hpp\n/* b/one.hpp */\n", "docs/x.md": "`one.hpp`, three.cpp, *_test.cpp, y.md\n",
                 "b/two.cpp": '#include "gone.hpp"  // gone.hpp\nint gone; const char* t = "gone.hpp";\n'}
        self.assertEqual(missing(files), ["a/one.hpp:1: two.hpp", "a/one.hpp:2: b/one.hpp", "docs/x.md:1: three.cpp", "docs/x.md:1: y.md"])


if __name__ == "__main__":
    sys.exit(not unittest.main(exit=False).result.wasSuccessful())
