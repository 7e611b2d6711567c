// SPDX-License-Identifier: Apache-2.0
// G33: threads of constant lead, metric and inch, straight and tapered (M700 6.7).
#include <cmath>

#include "base/units.hpp"
#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

/// M700 6.7.1: a lead is below the end of its range, which in inches is another one by F than by E.
bool lead_in_range(double lead, double limit) { return lead > 0 && lead < limit; }

/// The lead along the long axis that the words give; it stays in force for the thread blocks behind.
Execution take_lead(BlockInHand& in) {
  const Command& w = in.words;
  const bool inch = in.state.modal.is(Function::inch);
  const double unit = inch ? kMillimetresPerInch : 1.0;
  const RangeRules& range = in.dialect->rules.range;
  double lead = 0, limit = range.end_of_lead_mm;
  Role word = Role::thread_lead;
  if (w.has(Role::fine_thread_lead)) {
    word = Role::fine_thread_lead;
    // M700 6.7.1, 6.7.2: #1229 bit 1 says whether E is a precision lead or the number of ridges per inch.
    if (in.settings.precision_lead) {
      lead = w.get(Role::fine_thread_lead) * unit;
      if (inch) limit = range.end_of_fine_lead_inch * kMillimetresPerInch;
    } else if (w.get(Role::fine_thread_lead) > 0 && w.get(Role::fine_thread_lead) < (inch ? range.end_of_ridges_inch : range.end_of_ridges_mm)) {
      lead = kMillimetresPerInch / w.get(Role::fine_thread_lead);
      if (inch) limit = range.end_of_lead_inch * kMillimetresPerInch;  // 6.7.2 (3): within the range of the lead that it is
    }
  } else if (w.has(Role::thread_lead)) {
    lead = w.get(Role::thread_lead) * unit;  // M700 6.7.1: F1 = 1.000
    if (inch) limit = range.end_of_lead_inch * kMillimetresPerInch;
  } else {
    return in.state.thread_lead > 0 ? Execution::done : in.raise(in.dialect->addresses.same(Role::thread_lead, Role::feed) ? Condition::no_feed : Condition::words_missing, Role::thread_lead);
  }
  if (!lead_in_range(lead, limit)) return in.raise(Condition::thread_lead, word, w.get(word));
  in.state.thread_lead = lead;
  return Execution::done;
}

}  // namespace

Execution move_thread(BlockContext& in, const AxisVec& target, uint32_t commanded) {
  const Command& w = in.words;
  if (commanded == 0 && !w.any({Role::fine_thread_lead, Role::thread_lead})) return Execution::done;  // nothing is cut, so no lead is missing
  const Execution did = take_lead(in);
  if (did != Execution::done) return did;
  double angle = 0;  // M700 6.7.1: not modal
  if (w.has(Role::thread_start)) {
    angle = length_value(in, w.written(Role::thread_start), true, true);
    if (!(angle >= 0 && angle <= 360)) return in.raise(Condition::value_range, Role::thread_start, w.get(Role::thread_start));
  }
  if (commanded == 0) return Execution::done;
  LinearStyle style;
  style.kind = NC_MOVE_THREAD;
  style.feed_mm_rev = in.state.thread_lead;
  const bool turns_alone = (w.target.axes() & ~in.rotary) == 0;
  if (turns_alone && in.state.modal.is(Function::inch)) style.feed_mm_rev *= feed_unit(in, in.position(), target) / kMillimetresPerInch;  // 3.2 note 6
  style.thread_angle = angle;
  style.transparent = true;  // M700 6.7.1: radius compensation is away for the thread
  move_linear(in, target, commanded, style);
  return Execution::done;
}

}  // namespace nc
