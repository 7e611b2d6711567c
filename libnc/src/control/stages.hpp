// SPDX-License-Identifier: Apache-2.0
// The stages of a part system, in the order of the stream.
#pragma once

#include "contour/contour.hpp"
#include "control/stage_row.hpp"
#include "fairing/fairing.hpp"
#include "offset/offset.hpp"
#include "offset/space.hpp"

namespace nc {

inline const FairingRule& rule_of(const FairingStage&, const MotionSettings& settings) { return settings.fairing; }
inline ContourRule rule_of(const ContourStage&, const MotionSettings& settings) { return {settings.corner_arcs}; }
inline NoRule rule_of(const OffsetStage&, const MotionSettings&) { return {}; }
inline SpaceRule rule_of(const SpaceStage&, const MotionSettings& settings) { return {settings.arc_tolerance}; }

using Stages = StageRow<ContourStage, FairingStage, OffsetStage, SpaceStage>;

/// False: no stage holds this item back while all stages are at rest, which is so for most moves. True: one of them may.
inline bool may_be_held(const Item& item) {
  return item.kind == ItemKind::move &&
         (item.move.comp.side != 0 || (item.move.high_accuracy & kFineSegmentsOn) != 0 || item.move.corner != Corner::none || item.move.space.on);
}

}  // namespace nc
