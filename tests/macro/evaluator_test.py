#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Expressions of user macros in `ncsim trace` against an evaluator that shares nothing with it: a recursive descent over the text in
another language, rational numbers without rounding, sines and arcs from their series in fifty digits (M700 13.5.4, 13.5.6, 13.5.7).

The texts are random: operators and functions in their long and short spellings and any case, blanks, brackets that are needed and brackets
that are not, indirect variables, vacant ones, comparisons. Where the rules have an error the program must raise its alarm.
"""
import decimal
import json
import os
import random
import re
import subprocess
import sys
import tempfile
from fractions import Fraction

PROGRAMS = 6
EXPRESSIONS = 250     # of each program
ERRORS = 60           # programs of one expression that is wrong
CLOSE = 1e-9
decimal.getcontext().prec = 60
D = decimal.Decimal


class Wrong(Exception):
    """The alarm that the manual has for the expression."""


class Delicate(Exception):
    """The result would depend on the last bit of a double, so that it is no test case."""


class Number:
    """A rational number. `exact`: a double holds it exactly, and everything from which it was computed."""

    def __init__(self, value, exact=False):
        self.value = Fraction(value)
        if abs(self.value) > 10 ** 12 or (self.value != 0 and abs(self.value) < Fraction(1, 10 ** 9)):
            raise Delicate
        denominator = self.value.denominator
        self.exact = exact and denominator & (denominator - 1) == 0 and denominator <= 2 ** 20

    def decimal(self):
        return D(self.value.numerator) / D(self.value.denominator)


def from_decimal(value):
    return Number(Fraction(value))


PI = D("3.14159265358979323846264338327950288419716939937510582097494459230781640628620899")


def sine(x):
    x %= 2 * PI
    term, total, n = x, x, 1
    while abs(term) > D(10) ** -55:
        term = -term * x * x / ((n + 1) * (n + 2))
        total += term
        n += 2
    return total


def arc_tangent(x):
    if abs(x) > 1:
        return (PI / 2).copy_sign(x) - arc_tangent(1 / x)
    if abs(x) > D("0.1"):
        return 2 * arc_tangent(x / (1 + (1 + x * x).sqrt()))
    term, total, n = x, x, 1
    while abs(term) > D(10) ** -55:
        term = -term * x * x
        n += 2
        total += term / n
    return total


def degrees(x):
    return from_decimal(x * 180 / PI)


def arc_sine(x):
    if abs(x) > 1:
        raise Wrong("P282")
    return PI / 2 * (1 if x > 0 else -1) if abs(x) == 1 else arc_tangent(x / (1 - x * x).sqrt())


def to_integer(x, rule):
    """FIX, FUP and ROUND: values near the border between two results are no test case, unless they are exactly there."""
    border = Fraction(1, 2) if rule == "ROUND" else Fraction(0)
    distance = abs((abs(x.value) + border) - round(abs(x.value) + border))
    if distance < Fraction(1, 10 ** 6) and not x.exact:
        raise Delicate
    size = abs(x.value)
    whole = size.numerator // size.denominator
    if rule == "FUP" and whole != size:
        whole += 1
    if rule == "ROUND" and size - whole >= Fraction(1, 2):
        whole += 1
    return Number(whole if x.value >= 0 else -whole, True)


def bits(x):
    if x.value.denominator != 1 or not 0 <= x.value < 2 ** 31:
        raise Delicate  # what OR does with other numbers is not said
    return int(x.value)


def call(name, x):
    name = {"SQR": "SQRT", "ATN": "ATAN", "RND": "ROUND"}.get(name, name)
    if name in ("FIX", "FUP", "ROUND"):
        return to_integer(x, name)
    if name == "ABS":
        return Number(abs(x.value), x.exact)
    if name == "SQRT":
        if x.value < 0:
            raise Wrong("P282")
        return from_decimal(x.decimal().sqrt())
    if name == "LN":
        if x.value <= 0:
            raise Wrong("P282")
        return from_decimal(x.decimal().ln())
    if name == "EXP":
        if abs(x.value) > 20:
            raise Delicate
        return from_decimal(x.decimal().exp())
    if name in ("BIN", "BCD"):
        n = bits(x)
        if n > 99999999 or (name == "BIN" and not re.fullmatch("[0-9]*", f"{n:x}")):
            raise Delicate
        return Number(int(f"{n:x}") if name == "BIN" else int(str(n), 16), True)
    if name in ("ASIN", "ACOS"):
        if not x.exact and abs(abs(x.value) - 1) < Fraction(1, 10 ** 6):
            raise Delicate
        arc = arc_sine(x.decimal())
        return degrees(arc if name == "ASIN" else PI / 2 - arc)
    if name == "ATAN":
        return degrees(arc_tangent(x.decimal()))
    if abs(x.value) > 10000:
        raise Delicate
    angle = x.decimal() * PI / 180
    s, c = sine(angle), sine(angle + PI / 2)
    if name == "TAN":
        if abs(c) < D("0.001"):
            raise Delicate
        return from_decimal(s / c)
    return from_decimal(s if name == "SIN" else c)


class Evaluator:
    TOKEN = re.compile(r"\s*(\d+\.?\d*|\.\d+|SQRT|SQR|ATAN|ATN|ASIN|ACOS|SIN|COS|TAN|ABS|BIN|BCD|ROUND|RND|FIX|FUP|LN|EXP|MOD|AND|XOR|OR|EQ|NE|GT|LT|GE|LE|.)")

    def __init__(self, text, variables):
        self.tokens = self.TOKEN.findall(text.upper().strip())
        self.at = 0
        self.variables = variables
        self.depth = 0

    def peek(self):
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def take(self, *wanted):
        if self.peek() not in wanted:
            return ""
        self.at += 1
        return self.tokens[self.at - 1]

    def whole(self):
        """The value, or None: vacant, which only a variable by itself is."""
        if re.fullmatch(r"\s*#\d+\s*", "".join(self.tokens)):
            return self.variables.get(int("".join(self.tokens).strip().lstrip("#")))
        return self.sum()

    def sum(self):
        left = self.product()
        while operator := self.take("+", "-", "OR", "XOR"):
            right = self.product()
            if operator in "+-":
                left = Number(left.value + (right.value if operator == "+" else -right.value), left.exact and right.exact)
            else:
                left = Number(bits(left) | bits(right) if operator == "OR" else bits(left) ^ bits(right), True)
        return left

    def product(self):
        left = self.factor()
        while operator := self.take("*", "/", "MOD", "AND"):
            right = self.factor()
            if operator == "*":
                left = Number(left.value * right.value, left.exact and right.exact)
            elif operator == "AND":
                left = Number(bits(left) & bits(right), True)
            else:
                if right.value == 0:
                    raise Wrong("P283")
                if operator == "/":
                    left = Number(left.value / right.value, left.exact and right.exact)
                else:
                    if not (left.exact and right.exact) or left.value < 0 or right.value < 0:
                        raise Delicate  # the sign of the remainder is not said
                    left = Number(left.value - right.value * (left.value // right.value), True)
        return left

    def factor(self):
        if self.take("-"):
            x = self.factor()
            return Number(-x.value, x.exact)
        if self.take("["):
            self.depth += 1
            if self.depth > 5:
                raise Wrong("P280")
            x = self.sum()
            self.close()
            return x
        if self.take("#"):
            return self.variable()
        token = self.tokens[self.at]
        self.at += 1
        if token[0].isdigit() or token[0] == ".":
            return Number(Fraction(token if token[-1] != "." else token[:-1]), True)
        if not self.take("["):
            raise AssertionError("generator")
        self.depth += 1
        if self.depth > 5:
            raise Wrong("P280")
        x = self.sum()
        self.close()
        return call(token, x)

    def close(self):
        if not self.take("]"):
            raise Wrong("P281")
        self.depth -= 1

    def variable(self):
        if self.take("#"):
            number = self.variable()
        elif self.peek() == "[":
            self.take("[")
            self.depth += 1
            if self.depth > 5:
                raise Wrong("P280")
            number = self.sum()
            self.close()
        else:
            number = Number(int(self.tokens[self.at]))
            self.at += 1
        if number.value not in self.variables and number.value != 0:
            raise Delicate
        found = self.variables.get(int(number.value))
        return Number(0, True) if found is None else found


class Writer:
    FUNCTIONS = ["SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN", "ATN", "SQRT", "SQR", "ABS", "BIN", "BCD", "ROUND", "RND", "FIX", "FUP", "LN", "EXP"]

    def __init__(self, seed):
        self.random = random.Random(seed)

    def blank(self):
        return " " * self.random.choice([0, 0, 0, 1, 2])

    def case(self, word):
        return self.random.choice([word, word.lower(), word.capitalize()])

    def atom(self, depth):
        kind = self.random.randrange(10)
        if kind < 4:
            return self.random.choice(["%d", "%d.", "%d.5", "%d.0625", ".%d"]) % self.random.randrange(0, 400)
        if kind < 6:
            return f"#{self.random.choice([0, 1, 2, 3, 4, 5, 6, 7, 8, 9])}"
        if kind == 6:
            return f"#{self.blank()}#{self.random.choice([10, 11])}"
        if kind == 7 and depth > 0:
            return f"#[{self.random.choice([1, 2, 3])}+{self.random.choice([1, 2])}]"
        if kind == 8 and depth > 0:
            return "[" + self.expression(depth - 1) + "]"
        if depth > 0:
            return self.case(self.random.choice(self.FUNCTIONS)) + self.blank() + "[" + self.blank() + self.expression(depth - 1) + "]"
        return str(self.random.randrange(1, 40))

    def expression(self, depth):
        text = self.random.choice(["", "", "", "-"]) + self.atom(depth)
        for _ in range(self.random.choice([0, 0, 1, 1, 2, 3])):
            operator = self.random.choice(["+", "-", "*", "/", "+", "-", "*", "/", "MOD", "AND", "OR", "XOR"])
            text += self.blank() + (self.case(operator) if operator.isalpha() else operator) + self.blank() + self.atom(depth)
        return text


VALUES = {1: 1, 2: 2.5, 3: -7, 4: 12, 5: 0, 6: 100.125, 7: 0.5, 8: 37, 10: 4, 11: 2}   # #9 is vacant, #0 always
VARIABLES = {n: Number(v, True) for n, v in VALUES.items()} | {9: None, 0: None}
HEAD = "".join(f"#{n}={v}\n" for n, v in VALUES.items())
COMPARISONS = ["EQ", "NE", "GT", "LT", "GE", "LE"]


def evaluate(text):
    return Evaluator(text, VARIABLES).whole()


def compare(left, operator, right):
    """13.5.4: vacant differs from 0 for EQ and NE, and is 0 for the others."""
    if operator in ("EQ", "NE"):
        same = (left is None) == (right is None) and (left is None or left.value == right.value)
        return same == (operator == "EQ")
    a, b = (Fraction(0) if x is None else x.value for x in (left, right))
    return {"GT": a > b, "LT": a < b, "GE": a >= b, "LE": a <= b}[operator]


def run(ncsim, folder, program):
    path = os.path.join(folder, "p.nc")
    with open(path, "w", encoding="ascii") as stream:
        stream.write(program)
    done = subprocess.run([ncsim, "trace", path], capture_output=True, text=True, check=False)
    lines = [json.loads(line) for line in done.stdout.splitlines()]
    alarms = [line for line in lines if line["t"] == "alarm"]
    return (alarms[0] if alarms else None), lines[-1].get("vars", {})


def make_good(writer):
    """A statement of one or more lines that leaves its value in the variable %d, and that value."""
    while True:
        try:
            if writer.random.randrange(4) != 0:
                text = writer.expression(writer.random.choice([1, 2, 3]))
                return f"#%d={text}\n", evaluate(text)
            left, right = writer.expression(1), writer.expression(1)
            operator = writer.random.choice(COMPARISONS)
            a, b = evaluate(left), evaluate(right)
            near = a is not None and b is not None and a.value != b.value and abs(a.value - b.value) < Fraction(1, 10 ** 6) * (1 + abs(a.value))
            inexact = a is not None and b is not None and a.value == b.value and not (a.exact and b.exact)
            if near or inexact:
                continue
            holds = compare(a, operator, b)
            spelled = f"{left}{writer.blank()} {writer.case(operator)} {right}"
            return f"#%d=0\nIF [{spelled}] GOTO %d\nGOTO %d\nN%d #%d=1\nN%d\n", Number(1 if holds else 0, True)
        except (Delicate, Wrong, ZeroDivisionError, decimal.DecimalException):
            continue


def make_wrong(writer):
    while True:
        text = writer.expression(writer.random.choice([1, 2, 6, 7]))
        try:
            if writer.random.randrange(6) == 0 and "]" in text:
                at = text.rindex("]")
                evaluate(text)
                return text[:at] + text[at + 1:], "P281"
            evaluate(text)
        except Wrong as wrong:
            return text, str(wrong)
        except (Delicate, ZeroDivisionError, decimal.DecimalException):
            pass


def numbered(statement, variable):
    if statement.count("%d") == 1:
        return statement % variable
    yes, behind = 10000 + variable, 20000 + variable
    return statement % (variable, yes, behind, yes, variable, behind)


def main():
    ncsim = os.path.join(os.environ["NC_BINARY_DIR"], "bin", "ncsim")
    failures, seen = 0, 0
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(PROGRAMS):
            writer = Writer(seed)
            statements = [make_good(writer) for _ in range(EXPRESSIONS)]
            program = HEAD + "".join(numbered(text, 500 + i) for i, (text, _) in enumerate(statements)) + "M30\n"
            alarm, values = run(ncsim, folder, program)
            if alarm:
                line = program.splitlines()[alarm["line"] - 1]
                print(f"program {seed}: {alarm['code']} in line {alarm['line']}: {line}")
                failures += 1
                continue
            for i, (text, expected) in enumerate(statements):
                found = values.get(str(500 + i))
                seen += 1
                if expected is None or found is None:
                    good = expected is None and found is None
                else:
                    good = abs(found - float(expected.value)) <= CLOSE * (1 + abs(float(expected.value)))
                if not good:
                    print(f"{text.strip()!r}: {found}, not {None if expected is None else float(expected.value)}")
                    failures += 1
        writer = Writer(1000)
        codes = set()
        for _ in range(ERRORS):
            text, expected = make_wrong(writer)
            codes.add(expected)
            alarm, _ = run(ncsim, folder, HEAD + f"#500={text}\nM30\n")
            if alarm is None or alarm["code"] != expected:
                print(f"{text!r}: {alarm and alarm['code']}, not {expected}")
                failures += 1
    print(f"{seen} values, {ERRORS} errors of {sorted(codes)}: {failures} differ")
    return 1 if failures or seen < PROGRAMS * EXPRESSIONS or len(codes) < 4 else 0


if __name__ == "__main__":
    sys.exit(main())
