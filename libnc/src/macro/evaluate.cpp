// SPDX-License-Identifier: Apache-2.0
// The evaluator: a stack machine over the code of macro/compile.hpp, and the arithmetic of M700 13.5.6.
#include <cmath>
#include <cstdint>

#include "alarm/condition.hpp"
#include "base/units.hpp"
#include "macro/compile.hpp"
#include "macro/named_parameters.hpp"

namespace nc {
namespace {

constexpr double kDegree = kPi / 180.0;

/// Relative difference that a control which calculates with about ten digits (M700 13.5.6, table of accuracy) does not notice.
constexpr double kNoise = 1e-9;
constexpr double kLargestNoise = 1e-4;  ///< upper limit of it, so that large numbers keep their visible fractions

double noise(double x) {
  const double scale = std::fabs(x) > 1 ? std::fabs(x) : 1;
  const double width = kNoise * scale;
  return width < kLargestNoise ? width : kLargestNoise;
}

double fix(double x) {  // towards 0; 2.9999999999 is 3
  const double whole = std::floor(std::fabs(x) + noise(x));
  return x < 0 ? 0 - whole : whole;
}

double fup(double x) {  // away from 0; 3.0000000001 is 3
  const double whole = std::ceil(std::fabs(x) - noise(x));
  return x < 0 ? 0 - whole : whole;
}

double round_half_away(double x) {
  const double whole = std::floor(std::fabs(x) + 0.5 + noise(x));
  return x < 0 ? 0 - whole : whole;
}

/// Sine and cosine of an angle in degrees, which is reduced to [-45, 45] degrees first. They are exact at multiples of 30 degrees where the value is 0, +-1/2
/// or +-1.
void sine_cosine(double degrees, double* sine, double* cosine) {
  double r = std::fmod(degrees, 360.0);
  const double quarter = std::nearbyint(r / 90.0);
  r -= quarter * 90.0;
  const double s = std::fabs(r) == 30.0 ? std::copysign(0.5, r) : std::sin(r * kDegree);
  const double c = std::cos(r * kDegree);
  switch (static_cast<int>(quarter) & 3) {
    case 0:
      *sine = s, *cosine = c;
      break;
    case 1:
      *sine = c, *cosine = -s;
      break;
    case 2:
      *sine = -s, *cosine = -c;
      break;
    default:
      *sine = -c, *cosine = s;
      break;
  }
  *sine += 0.0;  // no -0
  *cosine += 0.0;
}

/// Angle in degrees. A result that differs from a whole number of degrees only in its last bits becomes that number: ACOS[0.5] is 60.
double to_degrees(double radians) {
  const double degrees = radians / kDegree;
  const double whole = std::nearbyint(degrees);
  return std::fabs(degrees - whole) <= 1e-13 * std::fabs(whole) ? whole : degrees;
}

/// The value as a pattern of 32 bits, unsigned or two's complement. False when it does not fit.
bool to_bits(double x, int64_t* bits) {
  const double whole = fix(x);
  if (!(whole >= INT32_MIN && whole <= UINT32_MAX)) return false;
  *bits = static_cast<int64_t>(whole);
  return true;
}

double from_bits(int64_t bits) {
  if (bits < INT32_MIN || bits > UINT32_MAX) bits = static_cast<int64_t>(static_cast<uint32_t>(bits));
  return static_cast<double>(bits);
}

/// BIN: decimal digits packed four bits each -> number. BIN[100] = 64.
bool bcd_to_binary(double x, double* result) {
  int64_t bits = 0;
  if (!to_bits(x, &bits) || bits < 0) return false;
  uint32_t value = 0, weight = 1;
  for (; bits != 0; bits >>= 4, weight *= 10) {
    const uint32_t digit = static_cast<uint32_t>(bits & 15);
    if (digit > 9) return false;
    value += digit * weight;
  }
  *result = value;
  return true;
}

/// BCD: number -> decimal digits packed four bits each. BCD[100] = 256.
bool binary_to_bcd(double x, double* result) {
  constexpr int64_t kMost = 99999999;  // eight digits fill 32 bits
  int64_t number = 0;
  if (!to_bits(x, &number) || number < 0 || number > kMost) return false;
  uint32_t value = 0;
  for (unsigned shift = 0; number != 0; number /= 10, shift += 4)
    value |= static_cast<uint32_t>(number % 10) << shift;
  *result = value;
  return true;
}

/// An x that is above 1 only by the noise of a calculation is taken as 1, so that ASIN of a calculated 1 is not an error.
double clip_to_one(double x) {
  return std::fabs(x) > 1 && std::fabs(x) - 1 < kNoise ? std::copysign(1.0, x) : x;
}

/// Calculates a function. Condition::none = *result is valid.
Condition function(Op op, double x, const EvalOptions& options, double* result) {
  double sine = 0, cosine = 0;
  switch (op) {
    case Op::sin:
      sine_cosine(x, result, &cosine);
      return Condition::none;
    case Op::cos:
      sine_cosine(x, &sine, result);
      return Condition::none;
    case Op::tan:  // M700 13.5.6: sin/cos used for tan
      sine_cosine(x, &sine, &cosine);
      if (cosine == 0) return Condition::division_by_zero;
      *result = std::fabs(std::fmod(x, 90.0)) == 45.0 ? std::copysign(1.0, sine * cosine) : sine / cosine;
      return Condition::none;
    case Op::asin:
      x = clip_to_one(x);
      if (!(std::fabs(x) <= 1)) return Condition::calculation;
      *result = to_degrees(std::asin(x));
      if (options.asin_0_360 && *result < 0) *result += 360;  // M700 #1273 bit 0
      return Condition::none;
    case Op::acos:
      x = clip_to_one(x);
      if (!(std::fabs(x) <= 1)) return Condition::calculation;
      *result = to_degrees(std::acos(x));
      return Condition::none;
    case Op::atan:
      *result = to_degrees(std::atan(x));
      return Condition::none;
    case Op::sqrt:
      if (x < 0) return Condition::calculation;
      *result = std::sqrt(x);
      return Condition::none;
    case Op::abs:
      *result = std::fabs(x);
      return Condition::none;
    case Op::bin:
      return bcd_to_binary(x, result) ? Condition::none : Condition::calculation;
    case Op::bcd:
      return binary_to_bcd(x, result) ? Condition::none : Condition::calculation;
    case Op::round:
      *result = round_half_away(x);
      return Condition::none;
    case Op::fix:
      *result = fix(x);
      return Condition::none;
    case Op::fup:
      *result = fup(x);
      return Condition::none;
    case Op::floor:  // as with FIX, a value that is whole except for noise counts as whole
      *result = std::floor(x + noise(x));
      return Condition::none;
    case Op::ceil:
      *result = std::ceil(x - noise(x)) + 0.0;
      return Condition::none;
    case Op::ln:
      if (!(x > 0)) return Condition::calculation;
      *result = std::log(x);
      return Condition::none;
    case Op::exp:
      *result = std::exp(x);
      return Condition::none;
    default:
      return Condition::internal;
  }
}

/// Remainder with the sign of the dividend; a remainder that equals the divisor except for noise is 0.
double modulo(double a, double b) {
  const double r = std::fmod(a, b);
  return std::fabs(b) - std::fabs(r) <= 1e-12 * std::fabs(a) ? 0.0 : r;
}

/// Calculates an operator. *culprit: the operand because of which there is no result.
Condition binary(Op op, double a, double b, double* result, double* culprit) {
  int64_t m = 0, n = 0;
  *culprit = b;
  switch (op) {
    case Op::add:
      *result = a + b;
      return Condition::none;
    case Op::subtract:
      *result = a - b;
      return Condition::none;
    case Op::multiply:
      *result = a * b;
      return Condition::none;
    case Op::divide:
      if (b == 0) return Condition::division_by_zero;
      *result = a / b;
      return Condition::none;
    case Op::modulo:
      if (b == 0) return Condition::division_by_zero;
      *result = modulo(a, b);
      return Condition::none;
    case Op::remainder:
      if (b == 0) return Condition::division_by_zero;
      *result = modulo(a, b);
      if (*result < 0) *result += std::fabs(b);
      return Condition::none;
    case Op::power:  // a result that is not finite is refused by the caller, as with every operator
      *result = std::pow(a, b);
      return Condition::none;
    case Op::logic_and:
      *result = a != 0 && b != 0 ? 1 : 0;
      return Condition::none;
    case Op::logic_or:
      *result = a != 0 || b != 0 ? 1 : 0;
      return Condition::none;
    case Op::logic_xor:
      *result = (a != 0) != (b != 0) ? 1 : 0;
      return Condition::none;
    case Op::atan2:
      *result = to_degrees(std::atan2(a, b));
      return Condition::none;
    default:
      break;
  }
  if (!to_bits(a, &m)) {
    *culprit = a;
    return Condition::calculation;
  }
  if (!to_bits(b, &n)) return Condition::calculation;
  *result = from_bits(op == Op::bit_or ? m | n : op == Op::bit_xor ? m ^ n : m & n);
  return Condition::none;
}

/// Numbers that differ by this or less compare as equal. Programs compare decimal numbers of at most 12 digits (M700 5.3: below 100000 in units of 1e-6 mm,
/// below 10000 in units of 1e-7 inch), and results of calculations with them, which have rounding errors:
///   * The difference of two positions, which may be large, is off by a few units in the last place of 100000, 1.5e-11 each. Where it should be 0 the
///     error cannot be measured by the size of the result, so there is a lower limit: 1e-9 is 68 such units, and a hundredth of the finest unit.
///   * A chain of calculations adds half a unit in the last place for each step, 2^-53 of the value. 2^-40 allows for 8192 steps, and is still less than
///     a tenth of the finest unit at the end of the range of positions (9.1e-8 for 1e-6 mm, 9.1e-9 for 1e-7 inch).
/// FIX and FUP allow for at least as much: the FIX and the FUP of a value that EQ finds equal to a whole number are that number.
double sameness(double x, double y) {
  constexpr double kFloor = 1e-9, kShare = 0x1p-40;
  const double width = kShare * std::fmax(std::fabs(x), std::fabs(y));
  return width < kFloor ? kFloor : width < kLargestNoise ? width : kLargestNoise;
}

/// -1, 0 or 1 for LT, EQ or GT, of which exactly one holds. LE, GE and NE follow from these three.
int order(double x, double y) {
  if (x == y || std::fabs(x - y) <= sameness(x, y)) return 0;
  return x < y ? -1 : 1;
}

/// M700 13.5.4 (3): vacant and 0 differ only for EQ and NE.
bool compare(Op op, const Value& a, const Value& b) {
  const int is = order(a.or_zero(), b.or_zero());
  switch (op) {
    case Op::equal:
      return a.vacant == b.vacant && is == 0;
    case Op::not_equal:
      return a.vacant != b.vacant || is != 0;
    case Op::greater:
      return is > 0;
    case Op::less:
      return is < 0;
    case Op::greater_equal:
      return is >= 0;
    default:
      return is <= 0;
  }
}

Eval fail(Fault* fault, Condition condition, double value, const char* function = nullptr) {
  *fault = Fault{};
  fault->condition = condition;
  fault->has_value = true;
  fault->value = value;
  fault->function = function;
  return Eval::fault;
}

/// The name of an operator or function as it is written in a program.
const char* name_of(Op op) {
  static constexpr const char* kNames[] = {"+",    "-",    "OR",  "XOR", "*",   "/",     "MOD", "**", "MOD", "AND", "OR", "XOR", "ATAN", "AND", "SIN", "COS", "TAN", "ASIN",
                                           "ACOS", "ATAN", "SQRT", "ABS", "BIN", "BCD", "ROUND", "FIX", "FUP", "FIX", "FUP", "LN",  "EXP"};
  static_assert(sizeof kNames / sizeof kNames[0] == static_cast<unsigned>(Op::exp) - static_cast<unsigned>(Op::add) + 1);
  return kNames[static_cast<unsigned>(op) - static_cast<unsigned>(Op::add)];
}

/// The stack of values. It is not cleared, because that would take longer than most formulas; every value is written before it is read.
struct ValueStack {
  ValueStack() {}
  union {
    Value at[kStackDepth];
  };
};

}  // namespace

bool variable_number(const Value& value, const EvalOptions& options, uint32_t* number) {
  const double x = value.or_zero(), within = options.variable_numbers_within;
  if (within >= 0 && !(std::fabs(x - std::round(x)) <= within)) return false;
  if (!(x > -std::fmax(kNoise, within) && x < UINT32_MAX)) return false;
  *number = static_cast<uint32_t>(std::floor(x + 0.5 + kNoise));
  return true;
}

bool constant_number(const Block& block, uint16_t code, uint32_t* number) {
  const uint8_t* p = block.code.begin() + code;
  if (static_cast<Op>(p[0]) != Op::small || static_cast<Op>(p[3]) != Op::end) return false;
  *number = static_cast<uint32_t>(p[1] | p[2] << 8);
  return *number <= INT16_MAX;
}

bool lone_variable(const Block& block, uint16_t code, uint32_t* number) {
  const uint8_t* p = block.code.begin() + code;
  if (static_cast<Op>(p[0]) != Op::variable || static_cast<Op>(p[4]) != Op::end) return false;
  *number = static_cast<uint32_t>(p[1] | p[2] << 8 | p[3] << 16);
  return true;
}

Eval evaluate(const Block& block, uint16_t code, const VariableReader& reader, const EvalOptions& options,
              Value* value, Fault* fault, uint32_t* sync) {
  ValueStack values;
  Value* const stack = values.at;
  unsigned top = 0;  // number of values on the stack
  const uint8_t* p = block.code.begin() + code;
  for (;;) {
    const Op op = static_cast<Op>(*p++);
    switch (op) {
      case Op::end:
        *value = stack[0];
        return Eval::ok;
      case Op::constant:
        stack[top++] = Value::of(block.constants[*p++]);
        break;
      case Op::small:
        stack[top++] = Value::of(static_cast<int16_t>(static_cast<uint16_t>(p[0] | p[1] << 8)));
        p += 2;
        break;
      case Op::variable: {
        const uint32_t number = static_cast<uint32_t>(p[0] | p[1] << 8 | p[2] << 16);
        p += 3;
        if (number - 1 < reader.local_count) {
          const double stored = reader.locals[number - 1];
          stack[top++] = stored != stored ? Value{} : Value::of(stored);
          break;
        }
        Value& v = stack[top++] = Value{};
        const Eval got = reader.read(reader.self, number, &v, fault, sync);
        if (got != Eval::ok) return got;
        break;
      }
      case Op::load: {
        uint32_t number = 0;
        Value& v = stack[top - 1];
        if (!variable_number(v, options, &number) || number > kMaxVariable) return fail(fault, Condition::variable_number, v.or_zero());
        const Eval got = reader.read(reader.self, number, &v, fault, sync);
        if (got != Eval::ok) return got;
        break;
      }
      case Op::name: {
        const unsigned begin = static_cast<unsigned>(p[0] | p[1] << 8), length = p[2];
        p += 3;
        uint32_t number = 0;
        if (reader.names_need != 0) {
          *sync = reader.names_need;
          return Eval::need_sync;
        }
        if (reader.find_name == nullptr ||
            !reader.find_name(reader.self, block.text.begin() + begin, length, &number)) {
          *fault = Fault{};
          fault->condition = Condition::variable_name;
          return Eval::fault;
        }
        stack[top++] = Value::of(number);
        break;
      }
      case Op::named:
      case Op::exists:
      case Op::name_for_writing: {
        const unsigned begin = static_cast<unsigned>(p[0] | p[1] << 8), length = p[2];
        p += 3;
        uint32_t number = 0;
        const bool writing = op == Op::name_for_writing;
        Value& v = stack[top++];
        v = Value{};
        if (reader.find_named != nullptr && reader.find_named(reader.self, block.text.begin() + begin, length, writing, &number)) {
          if (writing) {
            v = Value::of(number);
            break;
          }
          const Eval got = reader.read(reader.self, number, &v, fault, sync);
          if (got != Eval::ok) return got;
        } else if (writing) {
          return fail(fault, Condition::too_many_names, NamedParameters::kMost);
        }
        if (op == Op::exists) {
          v = Value::of(v.vacant ? 0 : 1);
        } else if (v.vacant) {
          *fault = Fault{};
          fault->condition = Condition::name_without_value;
          return Eval::fault;
        }
        break;
      }
      case Op::zero_for_vacant:
        // NOLINTNEXTLINE(clang-analyzer-core.uninitialized.Branch): what is on the stack has been pushed, which the analyzer does not see
        if (stack[top - 1].vacant) stack[top - 1] = Value::of(0);
        break;
      case Op::check_number: {
        uint32_t number = 0;
        const Value& v = stack[top - 1];
        if (!variable_number(v, options, &number) || number > kMaxVariable) return fail(fault, Condition::variable_number, v.or_zero());
        break;
      }
      case Op::negate:
        stack[top - 1] = Value::of(0 - stack[top - 1].or_zero());
        break;
      case Op::negate_word:
        // NOLINTNEXTLINE(clang-analyzer-core.uninitialized.Branch): the same
        if (!stack[top - 1].vacant) stack[top - 1].number = -stack[top - 1].number;
        break;
      case Op::equal:
      case Op::not_equal:
      case Op::greater:
      case Op::less:
      case Op::greater_equal:
      case Op::less_equal:
        --top;
        stack[top - 1] = Value::of(compare(op, stack[top - 1], stack[top]) ? 1 : 0);
        break;
      default: {
        const bool two = op <= Op::bit_and;
        if (two) --top;
        const double x = stack[top - 1].or_zero();
        double result = 0, culprit = x;
        const Condition wrong =
            two ? binary(op, x, stack[top].or_zero(), &result, &culprit) : function(op, x, options, &result);
        if (wrong != Condition::none) return fail(fault, wrong, culprit, name_of(op));
        if (!std::isfinite(result)) return fail(fault, Condition::calculation, x, name_of(op));
        stack[top - 1] = Value::of(result);
        break;
      }
    }
  }
}

}  // namespace nc
