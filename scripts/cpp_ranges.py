# SPDX-License-Identifier: Apache-2.0
"""Ranges of words, parameters and variables that stand in sources of C++ as numbers: what scripts/check-meaning finds as kind `range`.

A manual prints a range by its digits, so its end shows: 9999 or 99999.999, or a power of ten that a least unit is taken from. Other ends are found where
they are compared with, and by the names of constants.
"""
import re

from cpp_tokens import value_of, written_hex

NINES = re.compile(r"9{3,}(\.9*)?|9{2,}\.9{2,}")
ORDER = ("<", ">", "<=", ">=")
NAMES = re.compile(r"k(Most|Last|Largest|Highest|Longest|Least)\w*")  # of constants
LIMITS = re.compile(r"(most|last|largest|highest|longest|limit)(_\w+)?")  # of variables that begin with one


def power_of_two(value):
    """A room of the control, or what a type can hold: 4096, 255, 4294967295, 2147483647.5."""
    whole = int(value + 0.5)
    return whole & (whole - 1) == 0 or whole & (whole + 1) == 0


def power_of_ten(value):
    return float(value).is_integer() and re.fullmatch("10+", str(int(value))) is not None


def ranges_in(tokens):
    """The places of such numbers."""
    def text(at):
        return tokens[at].text if 0 <= at < len(tokens) else ""

    def compared(at):
        """Whether something is compared with the number, or with a choice of which it is an operand: value < (inch ? 10000 : 1000)."""
        if text(at - 1) in ORDER or text(at - 1) == "-" and text(at - 2) in ORDER:
            return True
        if text(at + 1) in ORDER:
            return text(at - 1) not in (",", "<")  # Pool<Entry, 1000>
        if text(at - 1) not in ("?", ":"):
            return False
        opening = next((p for p in range(at - 1, max(at - 8, 0), -1) if text(p) in ("(", ";")), 0)
        return text(opening) == "(" and text(opening - 1) in ORDER

    for at, token in enumerate(tokens):
        value = value_of(token)
        if value is None or written_hex(token):
            continue
        before, behind = text(at - 1), text(at + 1)
        if NINES.fullmatch(token.text.replace("'", "").rstrip("uUlLfF")):
            yield at
        elif value >= 1000 and power_of_ten(value) and behind == "-" and before not in ("*", "/"):
            yield at
        elif value >= 1000 and not power_of_two(value) and compared(at):
            yield at
        elif value >= 100 and not power_of_two(value) and before == "=" and behind in (",", ";") and LIMITS.fullmatch(text(at - 2)):
            yield at
        elif value >= 10 and not power_of_two(value) and before == "=" and behind in (",", ";") and NAMES.fullmatch(text(at - 2)):
            yield at
