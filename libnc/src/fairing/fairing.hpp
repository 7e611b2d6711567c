// SPDX-License-Identifier: Apache-2.0
// Fairing and the judgement of corners: a stage of the stream in high-speed high-accuracy control II (M700 13.17.1, additional functions
// (1) and (3)). Lines go in as programmed; some come out with other ends, some not at all, and each knows how sharp the corner at its
// start is judged to be. Every other item goes through in its place.
//
// How it works. The line in front is held until kFairingAhead lines behind it are known, or nothing that is to come can change it. A chain of
// these (line_chain.hpp) says where it ends and how many lines behind it are left out; then it goes. The next line that stays begins where it
// ended, and the chain is made anew. So what a line becomes follows from where it begins and from the text behind it, and from nothing
// else: FairingResume is all that a mark must keep to go on from there.
//
// Marks between the lines stay where they are. The mark of a block that is left out stands at the joint, where the machine is. Any other
// item ends the row of lines: nothing is left out across it, and the line in front of it ends where it is programmed.
#pragma once

#include "base/arena.hpp"
#include "fairing/line_chain.hpp"

namespace nc {

/// What is needed to go on from a mark.
struct FairingResume {
  bool moved = false;      ///< the machine stands at `joint` and not where the program is
  uint8_t left_out = 0;    ///< so many of the next lines are left out
  bool judging = false;    ///< a line is behind us ...
  bool short_before = false;  ///< ... which does not count where a corner is judged
  bool long_known = false;    ///< and before it one that does, with this direction:
  AxisVec joint;           ///< compensation frame
  AxisVec long_before;
  bool active() const { return moved || judging; }
};

inline bool in_force(const FairingResume& resume) { return resume.active(); }

class FairingStage {
 public:
  static constexpr unsigned kHeld = 32;  ///< items; a power of two, so that their numbers may wrap
  using Rule = FairingRule;
  using Resume = FairingResume;
  /// `rotary`: bit i: axis i turns. A line that moves one is not faired.
  void create(unsigned axis_count, uint32_t rotary, Arena& arena) {
    axis_count_ = axis_count;
    rotary_ = rotary;
    held_ = arena.make<Held>(kHeld);
  }
  /// A line that fairing or the judgement is about. Not while a contour is compensated behind: there its figure is what is compensated
  /// (docs/decisions.md).
  bool takes(const Item& item, const FairingRule& rule, bool calm) const { return calm && rule.any() && takes(item); }
  /// An item, where there is room. False: what is held has to go first, as it is (pop() until there is none).
  /// An item that is no line and no mark of one closes the row: nothing behind it is waited for.
  bool push(const Item& item, const FairingRule& rule);
  /// Next finished item, false when the stage has none or must see more first.
  bool pop(Item& out);
  /// Forget everything.
  void reset();
  /// State right behind the mark that pop() gave last.
  const FairingResume& resume_point() const { return state_; }
  void restore(const FairingResume& resume) {
    reset();
    state_ = resume;
  }
  /// What has been joined is no more: every line goes to its own end.
  void displaced() { reset(); }
  /// True when nothing is held: items may bypass the stage.
  bool idle() const { return count_ == 0 && !state_.active(); }

 private:
  static constexpr unsigned kMostHeld = 24;  ///< with so many the line in front waits for no more
  struct Held {
    Item item;
    bool line = false;
    double length = 0;  ///< of a line, as programmed, mm
  };
  Held& held(unsigned number) { return held_[(first_ + number) % kHeld]; }
  double distance(const AxisVec& a, const AxisVec& b) const { return distance_of(a, b, axis_count_); }
  bool takes(const Item& item) const;
  /// Nothing that is still to come changes what is held.
  void close() { closing_ = count_ != 0; }
  bool follows(const Move& move) const;
  bool short_ahead() const { return short_ > (held_[first_].length < rule_.length_mm ? 1u : 0u); }
  void decide(Move* move);
  void judge(const LineChain& chain, Move* move);
  void judge_long(const Move& move);
  bool drop_line(const Move& move);
  void drop_front();

  Held* held_ = nullptr;
  unsigned first_ = 0, count_ = 0;
  unsigned lines_ = 0;     ///< of those held
  unsigned short_ = 0;     ///< of these, shorter than rule_.length_mm as programmed
  bool closing_ = false;
  AxisVec end_;            ///< of the line pushed last, as programmed
  TransformId transform_ = 0;  ///< and what it stands in
  uint32_t stroke_box_ = 0;
  SettingsId settings_ = 0;
  FairingRule rule_;
  FairingResume state_;    ///< in front of the item in front
  unsigned axis_count_ = 3;
  uint32_t rotary_ = 0;
};

}  // namespace nc
