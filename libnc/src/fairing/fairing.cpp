// SPDX-License-Identifier: Apache-2.0
#include "fairing/fairing.hpp"

#include "base/same_place.hpp"

namespace nc {
namespace {

constexpr double kSlack = 1e-9;     // mm, for rounding of positions when the program goes on from a mark

/// The mark at the end of a block, which does not end a row of lines. The mark of M99 does, because the program begins again behind it.
bool plain_mark(const Item& item) { return item.kind == ItemKind::mark && !item.mark.again; }

}  // namespace

// M700 13.17.1 precaution (13): fairing applies only to consecutive G01 blocks.
bool FairingStage::takes(const Item& item) const {
  if (item.kind != ItemKind::move) return false;
  const Move& m = item.move;
  const bool line = m.kind == NC_MOVE_LINE && !m.circular && m.shape == 0 && m.skip_mask == 0 && !m.exact_stop && !m.connecting;
  if (!line || (m.high_accuracy & kFineSegmentsOn) == 0 || m.comp.side != 0 || m.space.on) return false;
  for (unsigned i = 0; rotary_ >> i != 0 && i < axis_count_; ++i)
    if ((rotary_ >> i & 1) != 0 && m.end[i] != m.start[i]) return false;  // degrees cannot be measured together with millimetres
  return true;
}

/// The line begins where the one before it ends, in the same coordinates and with the same parameters.
bool FairingStage::follows(const Move& move) const {
  return move.transform == transform_ && move.stroke_box == stroke_box_ && move.settings == settings_ && distance(end_, move.start) <= kNoLength;
}

bool FairingStage::push(const Item& item, const FairingRule& rule) {
  if (closing_ || count_ == kHeld) return false;
  const bool line = takes(item);
  if (line && lines_ != 0 && (!(rule == rule_) || !follows(item.move))) {
    close();
    return false;
  }
  Held& place = held(count_);
  if (line) {
    place.length = distance(item.move.start, item.move.end);
    if (place.length <= kNoLength) return true;  // commit would leave it out
    rule_ = rule;
    end_ = item.move.end;
    transform_ = item.move.transform;
    stroke_box_ = item.move.stroke_box;
    settings_ = item.move.settings;
    ++lines_;
    if (place.length < rule.length_mm) ++short_;
  }
  place.item = item;
  place.line = line;
  ++count_;
  if (!line && !plain_mark(item)) closing_ = true;
  return true;
}

bool FairingStage::pop(Item& out) {
  while (count_ != 0) {
    Held& front = held(0);
    if (front.line) {
      if (state_.left_out != 0 && drop_line(front.item.move)) continue;
      if (!closing_ && lines_ <= kFairingAhead && count_ < kMostHeld) return false;
      decide(&front.item.move);
    }
    out = front.item;
    drop_front();
    return true;
  }
  return false;
}

/// Leaves the first line out. False: it is not the line that was meant, because the text may be another one after blocks are read again (a switch of
/// optional block skip has changed).
bool FairingStage::drop_line(const Move& move) {
  if (distance(move.end, state_.joint) > rule_.length_mm + kSlack) {
    state_.left_out = 0;
    return false;
  }
  --state_.left_out;
  drop_front();
  return true;
}

void FairingStage::drop_front() {
  const Held& front = held(0);
  if (front.line) {
    --lines_;
    if (front.length < rule_.length_mm) --short_;
  }
  first_ = (first_ + 1) % kHeld;
  if (--count_ != 0 || !closing_) return;
  closing_ = false;  // the row of lines has ended; the next row does not depend on it
  state_ = {};
}

/// Decides where the first line begins and ends, how many lines behind it are left out, and how sharp the corner at its start is judged to be.
void FairingStage::decide(Move* move) {
  if (state_.moved && distance(move->start, state_.joint) <= rule_.length_mm + kSlack) move->start = state_.joint;
  const bool joins = rule_.fairing && short_ahead();
  if (!joins && !(rule_.judge && (state_.short_before || distance(move->start, move->end) < rule_.judge_length_mm))) {
    state_.left_out = 0;
    state_.moved = false;
    if (rule_.judge) judge_long(*move);
    return;
  }
  LineChain chain(axis_count_);
  chain.begin(move->start);
  chain.add(move->end);
  for (unsigned i = 1; i < count_ && chain.lines() <= kFairingAhead; ++i)
    if (held(i).line) chain.add(held(i).item.move.end);
  if (joins) chain.fair(rule_);
  state_.left_out = static_cast<uint8_t>(chain.left_out());
  state_.moved = state_.left_out != 0;
  if (state_.moved) state_.joint = move->end = chain.first_end();
  if (rule_.judge) judge(chain, move);
}

/// M700 13.17.1 (3): the corner at the start of the first line is judged by the directions of the nearest lines before and behind it that are not too
/// short.
void FairingStage::judge(const LineChain& chain, Move* move) {
  const double least = rule_.judge_length_mm;
  const bool is_short = chain.length(0) < least;
  if (state_.long_known && (state_.short_before || is_short)) {
    unsigned behind = 0;
    while (behind < chain.lines() && chain.length(behind) < least) ++behind;
    if (behind < chain.lines()) move->judged_turn = static_cast<float>(distance(state_.long_before, chain.direction(behind)));
  }
  state_.judging = true;
  state_.short_before = is_short;
  if (is_short) return;
  state_.long_known = true;
  state_.long_before = chain.direction(0);
}

/// Judges the corner where both lines at it are long enough: the real corner counts.
void FairingStage::judge_long(const Move& move) {
  state_.judging = state_.long_known = true;
  state_.short_before = false;
  const double length = distance(move.start, move.end);
  for (unsigned i = 0; i < axis_count_; ++i) state_.long_before[i] = (move.end[i] - move.start[i]) / length;
}

void FairingStage::reset() {
  first_ = count_ = lines_ = short_ = 0;
  closing_ = false;
  state_ = {};
}

}  // namespace nc
