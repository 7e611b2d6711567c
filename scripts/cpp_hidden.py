# SPDX-License-Identifier: Apache-2.0
"""Numbers, letters and families that sources of C++ ask for in a way that hides them: what scripts/check-meaning finds beside plain comparisons.

A code of one digit under a name of codes, a field of bits, an element of a table by its number, a property that gives a family away by its value, the bytes
of a text as hexadecimal numbers, a number in a choice, and a difference that is asked whether it is none.
"""
import re

from cpp_tokens import value_of, words_in, written_hex

EQUAL = ("==", "!=")
ORDER = ("<", ">", "<=", ">=")
COMPARE = EQUAL + ORDER
# Names that hold a code or the number of a group, wherever in the name the word stands.
ONE_DIGIT = {"code", "codes", "gcode", "mcode", "motion", "plane", "m", "g", "misc", "mode", "group", "groups"}
# With one of these words it counts something, or is a bound.
COUNTS = {"count", "size", "most", "max", "levels", "level", "left", "length", "digits", "width", "index", "bits", "point", "points"}
CHARACTERS = {"character", "characters", "char", "ascii"}  # chosen by their codes
PROPERTIES = {"dialect", "rules"}
ENDS = (")", ";", "&&", "||", "?", ",", ":", "}", "==", "!=")
ESCAPED = re.compile(r"\\x(4[1-9a-f]|5[0-9a])", re.I)  # a letter


class Hidden:
    def __init__(self, tokens, partner, constants):
        self.tokens, self.partner, self.constants = tokens, partner, constants

    def text(self, at):
        return self.tokens[at].text if 0 <= at < len(self.tokens) else ""

    def kind(self, at):
        return self.tokens[at].kind if 0 <= at < len(self.tokens) else ""

    def whole(self, at):
        """The value of a whole number, or of a constant of this file; None for anything else."""
        if self.kind(at) == "name":
            value = None if set(words_in(self.text(at))) & COUNTS else self.constants.get(self.text(at))
        else:
            value = value_of(self.tokens[at]) if self.kind(at) == "number" else None
        return value if isinstance(value, int) else None

    def chain_before(self, at):
        """The names of a.b->c[d].e that ends in front of `at`, with what is in its brackets passed over."""
        names, place = [], at - 1
        while place >= 0:
            if self.text(place) in (")", "]") and place in self.partner:
                place = self.partner[place] - 1
                continue
            if self.kind(place) != "name":
                break
            names.append(self.text(place))
            if self.text(place - 1) not in (".", "->", "::"):
                break
            place -= 2
        return names[::-1]

    def chain_behind(self, at):
        """The names of the chain that begins behind `at`."""
        names, place = [], at + 1
        while self.kind(place) == "name":
            names.append(self.text(place))
            place += 1
            while self.text(place) in ("(", "[") and place in self.partner:
                place = self.partner[place] + 1
            if self.text(place) not in (".", "->", "::"):
                break
            place += 1
        return names

    def sides(self, at):
        """(names of one operand, place of the number that it is compared with), in both orders."""
        if self.text(at + 2) in ENDS and self.whole(at + 1) is not None:
            yield self.chain_before(at), at + 1
        if self.whole(at - 1) is not None and self.text(at - 2) in ("(", "&&", "||", "return", "=", "!", ",", "?", ":"):
            yield self.chain_behind(at), at - 1

    @staticmethod
    def holds_code(names):
        words = set(words_in(names[-1])) if names else set()
        return bool(words & ONE_DIGIT) and not words & COUNTS and not names[-1].startswith("k") and not names[-1][:1].isupper()

    def compared(self, at):
        """code == 4, group_now != 7; dialect->most_offsets > 200, rules.macro.levels == 4."""
        for names, place in self.sides(at):
            value = self.whole(place)
            if set(names[:-1]) & PROPERTIES and value >= 2 and self.kind(place) == "number":
                return "identity"
            if self.text(at) in EQUAL and 1 <= value <= 9 and self.holds_code(names):
                return "group" if set(words_in(names[-1])) & {"group", "groups"} else "code"
            if self.text(at) in EQUAL and value >= 10 and self.kind(place) == "name" and names and value & (value - 1) != 0:
                return "plain"
        return None

    def field(self, at):
        """(g & 15) == 1, (v & 0xff) == 0x29, ((v >> 4) & 15) == 9: bits of a number that are asked for a number."""
        value, mask = self.whole(at + 1), self.whole(at - 2)
        if self.text(at) not in EQUAL or self.text(at - 1) != ")" or self.text(at - 3) != "&" or value is None or mask is None:
            return None
        return "plain" if mask & (mask + 1) == 0 and mask > 1 and 0 < value < mask else None

    def sum(self, at):
        """v == 4 * 10 + 1, -v == -41, v * 10 == 410: what a number is made of, or what is made of the number that is asked."""
        if self.text(at) not in EQUAL:
            return None
        end = at + 1
        while self.kind(end) == "number" or self.text(end) in ("+", "-", "*"):
            end += 1
        numbers = [self.whole(p) for p in range(at + 1, end) if self.kind(p) == "number"]
        if self.text(end) not in ENDS or not numbers or None in numbers:
            return None
        if len(numbers) > 2 and self.kind(at - 1) == "name":
            return "plain"
        if len(numbers) > 1 or numbers[0] < 10:
            return None
        scaled = self.kind(at - 1) == "number" and self.text(at - 2) == "*" and self.kind(at - 3) == "name"
        return "plain" if scaled or self.text(at + 1) == "-" and self.kind(at - 1) == "name" else None

    def distance(self, at):
        """static_cast<unsigned>(v - 40) < 3."""
        value, within = self.whole(at - 2), self.whole(at + 1)
        if self.text(at) not in ("<", "<=") or self.text(at - 1) != ")" or self.text(at - 3) != "-" or value is None or within is None:
            return None
        return "plain" if value >= 10 and 0 < within < value and self.kind(at - 4) == "name" else None

    def range(self, at):
        """41 <= v && v <= 43, v < 44 && v >= 41: the two ends in another order than `v >= 41 && v < 44`."""
        if self.text(at + 2) != "&&" or self.text(at) not in ORDER or self.text(at + 4) not in ORDER:
            return None
        left = self.whole(at - 1) if self.text(at + 1) == self.text(at + 3) and self.kind(at + 1) == "name" else None
        if left is None and self.text(at) in ("<", "<=") and self.text(at - 1) == self.text(at + 3) and self.kind(at - 1) == "name":
            left = self.whole(at + 1)
        right = self.whole(at + 5)
        ends = (left, right) if left is not None and right is not None else (0, 0)
        return "plain" if min(ends) >= 10 and left != right else None

    def digits(self, at):
        """t == "41"."""
        texts = [self.text(p) for p in (at - 1, at + 1) if self.kind(p) == "string"]
        return "plain" if self.text(at) in EQUAL and any(re.fullmatch(r'"\d{2,3}(\.\d)?"', text) for text in texts) else None

    def choice(self, at):
        """v == (inch ? 20 : 21)."""
        if self.text(at) not in EQUAL or self.text(at + 1) != "(" or at + 1 not in self.partner:
            return None
        end = self.partner[at + 1]
        numbers = [p for p in range(at + 2, end) if self.text(p - 1) in ("?", ":") and self.text(p + 1) in (":", ")") and (self.whole(p) or 0) >= 10]
        return "plain" if numbers else None

    def byte(self, at):
        """p[0] == 0x47, c == 0x47: a letter of a text."""
        for place in (at - 1, at + 1):
            if self.text(at) in EQUAL and self.kind(place) == "number" and written_hex(self.tokens[place]) and 0x41 <= (value_of(self.tokens[place]) or 0) <= 0x5a:
                return "letter"
        return None

    def none_of(self, at):
        """!(v - 41), (v ^ 41) == 0, code - 4 == 0."""
        value = self.whole(at + 1)
        if value is None or self.kind(at + 1) != "number" or self.kind(at - 1) != "name":
            return None
        asked = self.text(at + 2) in EQUAL and self.text(at + 3) == "0" or self.text(at + 2) == ")" and self.text(at + 3) in EQUAL and self.text(at + 4) == "0"
        opening = self.partner.get(at + 2, 0) if self.text(at + 2) == ")" else 0
        denied = opening > 0 and self.text(opening - 1) == "!"
        if not asked and not denied:
            return None
        if value >= 10:
            return "plain"
        return "code" if value > 0 and self.holds_code(self.chain_before(at)) else None

    def element(self, at):
        """arr[41], cells.at(41), bits.test(41), *(table + 41)."""
        value = self.whole(at + 1)
        if value is None or value < 10 or self.kind(at + 1) != "number":
            return None
        if self.text(at) == "[" and self.text(at + 2) == "]" and (self.kind(at - 1) == "name" or self.text(at - 1) in ("]", ")")):
            if set(words_in(self.text(at - 1))) & CHARACTERS:
                return None
            name = at - 1
            while self.text(name) == "]" and name in self.partner:
                name = self.partner[name] - 1
            before = self.text(name - 1)
            declares = self.kind(name - 1) == "name" and before not in ("return", "case", "else") or before in ("*", "&", ">", ",") and self.text(
                at + 3) in (";", "{", ",", "=", "[")
            return None if declares else "plain"
        if self.text(at) == "(" and self.text(at - 1) in ("at", "test") and self.text(at - 2) in (".", "->") and self.text(at + 2) == ")":
            return "plain"
        if self.text(at) == "+" and self.text(at + 2) == ")" and self.kind(at - 1) == "name" and self.text(at - 2) == "(" and self.text(at - 3) == "*" and (
                self.kind(at - 4) != "name" or self.text(at - 4) == "return"):
            return "plain"
        return None

    def case(self, at):
        """switch (misc) { case 3: } and switch (v / 10) { case 4: }: one digit under a name that holds codes, or of a quotient."""
        bracket = self.partner.get(at + 1)
        if bracket is None or self.text(bracket + 1) != "{" or bracket + 1 not in self.partner:
            return
        tens = self.text(bracket - 2) in ("/", "%") and (self.whole(bracket - 1) or 0) >= 10
        if not tens and not self.holds_code(self.chain_before(bracket)):
            return
        for place in range(bracket + 2, self.partner[bracket + 1]):
            if self.text(place) == "case" and self.text(place + 2) == ":" and 1 <= (self.whole(place + 1) or 0) <= 9 and self.kind(place + 1) == "number":
                yield place

    def function_object(self, at):
        """std::equal_to<int>{}(v, 41), std::find(v.begin(), v.end(), 41)."""
        opening = next((p for p in range(at + 1, at + 8) if self.text(p) == "("), None)
        if opening is None or opening not in self.partner:
            return None
        return "plain" if any((self.whole(p) or 0) >= 10 for p in range(opening + 1, self.partner[opening])) else None


def hidden_in(tokens, partner, constants):
    """(place, kind) of each."""
    hidden = Hidden(tokens, partner, constants)
    for at, token in enumerate(tokens):
        checks = ()
        if token.text in COMPARE:
            checks = (hidden.compared, hidden.field, hidden.choice, hidden.byte, hidden.sum, hidden.distance, hidden.range, hidden.digits)
        elif token.text in ("-", "^"):
            checks = (hidden.none_of,)
        elif token.text in ("equal_to", "not_equal_to") or token.text == "find" and hidden.text(at - 1) == "::":
            checks = (hidden.function_object,)
        elif token.text == "switch":
            yield from ((place, "code") for place in hidden.case(at))
        elif token.kind in ("string", "char") and ESCAPED.search(token.text):
            yield at, "letter"
        if token.text in ("[", "(", "+"):
            checks = (hidden.element,)
        kind = next(filter(None, (check(at) for check in checks)), None)
        if kind is not None:
            yield at, kind
