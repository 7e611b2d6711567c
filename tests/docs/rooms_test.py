#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What scripts/check-rooms finds in small trees: a cycle of two rooms, of three, of folders; a private header outside its room."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ.get("NC_SOURCE_DIR", pathlib.Path(__file__).resolve().parents[2]))
INTERPRETER = "libnc/src/interpret/interpreter.hpp"
LAYERS = ["libnc/src/interpret/" + name for name in ("context.hpp", "block_in_hand.hpp", "in_force.hpp", "jobs_of_block.hpp")]


def include(*headers):
    return "".join(f'#include "{header}"\n' for header in headers)


class Rooms(unittest.TestCase):
    def check(self, files, *options):
        """Status and output for a tree of these files; the private headers are there unless `files` says what they are."""
        with tempfile.TemporaryDirectory() as folder:
            for path, text in {INTERPRETER: "", **dict.fromkeys(LAYERS, ""), **files}.items():
                if text is None:
                    continue
                place = pathlib.Path(folder, path)
                place.parent.mkdir(parents=True, exist_ok=True)
                place.write_text(text, encoding="utf-8")
            command = [sys.executable, SOURCE / "scripts" / "check-rooms", "--top", folder, *options]
            done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
            self.assertEqual(done.stderr, "")
            return done.returncode, done.stdout

    CHAIN = {
        "libnc/src/base/a.hpp": include("nc/types.h") + "#include <vector>\n",
        "libnc/src/path/b.hpp": include("base/a.hpp"),
        "libnc/src/motion/c.cpp": include("motion/c.hpp", "path/b.hpp", "base/a.hpp"),
        "libnc/src/motion/c.hpp": "",
        "runtime/scan.hpp": include("nc/run.h", "hal/hal.hpp"),
        "hal/hal.hpp": include("nc/run.h"),
        "tools/ncsim_main.cpp": include("runtime/scan.hpp", "lib/args.hpp"),
        "dds/convert.hpp": include("nc_dds.h", "runtime/scan.hpp"),
        "libnc/include/nc/run.h": include("nc/types.h"),
    }

    def test_a_chain_is_none(self):
        self.assertEqual(self.check(self.CHAIN), (0, ""))
        status, output = self.check(self.CHAIN, "--list")
        self.assertEqual(status, 0)
        self.assertIn("base:\ninterpret:\npath: base\nmotion: base path\n", output)
        self.assertIn("libnc:\nhal: libnc\nruntime: hal libnc\ndds: runtime\ntools: runtime\n", output)

    def test_two_rooms(self):
        status, output = self.check({**self.CHAIN, "libnc/src/base/a.hpp": "\n\n" + include("path/b.hpp")})
        self.assertEqual(status, 1)
        self.assertIn("rooms that include each other: base, path\n", output)
        self.assertIn('libnc/src/base/a.hpp:3: #include "path/b.hpp"', output)
        self.assertIn('libnc/src/path/b.hpp:1: #include "base/a.hpp"', output)
        self.assertNotIn("motion", output)  # it includes them, and is not in their cycle

    def test_round_three_rooms(self):
        status, output = self.check({**self.CHAIN, "libnc/src/base/deep/d.hpp": include("motion/c.hpp")})
        self.assertEqual(status, 1)
        self.assertIn("rooms that include each other: base, motion, path\n", output)

    def test_two_knots(self):
        status, output = self.check({"libnc/src/a/x.hpp": include("b/x.hpp"), "libnc/src/b/x.hpp": include("a/x.hpp"),
                                     "libnc/src/c/x.hpp": include("d/x.hpp"), "libnc/src/d/x.hpp": include("c/x.hpp")})
        self.assertEqual(status, 1)
        self.assertIn("each other: a, b\n", output)
        self.assertIn("each other: c, d\n", output)

    def test_folders(self):
        status, output = self.check({**self.CHAIN, "hal/hal.hpp": include("nc/run.h", "tools/lib/args.hpp")})
        self.assertEqual(status, 1)
        self.assertIn("rooms that include each other: hal, runtime, tools\n", output)
        status, output = self.check({**self.CHAIN, "libnc/src/base/a.hpp": include("runtime/scan.hpp")})
        self.assertEqual(status, 1)
        self.assertIn("rooms that include each other: hal, libnc, runtime\n", output)
        status, output = self.check({**self.CHAIN, "hal/hal.hpp": include("motion/c.hpp"), "libnc/src/path/b.hpp": include("hal/hal.hpp")})
        self.assertEqual(status, 1)
        self.assertIn("rooms that include each other: hal, libnc\n", output)

    def test_what_is_no_include(self):
        for text in ('/* was:\n#include "path/b.hpp"\n*/\n', '//   path/*.cpp\n// #include "path/b.hpp"\n', 'const char* t = R"(\n#include "path/b.hpp"\n)";\n'):
            self.assertEqual(self.check({**self.CHAIN, "libnc/src/base/a.hpp": text}), (0, ""), text)

    def test_what_is_one(self):
        for text in ('//   path/*.cpp\n#include "path/b.hpp"\n// */\n', 'const char* t = "/*";\n#  include "path/b.hpp"\n// */\n', "#ifdef X\n #include \"path/b.hpp\"\n#endif\n",
                     "const char q = '\"';\n#include \"path/b.hpp\"\n", "#include <path/b.hpp>\n", '#include "../path/b.hpp"\n', '#include "../base/./../path/b.hpp"\n'):
            self.assertEqual(self.check({**self.CHAIN, "libnc/src/base/a.hpp": text})[0], 1, text)

    def test_private_header(self):
        users = {"libnc/src/interpret/flow.cpp": include("interpret/interpreter.hpp"), "libnc/src/interpret/functions/f.cpp": include("interpret/context.hpp"), "tests/interpret/t.cpp": include("interpret/interpreter.hpp")}
        self.assertEqual(self.check(users), (0, ""))
        for header in ('"../interpret/interpreter.hpp"', "<interpret/interpreter.hpp>", '"../../src/interpret/interpreter.hpp"'):
            status, output = self.check({**users, "libnc/src/control/c.cpp": f"#include {header}\n"})
            self.assertEqual(status, 1, header)
            self.assertIn(f"{INTERPRETER} is private", output)
        for user in ("libnc/src/control/c.cpp", "tools/lib/l.cpp"):
            status, output = self.check({**users, user: include("interpret/interpreter.hpp")})
            self.assertEqual(status, 1)
            self.assertIn(f"{INTERPRETER} is private to libnc/src/interpret/\n  {user}:1: #include", output)
        status, output = self.check({**users, "libnc/src/interpret/functions/f.cpp": include("interpret/interpreter.hpp")})  # a folder inside that is barred
        self.assertEqual(status, 1)
        self.assertIn(f"{INTERPRETER} is private to libnc/src/interpret/\n  libnc/src/interpret/functions/f.cpp:1: #include", output)
        # Through a header of the room that is no private one, and one more outside of it.
        status, output = self.check({**users, "libnc/src/interpret/tables.hpp": include("base/a.hpp", "interpret/interpreter.hpp"),
                                     "libnc/src/control/part.hpp": include("interpret/tables.hpp"), "libnc/src/control/part.cpp": include("control/part.hpp"),
                                     "libnc/src/base/a.hpp": ""})
        self.assertEqual(status, 1)
        self.assertIn('libnc/src/control/part.hpp:1: #include "interpret/tables.hpp"\n  libnc/src/interpret/tables.hpp:2: #include "interpret/interpreter.hpp"\n', output)
        self.assertNotIn("part.cpp", output)  # mended with part.hpp
        for layer in LAYERS:
            status, output = self.check({**users, "libnc/src/control/c.cpp": include(layer.removeprefix("libnc/src/"))})
            self.assertEqual(status, 1)
            self.assertIn(f"{layer} is private to libnc/src/interpret/", output)
        status, output = self.check({INTERPRETER: None, **users})  # moved: the list has to follow
        self.assertEqual(status, 1)
        self.assertIn(f"{INTERPRETER}: named in PRIVATE, and not there", output)


if __name__ == "__main__":
    unittest.main()
