// SPDX-License-Identifier: Apache-2.0
// G37: automatic tool length measurement (M700 15.1). The axis goes in rapid to the distance R before the measuring position, then at the measuring feed up
// to the distance D behind it, until the sensor signals; the signal must come within D of the position. The difference between the commanded coordinate and
// the one at the signal goes into the tool length.
#include <cmath>
#include <initializer_list>

#include "base/units.hpp"
#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

/// A distance, given by a word of the block, or else by the parameter.
double distance(const BlockInHand& in, Role word, double parameter) {
  return in.words.has(word) ? std::fabs(length_of(in, word)) : parameter;
}

struct Measurement {
  unsigned axis = 0;
  double position = 0;       ///< commanded position, in workpiece coordinates with the tool length in force
  double deceleration = 0;   ///< R, mm
  double range = 0;          ///< D, mm
  double feed_mm_min = 0;
};

Execution read_measurement(BlockInHand& in, Measurement* m) {
  const Command& w = in.words;
  for (const Role word : {Role::length_number, Role::tool})  // (3); T: appendix 1
    if (w.has(word)) return in.raise(Condition::measure_h, word, w.get(word));
  if (w.target.axes() == 0 || (w.target.axes() & (w.target.axes() - 1)) != 0) return in.raise_code(Condition::measure_axis, *w.one_shot);
  while (!w.target.commands(m->axis)) ++m->axis;
  const ModalState& modal = in.state.modal;
  const bool direction_fits = modal.is(Function::length_plus) || (modal.is(Function::length_minus) && !in.dialect->rules.skip.measurement_of_added_length);
  const bool offset_given = direction_fits && modal.h != 0 && in.state.length_axis == m->axis;
  if (!offset_given) return in.raise_code(Condition::measure_no_length, *w.one_shot);
  if (in.state.compensated()) return in.raise_code(Condition::skip_in_compensation, *w.one_shot);
  const bool inch = modal.is(Function::inch);
  m->feed_mm_min = in.settings.measure_feed;
  if (w.has(Role::feed)) {
    const Execution did = feed_of(in, &m->feed_mm_min);
    if (did != Execution::done) return did;
    if (inch) m->feed_mm_min *= kMillimetresPerInch;
  }
  if (!(m->feed_mm_min > 0)) {
    if (in.dialect->rules.skip.measurement_needs_values) return in.raise(Condition::value_range, Role::feed);
    m->feed_mm_min = 1;  // (3)
  }
  m->deceleration = distance(in, Role::measure_deceleration, in.settings.measure_deceleration);
  m->range = distance(in, Role::measure_range, in.settings.measure_range);
  return Execution::done;
}

double finest(const InForce& in) { return in.settings.setting_unit_mm / 2; }

}  // namespace

Execution do_measure_length(BlockContext& in) {
  Measurement m;
  const Execution did = read_measurement(in, &m);
  if (did != Execution::done) return did;
  const uint32_t axis = 1u << m.axis;
  const AxisVec target = target_of_words(in);
  const double way = target[m.axis] - in.position()[m.axis];
  m.position = target[m.axis];
  // (7): |measuring point - start point| > R > D; (8), (9): both may be 0, or only D.
  const bool none = m.deceleration == 0 && m.range == 0 && !in.dialect->rules.skip.measurement_needs_values;
  if (!none && !(m.deceleration > m.range)) return in.raise(Condition::value_range, Role::measure_range, m.range);
  if (!none && !(std::fabs(way) > m.deceleration)) return in.raise(Condition::value_range, Role::measure_deceleration, m.deceleration);
  const double direction = std::copysign(1.0, way);
  AxisVec before = target;
  before[m.axis] = m.position - direction * m.deceleration;
  LinearStyle style;
  style.kind = NC_MOVE_RAPID;
  move_linear(in, before, axis, style);
  in.next_step = Step::measured;
  in.jobs.measure.position = m.position;
  in.jobs.measure.range = m.range;
  in.jobs.measure.nothing = none;
  if (none) return Execution::later;  // (9): P607, whether the sensor signals or not
  AxisVec behind = target;
  behind[m.axis] = m.position + direction * m.range;
  style.kind = NC_MOVE_SKIP;
  style.feed_mm_min = m.feed_mm_min;
  style.exact_stop = true;
  const unsigned number = in.words.one_shot->number;
  style.skip_mask = number < 2 ? uint8_t{1} : static_cast<uint8_t>(1u << (number - 1));  // (2): the skip signal; HX 4.10: one for each code
  move_linear(in, behind, axis, style);
  return in.need(NC_SYNC_SKIP | NC_SYNC_POSITION);
}

Execution measured(BlockInHand& in) {
  State& state = in.state;
  const unsigned axis = state.length_axis;
  const WordSlot name = in.axis_words.word(axis);
  if (in.jobs.measure.nothing) return in.raise(Condition::measure_signal, name, in.jobs.measure.position);
  for (unsigned i = 0; i < in.axis_count; ++i) state.machine[i] = in.world.machine.v[i];
  if (!in.world.skipped) return in.raise(Condition::measure_signal, name, in.jobs.measure.position);
  if (in.dialect->rules.skip.measurement_stores) {
    AxisVec place = state.machine;
    for (unsigned i = 0; i < in.axis_count; ++i) place[i] = in.world.skip_machine.v[i];
    store_skip_position(in, place, ~0u, true);
  }
  const double at = in.world.skip_machine.v[axis] - in.zero()[axis] - state.applied[axis];
  const double difference = at - in.jobs.measure.position;
  if (std::fabs(difference) > in.jobs.measure.range + finest(in)) return in.raise(Condition::measure_signal, name, in.jobs.measure.position);
  // The tool is longer by the difference than the offset that is applied says; G44 counts the offset with the opposite sign.
  const double longer = state.modal.is(Function::length_minus) ? -difference : difference;
  const Frames& f = in.frames;
  const unsigned length = f.tool_key(state.modal.h, NC_TOOL_LENGTH), wear = f.tool_key(state.modal.h, NC_TOOL_LENGTH_WEAR);
  const bool has_wear = in.settings.tool_memory_2 && !in.dialect->rules.skip.measurement_sets_length;
  const double amount = f.get(length) + (has_wear ? f.get(wear) : 0);
  // An offset that is not 0 is corrected in its wear, where the tool memory has wear.
  const unsigned key = has_wear && amount != 0 ? wear : length;
  const double corrected = f.get(key) + longer;
  if (std::fabs(corrected) >= end_of_offset(in, has_wear && amount != 0 ? NC_TOOL_LENGTH_WEAR : NC_TOOL_LENGTH)) return in.raise(Condition::value_range, Role::length_number, corrected);
  in.set_table(key, corrected);  // (4): it acts from the next command of the axis on
  return Execution::done;
}

}  // namespace nc
