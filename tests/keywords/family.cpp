// SPDX-License-Identifier: Apache-2.0
#include "family.hpp"

#include <cstring>

#include "alarm/condition.hpp"
#include "dialect/m700/m700.hpp"
#include "dialect/m700/rules.hpp"
#include "program/cursor.hpp"

namespace nc::keywords {
namespace {

using C = Condition;
using F = Function;
using M = MiscFunction;

// Axes have the words of their names; the first words behind Z are those that no letter suggests.
constexpr WordSlot kMotionWord = word_behind_z(0), kCommandWord = word_behind_z(1), kLevel = word_behind_z(2), kStep = word_behind_z(3), kTimes = word_behind_z(4);
constexpr WordSlot kProgram = word_named('O'), kLabel = word_named('N'), kFeed = word_named('F'), kSpeed = word_named('S'), kTool = word_named('T');
constexpr WordSlot kOffset = word_named('D'), kRadius = word_named('R'), kCall = word_named('P'), kTime = word_named('Q');

constexpr SlotRow kRoles[] = {
    {Role::code, kMotionWord},      {Role::misc_code, kCommandWord}, {Role::program_number, kProgram}, {Role::sequence_number, kLabel},
    {Role::feed, kFeed},            {Role::spindle_speed, kSpeed},   {Role::tool, kTool},              {Role::offset_number, kOffset},
    {Role::basic_x, word_named('X')}, {Role::basic_y, word_named('Y')}, {Role::basic_z, word_named('Z')}, {Role::arc_radius, kRadius},
    {Role::cycle_level, kLevel},    {Role::cycle_depth_step, kStep}, {Role::call_program, kCall},      {Role::call_repeats, kTimes},
    {Role::dwell_time, kTime},
};
constexpr WordName kNames[] = {
    {kMotionWord, "motion"}, {kCommandWord, "command"}, {kLevel, "LEVEL"}, {kStep, "STEP"},     {kTimes, "TIMES"},   {kProgram, "PROGRAM"}, {kLabel, "LABEL"}, {kFeed, "FEED"},
    {kSpeed, "SPEED"},       {kTool, "TOOL"},           {kOffset, "OFFSET"}, {kRadius, "RADIUS"}, {kCall, "CALL"},     {kTime, "TIME"},
};

constexpr FunctionRow kFunctions[] = {
    {10, 1, F::rapid, nullptr, "RAPID", "1"},
    {20, 1, F::linear, nullptr, "LINE", "1"},
    {30, 1, F::arc_cw, nullptr, "CIRCLE", "1"},
    {40, 1, F::arc_ccw, nullptr, "ANTICIRCLE", "1"},
    {50, 0, F::dwell, nullptr, "WAIT", "1"},
    {60, 2, F::plane_xy, nullptr, "TOPVIEW", "1"},
    {70, 6, F::metric, nullptr, "METRIC", "1"},
    {80, 7, F::comp_off, nullptr, "CENTRE", "1"},
    {90, 7, F::comp_left, nullptr, "LEFT", "1"},
    {100, 7, F::comp_right, nullptr, "RIGHT", "1"},
    {110, 9, F::cycle_off, nullptr, "NODRILL", "1"},
    {120, 9, F::cycle_peck, nullptr, "PECK", "1"},
    {130, 3, F::absolute, nullptr, "ABSOLUTE", "1"},
    {140, 3, F::incremental, nullptr, "INCREMENTAL", "1"},
    {150, 5, F::feed_per_minute, nullptr, "FEEDMINUTE", "1"},
};
constexpr MiscRow kMisc[] = {
    {2, M::program_end, nullptr, "END", "1"},
    {98, M::call_sub, nullptr, "CALL", "1"},
    {99, M::return_sub, nullptr, "RETURN", "1"},
};
constexpr OutputRow kOutputs[] = {{3, M::spindle_forward}, {5, M::spindle_stop}};
constexpr AlarmText kAlarms[] = {{"FEEDLESS", "no feed"}};
constexpr AlarmRow kConditions[] = {{C::no_feed, "FEEDLESS", nullptr}};
constexpr Function kInitial[] = {F::rapid, F::plane_xy, F::metric, F::comp_off, F::cycle_off, F::absolute, F::feed_per_minute};
// Unlike in other families a code of compensation counts beside a dwell, and increments are a fault in compensation.
constexpr PrecedenceRow kPrecedence[] = {
    {F::dwell, Precedence::both, Precedence::both, Precedence::both, Precedence::both, Precedence::both, Precedence::both, Precedence::both},
};
constexpr BarredRow kBarred[] = {{kInCompensation, F::incremental, C::not_in_compensation, "1"}};
constinit const FamilyParameters kParameters = {.arc_tolerance_mm = 0.01, .checks_interference = true};
constinit const FamilyVariables kVariables = {};

// ---- the reader

struct Keyword {
  const char* text;
  WordSlot slot;     ///< of the number behind it; kNoWord = there is none
  int code = -1;     ///< of a motion, as in its row
  int command = -1;  ///< of a command
};
constexpr Keyword kKeywords[] = {
    {"X", word_named('X')}, {"Y", word_named('Y')}, {"Z", word_named('Z')}, {"FEED", kFeed}, {"SPEED", kSpeed}, {"TOOL", kTool},
    {"OFFSET", kOffset}, {"RADIUS", kRadius}, {"LEVEL", kLevel}, {"STEP", kStep}, {"TIMES", kTimes},
    {"RAPID", kNoWord, 10}, {"LINE", kNoWord, 20}, {"CIRCLE", kNoWord, 30}, {"ANTICIRCLE", kNoWord, 40}, {"WAIT", kTime, 50},
    {"CENTRE", kNoWord, 80}, {"LEFT", kNoWord, 90}, {"RIGHT", kNoWord, 100}, {"NODRILL", kNoWord, 110}, {"PECK", kNoWord, 120},
    {"ABSOLUTE", kNoWord, 130}, {"INCREMENTAL", kNoWord, 140},
    {"CALL", kCall, -1, 98}, {"RETURN", kNoWord, -1, 99}, {"END", kNoWord, -1, 2}, {"SPINDLE", kNoWord, -1, 3}, {"HALT", kNoWord, -1, 5},
};

class Reader {
 public:
  Reader(const char* text, size_t size, Block& block) : text_(text), p_(text), end_(text + size), block_(block) {}

  LexResult run() {
    bool first = true;
    while (!block_.has_fault && pass_blanks()) {
      word(first);
      first = false;
    }
    LexResult result;
    while (p_ != end_ && *p_ != '\n' && *p_ != '|') {
      if (*p_ == '!') {
        while (p_ != end_ && *p_ != '\n') ++p_;
        break;
      }
      ++p_;
    }
    result.ran_out = p_ == end_;
    result.newline = p_ != end_ && *p_ == '\n';
    if (p_ != end_) ++p_;
    result.used = static_cast<size_t>(p_ - text_);
    return result;
  }

 private:
  /// True: something else than the end of the block is here.
  bool pass_blanks() {
    while (p_ != end_ && (*p_ == ' ' || *p_ == '\t' || *p_ == '\r')) ++p_;
    return p_ != end_ && *p_ != '\n' && *p_ != '|' && *p_ != '!';
  }

  void word(bool first) {
    const char* const from = p_;
    while (p_ != end_ && is_letter(*p_)) ++p_;
    const auto length = static_cast<size_t>(p_ - from);
    const auto is = [&](const char* text) { return std::strlen(text) == length && std::memcmp(text, from, length) == 0; };
    double value = 0;
    if (first && is("PROGRAM")) {
      if (number(kProgram, &value)) block_.has_o = true, block_.o = static_cast<uint32_t>(value);
      return;
    }
    if (is("LABEL")) {
      if (number(kLabel, &value)) block_.has_n = true, block_.n = static_cast<uint32_t>(value);
      return;
    }
    for (const Keyword& keyword : kKeywords) {
      if (!is(keyword.text)) continue;
      if (keyword.code >= 0) put(kMotionWord, 0, keyword.code / 10.0, from);
      if (keyword.command >= 0) put(kCommandWord, 0, keyword.command, from);
      if (keyword.slot != kNoWord && number(keyword.slot, &value)) put(keyword.slot, static_cast<uint8_t>(kWordPoint | (value < 0 ? kWordNegative : 0)), value, from);
      return;
    }
    fault(length == 0 ? C::illegal_character : C::illegal_address, length == 0 ? *from : char{0});
  }

  bool number(WordSlot slot, double* value) {
    pass_blanks();
    const char* q = p_;
    const bool minus = q != end_ && *q == '-';
    if (q != end_ && (*q == '-' || *q == '+')) ++q;
    double whole = 0, scale = 1;
    bool point = false, any = false;
    for (; q != end_ && (is_digit(*q) || (*q == '.' && !point)); ++q) {
      if (*q == '.') {
        point = true;
        continue;
      }
      any = true;
      whole = whole * 10 + (*q - '0');
      if (point) scale *= 10;
    }
    if (!any) return fault(C::format_error, letter_of(slot));
    p_ = q;
    *value = (minus ? -whole : whole) / scale;
    return true;
  }

  void put(WordSlot slot, uint8_t flags, double value, const char* at) {
    const size_t column = static_cast<size_t>(at - text_) + 1;
    if (!block_.words.push_back(Word{slot, flags, 0, static_cast<uint8_t>(column < 255 ? column : 255), kNoCode, value})) fault(C::block_too_long, 0);
    block_.empty = false;
  }

  bool fault(C condition, char named_by) {
    block_.has_fault = true;
    block_.fault.condition = condition;
    block_.fault.letter = named_by;
    return false;
  }

  const char* const text_;
  const char* p_;
  const char* const end_;
  Block& block_;
};

LexResult read(const char* text, size_t size, const LexRules&, Semicolon, const uint8_t*, Block& block) {
  block.clear();
  return Reader(text, size, block).run();
}

constexpr LexRules make_rules() {
  LexRules rules{};
  rules.read = read;
  return rules;
}
constexpr LexRules kLex = make_rules();

}  // namespace

const Dialect kDialect = {
    .id = NC_DIALECT_DGSHAPE,
    .name = "keywords",
    .title = "a language of keywords",
    .lex = &kLex,
    .addresses = AddressTable(kRoles, kNames),
    .axis_addresses = AddressTable::letters("XYZ"),
    .length_addresses = 0,
    .codes_by_name = true,
    .functions = kFunctions,
    .misc = kMisc,
    .outputs = kOutputs,
    .conditions = kConditions,
    .alarms = kAlarms,
    .precedence = kPrecedence,
    .barred = kBarred,
    .parameters = &kParameters,
    .variables = &kVariables,
    .rules = m700::kRules,
    .initial = kInitial,
    .percent_required = false,
    .end_code_required = true,
    .bare_letters = false,
    .call_depth = 4,
};

}  // namespace nc::keywords

// It replaces the function of libnc (dialect/registry.cpp): the family takes the place of DGSHAPE, and all others are m700.
const nc::Dialect& nc::dialect(nc_dialect id) { return id == NC_DIALECT_DGSHAPE ? nc::keywords::kDialect : nc::m700::kDialect; }
