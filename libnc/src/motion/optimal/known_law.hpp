// SPDX-License-Identifier: Apache-2.0
// A law that is there before the solver has found one, whatever the start: on as before, which is always feasible and ends at rest, and at
// the first place from which there is one, the law in phases (docs/motion-optimal.md, "A law from every start").
#pragma once

#include "motion/optimal/phase_law.hpp"

namespace nc::optimal {

class KnownLaw {
 public:
  /// `phases` is the room for its second part and stays with it. False where nothing is followed and there is none from the start, and where
  /// what is followed rests behind the end of the path that is asked for.
  Task<bool> find(Work& work, const MeshRequest& request, const Limits& limits, PhaseLaw* phases);
  /// The place at which it leaves what is followed: place k of the request's, 0 the start; not where it rests().
  unsigned leaves_at() const { return leaves_at_; }
  /// It follows to the rest there, and goes on from it.
  bool rests() const { return rests_; }
  double seconds() const { return before_s_ + (ends_there_ ? 0 : phases_->seconds()); }
  bool whole() const { return ends_there_ || phases_->whole(); }
  /// Squared speed at ever farther places.
  double squared_speed(double s);

 private:
  Task<bool> from(Work& work, unsigned place);
  Task<bool> from_its_rest(Work& work);

  const Followed* followed_ = nullptr;
  PhaseLaw* phases_ = nullptr;
  unsigned leaves_at_ = 0, hint_ = 0;
  bool rests_ = false, ends_there_ = false;
  double before_s_ = 0, begins_ = 0;
};

}  // namespace nc::optimal
