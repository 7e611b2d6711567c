// SPDX-License-Identifier: Apache-2.0
// The stage of contours: moves that are pending, because only a later block settles where they end. Its first user is the corner between
// two lines (M700 13.7, ,C and ,R).
//
// How it works. A pending move (Move::corner) is held, and all that comes behind it, until the next movement is there. Then the corner is
// cut (corner.hpp): the pending line ends earlier, the cut is a move of its block (Move::connecting) in front of the block's mark, and the
// next line begins later by the same amount. That line may be pending itself. Nothing but the direction of the next line and how far into
// it the cut reaches goes across the mark, and the next line is read again after a rewind: ContourResume is where the machine stands beside
// the programmed corner.
//
// A block without an end (M700 13.9, Corner::meet) ends where the movement behind it begins, which is the interpreter's to know: it has both
// blocks when it makes that movement, and says so (Move::meets). An arc that may stand alone (a whole circle) goes as it is where no movement
// meets it, and one by its radius alone is nothing then.
//
// What cannot be waited for is an alarm in the place of the pending move: a block without a movement (M700 P382), an arc (P381, but for a machine that
// cuts corners beside arcs), a stop, a sync and the end of the program, and more items than the stage holds. A next block that is in alarm itself says
// so there with its own alarm, which is what has to be mended.
#pragma once

#include "base/arena.hpp"
#include "contour/corner.hpp"

namespace nc {

/// What is needed to go on from a mark.
struct ContourResume {
  bool displaced = false;  ///< the machine stands by `lead` beside the programmed end of the block
  bool meets = false;      ///< which had no end when it was read: positions up to the next movement are by that other ones, too
  AxisVec lead;            ///< compensation frame
};
inline bool in_force(const ContourResume& resume) { return resume.displaced; }

/// Corners beside arcs are cut, too (corner_ii).
struct ContourRule {
  bool arcs = false;
};

class ContourStage {
 public:
  static constexpr unsigned kHeld = 32;  ///< items; a power of two, so that their numbers may wrap
  using Rule = ContourRule;
  using Resume = ContourResume;
  /// `rotary`: bit i: axis i turns. A degree is no length, such an axis goes along. The letters are what alarms call a chamfer and a rounding.
  void create(unsigned axis_count, uint32_t rotary, char chamfer_letter, char rounding_letter, Arena& arena) {
    axis_count_ = axis_count;
    chamfer_letter_ = chamfer_letter;
    rounding_letter_ = rounding_letter;
    rotary_ = rotary;
    held_ = arena.make<Held>(kHeld);
  }
  bool takes(const Item& item, ContourRule, bool) const { return item.move.corner != Corner::none; }
  /// Never refuses: what can be given out is to be fetched before more is pushed.
  bool push(const Item& item, ContourRule rule = {});
  bool pop(Item& out);
  void reset();
  ContourResume resume_point() const { return state_; }
  void restore(const ContourResume& resume) {
    reset();
    state_ = entry_ = resume;
  }
  /// The lead counts from the programmed end, which goes along.
  void displaced() {}
  bool idle() const { return count_ == 0 && !state_.displaced && !entry_.displaced && !failed_; }

 private:
  struct Held {
    Item item;
    bool vacant = false;  ///< place of a cut that there is not
    bool cut = false;     ///< behind it the machine stands by `lead` beside the programmed corner
    bool meets = false;   ///< ... beside the start of a block that had no end
    AxisVec lead;
  };
  Held& held(unsigned number) { return held_[(first_ + number) % kHeld]; }
  Held& append(const Item& item);
  void push_move(const Item& item, ContourRule rule);
  void settle(const Item& next, ContourRule rule);
  void settle_meeting(const Move& next);
  void stand_alone();
  void push_behind_meeting(const Item& item);
  void show_meeting(Item& item, const AxisVec& lead) const;
  void stop_by(const Item& alarm);
  void fail(Condition condition, const nc_source& source, double value);

  Held* held_ = nullptr;
  unsigned first_ = 0, count_ = 0;
  unsigned ready_ = 0;      ///< how many of those held pop() may give
  bool pending_ = false;    ///< item number ready_ is the pending line, and behind it lies the place of its cut
  bool behind_mark_ = false;  ///< the pending line's own block has ended
  bool failed_ = false;
  ContourResume entry_;     ///< for the next move that is pushed
  ContourResume state_;     ///< behind the item that pop() gave last
  char chamfer_letter_ = 0, rounding_letter_ = 0;
  unsigned axis_count_ = 3;
  uint32_t rotary_ = 0;
};

}  // namespace nc
