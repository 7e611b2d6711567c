#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""scripts/check-meaning finds a sample of each kind, and finds nothing in code that only looks like one."""
import importlib.machinery
import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ.get("NC_SOURCE_DIR", pathlib.Path(__file__).resolve().parents[2]))
SCRIPT = SOURCE / "scripts" / "check-meaning"
sys.dont_write_bytecode = True
loader = importlib.machinery.SourceFileLoader("check_meaning", str(SCRIPT))
spec = importlib.util.spec_from_loader("check_meaning", loader)
checker = importlib.util.module_from_spec(spec)
loader.exec_module(checker)

PLANTED = {
    "identity": [
        "if (in.dialect->id == other) return;",
        "if (dialect.id != wanted) return;",
        "const bool wide = NC_DIALECT_M700 == config.dialect;",
        "bool f(nc_dialect d) { return d == NC_DIALECT_DGSHAPE; }",
        "if (config.dialect == wanted) return;",
        "switch (config.dialect) { default: break; }",
        "switch (in.dialect->id) { default: break; }",
        "if (same(in.dialect->name, other)) return;",
        'if (name == "m700") return;',
        "static_assert(NC_DIALECT_COUNT == 2);",
        "if (!config.dialect) return;",
        "if (config.dialect) return;",
        "const int shown = config.dialect && wide;",
        "const unsigned d = config.dialect;\nbool f() { return d == 1; }",
        "if (in.dialect->most_offsets == 400) return;",
        "if (in.dialect->most_offsets > 200) return;",
        "if (rules.macro.levels != 4) return;",
        "return 187 == dialect.functions.size();",
    ],
    "family": [
        '#include "dialect/m700/tables.hpp"',
        '#include "motion/m700_accuracy.hpp"',
        "double m700_seconds(double raw);",
        "const bool dgshape = rules.one_thing;",
        "Execution scale_dgshape(Interpreter& in);",
        "if (isM700) return;",
        "inline constexpr bool kDgshape = true;",
        "return nc::m700::kDialect;",
    ],
    "code": [
        "if (in.state.modal.code[kPlane] == 170) return;",
        "if (m == 6) return;",
        "if (mode == 3) return;",
        "if (2 == plane) return;",
        "return code_value == 4;",
        "switch (misc) { case 3: stop(); }",
        "switch (v / 10) { case 4: stop(); }",
        "if (code - 4 == 0) return;",
        "constexpr int kFour = 4;\nif (motion == kFour) return;",
        "if (170 == in.state.modal.code[kPlane]) return;",
        "if (modal.code[kMotion] != 0) return;",
        "if (modal[kMotion] == 20) return;",
        "if (row->code >= 730 && ok) return;",
        "const bool arc = code == 20;",
        "if (static_cast<int>(row.code) == 541) return;",
        "if ((code) == 20) return;",
        "if (m == 98) return;",
        "if (word.letter == 'G' && motion == 33) return;",
        "const int16_t length = modal.code[kLength];\nif (length == 430) return;",
        "auto now = row->code;\nbool f() { return 10 < now; }",
        "state.modal.code[kCycle] = 800;",
        "state.modal.code[kMotion] = 0;",
        "int16_t start_plane = 170;",
        "code = rotated ? 680 : 690;",
        "switch (code) { case 0: return; default: break; }",
        "switch (f(x)) { case 330: return; }",
        "for (const int16_t code : {410, 420}) use(code);",
        "constexpr int16_t kRefused[] = {20, 30, 330};",
        "constexpr BarredRow kBarred[] = {{kInFigure, 450, 450, Condition::none}};",
        "constexpr std::array<CodeRow, 1> kRows[] = {{410, true}};",
        "return in.raise(Condition::words_missing, 'G', 4);",
        "return in.raise(Condition::nesting, 'M', 98);",
        "in.raise(Condition::illegal_g, 'G', 92.1);",
        "in.raise(Condition::arc, 'G', side > 0 ? 41 : 42);",
        "in.raise(Condition::arc,\n  'G' /* here */, // there\n  41);",
        "Execution select_plane(Interpreter& in, int16_t code);\nvoid f() { select_plane(in, 180); }",
        "if (code == 2'0) return;",
        "constexpr int16_t kInch = 200;\nbool f(int code) { return code == kInch; }",
        "#define INCH 200\nbool f(int code) { return code == INCH; }",
        "enum { kInch = 200, kMetric = 210 };\nbool f(int code) { return kMetric != code; }",
        "if (what.code == static_cast<int16_t>(200)) return;",
        "if (what.code == int16_t(200)) return;",
        "if (code == 0xC8) return;",
        "if (code / 10 == 20) return;",
        "if (code - 200 == 0) return;",
        "if (!(row.code - 200)) return;",
        "if ((code ^ 200) == 0) return;",
        "if (row.code() == 200) return;",
        "if (code_of(row) == 200) return;",
        "if (std::lround(10 * code) == 200) return;",
        "if (abs(code) == 200) return;",
        "if (std::clamp(code, 540, 590) == code) return;",
        "if (address == 'M' && value == 6) return;",
        "constexpr double kToolChange = 6;\nconst bool changes = address == 'M' && value == kToolChange;",
        "if (value == 541 && 'G' == address) return;",
        "for (const auto& [a, b] : {std::pair{'M', \"98\"}, {'G', \"66.1\"}}) use(a, b);",
        "const bool external = has(block, 'M', \"198\");",
        "bool f(int code) { return within(code, 540, 590); }",
        "const std::set<int> kCodes{200, 210};",
        "constexpr std::array kCodes = {200, 210};",
        'if (std::strcmp(text, "G20") == 0) return;',
        'if (text == "M98") return;',
        'if (text.starts_with("G54.1")) return;',
    ],
    "group": [
        "if (row->group == 7) return;",
        "if (group_now != 7) return;",
        "if (modal.code[3] == wanted) return;",
        "use(state.modal.shown[12]);",
        "enum Group { kGroupMotion };",
        "switch (row.group) { case 1: return; default: break; }",
        "if (mode.group() == 7) return;",
    ],
    "number": [
        "if (number == 3003) return;",
        "if (in_range(number, 150, 199)) return;",
        "if (a.number >= 7000) return;",
        "if (10000 <= variable) return;",
        "switch (number) { case 1012: return; default: break; }",
        "switch (x) { case 3001: return; }",
        "constexpr Range kRanges[] = {{1000, 1031, true}};",
        "constexpr ParameterRow kTable[] = {{8621, 8621, 1}};",
        "return in.raise(Condition::variable_number, '#', 3001);",
        "double whole(const Store& s, unsigned parameter);\nvoid f() { whole(s, 1081); }",
        "if (first == 5221) return;",
        "if (what - 5001 < 20) return;",
        "use(vars[5001]);",
        "const double q = t.get(8090);",
        "use(parameter_value(t, 8090));",
        "constexpr uint32_t kUnit = 1041;\nbool f(uint32_t number) { return number == kUnit; }",
    ],
    "letter": ["if (word.letter == 'P') return;", "return in.raise(Condition::value_range, 'R');", "switch (letter) { case 'G': return; default: break; }",
               'if ("GM"[0] == letter) return;', 'if (std::strchr("IJK", letter) != nullptr) return;', 'const size_t at = "GM"sv.find(letter);',
               "if (p[0] == 0x47 && p[1] == other) return;", "return 0x4d == c;", 'return std::memcmp(p, "\\x47\\x34", 2) == 0;', "return c == '\\x47';"],
    "word": [
        "for (const Word& word : block.words) use(word);",
        "if ((form & kWordPoint) != 0) return;",
        "if (in.block->words.size() > 1) return;",
        "copy.words.clear();",
        "const double r = words.raw[at];",
        "use(word.letter);",
        "action.letter = name;",
        "char second_letter = 0;",
        "const unsigned at = address_of(name);",
        "out.put(letter_of(word));",
        "const int axis = in.axis_words.axis(word_named(name));",
        "if (addresses.at(a) == addresses.at(b)) return;",
        "raise(condition, in.dialect->addresses.letter(Role::feed));",
        "if (dialect.addresses.is(c, Role::code)) return;",
        "const auto name = in.system->axis[i].name;",
        "int8_t axis_of[kAddresses];",
        "const LexRules& lex = *dialect->lex;",
        "if (axis >= 'A' && axis <= 'Z') return;",
        "if (c == 'x') return;",
        "bool f(char name) { return name == other; }",
        "const char a = basic, b = parallel;\nbool f() { return a != b; }",
        '#include "program/block.hpp"',
        '#include "dialect/iso_lexer.hpp"',
    ],
    "numbered": ["const bool waits = settings.shared_100 != 0;", "constexpr uint32_t kLast500 = 999;", "if (last_100_ < other) return;", "raise(Condition::g10_l);",
                 "if (settings.clamp_in_g96_only) return;", "constexpr bool kOnlyInG96 = true;"],
    "plain": ["s.last = last_shared(parameter, 100, 199, 0);", "constexpr uint32_t kBegin = 100, kEnd = 199;\nconst auto n = up_to(last, kBegin, kEnd);", "for (uint32_t n = 100; n <= 199; ++n) clear(n);", "if (v >= 540 && v <= 599) return;", "if (v == 20 * 10) return;", "return v != 100 + 100;", "if (is<200>(v)) return;", "if (value == 200) return;", "if (letter == 71) return;", "const bool set = 104 != a.written;", "if (std::fabs(x) == 30.0) return;",
              "if (value == 0x29a) return;", "if (n / 1000 == 5) return;", "if (n % 1000 == 132) return;", "if (static_cast<int>(what) == 3) return;", "if (std::abs(n - 41) <= 1) return;",
              "return (g & 15) == 1;", "return (v & 0xff) == 0x29;", "return ((v >> 4) & 15) == 9;", "return arr[41];", "return rows[2][41];", "return seen()[98];", "return state.amounts[0x29];", "return cells.at(41);",
              "return bits.test(41);", "return *(table + 41);", "return v == (inch ? 20 : 21);", "return !(v - 41);", "return (v ^ 41) == 0;",
              "enum { kThis = 41 };\nbool f(int v) { return v == kThis; }", "return std::equal_to<int>{}(v, 41);", "return std::find(first, last, 41) != last;",
              "return v == 4 * 10 + 1;", "return -v == -41;", "return v * 10 == 410;", "return static_cast<unsigned>(v - 40) < 3;", "return 41 <= v && v <= 43;",
              "return v < 44 && v >= 41;", 'return t == "41";',
              "const int these[] = {41, 42};", "static constexpr uint16_t kThese[2] = {28, 30};"],
    "range": [  # as they stood in the core before the families had them
        "return whole_number(value, number) && *number <= 99999999 ? done : raise();",
        "if (!(a.written >= 1) || a.written > 9999) return;",
        "constexpr double kMinute_ms = 60000, kMostMinutes = 4000;",
        "constexpr double kLargestVector = 1, kLargestAngle = 360;",
        "bool in_position_range(double mm) { return mm < 999.999 + 1e-9; }",
        "const double end = 99.999999;",
        "if (value > 1000 - unit + kNoise) return;",
        "s_.last_mm = 100000 - s_.setting_unit_mm;",
        "if (a.written * unit > 244335917226.0) return;",
        "if (d.high < 2000 || d.high > 2099) return;",
        "m.code = whole({P::m_call_code, i}, 9999);",
        "double lead = 0, limit = 1000;",
        "if (lead < (inch ? 10000 : 1000)) return;",
        "constexpr double kLast[3] = {99999, 1, 8};",
    ],
    "key": ['get("1078", -1, &value);', 'get("1267/bit0");', 'return number("8621");'],
    "text": ['say("no effect while #8107 is 0");', 'const char* why = R"(set #1037)";'],
    "alarm": ['if (alarm.code == "P62") return;', 'return !strcmp(code, "P130");'],
}
INNOCENT = [
    "// if (code == 20) NC_DIALECT_M700, #1078",
    "/* raise(x, 'G', 41); */",
    'say("G41 is M700 12.4.1, code == 20");',
    "if (in.dialect == nullptr) return;",
    "const Dialect& d = nc::dialect(config.dialect);",
    "if (modal.code[kPlane] < 0) return;  // no such group",
    "if (modal.is(Function::inch)) return;",
    "in.raise(condition, 'G', row->code / 10.0);",
    "in.raise(condition, 'G', value);",
    "in.raise(condition, 'P', 42);",
    "unsigned code = 0;",
    "line.put(info.modal[0] ? info.modal : nothing);",
    "FixedVector<uint32_t, 16> m;",
    "std::array<char, 20> code;",
    "if (exit_code == 20) return;",
    "if (i < 20 || radius > 170 || count < 3003) return;",
    "static_assert(sizeof(Entry) == 24);",
    "if (length % 64 == 32 || name.size() == 48 || bits == 0x41) return;",
    'const char* end = text.find("XYZ");',
    "if (length > 170) return;",
    "switch (state) { case 1: return; case 2: return; default: break; }",
    "switch (letter) { case 'G': return; default: break; }",
    "constexpr double kFactor[] = {10, 20, 30};",
    "constexpr uint32_t kSpread[] = {10, 20, 30};",
    "const uint32_t number = word << 10;",
    "unsigned kMaxNumber = 127;",
    "if (number > 4294967295.0) return;",
    "point.code = code;",
    'open("1078.txt");',
    "const double one_shot = raw / 1000;",
    "#define NUMBER_OF(x) x",
    "constexpr unsigned kMostCodes = 200;\nbool f(unsigned code) { return code < kMostCodes; }",
    "constexpr int kHalvings = 20;\nbool f(int m) { return m < kHalvings; }",
    "if (number - first < 3) return;",
    "if (code / 10 == other) return;",
    "if (code % 10 != 0) return;",
    "use(config.dialect);",
    "if (f(config.dialect)) return;",
    "const unsigned d = config.dialect;\nvoid f() { use(d); }",
    "use(table[5001]);",
    "const std::vector<double> lengths{200, 210};",
    "for (unsigned i = 0; i < 200; ++i) use(i);",
    "if (in_range(length, 100, 149)) return;",
    "const uint32_t bits = uint32_t(x) ^ kSha256;",
    "if (letter == 'M' && count == most) return;",
    "put('M', \"units\");",
    'say("G54 to G59, P62");',
    "if ((flags & 3) == 3 || (flags & 4) != 0) return;",
    "char line[160]; char lines[16][80]; double axis[2] = {0, 0};",
    "use(axis[2], rules.block.wide, row[i + 1]);",
    "use(character[0x70]);",
    "if (rules.macro.levels == level || dialect->most_offsets > 0) return;",
    "if (count == 4 || motion_count == 4 || kMotion == 3) return;",
    "if (m == 0 || plane == none) return;",
    "if (c == 0x0a || c == 0x7f) return;",
    "if (x < 0.5 && x > -0.5) return;",
    "return std::find(first, last, wanted) != last;",
    'if (t == "on") return;',
    "if (v - first == 0) return;",
]


def kinds(text, path="libnc/src/interpret/x.hpp"):
    return [finding.kind for finding in checker.findings_in(SOURCE, {path: text})]


class Found(unittest.TestCase):
    def test_each_planted_sample_is_found(self):
        for kind, samples in PLANTED.items():
            for sample in samples:
                with self.subTest(kind=kind, sample=sample):
                    self.assertIn(kind, kinds(sample))

    def test_what_only_looks_like_one_is_not(self):
        for sample in INNOCENT:
            with self.subTest(sample=sample):
                self.assertEqual(kinds(sample, "runtime/x.hpp"), [])

    def test_ranges_are_for_the_rooms_that_hold_values_to_them(self):
        for sample in ("if (x > 0.999) return;", "if (value >= 0 && value <= 4294967295.0) return;", "constexpr unsigned kMostShapes = 256;", "const double per_s = value / 1000;",
                       "if (std::fabs(value) < 2147483647.5) return;", "constexpr double kAnyFeed = 1e12;", "days = days - 1000 * x;", "Pool<Entry, 1000> pool;",
                       "if (359.9999 - angle > noise) return;", "constexpr unsigned kMost = 8;", "use(value * 1e4 - std::nearbyint(value));"):
            with self.subTest(sample=sample):
                self.assertNotIn("range", kinds(sample))
        for sample in PLANTED["range"]:
            with self.subTest(sample=sample):
                self.assertNotIn("range", kinds(sample, "libnc/src/motion/x.cpp"))

    def test_plain_numbers_that_are_none_of_a_family(self):
        for sample in ("if (file != 0xffff) return;", "if ((bits & 0x30) == 0x20) return;", "if (n % 1000 == 0) return;", "if (n % 10 == 5) return;", "if (static_cast<int>(what) == 0) return;",
                       "if (std::abs(x - y) <= 1) return;", "constexpr uint32_t kPowers[] = {10, 100, 1000};", "const int quarters[] = {90, 180, 360};", "const int few[] = {1, 2, 41};"):
            with self.subTest(sample=sample):
                self.assertEqual(kinds(sample), [])

    def test_letters_are_for_the_core_alone_to_avoid(self):
        for sample in ("if (c >= 'A' && c <= 'Z') return;", "const char digit = '0';", "const char separator = ',';"):
            with self.subTest(sample=sample):
                self.assertEqual(kinds(sample, "libnc/src/macro/x.hpp"), [])
        self.assertEqual(kinds("if (key == 'P') return;", "tools/lib/x.cpp"), [])

    def test_words_are_read_in_other_rooms_than_interpret(self):
        for sample in PLANTED["word"]:
            with self.subTest(sample=sample):
                self.assertNotIn("word", kinds(sample, "libnc/src/command/x.hpp"))
        for sample in ("if (words.has(Role::feed)) return in.raise(Condition::value_range, Role::feed, words.get(Role::feed));",
                       "const WordSlot word = in.axis_words.word(i);", "if (second == kNoWord || holds(known, second)) return;",
                       "const Table<ModalWord>& words = dialect->variables->words;", "a.word = word_of_capital(whole({P::ascii_call_letter, i}, 0));",
                       "if (n >= 0 && n < kLimit) return;", "if (bits == 3 * kStride) return;", "FixedVector<uint32_t, 16> m(in);", "std::get<1>(pair);",
                       "if (!is_letter(text[0])) return;", "char line[160];", "double f(double raw);", "out.put(',');"):
            with self.subTest(sample=sample):
                self.assertEqual(kinds(sample), [])

    def test_the_public_header_declares_the_ids(self):
        declared = "typedef enum nc_dialect { NC_DIALECT_M700 = 0, NC_DIALECT_COUNT = 1 } nc_dialect;"
        self.assertEqual(kinds(declared, "libnc/include/nc/types.h"), [])
        self.assertIn("identity", kinds(declared, "libnc/include/nc/control.h"))

    def test_a_file_called_after_a_family_is_found(self):
        self.assertIn("family", kinds("int x;", "libnc/src/motion/m700_filters.hpp"))

    def test_a_family_is_a_whole_word_of_a_name(self):
        for name in ("FLAG_OPEN_DRAIN", "O_APPEND", "kOpenDrain", "pending", "open_pen2", "SUSPEND"):
            self.assertFalse(checker.called_after("pen", name), name)
        for name in ("pen", "kPen", "isPEN", "NC_DIALECT_PEN", "pen_seconds", "PENLexer", "kPENLexer", "penWords", "PEN_2"):
            self.assertTrue(checker.called_after("pen", name), name)
        self.assertTrue(checker.called_after("m700", "isM700Code"))

    def test_a_private_function_is_no_other_file_s(self):
        taker = "unsigned whole(unsigned key, unsigned parameter) { return 0; }"
        sources = {"tools/a.cpp": taker, "tools/b.cpp": "void f() { whole(1, 1081); }"}
        self.assertEqual(checker.findings_in(SOURCE, sources), [])
        sources = {"tools/a.hpp": taker, "tools/b.cpp": "void f() { whole(1, 1081); }"}
        self.assertEqual([finding.kind for finding in checker.findings_in(SOURCE, sources)], ["number"])

    def test_lines_are_those_of_the_source(self):
        text = '/* a\nb */ auto s = R"x(\n)x";\n\nbool y = code == 20;\n'
        found = checker.findings_in(SOURCE, {"x.cpp": text})
        self.assertEqual([(finding.line, finding.kind) for finding in found], [(5, "code")])


class Listed(unittest.TestCase):
    """In a tree of the test: counts may fall, and must then be lowered, but never rise."""

    def run_in(self, source, known, *options):
        with tempfile.TemporaryDirectory() as folder:
            top = pathlib.Path(folder)
            for family in ("m700", "dgshape"):
                (top / "libnc/src/dialect" / family).mkdir(parents=True)
                rules = top / "libnc/src/dialect" / family / "rules.cpp"
                rules.write_text('bool m700 = code == 20 && name == "m700";\n')
            (top / "libnc/src/x.cpp").write_text(source)
            (top / "known").write_text(known)
            command = [sys.executable, SCRIPT, "--top", top, "--known", top / "known", *options]
            done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
            return done.returncode, done.stdout + done.stderr, (top / "known").read_text()

    TWO = "bool f(int code) { return code == 20 || code == 30; }\n"

    def test_as_listed(self):
        self.assertEqual(self.run_in(self.TWO, "libnc/src/x.cpp code 2\n")[0], 0)
        both = "# why\nlibnc/src/x.cpp code 1\nexempt libnc/src/x.cpp code 1  # not ours\n"
        self.assertEqual(self.run_in(self.TWO, both)[0], 0)

    def test_more_is_refused_and_shown(self):
        status, output, _ = self.run_in(self.TWO, "libnc/src/x.cpp code 1\n")
        self.assertEqual(status, 1)
        self.assertIn("libnc/src/x.cpp:1: code == 30", output)
        one = "libnc/src/x.cpp code 1\n"
        self.assertEqual(self.run_in(self.TWO, one, "--lower")[2], one)
        self.assertEqual(self.run_in(self.TWO, "")[0], 1)

    def test_less_is_refused_until_lowered(self):
        two = "libnc/src/x.cpp code 2\n"
        for known, lowered in (("libnc/src/x.cpp code 5\n", two),
                               (two + "libnc/src/gone.cpp group 4\n", two),
                               ("libnc/src/x.cpp code 7\nexempt libnc/src/x.cpp code 1  # why 1\n",
                                "libnc/src/x.cpp code 1\nexempt libnc/src/x.cpp code 1  # why 1\n")):
            self.assertEqual(self.run_in(self.TWO, known)[0], 1)
            status, _, after = self.run_in(self.TWO, known, "--lower")
            self.assertEqual((status, after), (0, lowered))

    def test_an_exemption_says_why(self):
        self.assertEqual(self.run_in(self.TWO, "exempt libnc/src/x.cpp code 2\n")[0], 2)
        self.assertEqual(self.run_in(self.TWO, "libnc/src/x.cpp code\n")[0], 2)


if __name__ == "__main__":
    unittest.main()
