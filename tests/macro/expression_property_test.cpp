// SPDX-License-Identifier: Apache-2.0
// Random expression trees: what is compiled from their text and run must be what walking the tree gives.
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "macro/expression.hpp"
#include "program/lex_helpers.hpp"

namespace nc::test {
namespace {

/// A tree; its text has just the brackets that priorities and left-to-right order need.
struct Node {
  enum Kind { number, variable, indirect, add, subtract, multiply, divide, modulo, negate, sine, absolute, round, fix, fup, square_root } kind;
  double value = 0;
  unsigned index = 0;
  std::unique_ptr<Node> a, b;
};

using Tree = std::unique_ptr<Node>;

constexpr double kVariables[] = {0, 1, 2, 3, -4.5, 0.125, 1000, -7, 9, 33.3};  // #0 stays vacant in the reader below

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

std::string operand(const Node& n, int at_least) { return priority(n) >= at_least ? text(n) : "[" + text(n) + "]"; }

std::string text(const Node& n) {
  char number[32];
  switch (n.kind) {
    case Node::number: std::snprintf(number, sizeof number, "%.6f", n.value); return number;
    case Node::variable: return "#" + std::to_string(n.index);
    case Node::indirect: return "##" + std::to_string(n.index);
    case Node::add: return operand(*n.a, 1) + "+" + operand(*n.b, 2);
    case Node::subtract: return operand(*n.a, 1) + " - " + operand(*n.b, 2);
    case Node::multiply: return operand(*n.a, 2) + "*" + operand(*n.b, 3);
    case Node::divide: return operand(*n.a, 2) + "/" + operand(*n.b, 3);
    case Node::modulo: return operand(*n.a, 2) + " MOD " + operand(*n.b, 3);
    case Node::negate: return "-" + operand(*n.a, 4);
    case Node::sine: return "SIN[" + text(*n.a) + "]";
    case Node::absolute: return "abs[" + text(*n.a) + "]";
    case Node::round: return "ROUND[" + text(*n.a) + "]";
    case Node::fix: return "FIX[" + text(*n.a) + "]";
    case Node::fup: return "FUP[" + text(*n.a) + "]";
    case Node::square_root: return "SQRT[" + text(*n.a) + "]";
  }
  return "";
}

/// NaN: the evaluator must refuse.
double walk(const Node& n) {
  const double nan = std::nan("");
  const double a = n.a ? walk(*n.a) : 0, b = n.b ? walk(*n.b) : 0;
  if (std::isnan(a) || std::isnan(b)) return nan;
  switch (n.kind) {
    case Node::number: return n.value;
    case Node::variable: return kVariables[n.index];
    case Node::indirect: return kVariables[static_cast<unsigned>(kVariables[n.index])];
    case Node::add: return a + b;
    case Node::subtract: return a - b;
    case Node::multiply: return a * b;
    case Node::divide: return b == 0 ? nan : a / b;
    case Node::modulo: return b == 0 ? nan : std::fmod(a, b);
    case Node::negate: return 0 - a;
    case Node::sine: return std::sin(std::remainder(a, 360.0) * std::acos(-1.0) / 180);
    case Node::absolute: return std::fabs(a);
    case Node::round: return a < 0 ? -std::floor(0.5 - a) : std::floor(a + 0.5);
    case Node::fix: return std::trunc(a);
    case Node::fup: return a < 0 ? std::floor(a) : std::ceil(a);
    case Node::square_root: return a < 0 ? nan : std::sqrt(a);
  }
  return nan;
}

/// The two may differ where a step function is stepped on within noise, and where a function amplifies a difference of the last bits.
bool delicate(const Node& n) {
  if ((n.a && delicate(*n.a)) || (n.b && delicate(*n.b))) return true;
  if (!n.a) return false;
  const double a = walk(*n.a);
  if (std::isnan(a)) return false;
  if (std::fabs(a) > 1e6) return true;
  switch (n.kind) {
    case Node::round: return std::fabs(a + 0.5 - std::round(a + 0.5)) < 1e-5;
    case Node::fix:
    case Node::fup: return a != std::round(a) && std::fabs(a - std::round(a)) < 1e-5;
    case Node::square_root: return a < 0 ? a > -1e-9 : a < 1e-9;
    case Node::divide: return std::fabs(walk(*n.b)) < 1e-5;
    case Node::modulo: {
      const double b = walk(*n.b);
      if (std::isnan(b) || std::fabs(b) < 1e-5) return true;
      const double q = a / b;
      return std::fabs(q - std::round(q)) < 1e-5;
    }
    default: return false;
  }
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
  const double expected = walk(tree);
  if (std::isnan(expected)) {
    RC_ASSERT(eval == Eval::fault);
    return;
  }
  RC_ASSERT(eval == Eval::ok);
  RC_ASSERT(std::fabs(value.or_zero() - expected) <= 1e-9 * std::max(1.0, std::fabs(expected)));
}

RC_GTEST_PROP(ExpressionProperty, RunsLikeItsTree, ()) {
  int checked = 0;
  for (int i = 0; i < 60; ++i) {
    const Tree tree = grow(*rc::gen::inRange(1, 5));
    if (brackets(*tree) > 5 || delicate(*tree)) continue;
    check_tree(*tree);
    ++checked;
  }
  RC_ASSERT(checked > 0);
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
    RC_ASSERT(block->words[i].letter == words[i].letter);
    RC_ASSERT(block->words[i].value == words[i].value);
  }
}

}  // namespace
}  // namespace nc::test
