#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every function and callback of the public headers says in its comment what each parameter is, what it returns and in which thread it may be
called; every parameter has a name, and a number that has a unit says which. Every member of a public struct says what it is, and types.h names the structs that begin with their size. What the comments name is declared.
Each header has one concept, as its length shows."""
import os
import pathlib
import re
import sys

HEADERS = pathlib.Path(os.environ["NC_SOURCE_DIR"]) / "libnc/include/nc"
MOST_LINES = 500
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
    if returns.split()[-1:] == ["nc_status"] and "@return" in comment and not re.search(r"NC_OK|as nc_\w+\(\)", comment.split("@return", 1)[1]):
        faults.append(f"{name}: does not say which status means what")
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


STRUCT = re.compile(r"typedef struct (nc_\w+) \{\n(.*?)\n\} \1;", re.S)


def bare_members(text):
    """The members of the structs of a header that have no comment behind them, as "struct: declaration". A nested struct or union may have one behind its end."""
    bare = []
    for name, body in STRUCT.findall(text):
        body = re.sub(r"/\*[^*]((?!\*/).)*\*/", "", body, flags=re.S)  # a comment that belongs to no member
        body = re.sub(r"/\*\*<((?!\*/).)*\*/", "///", body, flags=re.S)
        bare += [f"{name}: {line.strip()}" for line in body.split("\n") if re.search(r"[;)]\s*$", line)]
    return bare


def unlisted_structs(headers):
    """The structs that begin with NC_STRUCT_SIZE and that the comment of the macro does not name, and those that it names without reason."""
    sized = {name for text in headers.values() for name, body in STRUCT.findall(text) if "NC_STRUCT_SIZE(" in body}
    listed = re.search(r"may be of different versions: (.*?)\. Every other", headers["types.h"], re.S)
    named = set(re.findall(r"nc_\w+", listed.group(1))) if listed else set()
    return sorted(sized ^ named)


UNIT = re.compile(r"\b(?:mm|deg|s|ms|rev|r/min|seconds|minutes|revolutions|units?|share)\b|1 = 100 %|must be 0")


def without_unit(text):
    """Members and parameters of the type double whose comment says neither their unit nor that they have none (or where it is said), as "owner: name". Those of
    the type nc_axes have theirs there."""
    bare = [f"{name}: {member.split('[')[0]}" for name, body in STRUCT.findall(text)
            for member, comment in re.findall(r"^ *double ([^;]*); */\*\*<(.*?)\*/", body, re.S | re.M) if not UNIT.search(comment)]
    for match in DECLARATION.finditer(text):
        row = match.groupdict()
        for name in re.findall(r"\bdouble\s*\*?\s*(\w+)\s*(?:,|$)", row["parameters"] or row["parameters2"] or row["parameters3"] or ""):
            said = re.search(rf"@param {name}\b(.*?)(?=@param|@return|\*/)", row["comment"] or "", re.S)
            if not said or not UNIT.search(said.group(1)):
                bare.append(f"{row['name'] or row['name2'] or row['name3']}: {name}")
    return bare


NAME = re.compile(r"\b(?:nc_[a-z0-9_]+\(\)|NC_[A-Z0-9_]*[A-Z0-9]\b(?!_))")


def unknown_names(headers):
    """Functions (with their brackets) and constants that the comments of the headers mention and that are not declared, as "header: name"."""
    code = {name: re.sub(r"/\*.*?\*/", "", text, flags=re.S) for name, text in headers.items()}
    declared = {word for text in code.values() for word in re.findall(r"\w+", text)}
    return sorted({f"{name}: {mention}" for name, text in headers.items() for mention in NAME.findall(text) if mention.rstrip("()") not in declared})


def main():
    total, faults = 0, []
    headers = {path.name: path.read_text(encoding="utf-8") for path in HEADERS.glob("*.h")}
    faults += [f"{name}: says nothing of {member}" for name, text in headers.items() for member in bare_members(text)]
    faults += [f"{name}: says no unit of {member}" for name, text in headers.items() for member in without_unit(text)]
    sample = "typedef struct nc_s {\n  double a; /**< x */\n  double b; /**< x, mm */\n} nc_s;\n/**\n * @param v x\n * @param w x, s\n */\nNC_API void nc_f(double v, double* w);"
    if without_unit(sample) != ["nc_s: a", "nc_f: v"]:
        faults.append("this check does not see a number without a unit")
    faults += [f"types.h: begins with its size, or is listed there, but not both: {name}" for name in unlisted_structs(headers)]
    faults += [f"{name}: {text.count(chr(10))} lines, more than {MOST_LINES}: split it by concept" for name, text in headers.items() if text.count("\n") > MOST_LINES]
    faults += [f"mentions what is not declared: {mention}" for mention in unknown_names(headers)]
    if unknown_names({"a.h": "/* as nc_g() and NC_G, see nc_f() */ int nc_f(void);"}) != ["a.h: NC_G", "a.h: nc_g()"]:
        faults.append("this check does not see a name that is not declared")
    sample = "typedef struct nc_s {\n  NC_STRUCT_SIZE(nc_s); /**< size */\n  /* both */\n  int a; /**< x\n     y */\n  union {\n    int b;\n  } u; /**< z */\n} nc_s;"
    if bare_members(sample) != ["nc_s: int b;"] or unlisted_structs({"types.h": sample}) != ["nc_s"]:
        faults.append("this check does not see a member without a comment, or a struct that is not listed")
    for header in sorted(HEADERS.glob("*.h")):
        count, found = check(header.read_text(encoding="utf-8"))
        total += count
        faults += [f"{header.name}: {fault}" for fault in found]
    good = "/** Any thread.\n * @param a x\n * @return y\n */\n"
    # The check itself finds what it must find.
    for comment, declaration in ((good, "NC_API int nc_f(int a, int b);"), (good, "NC_API int nc_f(int);"), ("", "NC_API int nc_f(int a);"),
                                 (good.replace("@return", ""), "NC_API int nc_f(int a);"), (good.replace("Any thread", ""), "NC_API int nc_f(int a);"),
                                 (good, "NC_API int nc_f(void);"), (good, "NC_API nc_status nc_f(int a);")):
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
