// SPDX-License-Identifier: Apache-2.0
// Macro interrupts (M700 13.12): where they may begin, and how a block that was cut goes on behind them.
#include <cmath>

#include "base/same_place.hpp"
#include "control/part_system.hpp"

namespace nc {

nc_status PartSystem::interrupt_signal(bool on, bool* take_back) {
  *take_back = false;
  const bool rises = on && !uit_;
  uit_ = on;
  if (!on) uit_rest_.forget();
  watch();
  const bool stays = on && interpreter.interrupts().by_level && uit_rest_.over();
  if (!(rises || stays) || !interruptible()) return NC_OK;
  uit_pending_ = true;
  watch();
  // M700 13.12: an interrupt of type 1 acts at once. It interrupts the item that was given out last, where that takes time; a contour under
  // compensation, a hole of a fixed cycle and a block that waits for an answer are finished first.
  const bool cuttable = !pulled_in_hole_ && (takes_time(pulled_) || pulled_ == ItemKind::action) && (!is_amid_ || cut_within());
  if (interpreter.interrupts().type_2 || !cuttable || !stages_.idle() || staged_count_ != 0 || open_sync_ != 0) return NC_OK;
  commit_.take_back(pulled_ == ItemKind::move);
  if (interpreter.interrupt(standing(), 1, true)) {
    if (is_amid_) commit_.displace(amid_);
    is_amid_ = uit_pending_ = false;
    uit_mode_ |= NC_INTERRUPT_IN_SERVICE;
    pulled_ = ItemKind::mark;
    looked_behind_ = kNowhere;
    *take_back = true;
  } else {
    commit_.put_back(pulled_ == ItemKind::move);
  }
  return NC_OK;
}

/// The item given out last may end in its middle, as on the machine (Interpolator::may_cut()).
bool PartSystem::cut_within() const {
  if (pulled_ != ItemKind::move) return true;
  const bool with_spindle = move_kind_ == NC_MOVE_THREAD || move_kind_ == NC_MOVE_TAP;
  return !with_spindle && !commit_.moves_tables() && !commit_.rounds();
}

/// Begins the interrupt program at the end of a block. The blocks that were read ahead behind this block are given up.
bool PartSystem::begin_interrupt() {
  const MarkPoint* last = commit_.newest();
  if (last == nullptr || last->serial != commit_.serial()) return false;
  const Serial serial = last->serial;
  if (rewind(serial) != NC_OK) return false;
  uit_pending_ = false;
  if (!interrupt_between()) return false;
  uit_mode_ |= NC_INTERRUPT_IN_SERVICE;
  return true;
}

/// Begins the interrupt program behind the newest mark. The next block may be one that an earlier interrupt has cut: then the machine is not where
/// that block begins.
bool PartSystem::interrupt_between() {
  AxisVec machine = interpreter.machine();
  if (interpreter.repeat().active) {
    forget_interrupt();
    machine = commit_.newest()->machine;
    commit_.set_machine(machine);
  }
  return interpreter.interrupt(machine, 0, false);
}

/// The scan has stopped for an interrupt, and the interpreter stands behind the newest mark that has been executed. The machine stands there, too, or
/// inside the next block (type 1).
void PartSystem::interrupt_online() {
  const Cut cut = executor.cut();
  if (!cut.inside) {
    interrupt_between();
    return;
  }
  const auto items = static_cast<unsigned>(cut.done - commit_.serial()) - cut.syncs;  // a sync is not executed again, but answered again
  cut_ = cut;
  if (interpreter.interrupt_inside(cut.machine, items)) {
    forget_interrupt();  // what a block cut earlier had done does not belong to the interrupt program
    commit_.go_on(cut.done, cut.machine);
  } else {  // M97 has been executed meanwhile, so the block goes on
    interpreter.go_on_inside(items);
    commit_.go_on(cut.done, cut.machine);
    drop_repeated(interpreter.repeat(), interpreter.machine());
  }
}

/// The item was executed before its block was interrupted, so it is dropped. No such item lies behind the end of the block.
bool PartSystem::drops(const Item& item) {
  if (item.kind == ItemKind::mark && item.mark.resume) drop_ = 0;
  if (drop_ == 0 || item.kind == ItemKind::sync) return false;
  --drop_;
  return true;
}

/// Reduces the record of a move or dwell that was cut to what is left of it.
void PartSystem::resume_record(Record& record) {
  resumes_ = false;
  if (record.kind == ItemKind::gate && cut_.left > 0 && (record.gate.kind == NC_GATE_DWELL_SECONDS || record.gate.kind == NC_GATE_DWELL_TURNS))
    record.gate.value = cut_.left;
  if (record.kind != ItemKind::move || !(cut_.length > 0)) return;
  Segment& s = record.segment;
  const AxisVec at = curve_position(s.curve, cut_.length, axis_count_);
  double off = 0;
  for (unsigned i = 0; i < axis_count_; ++i) off = std::fmax(off, std::fabs(at[i] - cut_.machine[i]));
  if (off < kReached) {  // the curve, which has been made again, passes through the point where it was cut
    s.begun = cut_.length;
  } else {  // the interrupt program has changed what the block is made from, so the axes do not stand on its curve: a line leads to its end
    s.curve = make_line(cut_.machine, s.curve.end, axis_count_, rotary_);
    s.round_mm[0] = s.round_mm[1] = 0;
    commit_.set_index_axes(&s);
  }
}

/// A block that was interrupted is read again from its head: what it has done is not done twice.
void PartSystem::drop_repeated(const Repeat& repeat, const AxisVec& head) {
  drop_ = repeat.items;
  commit_.set_machine(head);
  resumes_ = online_;
  watch();
}

/// Notes the state of the macro interrupt that M96, M97, the beginning and the end of an interrupt program give out. Such a block cannot be cut.
void PartSystem::note_interrupt_mode(const Item& item) {
  if (item.kind != ItemKind::action || item.action.kind != NC_ACTION_CONTROL || item.action.index != NC_CONTROL_INTERRUPT) return;
  const auto mode = static_cast<uint32_t>(item.action.value);
  uit_rest_.change(uit_mode_, mode);
  uit_mode_ = mode;
  pulled_ = ItemKind::sync;
}

}  // namespace nc
