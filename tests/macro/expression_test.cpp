// SPDX-License-Identifier: Apache-2.0
// The numbers of the manual (M700 13.4, 13.5.4, 13.5.6, 13.5.7), and exact results where a user expects them.
#include "macro/expression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "program/lex_helpers.hpp"

namespace nc::test {
namespace {

/// The variables of a test; those that are not in the map are vacant.
struct Memory {
  std::map<uint32_t, double> values;
  static Eval read(void* self, uint32_t number, Value* value, Fault* fault, uint32_t* sync) {
    const auto& values = static_cast<Memory*>(self)->values;
    if (number == 5041) {
      *sync = 1;
      return Eval::need_sync;
    }
    if (number > 1000) {
      fault->condition = Condition::variable_number;
      fault->value = number;
      return Eval::fault;
    }
    const auto found = values.find(number);
    *value = found == values.end() ? Value{} : Value::of(found->second);
    return Eval::ok;
  }
  static bool find_name(void*, const char* name, size_t length, uint32_t* number) {
    if (std::string(name, length) != "TOOL25") return false;
    *number = 502;
    return true;
  }
  VariableReader reader() { return {this, read, find_name}; }
};

struct Outcome {
  bool compiled = false;
  Eval eval = Eval::fault;
  Value value;
  Fault fault;
  uint32_t sync = 0;
  size_t used = 0;
};

Outcome run(const std::string& text, Memory& memory, bool condition = false, EvalOptions options = {}) {
  Block block;
  block.clear();
  Outcome o;
  uint16_t code = 0;
  o.compiled = compile_expression(block, text.data(), text.size(), &o.used, condition, &code, &o.fault);
  if (o.compiled) o.eval = evaluate(block, code, memory.reader(), options, &o.value, &o.fault, &o.sync);
  return o;
}

Outcome run(const std::string& text) {
  Memory empty;
  return run(text, empty);
}

double value(const std::string& text, Memory& memory) {
  const Outcome o = run(text, memory);
  EXPECT_TRUE(o.compiled && o.eval == Eval::ok)
      << text << " condition " << static_cast<int>(o.fault.condition);
  EXPECT_EQ(o.used, text.size()) << text;
  EXPECT_FALSE(o.value.vacant) << text;
  return o.value.number;
}

double value(const std::string& text) {
  Memory empty;
  return value(text, empty);
}

Condition fault(const std::string& text) {
  const Outcome o = run(text);
  return o.compiled && o.eval == Eval::ok ? Condition::none : o.fault.condition;
}

TEST(Expression, PrintedArithmetic) {
  Memory m{{{1, 1000}, {2, 1000}, {101, 100}, {102, 200}, {110, -10}, {19, 48}, {20, 9}}};
  const struct {
    const char* text;
    double result;
  } rows[] = {{"#1+1000", 2000},    {"#2-50.", 950},        {"#101+#1", 1100},    {"#110-3.", -13},
              {"#110+#102", 190},   {"100*100", 10000},     {"100.*100", 10000},  {"100/100", 1},
              {"100./100.", 1},     {"#110*#101", -1000},   {"#110/#102", -0.05}, {"#19 MOD #20", 3},
              {"100 OR 14", 110},   {"100 XOR 14", 106},    {"100 AND 15", 4},    {"ABS[-1000]", 1000},
              {"ABS[-50-70]", 120}, {"BIN[100]", 64},       {"BCD[100]", 256},    {"BIN[4660]", 1234},
              {"BCD[1234]", 4660},  {"BIN[BCD[978]]", 978}, {"BCD[9]", 9}};
  for (const auto& row : rows) EXPECT_EQ(value(row.text, m), row.result) << row.text;
}

TEST(Expression, PrintedFunctions) {
  const double band = 6e-4;  // printed with three decimals
  EXPECT_NEAR(value("1000*SIN[60]"), 866.025, band);
  EXPECT_NEAR(value("COS[45.]"), 0.707, band);
  EXPECT_NEAR(value("1000.*COS[45]"), 707.107, band);
  EXPECT_NEAR(value("TAN[60]"), 1.732, band);
  EXPECT_NEAR(value("1000*TAN[60.]"), 1732.051, band);
  EXPECT_EQ(value("ASIN[100.500/201.]"), 30);
  EXPECT_EQ(value("ASIN[-0.500]"), -30);
  EXPECT_NEAR(value("ATAN[173205/100000]"), 60, band);
  EXPECT_NEAR(value("ATN[1.73205]"), 60, band);
  EXPECT_NEAR(value("ACOS[100./141.421]"), 45, band);
  EXPECT_NEAR(value("SQRT[1000]"), 31.623, band);
  EXPECT_NEAR(value("SQR[10.*10.+20.*20.]"), 22.3607, band);
  EXPECT_NEAR(value("LN[5]"), 1.609, band);
  EXPECT_NEAR(value("LN[0.5]"), -0.693, band);
  EXPECT_NEAR(value("EXP[2]"), 7.389, band);
  EXPECT_NEAR(value("EXP[1]"), 2.718, band);
  EXPECT_NEAR(value("EXP[-2]"), 0.135, band);
  Memory none;
  EXPECT_EQ(run("ASIN[-0.5]", none, false, {true}).value.number, 330);  // #1273 bit 0
  EXPECT_EQ(run("ASIN[0.5]", none, false, {true}).value.number, 30);
}

TEST(Expression, PrintedRounding) {
  for (const char* a : {"14/3", "14./3", "14/3.", "14./3."}) {
    const std::string x = a;
    EXPECT_EQ(value("ROUND[" + x + "]"), 5);
    EXPECT_EQ(value("RND[-" + x + "]"), -5);
    EXPECT_EQ(value("FIX[" + x + "]"), 4);
    EXPECT_EQ(value("FIX[-" + x + "]"), -4);
    EXPECT_EQ(value("FUP[" + x + "]"), 5);
    EXPECT_EQ(value("FUP[-" + x + "]"), -5);
  }
  EXPECT_EQ(value("FUP[6]"), 6);
  EXPECT_EQ(value("FIX[-6]"), -6);
  EXPECT_EQ(value("FUP[0]"), 0);
  EXPECT_EQ(value("ROUND[2.5]"), 3);
  EXPECT_EQ(value("ROUND[-2.5]"), -3);
}

TEST(Expression, RoundingDoesNotSeeTheNoiseOfBinaryNumbers) {
  EXPECT_EQ(value("FIX[0.1*3*10]"), 3);  // 3.0000000000000004
  EXPECT_EQ(value("FUP[0.1*3*10]"), 3);
  EXPECT_EQ(value("FIX[4.35*100]"), 435);  // 434.99999999999994
  EXPECT_EQ(value("FIX[1.1*1.1*100]"), 121);
  EXPECT_EQ(value("FUP[1.1*1.1*100]"), 121);
  EXPECT_EQ(value("FIX[-4.35*100]"), -435);
  EXPECT_EQ(value("ROUND[1.005*100-0.5+0.5]"), 101);  // 100.49999999999999 is 100.5 to a control
  EXPECT_EQ(value("FIX[2.0001]"), 2);
  EXPECT_EQ(value("FUP[2.0001]"), 3);
  EXPECT_EQ(value("FUP[12345678.001]"), 12345679);
  EXPECT_EQ(value("FIX[12345678.999]"), 12345678);
  EXPECT_EQ(value("FIX[12.3456*10000] MOD 10"), 6);
  EXPECT_EQ(value("0.3 MOD 0.1"), 0);
  EXPECT_EQ(value("-48 MOD 9"), -3);
  EXPECT_EQ(value("BCD[4.35*100]"), 0x435);
}

TEST(Expression, ExactAngles) {
  for (int k = -8; k <= 8; ++k) {
    const double sine[] = {0, 1, 0, -1};
    const int q = ((k % 4) + 4) % 4;
    const std::string a = std::to_string(90 * k);
    EXPECT_EQ(value("SIN[" + a + "]"), sine[q]) << a;
    EXPECT_FALSE(std::signbit(value("SIN[" + a + "]")) && sine[q] == 0) << a;
    EXPECT_EQ(value("COS[" + a + "]"), sine[(q + 1) % 4]) << a;
  }
  for (int degrees : {30, 150, 390, -210})
    EXPECT_EQ(value("SIN[" + std::to_string(degrees) + "]"), 0.5) << degrees;
  for (int degrees : {60, -60, 300, 420})
    EXPECT_EQ(value("COS[" + std::to_string(degrees) + "]"), 0.5) << degrees;
  for (int degrees : {120, 240}) EXPECT_EQ(value("COS[" + std::to_string(degrees) + "]"), -0.5) << degrees;
  for (int degrees : {45, 225, -135, 405})
    EXPECT_EQ(value("TAN[" + std::to_string(degrees) + "]"), 1) << degrees;
  for (int degrees : {-45, 135, 315}) EXPECT_EQ(value("TAN[" + std::to_string(degrees) + "]"), -1) << degrees;
  EXPECT_EQ(value("TAN[180]"), 0);
  EXPECT_EQ(value("ACOS[0.5]"), 60);
  EXPECT_EQ(value("ACOS[0]"), 90);
  EXPECT_EQ(value("ACOS[-1]"), 180);
  EXPECT_EQ(value("ASIN[1]"), 90);
  EXPECT_EQ(value("ATAN[1]"), 45);
  EXPECT_EQ(value("ATAN[-1]"), -45);
  EXPECT_EQ(value("ATAN[0]"), 0);
  EXPECT_EQ(value("ASIN[SIN[30]]"), 30);
  for (int degrees = -720; degrees <= 720; degrees += 7) {
    const double radians = degrees * 3.14159265358979323846 / 180;
    EXPECT_NEAR(value("SIN[" + std::to_string(degrees) + "]"), std::sin(radians), 1e-14);
    EXPECT_NEAR(value("COS[" + std::to_string(degrees) + "]"), std::cos(radians), 1e-14);
  }
}

TEST(Expression, Priorities) {
  Memory m{{{6, 9}, {106, 9}, {111, 2}, {112, 3}, {113, 30}}};
  EXPECT_EQ(value("#111+#112*SIN[#113]", m), 3.5);
  EXPECT_EQ(value("#6/2", m), 4.5);  // [#6]/2
  EXPECT_EQ(value("2+3*4"), 14);
  EXPECT_EQ(value("[2+3]*4"), 20);
  EXPECT_EQ(value("100-10-1"), 89);
  EXPECT_EQ(value("100/10/2"), 5);
  EXPECT_EQ(value("7 MOD 4*2"), 6);
  EXPECT_EQ(value("1 OR 6 AND 3"), 3);
  EXPECT_EQ(value("8+4 OR 1"), 13);
  EXPECT_EQ(value("-2+3"), 1);
  EXPECT_EQ(value("-[2+3]"), -5);
  EXPECT_EQ(value("2*-3"), -6);
  EXPECT_EQ(value("2--3"), 5);
  EXPECT_EQ(value("+5-+2"), 3);
  EXPECT_EQ(value("SIN[30]+COS[60]*2"), 1.5);
  EXPECT_EQ(value("1(one)+(and)2 (three)"), 3);
  EXPECT_EQ(value("SQRT[[[#111+#112]*SIN[#113]+#111]*2]", m), 3);
}

TEST(Expression, Variables) {
  Memory m{{{1, 10}, {10, 20}, {20, 30}, {3, 77}, {5, 2.5}, {502, 8}}};
  EXPECT_EQ(value("#[#[#1]]", m), 30);
  EXPECT_EQ(value("##1", m), 20);
  EXPECT_EQ(value("###1", m), 30);
  EXPECT_EQ(value("#[#10/2]", m), 20);
  EXPECT_EQ(value("#[#5]", m), 77);  // 2.5 is rounded up
  EXPECT_EQ(value("##5", m), 77);
  EXPECT_EQ(value("#[2.4999999999]", m), 77);
  EXPECT_EQ(value("[#TOOL25]+1", m), 9);
  EXPECT_EQ(value("[#tool 25]", m), 8);
  EXPECT_EQ(run("[#OTHER]").fault.condition, Condition::variable_name);
  EXPECT_EQ(fault("#[-1]"), Condition::variable_number);  // M700 P241
  EXPECT_EQ(fault("#[0-3]"), Condition::variable_number);
  EXPECT_EQ(fault("#99999999999"), Condition::variable_number);
  EXPECT_EQ(fault("#2000"), Condition::variable_number);
  EXPECT_EQ(fault("#[5000000000]"), Condition::variable_number);
  EXPECT_EQ(fault("#1.5"), Condition::variable_number);
  const Outcome sync = run("1+#5041");
  EXPECT_EQ(sync.eval, Eval::need_sync);
  EXPECT_EQ(sync.sync, 1u);
}

TEST(Expression, VariableNumber) {
  uint32_t n = 0;
  EXPECT_TRUE(variable_number(Value::of(2.5), {}, &n));
  EXPECT_EQ(n, 3u);
  EXPECT_TRUE(variable_number(Value::of(2.4), {}, &n));
  EXPECT_EQ(n, 2u);
  EXPECT_TRUE(variable_number(Value{}, {}, &n));
  EXPECT_EQ(n, 0u);
  EXPECT_FALSE(variable_number(Value::of(-0.4), {}, &n));
  EXPECT_FALSE(variable_number(Value::of(-1), {}, &n));
  EXPECT_FALSE(variable_number(Value::of(1e12), {}, &n));
  EXPECT_FALSE(variable_number(Value::of(std::nan("")), {}, &n));
}

TEST(Expression, Vacant) {  // M700 13.5.4
  Memory m{{{2, 0}}};
  EXPECT_TRUE(run("#0", m).value.vacant);
  EXPECT_TRUE(run("#1", m).value.vacant);
  EXPECT_TRUE(run("[#1]", m).value.vacant);
  EXPECT_FALSE(run("#2", m).value.vacant);
  EXPECT_EQ(value("#0+1", m), 1);
  EXPECT_EQ(value("1+#0", m), 1);
  EXPECT_EQ(value("#0*10", m), 0);
  EXPECT_EQ(value("#0+#0", m), 0);
  EXPECT_EQ(value("-#0", m), 0);
  EXPECT_EQ(value("ABS[#0]", m), 0);
  EXPECT_EQ(run("1/#0", m).fault.condition, Condition::division_by_zero);
}

TEST(Expression, VacantInAWordIsIgnoredWithItsSign) {  // M700 13.5.4 (2): G0 X#1 Y1000 = G0 Y1000
  const auto b = lex("X#1 Y-#1 Z-#2 A#1+10 B-[#1]");
  Memory m{{{2, 4}}};
  Value v[5];
  for (unsigned i = 0; i < 5; ++i) {
    Fault f;
    uint32_t sync = 0;
    EXPECT_EQ(evaluate(*b, b->words[i].code, m.reader(), {}, &v[i], &f, &sync), Eval::ok);
  }
  EXPECT_TRUE(v[0].vacant);
  EXPECT_TRUE(v[1].vacant);
  EXPECT_EQ(v[2].number, -4);
  EXPECT_EQ(v[3].number, 10);
  EXPECT_FALSE(v[3].vacant);
  EXPECT_TRUE(v[4].vacant);
}

TEST(Expression, Conditions) {
  Memory vacant, zero{{{101, 0}}};
  const struct {
    const char* text;
    bool when_vacant, when_zero;
  } rows[] = {{"#101 EQ #0", true, false}, {"#101 NE 0", true, false}, {"#101 GE #0", true, true},
              {"#101 GT 0", false, false}, {"#101 LE #0", true, true}, {"#101 LT 0", false, false},
              {"#101 EQ 0", false, true},  {"#101 NE #0", false, true}};
  for (const auto& row : rows) {
    EXPECT_EQ(run(row.text, vacant, true).value.number, row.when_vacant) << row.text;
    EXPECT_EQ(run(row.text, zero, true).value.number, row.when_zero) << row.text;
    EXPECT_EQ(run("[" + std::string(row.text) + "]", zero, true).value.number, row.when_zero) << row.text;
  }
  EXPECT_EQ(run("2+3EQ5", zero, true).value.number, 1);
  EXPECT_EQ(run("[1+1]*2 GT 3", zero, true).value.number, 1);
  EXPECT_EQ(run("1 EQ 1", zero, false).used, 2u);  // a comparison is not allowed here, so that the formula ends before it
  EXPECT_EQ(run("[1 EQ 1]", zero, false).fault.condition, Condition::calculation);
  // All words of a condition, as the lexer compiles them.
  const auto b = lex("IF[#1LT[#2+1]]GOTO[#3*10]");
  ASSERT_EQ(b->statements.size(), 1u);
  Memory m{{{1, 4}, {2, 4}, {3, 7}}};
  Value condition, target;
  Fault f;
  uint32_t sync = 0;
  evaluate(*b, b->statements[0].value, m.reader(), {}, &condition, &f, &sync);
  evaluate(*b, b->statements[0].target, m.reader(), {}, &target, &f, &sync);
  EXPECT_EQ(condition.number, 1);
  EXPECT_EQ(target.number, 70);
}

TEST(Expression, Bits) {
  EXPECT_EQ(value("4294967295 AND 255"), 255);
  EXPECT_EQ(value("2147483648 OR 1"), 2147483649.0);
  EXPECT_EQ(value("-1 AND 255"), 255);
  EXPECT_EQ(value("-1 OR 0"), -1);
  EXPECT_EQ(value("-1 XOR 4294967295"), 0);
  EXPECT_EQ(value("5.9 AND 7"), 5);
  EXPECT_EQ(fault("4294967296 AND 1"), Condition::calculation);
  EXPECT_EQ(fault("0-2147483649 OR 1"), Condition::calculation);
}

TEST(Expression, Impossible) {
  EXPECT_EQ(fault("1/0"), Condition::division_by_zero);
  EXPECT_EQ(fault("1 MOD 0"), Condition::division_by_zero);
  EXPECT_EQ(fault("TAN[90]"), Condition::division_by_zero);  // sin/cos
  EXPECT_EQ(fault("TAN[-270]"), Condition::division_by_zero);
  for (const char* text :
       {"LN[-5]", "LN[0]", "SQRT[-1]", "ASIN[1.1]", "ACOS[-1.1]", "BIN[10]", "BIN[-1]", "BCD[-1]",
        "BCD[100000000]", "EXP[1000]", "EXP[500]*EXP[500]", "BIN[5000000000]"}) {
    EXPECT_EQ(fault(text), Condition::calculation) << text;
  }
  EXPECT_EQ(value("ASIN[1+1/10000000000]"), 90);  // noise
  EXPECT_EQ(value("BCD[99999999]"), 2576980377.0);
  EXPECT_EQ(value("BIN[2576980377]"), 99999999);
}

TEST(Expression, Malformed) {
  for (const char* text : {"", "+", "-", "*1", "1+", "1+*2", "--5", "1---2", ".", "[]", "SIN", "SIN 30",
                           "SIN[]", "FOO[1]", "1 AND", "[1 2 X]"}) {
    EXPECT_EQ(fault(text), Condition::calculation) << text;
  }
  for (const char* text : {"#--5", "#-#1", "#", "##", "#[#-1]", "#.5"})
    EXPECT_EQ(fault(text), Condition::variable_number) << text;
  for (const char* text : {"[1", "SIN[1", "[", "]", "[1+[2]", "1+]"})
    EXPECT_EQ(fault(text), Condition::bracket_pair) << text;
  EXPECT_EQ(fault("[[[[[[1]]]]]]"), Condition::bracket_nesting);
  EXPECT_EQ(fault("#[#[#[#[#[#[1]]]]]]"), Condition::bracket_nesting);
  EXPECT_EQ(fault("12345678901234567890"), Condition::value_range);
}

TEST(Expression, TheDeepestStack) {
  // Five brackets, each with two operands waiting; a comparison outside.
  Memory m{{{1, 1}}};
  const std::string deep = "1+2*[1+2*[1+2*[1+2*[1+2*[#1+2*3]]]]]";
  EXPECT_EQ(value(deep, m), 255);
  EXPECT_EQ(
      run("1+2*[1+2*[1+2*[1+2*[1+2*-3]]]] LT 1+2*[1+2*[1+2*[1+2*[1+2*[#1+2*3]]]]]", m, true).value.number, 1);
  EXPECT_EQ(run("[1+2*[1+2*[1+2*[1+2*3]]] LT 1+2*[1+2*[1+2*[1+2*[#1+2*3]]]]]", m, true).value.number, 1);
}

TEST(Expression, ComparisonsDoNotSeeTheLastDigits) {
  Memory m;
  m.values = {{1, 0.1 + 0.2}, {2, 1149.974 + 0.2 - 1149.974}, {3, 99999.999999}, {4, 99999.999998}, {5, 9999.9999999}, {6, 9999.9999998}, {7, 99999.9 - 99999.8 - 0.1}};
  const auto holds = [&](const char* text) { return run(text, m, true).value.number == 1; };
  EXPECT_TRUE(holds("[#1 EQ 0.3]"));
  EXPECT_FALSE(holds("[#1 NE 0.3]"));
  EXPECT_FALSE(holds("[#1 GT 0.3]"));
  EXPECT_TRUE(holds("[#1 LE 0.3]"));
  EXPECT_TRUE(holds("[#2 EQ 0.2]"));
  EXPECT_TRUE(holds("[#7 EQ 0]"));  // only rounding errors are left
  EXPECT_TRUE(holds("[#7 GE 0]"));
  EXPECT_FALSE(holds("[#7 LT 0]"));
  // The finest units at the ends of their ranges are numbers of their own.
  EXPECT_TRUE(holds("[#3 NE #4]"));
  EXPECT_TRUE(holds("[#3 GT #4]"));
  EXPECT_TRUE(holds("[#5 GT #6]"));
  EXPECT_TRUE(holds("[0.0000001 GT 0]"));
  EXPECT_TRUE(holds("[12345678.001 GT 12345678]"));
  // Vacant is not 0 for EQ and NE, and is for the others (M700 13.5.4).
  EXPECT_FALSE(holds("[#9 EQ 0]"));
  EXPECT_FALSE(holds("[#9 EQ #7]"));
  EXPECT_TRUE(holds("[#9 GE #7]"));
}

}  // namespace
}  // namespace nc::test
