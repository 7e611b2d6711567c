// SPDX-License-Identifier: Apache-2.0
// The modal state: one active G code per group and the words that stay in force.
#pragma once

#include <cstring>

#include "nc/item.h"

namespace nc {

/// Modal groups by the M700's numbers (3.7); other families use the same number for the same thing.
enum Group : uint8_t {
  kGroupOneShot = 0, kGroupMotion = 1, kGroupPlane = 2, kGroupDistance = 3, kGroupStrokeCheck = 4, kGroupFeed = 5, kGroupUnit = 6,
  kGroupCompensation = 7, kGroupLength = 8, kGroupCycle = 9, kGroupReturn = 10, kGroupScaling = 11, kGroupWork = 12,
  kGroupCutting = 13, kGroupMacro = 14, kGroupNormalLine = 15, kGroupRotation = 16, kGroupSurfaceSpeed = 17, kGroupPolarCommand = 18,
  kGroupMirror = 19, kGroupInterpolationMode = 21
};

/// Trivially copyable and comparable: snapshots of it are interned.
struct ModalState {
  int16_t code[NC_GROUPS] = {};   ///< active code of each group, times 10; -1 = the dialect has no such group
  uint16_t extended = 0;          ///< n of G54.1 Pn while it is active
  uint16_t feed_digit = 0;        ///< n + 1: F is the one digit n (M700 7.3). No padding: states are compared as bytes, once in every block
  double feed = 0;                ///< F as programmed (its unit is that of the block that moves: M700 5.2 note 1); 0 = none yet
  double spindle = 0;
  uint32_t tool = 0, d = 0, h = 0, m = 0, n = 0, o = 0, b = 0;
  uint32_t h_given = 0;           ///< 1: an H has been commanded, be it H0

  bool operator==(const ModalState& other) const { return std::memcmp(this, &other, sizeof(*this)) == 0; }
};
static_assert(sizeof(ModalState) == NC_GROUPS * sizeof(int16_t) + 2 * sizeof(uint16_t) + 2 * sizeof(double) + 8 * sizeof(uint32_t));

inline nc_modal to_public(const ModalState& s) {
  nc_modal m{};
  for (unsigned i = 0; i < NC_GROUPS; ++i) m.code[i] = s.code[i];
  m.feed = s.feed;
  m.spindle = s.spindle;
  m.tool = s.tool;
  m.d = s.d;
  m.h = s.h;
  m.m = s.m;
  m.n = s.n;
  m.o = s.o;
  m.b = s.b;
  return m;
}

}  // namespace nc
