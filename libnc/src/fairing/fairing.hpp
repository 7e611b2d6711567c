// SPDX-License-Identifier: Apache-2.0
// Fairing and the judgement of corners: a stage of the stream in high-speed high-accuracy control II (M700 13.17.1, additional functions
// (1) and (3)). Lines go in as programmed; some come out with other ends, some not at all, and each knows how sharp the corner at its
// start is judged to be. Every other item goes through in its place.
//
// How it works. The first line is held until kFairingAhead lines behind it are known, or nothing that is still to come can change it. A chain of all these
// lines (line_chain.hpp) says where the first one ends and how many lines behind it are left out; then the first line is given out. The next line that
// is not left out begins where that one ended, and the chain is made anew. So the result for a line depends only on where it begins and on the text
// behind it, and FairingResume is all that has to be kept for a mark to go on from there.
//
// Marks between the lines stay where they are. The mark of a block that is left out stands at the joint, where the machine is. Any other item ends the
// row of lines: nothing is left out across it, and the line before it ends where it is programmed.
#pragma once

#include "base/arena.hpp"
#include "fairing/line_chain.hpp"

namespace nc {

/// What is needed to go on from a mark.
struct FairingResume {
  bool moved = false;      ///< the machine stands at `joint` and not at the programmed point
  uint8_t left_out = 0;    ///< number of lines to come that are left out
  bool judging = false;    ///< a line has been given out, so that the corner at the start of the next one can be judged
  bool short_before = false;  ///< that line is too short to count
  bool long_known = false;    ///< `long_before` is known
  AxisVec joint;           ///< compensation frame
  AxisVec long_before;     ///< direction, of length 1, of the last line that was long enough to count
  bool active() const { return moved || judging; }
};

inline bool in_force(const FairingResume& resume) { return resume.active(); }

class FairingStage {
 public:
  static constexpr unsigned kHeld = 32;  ///< the most items that are held; a power of two, so that their numbers may wrap
  using Rule = FairingRule;
  using Resume = FairingResume;
  /// `rotary`: bit i: axis i is rotary. A line that moves a rotary axis is not faired.
  void create(unsigned axis_count, uint32_t rotary, Arena& arena) {
    axis_count_ = axis_count;
    rotary_ = rotary;
    held_ = arena.make<Held>(kHeld);
  }
  /// The item is a line to which fairing or the judgement of corners applies. `calm` is false while the stage behind compensates a contour: then there is
  /// no fairing, because the figure as programmed is compensated (docs/decisions.md).
  bool takes(const Item& item, const FairingRule& rule, bool calm) const { return calm && rule.any() && takes(item); }
  /// Takes an item, where there is room. False: the items that are held have to go first, so pop() until there is none.
  /// An item that is neither a line nor the mark of one closes the row: nothing behind it is waited for.
  bool push(const Item& item, const FairingRule& rule);
  /// Next finished item, false when the stage has none or must see more items first.
  bool pop(Item& out);
  /// Forgets everything.
  void reset();
  /// What is needed to go on right behind the mark that pop() gave last.
  const FairingResume& resume_point() const { return state_; }
  void restore(const FairingResume& resume) {
    reset();
    state_ = resume;
  }
  /// The axes were moved by hand: a joint between lines does not hold any more, so every line leads to its own end.
  void displaced() { reset(); }
  /// True when nothing is held: items may bypass the stage.
  bool idle() const { return count_ == 0 && !state_.active(); }

 private:
  static constexpr unsigned kMostHeld = 24;  ///< with so many items the first line does not wait for further ones
  struct Held {
    Item item;
    bool line = false;
    double length = 0;  ///< length of a line as programmed, mm
  };
  Held& held(unsigned number) { return held_[(first_ + number) % kHeld]; }
  double distance(const AxisVec& a, const AxisVec& b) const { return distance_of(a, b, axis_count_); }
  bool takes(const Item& item) const;
  /// Closes the row: nothing that is still to come changes the items that are held.
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
  unsigned lines_ = 0;     ///< number of lines held
  unsigned short_ = 0;     ///< number of lines held that are, as programmed, shorter than rule_.length_mm
  bool closing_ = false;   ///< the row of lines is closed
  AxisVec end_;            ///< end of the line pushed last, as programmed
  TransformId transform_ = 0;  ///< what that line has in common with the row: its coordinates, prohibited area and parameters
  uint32_t stroke_box_ = 0;
  SettingsId settings_ = 0;
  FairingRule rule_;
  FairingResume state_;    ///< the state before the first item held
  unsigned axis_count_ = 3;
  uint32_t rotary_ = 0;
};

}  // namespace nc
