// SPDX-License-Identifier: Apache-2.0
// What functions that go over several calls keep for the block in hand until it has ended. Each member belongs to one function and is read by its file alone,
// except where it says otherwise.
#pragma once

#include "command/target.hpp"
#include "cycle/cavity.hpp"
#include "cycle/hole.hpp"
#include "cycle/pattern.hpp"
#include "stream/stream.hpp"

namespace nc {

/// How the holes of one block lie where its words are radius and angle and one of them is an increment (functions/polar_command.cpp).
struct PolarHoles {
  uint8_t axis[2] = {0, 1};   ///< of the plane
  bool on = false;
  double pole[2] = {0, 0};    ///< in the plane, as programmed
  double radius = 0, angle = 0;             ///< of the hole under way, mm, deg
  double radius_step = 0, angle_step = 0;   ///< to the next one
};

/// The holes that the block in hand makes (functions/cycle.cpp).
struct HolesOfBlock {
  Hole hole;                  ///< the one under way ...
  HoleProgress progress;
  uint32_t left = 0;          ///< with it
  Targets target;             ///< of the axes that the block positions
  PolarHoles polar;
  HolePattern pattern;        ///< where they lie, of a pattern
  AxisVec pattern_at;         ///< its reference point as programmed
  uint8_t pattern_axis[2] = {0, 1};  ///< of its plane
  bool one_by_one = false;    ///< a modal call calls its macro at each place of the pattern
  AxisVec over, beside;       ///< the hole, and the place that a shift goes to
  bool places_only = false;   ///< the block goes to the places of its holes and makes none
  bool whole = false;         ///< no pecks: what is tried before the block begins
  bool tapping = false;       ///< between R and R again
  bool inside = false;        ///< the item in hand belongs to a stroke

  /// A block begins: what says whether another member means anything is as at first. The others are not cleared, for they are many, and set where they mean
  /// something.
  void begin() {
    left = 0;
    polar.on = false;
    pattern.kind = PatternKind::none;
    one_by_one = places_only = whole = tapping = inside = false;
  }
};

/// The cavity that the block in hand mills (functions/cavity.cpp); lengths as programmed.
struct CavityOfBlock {
  Cavity shape;
  double center[2] = {0, 0};
  uint8_t axis = 2;           ///< that goes down
  double r = 0, bottom = 0, cut = 0;
  double depth = 0;           ///< level under way
  uint32_t ring = 0;
  unsigned piece = 0;
};

/// What the block in hand waits for (functions/machine_io.cpp).
struct InputWait {
  uint32_t number = 0, left = 0;   ///< of the input; questions that are left
  uint8_t kind = 0;
  bool analog = false, seen = false, last = false;  ///< ...; the level of the last question is known, and is `last`
};

/// The skip move under way (functions/skip.cpp).
struct SkipOfBlock {
  SkipSpeeds speeds;
  AxisVec start;              ///< where it begins, machine coordinates
};

/// The measurement under way (functions/measure.cpp).
struct MeasureOfBlock {
  double position = 0, range = 0;  ///< expected position and its range
  bool nothing = false;            ///< there is no range in which it could measure
};

struct JobsOfBlock {
  HolesOfBlock holes;
  PolarHoles polar_holes;     ///< what the words of the block say of its holes
  CavityOfBlock cavity;
  InputWait input_wait;
  SkipOfBlock skip;
  MeasureOfBlock measure;
};

}  // namespace nc
