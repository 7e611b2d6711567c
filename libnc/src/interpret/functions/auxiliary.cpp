// SPDX-License-Identifier: Apache-2.0
// M, S, T and the second auxiliary function (M700 9, 10, 11; DGSHAPE 2).
#include <cmath>
#include <initializer_list>

#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

void emit_action(Interpreter& in, nc_action_kind kind, char letter, double value) {
  Action& action = in.emit(ItemKind::action).action;
  action.kind = kind;
  action.letter = letter;
  action.value = value;
}

void emit_fin(Interpreter& in) { await_fin(in); }

/// DGSHAPE 2: S00..S99 are code numbers of the R20 series, 10^(n/20) with the series' rounded factors; from 100 on r/min.
double dgshape_speed(uint32_t s) {
  static constexpr double kFactor[20] = {1, 1.12, 1.25, 1.4, 1.6, 1.8, 2, 2.24, 2.5, 2.8, 3.15, 3.55, 4, 4.5, 5, 5.6, 6.3, 7.1, 8, 9};
  if (s >= 100) return s;
  double decade = 1;
  for (uint32_t i = 0; i < s / 20; ++i) decade *= 10;
  return kFactor[s % 20] * decade;
}

/// The second auxiliary address: B, unless an axis has that name; then A, then C (M700 9.2).
char second_address(const Interpreter& in) {
  for (const char letter : {'B', 'A', 'C'})
    if (in.axis_of[letter - 'A'] < 0) return letter;
  return 0;
}

Did spindle_word(Interpreter& in) {
  uint32_t s = 0;
  if (!whole_number(in.words.get('S'), &s) || s > 99999999) return in.raise(Condition::value_range, 'S', in.words.get('S'));
  if (in.state.spindle.axis != 0) {
    const Did did = surface_word(in);
    if (did != Did::done) return did;
  }
  const double speed = in.dialect->id == NC_DIALECT_DGSHAPE ? dgshape_speed(s) : s;
  in.state.modal.spindle = speed;
  emit_action(in, NC_ACTION_S, 'S', speed);
  return Did::done;
}

/// Addresses that are neither an axis nor anything else here.
Did check_axis_letters(Interpreter& in, char second) {
  constexpr uint32_t kAxisAddresses = 0x7 | (0x3f << ('U' - 'A'));  // A B C, U V W X Y Z
  if ((in.words.present & kAxisAddresses & ~in.axis_letters) == 0) return Did::done;
  for (const char letter : {'A', 'B', 'C', 'U', 'V', 'W', 'X', 'Y', 'Z'}) {
    if (!in.words.has(letter) || in.axis_of[letter - 'A'] >= 0 || letter == second) continue;
    const bool dwell = letter == 'X' && in.words.one_shot != nullptr && in.words.one_shot->function == Function::dwell;
    if (dwell) continue;
    const bool aux = letter == 'A' || letter == 'B' || letter == 'C';
    return in.raise(aux && second != 0 && in.dialect->id == NC_DIALECT_M700 ? Condition::second_aux : Condition::illegal_axis, letter,
                    in.words.get(letter));
  }
  return Did::done;
}

bool output_code(const Interpreter& in, uint32_t code) {
  if (is_interrupt_on(in, code) || is_interrupt_off(in, code)) return false;  // M700 13.12: processed internally
  const MiscRow* row = find_misc(*in.dialect, code);
  return row == nullptr || row->function == MiscFunction::output;
}

/// DGSHAPE M06: M06 and T come as a pair, never more than one of each in a block.
Did check_tool_pair(Interpreter& in) {
  unsigned changes = 0, tools = 0;
  for (const uint32_t m : in.words.m) changes += m == 6 ? 1u : 0u;
  for (const Word& word : in.block->words) tools += word.letter == 'T' ? 1u : 0u;
  if (changes != 1 || tools != 1) return in.raise(Condition::tool_pair, changes == 0 ? 'T' : 'M', changes == 0 ? in.words.get('T') : 6);
  return Did::done;
}

/// DGSHAPE 2: numbers "with no decimal point": codes, speeds, numbers of things; P (but the factor of G51) and K where they are
/// milliseconds, a number, a count.
Did check_whole_numbers(Interpreter& in) {
  const BlockWords& w = in.words;
  const bool cycle = w.cycle != nullptr || in.state.cycle.kind != CycleKind::none;
  const bool arc = w.motion != nullptr && w.motion->function != Function::rapid && w.motion->function != Function::linear;
  const uint32_t whole = letters("MSTDHL") | (w.one_shot != nullptr && w.one_shot->function == Function::scaling_on ? 0 : letters("P")) | (cycle && !arc ? letters("K") : 0);
  for (const Word& word : in.block->words)
    if (((whole >> (word.letter - 'A')) & 1) != 0 && (word.flags & kWordPoint) != 0)
      return in.raise(Condition::format_error, word.letter, word.value);
  return Did::done;
}

}  // namespace

/// M700 10.5: #3003 bit 1 = FIN is not awaited.
void await_fin(Interpreter& in) {
  if ((in.state.control_3003 & 2) != 0) return;
  in.emit(ItemKind::gate).gate.kind = NC_GATE_FIN;
}

Did check_company(Interpreter& in) {
  const BlockWords& w = in.words;
  if (in.dialect->id != NC_DIALECT_DGSHAPE) return Did::done;
  const Did did = check_whole_numbers(in);
  if (did != Did::done) return did;
  // DGSHAPE 2: M00 M01 M02 M30 alone; G04 alone in its block.
  const unsigned words = in.block->words.size();
  for (const uint32_t m : w.m)
    if (!output_code(in, m) && words > 1) return in.raise(Condition::must_stand_alone, 'M', m);
  if (w.one_shot != nullptr && w.one_shot->function == Function::dwell && words > 2) return in.raise(Condition::must_stand_alone, 'G', 4);
  const uint32_t tool = w.has('T') ? 1u : 0u;
  for (const uint32_t m : w.m)
    if (m == 6 || tool != 0) return check_tool_pair(in);
  return tool != 0 ? check_tool_pair(in) : Did::done;
}

bool codes_behind_motion(const Interpreter& in) { return in.settings.codes_after_motion && in.words.axes != 0; }

Did auxiliary_before(Interpreter& in) {
  BlockWords& w = in.words;
  // Most blocks have none of the addresses that are looked at here.
  if (w.m.empty() && !w.any(letters("ABCSTUVWXYZ") & ~in.axis_letters)) return Did::done;
  const bool dgshape = in.dialect->id == NC_DIALECT_DGSHAPE;
  const char second = dgshape ? char{0} : second_address(in);
  Did did = check_axis_letters(in, second);
  if (did != Did::done) return did;
  bool waiting = false;
  if (w.has('S') && !is_clamp_command(in)) {
    did = spindle_word(in);
    if (did != Did::done) return did;
    waiting = true;
  }
  if (w.has('T')) {
    if (!whole_number(w.get('T'), &in.state.modal.tool) || in.state.modal.tool > 99999999) return in.raise(Condition::value_range, 'T', w.get('T'));
    emit_action(in, NC_ACTION_T, 'T', in.state.modal.tool);
    waiting = true;
  }
  if (second != 0 && w.has(second)) {
    if (!whole_number(w.get(second), &in.state.modal.b) || in.state.modal.b > 99999999) return in.raise(Condition::value_range, second, w.get(second));
    emit_action(in, NC_ACTION_B, second, in.state.modal.b);
    waiting = true;
  }
  // M700 9.1: with five or more M codes only the last four count.
  const unsigned first = !dgshape && w.m.size() > 4 ? w.m.size() - 4 : 0;
  for (unsigned i = first; i < w.m.size(); ++i) {
    const uint32_t m = w.m[i];
    if (!output_code(in, m)) continue;
    if (m > 99999999) return in.raise(Condition::value_range, 'M', m);
    // DGSHAPE 2: M03 while turning and M05 while stopped are ignored.
    if (dgshape && ((m == 3 && in.state.spindle_on) || (m == 5 && !in.state.spindle_on))) continue;
    if (m == 3 || m == 4) in.state.spindle_on = true;
    if (m == 5) in.state.spindle_on = false;
    if (waiting && i > first) emit_fin(in);  // one M strobe at a time
    in.state.modal.m = m;
    emit_action(in, NC_ACTION_M, 'M', m);
    waiting = true;
  }
  if (!waiting) return Did::done;
  if (w.one_shot != nullptr && w.one_shot->function == Function::dwell) {
    w.fin_behind_dwell = true;  // M700 8.1 (5): the time begins with the function
  } else {
    emit_fin(in);
  }
  return Did::done;
}

namespace {

/// M98 or M99 beside another of M98 M99 M02 M30: only the first would ever act.
bool two_ways_on(const Interpreter& in) {
  unsigned ways = 0;
  bool call = false;
  for (const uint32_t m : in.words.m) {
    const MiscRow* row = find_misc(*in.dialect, m);
    if (row == nullptr) continue;
    const bool here = row->function == MiscFunction::call_sub || row->function == MiscFunction::return_sub;
    call = call || here;
    ways += here || row->function == MiscFunction::program_end ? 1u : 0u;
  }
  return call && ways > 1;
}

}  // namespace

Did auxiliary_after(Interpreter& in) {
  if (in.words.m.size() > 1 && two_ways_on(in)) return in.raise(Condition::format_error, 'M', in.words.m.back());
  for (const uint32_t m : in.words.m) {
    if (in.settings.any_reading_stop)
      for (const uint32_t stops : in.settings.reading_stops) in.state.stop_reading |= stops != 0 && stops == m;  // M700 4.2
    if (is_interrupt_on(in, m) || is_interrupt_off(in, m)) {
      const Did did = is_interrupt_on(in, m) ? enable_interrupt(in) : disable_interrupt(in);
      if (did != Did::done) return did;
      continue;
    }
    const MiscRow* row = find_misc(*in.dialect, m);
    if (row == nullptr) continue;
    switch (row->function) {
      case MiscFunction::program_stop:
        in.state.modal.m = m;
        emit_action(in, NC_ACTION_M, 'M', m);
        emit_fin(in);  // M700 9.1: the stop comes with the completion
        in.emit(ItemKind::gate).gate.kind = NC_GATE_STOP;
        break;
      case MiscFunction::optional_stop:
        in.state.modal.m = m;
        in.emit(ItemKind::gate).gate.kind = NC_GATE_OPTIONAL_STOP;
        break;
      case MiscFunction::program_end:
        if (check_loops_closed(in) != Did::done) return Did::fault;
        if (in.state.comp.side != 0) in.state.comp.side = 0;
        in.state.modal.m = m;
        emit_action(in, NC_ACTION_M, 'M', m);
        emit_fin(in);
        end_spindle_control(in);
        in.state.end_seen = true;
        return Did::done;
      case MiscFunction::call_sub: return call_sub(in);
      case MiscFunction::call_external: return call_external(in);
      case MiscFunction::return_sub: return return_sub(in);
      default: break;
    }
  }
  return Did::done;
}

}  // namespace nc
