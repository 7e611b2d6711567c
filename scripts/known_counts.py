# SPDX-License-Identifier: Apache-2.0
"""The list of the places that scripts/check-meaning still finds, scripts/check-meaning.known: read, compared with what is there, and lowered."""
import collections
import re


def read_known(path):
    """Two dictionaries {(path, kind): count}, of the places that must go and of the exempt ones."""
    known, exempt = {}, {}
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        entry, _, reason = line.partition("#")
        words = entry.split()
        if not words:
            continue
        into = known
        if words[0] == "exempt":
            into, words = exempt, words[1:]
            if not reason.strip():
                raise ValueError(f"{path}:{number}: an exemption says why")
        if len(words) != 3 or not words[2].isdigit() or tuple(words[:2]) in into:
            raise ValueError(f"{path}:{number}: not `path kind count`, once for each")
        into[tuple(words[:2])] = int(words[2])
    return known, exempt


def judge(found, known, exempt):
    """Returns sentences about the counts that differ from the list, and the new counts of those that may be lowered."""
    places = collections.defaultdict(list)
    for finding in found:
        places[finding.path, finding.kind].append(finding)
    complaints, lower = [], {}
    for key in sorted(set(places) | set(known) | set(exempt)):
        here, listed = len(places[key]), known.get(key, 0) + exempt.get(key, 0)
        if here > listed:
            complaints.append(f"{key[0]}: {here} of kind '{key[1]}', {listed} are listed:")
            complaints += [f"  {f.path}:{f.line}: {f.what}" for f in places[key]]
        elif here < listed:
            complaints.append(f"{key[0]}: {here} of kind '{key[1]}', {listed} are listed: lower it (--lower)")
            lower[key] = (max(here - exempt.get(key, 0), 0), min(here, exempt.get(key, 0)))
    return complaints, lower


def lower_lines(path, lower):
    lines = []
    for line in path.read_text(encoding="utf-8").splitlines():
        words = line.partition("#")[0].split()
        exempt = words[:1] == ["exempt"]
        key = tuple(words[1:3] if exempt else words[:2])
        if key in lower:
            count = lower[key][exempt]
            if count == 0:
                continue
            line = re.sub(r"\b\d+(?=\s*(#|$))", str(count), line, count=1)
        lines.append(line)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
