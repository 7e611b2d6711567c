# SPDX-License-Identifier: Apache-2.0
"""No function for wide vectors calls another one with the upper halves of the registers in use.

Instructions of the older kind wait some 70 cycles for those halves, once on the way in and once on the way back; the look at a law took twice as long by that. The
compiler clears them in front of a call unless it knows all that the called function does, so what is called is inlined or says NC_BESIDE_WIDE_VECTORS
(motion/optimal/four.hpp). Here the machine code of the library is read: in each clone for AVX2 a call stands behind a vzeroupper, or no wide register has been
touched on the straight way there. Skipped where the library has no such clones: on other processors, with other compilers, under sanitizers.
"""
import glob
import os
import re
import shutil
import subprocess
import sys
import unittest

ROOT = os.environ.get("NC_SOURCE_DIR") or os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BINARY = os.environ.get("NC_BINARY_DIR") or os.path.join(ROOT, "build", "release")


def clones(library):
    """The instructions of each clone for AVX2, by its name."""
    text = subprocess.run(["objdump", "-d", "-C", "--no-show-raw-insn", library], capture_output=True, text=True, check=True).stdout
    found, lines = {}, None
    for line in text.splitlines():
        head = re.match(r"[0-9a-f]+ <(.*)>:$", line)
        if head:
            lines = found.setdefault(head.group(1), []) if "avx2" in head.group(1) else None
        elif lines is not None and "\t" in line:
            lines.append(line.split("\t", 1)[1].strip())
    return found


def wrong_calls(lines):
    """Calls with a wide register used in front of them and not cleared since, on the straight way that leads there."""
    wrong, wide = [], False
    for text in lines:
        if re.match(r"(vzeroupper|jmp|ret)\b", text):
            wide = False
        elif "%ymm" in text:
            wide = True
        elif re.match(r"call\b", text) and wide:
            wrong.append(text)
    return wrong


class WideCalls(unittest.TestCase):
    def test_reads_code(self):
        self.assertEqual(wrong_calls(["vaddpd %ymm0,%ymm1,%ymm2", "vmovsd (%rax),%xmm0", "call 10 <f>"]), ["call 10 <f>"])
        self.assertEqual(wrong_calls(["vaddpd %ymm0,%ymm1,%ymm2", "vzeroupper", "mov %rax,%rdi", "call 10 <f>"]), [])
        self.assertEqual(wrong_calls(["vaddpd %ymm0,%ymm1,%ymm2", "ret", "call 10 <f>"]), [])
        self.assertEqual(wrong_calls(["vzeroupper", "vaddpd %ymm0,%ymm1,%ymm2", "call 10 <f>"]), ["call 10 <f>"])
        self.assertEqual(wrong_calls(["mov %rax,%rdi", "call 10 <f>"]), [])

    def test_the_library(self):
        self.assertTrue(FOUND)
        for name, lines in FOUND.items():
            self.assertEqual(wrong_calls(lines), [], name)


LIBRARIES = glob.glob(os.path.join(BINARY, "libnc", "libnc.a"))
if shutil.which("objdump") is None or not LIBRARIES or os.environ.get("NC_SANITIZE"):
    print("skipped: this wants objdump and the library without sanitizers")
    sys.exit(77)
FOUND = clones(LIBRARIES[0])
if not FOUND:
    print("skipped: the library has no functions for AVX2")
    sys.exit(77)

if __name__ == "__main__":
    unittest.main()
