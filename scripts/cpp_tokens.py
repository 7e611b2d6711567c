# SPDX-License-Identifier: Apache-2.0
"""Sources of C++ as tokens, and the words of their names: what scripts/check-meaning reads."""
import collections
import re

Token = collections.namedtuple("Token", "kind text line")

TOKEN = re.compile(r"""
    (?P<space>\s+|\\\n)
  | (?P<comment>//(?:\\\n|[^\n])*|/\*.*?\*/)
  | (?P<raw>(?:u8|[uUL])?R"(?P<mark>[^()\\\s]{0,16})\(.*?\)(?P=mark)")
  | (?P<string>(?:u8|[uUL])?"(?:\\.|[^"\\\n])*")
  | (?P<char>(?:u8|[uUL])?'(?:\\.|[^'\\\n])+')
  | (?P<number>\.?\d(?:[eEpP][+-]|'(?=\w)|[\w.])*)
  | (?P<name>[A-Za-z_]\w*)
  | (?P<mark_>->\*|<=>|<<=|>>=|\.\.\.|->|::|\+\+|--|==|!=|<=|>=|&&|\|\||<<|>>|[-+*/%&|^]=|.)
""", re.X | re.S)


def tokens_of(source):
    """The tokens of a file without blanks and comments. An include is one token of kind 'include'."""
    tokens, line, at = [], 1, 0
    while at < len(source):
        match = TOKEN.match(source, at)
        kind, text = match.lastgroup, match.group()
        if kind == "mark":
            kind = "raw"
        if text == "#" and (not tokens or tokens[-1].line != line):  # of a directive only the name is skipped
            include = re.compile(r'#[ \t]*include[ \t]*["<]([^">\n]*)[">]').match(source, at)
            if include:
                tokens.append(Token("include", include.group(1), line))
                at = include.end()
                continue
            word = re.compile(r"#[ \t]*\w*").match(source, at)
            at = word.end()
            if word.group().endswith("define"):  # treated as a constant
                tokens += [Token("name", "const", line), Token("name", "int", line)]
                if defined := re.compile(r"[ \t]+([A-Z]\w*)[ \t]+(\d+)[ \t]*(?=$|/)", re.M).match(source, at):
                    tokens += [Token("name", defined.group(1), line), Token("mark", "=", line), Token("number", defined.group(2), line),
                               Token("mark", ";", line)]
                    at = defined.end()
            continue
        if kind not in ("space", "comment"):
            tokens.append(Token({"raw": "string", "mark_": "mark"}.get(kind, kind), text, line))
        line += text.count("\n")
        at = match.end()
    return tokens


def value_of(token):
    """The value of a number; None for any other token."""
    if token is None or token.kind != "number":
        return None
    text = token.text.replace("'", "").lower()
    try:
        if text.startswith(("0x", "0b")):
            return int(text.rstrip("ul"), 0)
        if re.fullmatch(r"\d+[ulz]*", text):
            digits = text.rstrip("ulz")
            return int(digits, 8) if re.fullmatch(r"0[0-7]+", digits) else int(digits)
        return float(text.rstrip("fl"))
    except ValueError:
        return None


def written_hex(token):
    return token.text.lower().startswith(("0x", "0b"))


def words_in(name):
    """The words of an identifier: kGroupUnit -> group, unit; start_plane_ -> start, plane."""
    parts = re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])|\d+", name.replace("_", " "))
    return [word.lower() for word in parts]


def meant(name):
    """The word of an identifier that says what it holds: the last one, but of code_of the one before."""
    words = words_in(name)
    if len(words) > 1 and words[-1] in ("of", "at", "in"):
        words.pop()
    return words[-1] if words else ""


def called_after(family, name):
    """Whether an identifier contains the family as a whole word: m700_seconds, isM700, kDgshape. A part of a word of capitals is none: OPEN."""
    for match in re.finditer(re.escape(family), name, re.I):
        first, last = match.span()
        begins = first == 0 or name[first - 1] == "_" or (name[first].isupper() and not name[first - 1].isupper())
        new_word = name[last:last + 1].isupper() and (not name[last - 1].isupper() or name[last + 1:last + 2].islower())
        ends = last == len(name) or name[last] == "_" or new_word
        if begins and ends:
            return True
    return False


def is_type(name):
    return name in ("int", "unsigned", "long", "short", "double", "auto") or name.endswith("_t") or name[:1].isupper()


def constants_in(tokens):
    """(name, value) of the constants and enumerators that are numbers: kInch = 200, constexpr int kInch{200}."""
    for at in range(1, len(tokens) - 2):
        name, mark, number = tokens[at:at + 3]
        if name.kind == "name" and mark.text in ("=", "{") and number.kind == "number" and not written_hex(number):
            end = tokens[at + 3].text if at + 3 < len(tokens) else ";"
            declared = tokens[at - 1].kind == "name" or tokens[at - 1].text in ("{", ",", ">")
            fixed = re.match(r"k[A-Z0-9]", name.text) or name.text.isupper() or "const" in tokens[at - 2].text
            if end in (";", ",", "}") and declared and fixed and value_of(number) is not None:
                yield name.text, value_of(number)
