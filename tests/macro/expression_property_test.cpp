// SPDX-License-Identifier: Apache-2.0
// Random expression trees: the compiled text of a tree must have the same value as a walk over the tree.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "macro/expression.hpp"
#include "program/lex_helpers.hpp"

namespace nc::test {
namespace {

/// A tree. Its text has only the brackets that priorities and left-to-right order need.
struct Node {
  enum Kind {
    number,
    variable,
    indirect,
    add,
    subtract,
    multiply,
    divide,
    modulo,
    negate,
    sine,
    absolute,
    round,
    fix,
    fup,
    square_root
  } kind;
  double value = 0;
  unsigned index = 0;
  std::unique_ptr<Node> a, b;
};

using Tree = std::unique_ptr<Node>;

constexpr double kVariables[] = {0,     1,    2,  3, -4.5,
                                 0.125, 1000, -7, 9, 33.3};  // #0 stays vacant in the reader below

Tree grow(int depth) {
  auto n = std::make_unique<Node>();
  n->kind = static_cast<Node::Kind>(depth == 0 ? *rc::gen::inRange(0, 3) : *rc::gen::inRange(0, 15));
  if (n->kind == Node::number) n->value = *rc::gen::inRange(0, 20000) / 16.0;
  if (n->kind == Node::variable) n->index = *rc::gen::inRange(0u, 10u);
  if (n->kind == Node::indirect) n->index = *rc::gen::inRange(1u, 4u);
  if (n->kind >= Node::add) n->a = grow(depth - 1);
  if (n->kind >= Node::add && n->kind <= Node::modulo) n->b = grow(depth - 1);
  return n;
}

int priority(const Node& n) {
  if (n.kind == Node::add || n.kind == Node::subtract) return 1;
  if (n.kind == Node::multiply || n.kind == Node::divide || n.kind == Node::modulo) return 2;
  return n.kind == Node::negate ? 3 : 4;
}

std::string text(const Node& n);

std::string operand(const Node& n, int at_least) {
  return priority(n) >= at_least ? text(n) : "[" + text(n) + "]";
}

std::string text(const Node& n) {
  char number[32];
  switch (n.kind) {
    case Node::number:
      std::snprintf(number, sizeof number, "%.6f", n.value);
      return number;
    case Node::variable:
      return "#" + std::to_string(n.index);
    case Node::indirect:
      return "##" + std::to_string(n.index);
    case Node::add:
      return operand(*n.a, 1) + "+" + operand(*n.b, 2);
    case Node::subtract:
      return operand(*n.a, 1) + " - " + operand(*n.b, 2);
    case Node::multiply:
      return operand(*n.a, 2) + "*" + operand(*n.b, 3);
    case Node::divide:
      return operand(*n.a, 2) + "/" + operand(*n.b, 3);
    case Node::modulo:
      return operand(*n.a, 2) + " MOD " + operand(*n.b, 3);
    case Node::negate:
      return "-" + operand(*n.a, 4);
    case Node::sine:
      return "SIN[" + text(*n.a) + "]";
    case Node::absolute:
      return "abs[" + text(*n.a) + "]";
    case Node::round:
      return "ROUND[" + text(*n.a) + "]";
    case Node::fix:
      return "FIX[" + text(*n.a) + "]";
    case Node::fup:
      return "FUP[" + text(*n.a) + "]";
    case Node::square_root:
      return "SQRT[" + text(*n.a) + "]";
  }
  return "";
}

/// A value, and the possible error of its calculation in doubles. `refused`: the evaluator must report a fault.
/// `delicate`: the result depends on rounding, so it is not compared.
struct Walked {
  double v = 0, error = 0;
  bool refused = false, delicate = false;
};

constexpr double kEps = 4.5e-16;

Walked refused() {
  return {0, 0, true, false};
}
Walked delicate() {
  return {0, 0, false, true};
}

/// A function with steps at whole numbers: x counts as whole within 1e-9 of its size (but no more than 1e-4).
Walked step(const Walked& a, double x, double (*otherwise)(double)) {
  const double noise = std::min(1e-9 * std::max(1.0, std::fabs(a.v)), 1e-4);
  const double distance = std::fabs(x - std::round(x));
  const double sign = a.v < 0 ? -1 : 1;
  if (distance + a.error < 0.4 * noise) return {sign * std::round(x)};
  if (distance - a.error > 2 * noise) return {sign * otherwise(x)};
  return delicate();
}

Walked divide(const Walked& a, const Walked& b) {
  if (b.v == 0 && b.error == 0) return refused();
  if (std::fabs(b.v) < 4 * b.error) return delicate();
  const double v = a.v / b.v;
  return {v, 2 * (a.error + std::fabs(v) * b.error) / std::fabs(b.v) + kEps * std::fabs(v)};
}

Walked modulo(const Walked& a, const Walked& b) {
  const Walked q = divide(a, b);
  if (q.refused || q.delicate) return q;
  const double fraction = std::fabs(q.v - std::round(q.v));
  if (a.error == 0 && b.error == 0 && std::fmod(a.v, b.v) == 0) return {0};
  if (fraction < 1e-6 + 2 * q.error) return delicate();
  return {std::fmod(a.v, b.v), a.error + (std::fabs(q.v) + 1) * b.error + kEps * std::fabs(b.v)};
}

Walked walk(const Node& n) {
  const Walked a = n.a ? walk(*n.a) : Walked{}, b = n.b ? walk(*n.b) : Walked{};
  if (a.delicate || b.delicate) return delicate();
  if (a.refused || b.refused) return refused();
  const double x = std::fabs(a.v);
  if (x > 1e9 || std::fabs(b.v) > 1e9) return delicate();
  switch (n.kind) {
    case Node::number:
      return {n.value};
    case Node::variable:
      return {kVariables[n.index]};
    case Node::indirect:
      return {kVariables[static_cast<unsigned>(kVariables[n.index])]};
    case Node::add:
      return {a.v + b.v, a.error + b.error + kEps * std::fabs(a.v + b.v)};
    case Node::subtract:
      return {a.v - b.v, a.error + b.error + kEps * std::fabs(a.v - b.v)};
    case Node::multiply:
      return {a.v * b.v,
              x * b.error + std::fabs(b.v) * a.error + a.error * b.error + kEps * std::fabs(a.v * b.v)};
    case Node::divide:
      return divide(a, b);
    case Node::modulo:
      return modulo(a, b);
    case Node::negate:
      return {-a.v, a.error};
    case Node::sine:
      return {std::sin(std::remainder(a.v, 360.0) * std::acos(-1.0) / 180), a.error / 50 + 4 * kEps};
    case Node::absolute:
      return {x, a.error};
    case Node::round:
      return step(a, x + 0.5, [](double y) { return std::floor(y); });
    case Node::fix:
      return step(a, x, [](double y) { return std::floor(y); });
    case Node::fup:
      return step(a, x, [](double y) { return std::ceil(y); });
    case Node::square_root:
      if (x < 4 * a.error) return delicate();
      return a.v < 0 ? refused()
                     : Walked{std::sqrt(x), a.error / std::sqrt(x + 1e-300) + kEps * std::sqrt(x)};
  }
  return delicate();
}

int brackets(const Node& n, int depth = 0) {  // depth of brackets in the text, an upper bound
  const int here = n.kind >= Node::add ? 1 : 0;
  int deepest = depth + here;
  if (n.a) deepest = std::max(deepest, brackets(*n.a, depth + here));
  if (n.b) deepest = std::max(deepest, brackets(*n.b, depth + here));
  return deepest;
}

void check_tree(const Node& tree) {
  const std::string source = text(tree);
  const VariableReader reader{nullptr,
                              [](void*, uint32_t number, Value* value, Fault*, uint32_t*) {
                                *value = number == 0 ? Value{} : Value::of(kVariables[number]);
                                return Eval::ok;
                              },
                              nullptr};
  Block block;
  block.clear();
  size_t at = 0;
  uint16_t code = 0;
  Fault fault;
  RC_ASSERT(compile_expression(block, source.data(), source.size(), &at, false, &code, &fault));
  RC_ASSERT(at == source.size());
  Value value;
  uint32_t sync = 0;
  const Eval eval = evaluate(block, code, reader, {}, &value, &fault, &sync);
  const Walked expected = walk(tree);
  RC_ASSERT((eval == Eval::fault) == expected.refused);
  if (!expected.refused) RC_ASSERT(std::fabs(value.or_zero() - expected.v) <= 4 * expected.error);
}

RC_GTEST_PROP(ExpressionProperty, RunsLikeItsTree, ()) {
  int checked = 0;
  for (int i = 0; i < 60; ++i) {
    const Tree tree = grow(*rc::gen::inRange(1, 5));
    if (brackets(*tree) > 5 || walk(*tree).delicate) continue;
    check_tree(*tree);
    ++checked;
  }
  RC_ASSERT(checked > 0);
}

/// The result of a comparison of #1 = x with #2 = y.
bool holds(const char* comparison, double x, double y) {
  double values[2] = {x, y};
  const VariableReader reader{values,
                              [](void* self, uint32_t number, Value* value, Fault*, uint32_t*) {
                                *value = Value::of(static_cast<double*>(self)[number - 1]);
                                return Eval::ok;
                              },
                              nullptr};
  const std::string source = std::string("[#1 ") + comparison + " #2]";
  Block block;
  block.clear();
  size_t at = 0;
  uint16_t code = 0;
  Fault fault;
  Value value;
  uint32_t sync = 0;
  RC_ASSERT(compile_expression(block, source.data(), source.size(), &at, true, &code, &fault));
  RC_ASSERT(evaluate(block, code, reader, {}, &value, &fault, &sync) == Eval::ok);
  return value.or_zero() != 0;
}

/// Numbers of every size, often a few units in the last place, or about the tolerance, apart.
double near_number(double x) {
  const int kind = *rc::gen::inRange(0, 4);
  if (kind == 0) return *rc::gen::inRange(-2000000, 2000000) * 0.001;
  if (kind == 1) return x + *rc::gen::inRange(-3000, 3000) * 1e-12;
  const double share = kind == 2 ? 0x1p-40 : 0x1p-52;
  return x + x * share * (*rc::gen::inRange(-3000, 3000) / 1000.0);
}

RC_GTEST_PROP(ComparisonProperty, AreConsistent, ()) {
  for (int i = 0; i < 20; ++i) {
    const double size = std::pow(10.0, *rc::gen::inRange(-12, 13));
    const double x = *rc::gen::inRange(-99999, 99999) * 0.001 * size, y = near_number(x);
    const bool lt = holds("LT", x, y), eq = holds("EQ", x, y), gt = holds("GT", x, y);
    RC_ASSERT(lt + eq + gt == 1);
    RC_ASSERT(holds("GE", x, y) == !lt);
    RC_ASSERT(holds("LE", x, y) == !gt);
    RC_ASSERT(holds("NE", x, y) == !eq);
    // The same with the sides exchanged, and with the negative numbers.
    RC_ASSERT(holds("EQ", y, x) == eq);
    RC_ASSERT(holds("GT", y, x) == lt);
    RC_ASSERT(holds("LT", -y, -x) == lt);
    RC_ASSERT(holds("EQ", x, x));
    // A comparison never contradicts the order of the numbers, and a number between two equal ones is equal to both.
    RC_ASSERT(!(lt && x >= y));
    RC_ASSERT(!(gt && x <= y));
    const double between = x + (y - x) / 2;
    if (eq) RC_ASSERT(holds("EQ", x, between) && holds("EQ", between, y));
  }
}

/// A block printed from random words is read back as these words.
RC_GTEST_PROP(LexerProperty, RoundTrip, ()) {
  struct Printed {
    char letter;
    double value;
  };
  std::vector<Printed> words;
  std::string source = *rc::gen::element<std::string>("", " ", "/", "(a) ");
  const uint32_t n = *rc::gen::inRange(0u, 1000000u);
  if (n != 0) source += "N" + std::to_string(n);
  const int count = *rc::gen::inRange(0, 20);
  for (int i = 0; i < count; ++i) {
    const char letter = *rc::gen::elementOf(std::string("XYZABCUVWIJKRQEF"));
    const int decimals = *rc::gen::inRange(0, 7);
    char number[40];
    std::snprintf(number, sizeof number, "%.*f", decimals, *rc::gen::inRange(-9999999, 9999999) / 100.0);
    words.push_back({letter, std::strtod(number, nullptr)});
    source += *rc::gen::element<std::string>("", " ", "\t", "(x;%)", "  ");
    source += *rc::gen::arbitrary<bool>() ? letter : static_cast<char>(letter + 32);
    source += *rc::gen::element<std::string>("", " ");
    source += number;
  }
  source += *rc::gen::element<std::string>("\n", "\r\n", ";", "", " (end)\n");
  LexResult result;
  const auto block = lex(source, m700_rules(), &result);
  RC_ASSERT(!block->has_fault);
  RC_ASSERT(result.used == source.size());
  RC_ASSERT(block->words.size() == words.size());
  RC_ASSERT(block->has_n == (n != 0));
  RC_ASSERT(block->n == n);
  for (unsigned i = 0; i < words.size(); ++i) {
    RC_ASSERT(letter_of(block->words[i].slot) == words[i].letter);
    RC_ASSERT(block->words[i].value == words[i].value);
  }
}

}  // namespace
}  // namespace nc::test
