// SPDX-License-Identifier: Apache-2.0
// A path of any length in bounded memory: one time law after the other, each of which ends at rest, and of
// which only the part is kept that the artificial stop at its end has not slowed.
#pragma once

#include "motion/optimal/mesh.hpp"

namespace nc::optimal {

class Windows {
 public:
  /// Pieces from rest to rest. They stay where they are as long as this is used.
  void start(const Piece* piece, unsigned count, const Limits& limits, double period = 0.005);
  /// The next law. False at the end, and when none was found (failed()).
  bool next();
  bool failed() const { return failed_; }

  const Mesh& mesh() const { return mesh_; }
  const Law& law() const { return law_; }
  /// Cells [0, keep()) of the law are final.
  unsigned keep() const { return keep_; }
  const Piece& piece_of(unsigned cell) const { return request_.piece[mesher_.place(cell).piece]; }
  const PathPlace& place(unsigned cell) const { return mesher_.place(cell); }
  unsigned iterations() const { return iterations_; }  ///< of all laws so far
  unsigned solved() const { return solved_; }          ///< cells of all laws so far

 private:
  bool solve();
  double tighten();
  double excess(unsigned cell) const;

  MeshRequest request_;
  Limits limits_;
  double period_ = 0.005;
  double stop_s_ = 0;  ///< the longest time that braking from any speed takes, with some to spare
  unsigned keep_ = 0, iterations_ = 0, solved_ = 0;
  bool more_ = false, failed_ = false;
  Mesher mesher_;
  Mesh mesh_;
  TimeLaw time_law_;
  Law law_;
};

}  // namespace nc::optimal
