// SPDX-License-Identifier: Apache-2.0
// G04: dwell.
#include <cmath>

#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

/// M700 8.1 note 3: an X before G04 is read as a length. In inch, which has one decimal more, the time becomes ten times as long, unless X counts in that
/// decimal itself. In type II X5 is X5. (5.3).
bool read_as_inch(const BlockInHand& in) {
  if (!in.state.modal.is(Function::inch) || !(in.words.pointed(Role::dwell_seconds) || in.settings.whole_positions())) return false;
  return stands_before(*in.block, in.front, in.word(Role::dwell_seconds), Function::dwell);
}

/// Seconds of the word X or P. M700 8.1: by the table with #1078 and #8112. DGSHAPE G04: P is always in ms; X is in seconds with a point, otherwise in ms, or
/// in seconds where X is read by the calculator type.
double seconds_of(const BlockInHand& in, Role word) {
  const Command& w = in.words;
  const double raw = w.get(word);
  if (word == Role::dwell_seconds && in.dialect->rules.dwell.early_x_is_length && read_as_inch(in)) return raw * 10;
  if (word == Role::dwell_seconds && in.dialect->rules.dwell.x_is_seconds) return raw;
  if (word == Role::dwell_time && !in.settings.dwell_p_decimal) return std::trunc(raw) / 1000;  // always whole ms
  return w.pointed(word) || in.settings.whole_positions() ? raw : raw / 1000;
}

}  // namespace

Execution do_dwell(BlockContext& in) {
  const Command& w = in.words;
  const Role word = w.has(Role::dwell_seconds) ? Role::dwell_seconds : Role::dwell_time;
  const DwellRules& rules = in.dialect->rules.dwell;
  // "G04 X_" or "G04 P_" (M700 8.1, DGSHAPE G04, HX 5.4; Series 8 G04: X or F): of two times none is that of the program.
  if (w.has(Role::dwell_seconds) && w.has(Role::dwell_time) && !has_words_of_call(in)) return in.raise(Condition::two_words, Role::dwell_time, w.get(Role::dwell_time));
  if (!w.has(word) && !rules.time_optional) return in.raise_code(Condition::words_missing, *w.one_shot);
  // M700 15.2 prints "G04" alone behind G31, "machine stop check": the axes come to rest, and that is all.
  if (rules.refuses_axes && w.target.axes() != 0) return in.raise_code(Condition::must_stand_alone, *w.one_shot);
  const bool revolutions = in.settings.dwell_in_revolutions && in.state.modal.is(Function::feed_per_revolution);  // HX 5.4
  const double seconds = !w.has(word) ? 0 : revolutions ? w.get(word) : seconds_of(in, word);
  if (!(seconds >= 0) || seconds > rules.longest_s) return in.raise(Condition::value_range, word, w.get(word));
  Gate& gate = in.emit(ItemKind::gate).gate;
  gate.kind = revolutions ? NC_GATE_DWELL_TURNS : NC_GATE_DWELL_SECONDS;
  gate.announce = w.has(word);
  gate.value = seconds;
  gate.skip_mask = in.settings.dwell_skip;
  if (in.words.fin_behind_dwell) await_fin(in);
  return Execution::done;
}

}  // namespace nc
