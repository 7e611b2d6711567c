// SPDX-License-Identifier: Apache-2.0
#include "control/restart_search.hpp"

#include <algorithm>

namespace nc {

void RestartSearch::begin(const nc_restart_place& place, unsigned file, const nc_world& world) {
  *this = {};
  place_ = place;
  world_ = world;
  wanted_.file = static_cast<uint16_t>(file);
  phase_ = place.by == NC_RESTART_SEQUENCE ? Phase::sequence : Phase::passing;
  if (place.by == NC_RESTART_LINE) wanted_.line = static_cast<uint32_t>(place.number);
}

void RestartSearch::found_sequence(uint32_t on_line) {
  wanted_.line = on_line;
  phase_ = Phase::passing;
}

bool RestartSearch::comes_to_line(BlockSeq seq) {
  if (!counted_ || counted_at_ != seq) ++passings_, ++open_;
  counted_ = true;
  counted_at_ = seq;
  in_block_ = true;
  return passings_ == std::max(place_.passing, uint32_t{1});
}

bool RestartSearch::reached(const Item& item) {
  if (item.kind == ItemKind::alarm || item.kind == ItemKind::end) return false;  // of them the host is told otherwise
  const bool call_ends = item.kind == ItemKind::mark && item.mark.of_call;
  if (in_block_ && !call_ends) return false;
  in_block_ = true;
  if (wanted_.line == 0) return !call_ends && blocks_ == place_.number;
  if (!on_line(item) || (call_ends && open_ != 0)) return false;
  torn_ = call_ends;
  return ++passings_ == std::max(place_.passing, uint32_t{1});
}

void RestartSearch::note(const Item& item) {
  if (item.kind == ItemKind::mark && item.mark.report) {
    ++blocks_;
    in_block_ = false;
    if (on_line(item) && open_ != 0) --open_;
  }
  if (item.kind == ItemKind::sync) given_.asked |= item.sync.what;
  if (item.kind == ItemKind::action) note_action(item.action);
}

void RestartSearch::note_action(const Action& action) {
  const bool number = action.value >= 0 && action.value < 4294967296.0;
  const auto code = number ? static_cast<uint32_t>(action.value) : uint32_t{0};
  switch (action.kind) {
    case NC_ACTION_M: return note_m(code, action.changes_tool);
    case NC_ACTION_S: given_.s_given = true, given_.s = action.value, given_.s_order = ++codes_; return;
    case NC_ACTION_T: given_.t_given = true, given_.t = code, given_.t_order = ++codes_; return;
    case NC_ACTION_B: given_.b_given = true, given_.b = code, given_.b_order = ++codes_; return;
    case NC_ACTION_OUTPUT:
      if (action.index >= NC_WORDS) return;
      given_.output[action.index] = (given_.output[action.index] & ~action.mask) | (action.bits & action.mask);
      given_.output_written[action.index] |= action.mask;
      return;
    case NC_ACTION_CONTROL:
    case NC_ACTION_CURRENT_LIMIT: return note_control(action);
    default: return;
  }
}

/// Each M code once, the newest at the end. Where there are too many the oldest goes, since the newest tell more; but not the tool change, without which its T
/// means nothing.
void RestartSearch::note_m(uint32_t number, bool changes_tool) {
  if (changes_tool) {
    changed_ = true, change_ = number;
    given_.change_t_given = given_.t_given, given_.change_t = given_.t, given_.change_t_order = given_.t_order;
  }
  const unsigned kept = std::min<uint32_t>(given_.m_count, NC_RESTART_CODES);
  unsigned at = static_cast<unsigned>(std::find(given_.m, given_.m + kept, number) - given_.m);
  if (at == kept) ++given_.m_count;
  if (at == NC_RESTART_CODES) at = changed_ && given_.m[0] == change_ ? 1 : 0;
  const unsigned last = at == kept ? kept : kept - 1;
  std::copy(given_.m + at + 1, given_.m + last + 1, given_.m + at);
  std::copy(given_.m_order + at + 1, given_.m_order + last + 1, given_.m_order + at);
  given_.m[last] = number;
  given_.m_order[last] = ++codes_;
}

/// What two clamps of the spindle amount to: S and Q stay where the later one does not command them, and one without both ends the clamp.
static Action both_clamps(const Action& before, const Action& later) {
  const auto how = static_cast<uint32_t>(later.value), was = static_cast<uint32_t>(before.value);
  constexpr uint32_t kCommanded = NC_CLAMP_S | NC_CLAMP_Q;
  Action both = later;
  if ((how & kCommanded) == 0) return both;
  if ((how & NC_CLAMP_S) == 0) both.bits = before.bits;
  if ((how & NC_CLAMP_Q) == 0) both.mask = before.mask;
  both.value = how | (was & kCommanded);
  return both;
}

void RestartSearch::note_control(const Action& action) {
  if (action.kind == NC_ACTION_CONTROL && action.index == NC_CONTROL_TOOL_LIFE) return;
  if (action.kind == NC_ACTION_CONTROL && action.index == NC_CONTROL_SURFACE_RADIUS) radius_given_ = true;
  Action newest = action;
  const auto same = [&](const Action& other) { return other.kind == action.kind && other.index == action.index; };
  const Action* const before = std::find_if(control_, control_ + control_count_, same);
  if (before != control_ + control_count_ && action.kind == NC_ACTION_CONTROL && action.index == NC_CONTROL_SPINDLE_CLAMP) newest = both_clamps(*before, action);
  Action* const end = std::remove_if(control_, control_ + control_count_, same);
  control_count_ = static_cast<unsigned>(end - control_);
  if (control_count_ == kControls) std::copy(control_ + 1, control_ + control_count_--, control_);  // there are not so many kinds and axes
  control_[control_count_++] = newest;
}

void RestartSearch::tell(nc_restart_found* out) const {
  const uint32_t size = out->struct_size;
  *out = given_;
  out->struct_size = size;
  out->blocks = blocks_;
}

bool RestartSearch::goes_on_in(uint64_t hash) const { return std::find(hash_, hash_ + hashes_, hash) != hash_ + hashes_; }

void RestartSearch::searched_beside(uint64_t hash, bool begins) {
  if (begins) {
    if (hashes_ == kHashes) std::copy(hash_ + 2, hash_ + hashes_--, hash_ + 1);  // the first is that of the search itself
    ++hashes_;
  }
  if (hashes_ > 1) hash_[hashes_ - 1] = hash;
}

}  // namespace nc
