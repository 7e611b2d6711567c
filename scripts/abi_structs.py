#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the structs and unions of two descriptions of abidw, member by member: abi_structs.py KEPT NOW SIZED...
Each member that was kept has to have the name, the place and the type that it had. Only the structs SIZED, which begin with their own size, may
grow, and only by members that begin at or behind the size that they had. abidiff 2.2 (Debian 12) cannot be told that: with the
suppression that lets a struct grow at its end it also passes over what else changes in that struct, or inside of a member of it."""
import sys
import xml.etree.ElementTree

COMPOUND = ("class-decl", "union-decl")


class Interface:
    """One description: its types by their ids, and what a type is in words that do not depend on these ids."""

    def __init__(self, path):
        root = xml.etree.ElementTree.parse(path).getroot()
        self.types = {node.get("id"): node for node in root.iter() if node.get("id") and node.get("is-declaration-only") != "yes"}
        self.named = {node.get("name"): node for node in root.iter() if node.tag in COMPOUND and node.get("id") and not self.anonymous(node) and node.find("data-member") is not None}

    @staticmethod
    def anonymous(node):
        return node.get("is-anonymous") == "yes"

    def text(self, type_id):
        """A type in words. A named struct is its name and size, since its members are compared where it is declared."""
        if type_id is None or type_id not in self.types:
            return "void or opaque"
        node = self.types[type_id]
        if node.tag in COMPOUND:
            inside = "; ".join(f"{m['name']} at {m['at']}: {m['type']}" for m in self.members(node)) if self.anonymous(node) else node.get("name")
            return f"{{{inside}}} of {int(node.get('size-in-bits', 0)) // 8} bytes"
        if node.tag == "typedef-decl":
            return self.text(node.get("type-id"))
        if node.tag == "pointer-type-def":
            target = self.types.get(node.get("type-id"))
            while target is not None and target.tag in ("typedef-decl", "qualified-type-def"):
                target = self.types.get(target.get("type-id"))
            # What a pointer to a struct leads to is compared by itself; naming it alone also ends circles.
            return "pointer to " + (target.get("name") if target is not None and target.tag in COMPOUND else self.text(node.get("type-id")))
        if node.tag == "array-type-def":
            lengths = "".join(f"[{part.get('length')}]" for part in node.findall("subrange"))
            return self.text(node.get("type-id")) + lengths
        if node.tag == "qualified-type-def":
            return self.text(node.get("type-id"))
        if node.tag == "function-type":
            taken = ", ".join(self.text(part.get("type-id")) for part in node.findall("parameter"))
            returned = node.find("return")
            return f"function of ({taken}) that returns {self.text(returned.get('type-id') if returned is not None else None)}"
        return node.get("name")

    def members(self, node):
        for member in node.findall("data-member"):
            variable = member.find("var-decl")
            yield {"name": variable.get("name"), "at": int(member.get("layout-offset-in-bits", 0)) // 8, "type": self.text(variable.get("type-id"))}


def differences(kept, now, sized):
    """What has changed in each struct and union, as sentences."""
    found = []
    for name, before in sorted(kept.named.items()):
        after = now.named.get(name)
        if after is None:
            found.append(f"{name} is gone")
            continue
        members = {member["name"]: member for member in now.members(after)}
        old_names = set()
        for member in kept.members(before):
            old_names.add(member["name"])
            new = members.get(member["name"])
            if new is None:
                found.append(f"{name}::{member['name']} is gone")
            elif new["at"] != member["at"]:
                found.append(f"{name}::{member['name']} was at byte {member['at']} and is at {new['at']}")
            elif new["type"] != member["type"]:
                found.append(f"{name}::{member['name']} was {member['type']} and is {new['type']}")
        size, new_size = (int(node.get("size-in-bits")) // 8 for node in (before, after))
        for member in members.values():
            if member["name"] not in old_names and not (name in sized and member["at"] >= size):
                found.append(f"{name}::{member['name']} is new, at byte {member['at']} of a struct that had {size}")
        if new_size < size or (new_size != size and name not in sized):
            found.append(f"{name} had {size} bytes and has {new_size}")
    return found


def main():
    found = differences(Interface(sys.argv[1]), Interface(sys.argv[2]), set(sys.argv[3:]))
    print("\n".join(found), end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
