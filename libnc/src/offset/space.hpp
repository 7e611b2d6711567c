// SPDX-License-Identifier: Apache-2.0
// The stage of vectors in space: a move that carries one (Move::space) ends by it beside its programmed end. Three-dimensional radius
// compensation (M700 12.5) and a length along the axis of the tool (12.3) are such vectors; how they come about is the interpreter's.
//
// How it works. A vector belongs to the end of a block: a move leads from its start with the vector of the move before to its end with its
// own. So a line becomes another line, and the two radii of an arc are those of its displaced ends about the programmed centre, which stays
// (12.5: "the centre does not shift"). The interpreter has compared them, but for arcs that a stage in front of this one has made or cut (13.7, 13.9): where those of
// one are too far apart it is an alarm in its place. A move without a vector leads back, and so does one that takes the
// vectors away for a while (Move::leaves_space); the one behind it leads out again. A command without a movement is a move without
// length, which leads from one vector to the next.
//
// No move waits for the one behind it.
#pragma once

#include "stream/stream.hpp"

namespace nc {

/// What is needed to go on from a mark: the vector that the machine stands beside the programmed point by.
using SpaceResume = SpaceVector;
inline bool in_force(const SpaceResume& resume) { return resume.on; }

struct SpaceRule {
  double arc_tolerance = 0.1;  ///< by which the radii of an arc may differ, mm
};

class SpaceStage {
 public:
  static constexpr unsigned kHeld = 1;
  using Rule = SpaceRule;
  using Resume = SpaceResume;
  bool takes(const Item& item, SpaceRule, bool) const { return item.move.space.on; }
  /// False: the item before has to be fetched first.
  bool push(const Item& item, SpaceRule rule = {});
  bool pop(Item& out);
  void reset();
  SpaceResume resume_point() const { return vector_; }
  void restore(const SpaceResume& resume) {
    reset();
    vector_ = resume;
  }
  /// Vectors, not points, are carried on.
  void displaced() {}
  bool idle() const { return !full_ && !vector_.on && !failed_; }

 private:
  void displace(Move& move);
  void stop(double apart);

  Item item_;
  bool full_ = false;
  bool failed_ = false;  ///< an alarm of this stage ended the stream
  SpaceVector vector_;  ///< behind the move that was pushed last; `on`: it is not nothing
};

}  // namespace nc
