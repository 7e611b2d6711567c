#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""dds/nc_dds.py says the same as dds/nc_dds.idl, and the IDL keeps its rules: read as text, without DDS."""
import ast
import os
import re
import sys

root = os.environ.get("NC_SOURCE_DIR") or os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PRIMITIVES = {
    "boolean": "bool",
    "double": "types.float64",
    "long": "types.int32",
    "unsigned long": "types.uint32",
    "long long": "types.int64",
    "unsigned long long": "types.uint64",
}
failures = []


def fail(text):
    failures.append(text)
    print("FAILED:", text)


def python_type(idl):
    """The annotation that stands for a type of the IDL."""
    if idl in PRIMITIVES:
        return PRIMITIVES[idl]
    if match := re.fullmatch(r"string<(\d+)>", idl):
        return f"types.bounded_str[{match[1]}]"
    if match := re.fullmatch(r"sequence<(.+), *(\d+)>", idl):
        return f"types.sequence[{python_type(match[1])}, {match[2]}]"
    return idl


def read_idl(path):
    """{name: (extensibility, [(member, type, key)])} and {name: (extensibility, [enumerator])}."""
    with open(path, encoding="utf-8") as file:
        text = re.sub(r"//[^\n]*", "", file.read())
    structs, enums = {}, {}
    for extensibility, name, body in re.findall(r"@(\w+)\s+struct\s+(\w+)\s*\{([^}]*)\}", text):
        members = []
        for line in filter(None, (part.strip() for part in body.split(";"))):
            key = line.startswith("@key")
            kind, names = re.fullmatch(r"(?:@key\s+)?((?:string|sequence)<[^>]*>|(?:unsigned )?long long|unsigned long|\w+)\s+(.*)", line, re.S).groups()
            for member in (part.strip() for part in names.split(",")):
                array = re.fullmatch(r"(\w+)\[(\d+)\]", member)
                if array:
                    members.append((array[1], f"types.array[{python_type(kind)}, {array[2]}]", key))
                else:
                    members.append((member, python_type(kind), key))
        structs[name] = (extensibility, members)
    for extensibility, name, body in re.findall(r"@(\w+)\s+enum\s+(\w+)\s*\{([^}]*)\}", text):
        enums[name] = (extensibility, [part.strip() for part in body.split(",")])
    if len(re.findall(r"\bstruct\b", text)) != len(structs) or len(re.findall(r"\benum\b", text)) != len(enums):
        fail("a struct or enum without @appendable or @final")
    for forbidden in ("uint8", "int8", "octet", "@optional", "@mutable", "wstring", "string ", "sequence<double>"):
        if re.search(rf"(?<!\w){re.escape(forbidden)}", text):
            fail(f"the IDL uses {forbidden!r}")
    return structs, enums


def read_python(path):
    with open(path, encoding="utf-8") as file:
        tree = ast.parse(file.read())
    structs, enums = {}, {}
    for node in tree.body:
        if not isinstance(node, ast.ClassDef) or not node.bases:
            continue
        base = ast.unparse(node.bases[0])
        extensibility = next((ast.unparse(d).removeprefix("annotate.") for d in node.decorator_list if "annotate" in ast.unparse(d)), "")
        typename = next((k.value.value for k in node.keywords if k.arg == "typename"), "")
        if base in ("IdlStruct", "IdlEnum") and typename != f"nc.{node.name}":
            fail(f"{node.name}: its typename is {typename}")
        if base == "IdlEnum":
            values = [(n.targets[0].id, n.value.value) for n in node.body if isinstance(n, ast.Assign)]
            if [value for _, value in values] != list(range(len(values))):
                fail(f"{node.name}: its values are not 0, 1, 2 ...")
            enums[node.name] = (extensibility, [name for name, _ in values])
        if base == "IdlStruct":
            keys = {n.value.args[0].value for n in node.body if isinstance(n, ast.Expr) and isinstance(n.value, ast.Call)}
            structs[node.name] = (extensibility, [(n.target.id, ast.unparse(n.annotation), n.target.id in keys)
                                                  for n in node.body if isinstance(n, ast.AnnAssign)])
    return structs, enums


def compare(kind, wanted, got):
    for name in sorted(wanted.keys() | got.keys()):
        if name not in wanted or name not in got:
            fail(f"{kind} {name} stands only in the {'IDL' if name in wanted else 'Python file'}")
        elif wanted[name] != got[name]:
            fail(f"{kind} {name} differs:\n  IDL    {wanted[name]}\n  Python {got[name]}")


idl = read_idl(os.path.join(root, "dds/nc_dds.idl"))
python = read_python(os.path.join(root, "dds/nc_dds.py"))
compare("struct", idl[0], python[0])
compare("enum", idl[1], python[1])
for name, (extensibility, _) in idl[0].items():
    if (extensibility == "final") != bool(re.search(r"_v\d+$", name)):
        fail(f"struct {name}: final types, and only they, have their version in the name")
print(f"{len(idl[0])} structs, {len(idl[1])} enums compared")
sys.exit(1 if failures or not idl[0] else 0)
