#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Each line of ncctl that a document shows to be typed is one that ncctl reads: against a control that is not there it ends with "no control" and not with wrong usage."""
import os
import pathlib
import re
import shlex
import subprocess
import sys

SOURCE = pathlib.Path(os.environ.get("NC_SOURCE_DIR", pathlib.Path(__file__).resolve().parents[2]))
NCCTL = pathlib.Path(os.environ["NC_BINARY_DIR"]) / "bin" / "ncctl"
SKIPPED, USAGE = 77, 1


def commands(text):
    """The commands of the indented lines that begin with ncctl, without the remark behind three blanks, redirections and what is piped on."""
    for number, line in enumerate(text.split("\n"), 1):
        if not line.startswith("    ncctl "):
            continue
        for command in re.split(r"&&", re.split(r"\s{3,}", line.strip())[0]):
            words = shlex.split(re.split(r"[|>]", command)[0])
            if words[0] == "ncctl" and not {"--security", "--domain"} & set(words):
                yield number, words[1:]


def main():
    if not NCCTL.exists():
        print("ncctl is not built: skipped")
        return SKIPPED
    environment = {**os.environ, "NC_SOCKET": "/nowhere/nc.sock"}
    tried, wrong = 0, []
    for path in sorted((SOURCE / "docs").glob("*.md")):
        for number, words in commands(path.read_text(encoding="utf-8")):
            done = subprocess.run([NCCTL, *words], env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60)
            tried += 1
            if done.returncode in (0, USAGE):
                wrong.append(f"docs/{path.name}:{number}: ncctl {shlex.join(words)}: status {done.returncode}: {done.stderr.strip()}")
    print("\n".join(wrong) or f"{tried} commands")
    return 1 if wrong or tried < 30 else 0


if __name__ == "__main__":
    sys.exit(main())
