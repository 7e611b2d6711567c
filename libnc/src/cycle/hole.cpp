// SPDX-License-Identifier: Apache-2.0
#include "cycle/hole.hpp"

#include <cmath>

namespace nc {
namespace {

/// Along the drilling axis, towards the bottom.
double down(const Hole& hole) { return cuts_down(hole) ? -1.0 : 1.0; }

/// Bottom of the next peck. The last cut ends at the bottom, shorter if needed; a rest below the resolution is not a peck of its own.
double next_peck(const Hole& hole, double depth) {
  if (hole.has_first && depth == hole.r && (hole.first - depth) * down(hole) > 1e-9) return (hole.bottom - hole.first) * down(hole) > 1e-9 ? hole.first : hole.bottom;
  const double next = depth + down(hole) * hole.q;
  return hole.q > 0 && (hole.bottom - next) * down(hole) > 1e-9 ? next : hole.bottom;
}

double coordinate(const Hole& hole, Level level, HoleProgress& progress) {
  switch (level) {
    case Level::r: return hole.r;
    case Level::bottom: return hole.bottom;
    case Level::third: return hole.third;
    case Level::exit: return hole.return_to;
    case Level::initial: return hole.initial;
    case Level::peck: return progress.depth = next_peck(hole, progress.depth);
    case Level::above_peck:
    case Level::back_from_peck: return progress.depth - down(hole) * std::fmin(hole.clearance, std::fabs(progress.depth - hole.r));  // not beyond R
    case Level::none:
    case Level::beside:
    case Level::over: break;
  }
  return 0;
}

/// M700 13.1.1: during synchronous tapping no M code of the spindle goes out.
bool does_nothing(const Hole& hole, const Stroke& stroke) {
  if (stroke.kind == StrokeKind::dwell) return !(dwell_of(hole, stroke.to) > 0);
  return stroke.kind == StrokeKind::spindle && hole.synchronous;
}

/// The first row that cuts a peck: what kAgain goes back to.
uint32_t first_cut(const CycleTable& table) {
  uint32_t row = 0;
  while (table.stroke[row].to != Level::peck) ++row;
  return row;
}

}  // namespace

double dwell_of(const Hole& hole, Level level) { return level == Level::r ? hole.dwell_at_r_s : hole.dwell_s; }

HoleProgress begin_strokes(const Hole& hole) { return {0, hole.r}; }

bool next_stroke(const Hole& hole, HoleProgress& progress, CycleStep* step) {
  const CycleTable& table = strokes_of(hole.kind);
  while (progress.row < table.count) {
    const Stroke& stroke = table.stroke[progress.row++];
    if ((stroke.flags & kWhilePecking) != 0 && progress.depth == hole.bottom) continue;
    if (stroke.kind == StrokeKind::again) {
      progress.row = first_cut(table);
      continue;
    }
    if (!goes_along(stroke.kind) && does_nothing(hole, stroke)) continue;
    step->kind = stroke.kind;  // one by one: as a whole it would be copied
    step->level = stroke.to;
    step->spindle = stroke.spindle;
    step->flags = stroke.flags;
    step->to = coordinate(hole, stroke.to, progress);
    if (stroke.to == Level::peck && progress.depth == hole.bottom) step->level = Level::bottom;  // the last cut is the one that the figures have at the bottom
    return true;
  }
  return false;
}

}  // namespace nc
