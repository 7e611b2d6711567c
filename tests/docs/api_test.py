#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every function and callback of the public headers says in its comment what each parameter is, what it returns and in which thread it may be
called; every parameter has a name."""
import os
import pathlib
import re
import sys

HEADERS = pathlib.Path(os.environ["NC_SOURCE_DIR"]) / "libnc/include/nc"
DECLARATION = re.compile(
    r"(?P<comment>/\*\*(?:(?!\*/).)*\*/\n)?"
    r"(?:NC_API (?P<returns>[^;{}()]*?)\b(?P<name>nc_[a-z_]+)\((?P<parameters>[^;{}]*)\)(?: NC_RT)?;"
    r"|static inline (?P<returns2>[^;{}()]*?)\b(?P<name2>nc_[a-z_]+)\((?P<parameters2>[^;{}]*?)\) \{"
    r"|typedef (?P<returns3>[^;{}()]*?)\(\*(?P<name3>nc_[a-z_]+)\)\((?P<parameters3>[^;{}]*)\);)", re.S)
THREAD = re.compile(r"\b(?:Any|Feeder|Scan)\s+(?:\*\s+)?thread\b")


def parameters_of(text):
    """Names of the parameters of a declaration; None for one without a name. No parameter is itself a function."""
    if text.strip() == "void":
        return []
    names = []
    for part in text.split(","):
        match = re.search(r"(?:\(\*(\w+)\)|[\s*](\w+))(?:\[\w*\])*$", part.strip())
        name = match and (match.group(1) or match.group(2))
        names.append(name if match and not re.fullmatch(r"(?:const )?\w+", part.strip()) else None)
    return names


def faults_of(comment, returns, name, parameters):
    """The things that are missing in the comment of a function."""
    if not comment:
        return [f"{name}: has no comment"]
    faults = []
    for parameter in parameters_of(parameters):
        if parameter is None:
            faults.append(f"{name}: a parameter has no name: {parameters}")
        elif not re.search(rf"@param {parameter}\b", comment):
            faults.append(f"{name}: says nothing of {parameter}")
    for documented in re.findall(r"@param (\w+)", comment):
        if documented not in parameters_of(parameters):
            faults.append(f"{name}: has no parameter {documented}")
    if returns.strip() != "void" and "@return" not in comment:
        faults.append(f"{name}: does not say what it returns")
    if not THREAD.search(comment):
        faults.append(f"{name}: does not say in which thread it may be called")
    return faults


def check(text):
    """Number of functions in a header, and what their comments leave out."""
    faults, count = [], 0
    for match in DECLARATION.finditer(text):
        row = match.groupdict()
        pick = lambda key: row[key] or row[key + "2"] or row[key + "3"] or ""
        count += 1
        faults += faults_of(row["comment"], pick("returns"), pick("name"), pick("parameters"))
    return count, faults


def main():
    total, faults = 0, []
    for header in sorted(HEADERS.glob("*.h")):
        count, found = check(header.read_text(encoding="utf-8"))
        total += count
        faults += [f"{header.name}: {fault}" for fault in found]
    good = "/** Any thread.\n * @param a x\n * @return y\n */\n"
    # The check itself finds what it must find.
    for comment, declaration in ((good, "NC_API int nc_f(int a, int b);"), (good, "NC_API int nc_f(int);"), ("", "NC_API int nc_f(int a);"),
                                 (good.replace("@return", ""), "NC_API int nc_f(int a);"), (good.replace("Any thread", ""), "NC_API int nc_f(int a);"),
                                 (good, "NC_API int nc_f(void);")):
        if not check(comment + declaration)[1]:
            faults.append(f"this check does not see what is missing here: {comment}{declaration}")
    if check(good + "NC_API int nc_f(int a);") != (1, []):
        faults.append("this check finds fault with a good comment")
    print("\n".join(f"FAILED: {fault}" for fault in faults) or f"{total} functions say what they take, give and where they belong")
    if total < 57:
        print(f"FAILED: only {total} functions found")
    return 1 if faults or total < 57 else 0


if __name__ == "__main__":
    sys.exit(main())
