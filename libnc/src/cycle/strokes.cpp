// SPDX-License-Identifier: Apache-2.0
// The figures of M700 13.1.1 ("movement when executing each fixed cycle") in their order, as tables. Beside each row stands the number that it
// has in the figure, or in the list of RS-274/NGC 3.5.16 or of the Series 8.
#include "cycle/stroke.hpp"

namespace nc {
namespace {

using enum StrokeKind;
using S = CycleSpindle;
using L = Level;

// Every tool comes to R in rapid, and single block stops there: "(1), (2) and ...".
constexpr Stroke kToR{rapid, L::r, S::none, kStrokeStops};
constexpr Stroke kToBottom{feed, L::bottom};
constexpr Stroke kDwell{dwell}, kDwellAtR{dwell, L::r};
constexpr Stroke kReturn{rapid, L::exit, S::none, kStrokeReturns};  // at R nothing moves: "G99 mode: no movement"
constexpr Stroke kStop{spindle, L::none, S::stop}, kOrient{spindle, L::none, S::orient}, kForward{spindle, L::none, S::forward};
constexpr Stroke kAgain{again, L::none, S::none, kWhilePecking};

// (a) G81
constexpr Stroke kDrill[] = {
    kToR,       // 2
    kToBottom,  // 3
    kReturn,    // 4
};
// (b) G82
constexpr Stroke kSpot[] = {
    kToR,       // 2
    kToBottom,  // 3
    kDwell,     // 4
    kReturn,    // 5
};
// (c) G83
constexpr Stroke kPeck[] = {
    kToR,                                           // 2
    {feed, L::peck},                                // 3 6 9
    {rapid, L::r, S::none, kWhilePecking},          // 4 7 10
    {rapid, L::above_peck, S::none, kWhilePecking}, // 5 8
    kAgain,
    kReturn,  // n
};
// (d) G84, (k) G74
constexpr Stroke tap_cut(Level to, uint8_t also = 0) { return {feed, to, S::none, static_cast<uint8_t>(kStrokeTaps | also)}; }
constexpr Stroke turn(CycleSpindle to, uint8_t also = 0) { return {spindle, L::none, to, also}; }
template <CycleSpindle in, CycleSpindle out>
constexpr Stroke kTap[] = {
    kToR,                // 2
    tap_cut(L::bottom),  // 3
    kDwell,              // 4
    turn(out),           // 5
    tap_cut(L::r),       // 6
    kDwellAtR,           // 7
    turn(in),            // 8
    kReturn,             // 9
};
// The same in cuts of Q. Between two of them the tap goes back by the clearance, or to R, with the spindle turning back.
template <CycleSpindle in, CycleSpindle out, Level between>
constexpr Stroke kTapInCuts[] = {
    kToR,
    tap_cut(L::peck),
    turn(out, kWhilePecking),
    tap_cut(between, kWhilePecking),
    turn(in, kWhilePecking),
    kAgain,
    kDwell,
    turn(out),
    tap_cut(L::r),
    kDwellAtR,
    turn(in),
    kReturn,
};
// (e) G85
constexpr Stroke kBoreFeed[] = {
    kToR,          // 2
    kToBottom,     // 3
    {feed, L::r},  // 4
    kReturn,       // 5
};
// (f) G86
constexpr Stroke kBoreStop[] = {
    kToR,             // 2
    kToBottom,        // 3
    kDwell,           // 4
    kStop,            // 5
    {rapid, L::exit}, // 6
    kForward,         // 7
};
// (g) G87: R is the bottom that it goes down to beside the hole, Z the end of the cut upwards.
constexpr Stroke kBackBore[] = {
    kOrient,                                            // 2
    {shift_rapid, L::beside},                           // 3
    {rapid, L::r, S::none, kStrokeStops},               // 4
    {shift_feed, L::over},                              // 5
    {spindle, L::none, S::forward, kStrokeStops},       // 6
    kToBottom,                                          // 7
    kOrient,                                            // 8
    {shift_rapid, L::beside},                           // 9
    {rapid, L::initial},                                // 10: in the mode of R, too
    {shift_rapid, L::over, S::none, kStrokeStops},      // 11
    kForward,                                           // 12
};
// (h) G88
constexpr Stroke kBoreByHand[] = {
    kToR,                                      // 2
    kToBottom,                                 // 3
    kDwell,                                    // 4
    {spindle, L::none, S::stop, kStrokeStops}, // 5, 6, 7
    {rapid, L::exit},                          // 8
    kForward,                                  // 9
};
// HX 12.3.11 G88: the hand draws the tool back.
constexpr Stroke kBoreWaitsForHand[] = {
    kToR,
    kToBottom,
    kDwell,
    kStop,
    {StrokeKind::program_stop},
    {rapid, L::exit},
    kForward,
};
// (i) G89
constexpr Stroke kBoreDwell[] = {
    kToR,          // 2
    kToBottom,     // 3
    kDwell,        // 4
    {feed, L::r},  // 5
    kReturn,       // 6
};
// (j) G73
constexpr Stroke kStep[] = {
    kToR,                                               // 2
    {feed, L::peck},                                    // 3 6
    kDwell,                                             // 4
    {rapid, L::back_from_peck, S::none, kWhilePecking}, // 5
    kAgain,
    kReturn,  // n
};
// (l) G75
constexpr Stroke kCircle[] = {
    kToR,                                           // 2
    kToBottom,                                      // 3
    {circle_in, L::none},                           // 4
    {StrokeKind::circle, L::none},                  // 5
    {circle_out, L::none, S::none, kStrokeStops},   // 6
    {rapid, L::exit},                               // 7
};
// (m) G76
constexpr Stroke kFineBore[] = {
    kToR,                                           // 2
    kToBottom,                                      // 3
    kOrient,                                        // 4
    {shift_feed, L::beside},                        // 5
    {rapid, L::exit},                               // 6
    {shift_rapid, L::over, S::none, kStrokeStops},  // 7
    kForward,                                       // 8
};

// ---- RS-274/NGC 3.5.16; the numbers are those of its lists

template <CycleSpindle in, CycleSpindle out>
constexpr Stroke kTapByDirection[] = {
    kToR,                // 1: preliminary motion, 3.5.16 ...
    tap_cut(L::bottom),  // ... 3.5.16.4
    turn(out),           // LinuxCNC G84
    kDwell,
    tap_cut(L::exit),    // with the feed all the way
    turn(in),
};
constexpr Stroke kBoreStopAsBefore[] = {
    kToR,                                // 3.5.16.6: 1
    kToBottom,                           // 2
    kDwell,                              // 3
    kStop,                               // 4
    {rapid, L::exit},                    // 5
    turn(S::as_before),                  // 6
};
constexpr Stroke kBackBoreToLevel[] = {
    kToR,                      // 3.5.16.7: 1
    {shift_rapid, L::beside},  // 2
    kStop,
    kOrient,                   // 3
    {rapid, L::bottom},        // 4
    {shift_rapid, L::over},    // 5
    turn(S::as_before),        // 6
    {feed, L::third},          // 7
    kToBottom,                 // 8
    kStop,
    kOrient,                   // 9
    {shift_rapid, L::beside},  // 10
    {rapid, L::exit},          // 11
    {shift_rapid, L::over},    // 12
    turn(S::as_before),        // 13
};
constexpr Stroke kBoreLeftByHand[] = {
    kToR,                        // 3.5.16.8: 1
    kToBottom,                   // 2
    kDwell,                      // 3
    kStop,                       // 4
    {StrokeKind::program_stop},  // 5
    turn(S::as_before),          // 6
};

// ---- Series 8 G87, G88, G89; the numbers are those of its lists

constexpr Stroke kCaseBore[] = {
    kToR,       // 2, 4
    kToBottom,  // 3, 5
};
constexpr Stroke kBoreOriented[] = {
    kToR,                                           // 2
    kToBottom,                                      // 3
    kDwell,                                         // 4
    kStop,
    kOrient,
    {shift_rapid, L::beside},                       // 5
    {rapid, L::exit},                               // 6
    {shift_rapid, L::over, S::none, kStrokeStops},
    turn(S::as_before),
};
constexpr Stroke kFaceUpwards[] = {
    kStop,                                          // 2
    kOrient,
    {shift_rapid, L::beside},                       // 3
    {rapid, L::r, S::none, kStrokeStops},           // 4
    {shift_rapid, L::over},                         // 5
    {spindle, L::none, S::as_before, kStrokeStops},
    kToBottom,                                      // 6: upwards
    kDwell,                                         // 7
    {feed, L::r},                                   // 8
    kStop,                                          // 9
    kOrient,
    {shift_rapid, L::beside},
    {rapid, L::initial},                            // 10
    {shift_rapid, L::over, S::none, kStrokeStops},  // 11
    turn(S::as_before),                             // 12
};

template <unsigned count>
constexpr CycleTable table(const Stroke (&rows)[count], bool takes_widths) {
  CycleTable all{rows, count, takes_widths, false, false, false, false, false, false};
  for (const Stroke& row : rows) {
    all.pecks = all.pecks || row.kind == again;
    all.shifts = all.shifts || row.to == L::beside;
    all.moves_in_plane = all.shifts || row.kind == circle_in || all.moves_in_plane;
    all.turns_spindle = all.turns_spindle || row.kind == spindle;
    all.restarts = all.restarts || row.spindle == S::as_before;
    all.leaves_rapidly = all.leaves_rapidly || (row.kind == rapid && row.to == L::exit);
  }
  return all;
}

constexpr Stroke kNothing[] = {{dwell}};

constexpr CycleTable table_of(CycleKind kind) {
  switch (kind) {
    case CycleKind::none:
    case CycleKind::count_: break;
    case CycleKind::drill: return table(kDrill, true);
    case CycleKind::spot: return table(kSpot, true);
    case CycleKind::peck: return table(kPeck, true);
    case CycleKind::step: return table(kStep, true);
    case CycleKind::tap: return table(kTap<S::forward, S::reverse>, true);
    case CycleKind::reverse_tap: return table(kTap<S::reverse, S::forward>, true);
    case CycleKind::peck_tap: return table(kTapInCuts<S::forward, S::reverse, L::back_from_peck>, true);
    case CycleKind::peck_reverse_tap: return table(kTapInCuts<S::reverse, S::forward, L::back_from_peck>, true);
    case CycleKind::deep_tap: return table(kTapInCuts<S::forward, S::reverse, L::r>, true);
    case CycleKind::deep_reverse_tap: return table(kTapInCuts<S::reverse, S::forward, L::r>, true);
    case CycleKind::circle: return table(kCircle, false);
    case CycleKind::fine_bore: return table(kFineBore, false);
    case CycleKind::bore_feed: return table(kBoreFeed, true);
    case CycleKind::bore_stop: return table(kBoreStop, false);
    case CycleKind::back_bore: return table(kBackBore, false);
    case CycleKind::bore_waits_for_hand: return table(kBoreWaitsForHand, false);
    case CycleKind::bore_by_hand: return table(kBoreByHand, false);
    case CycleKind::bore_dwell: return table(kBoreDwell, true);
    case CycleKind::tap_by_direction: return table(kTapByDirection<S::forward, S::reverse>, true);
    case CycleKind::reverse_tap_by_direction: return table(kTapByDirection<S::reverse, S::forward>, true);
    case CycleKind::bore_stop_as_before: return table(kBoreStopAsBefore, false);
    case CycleKind::back_bore_to_level: return table(kBackBoreToLevel, false);
    case CycleKind::bore_left_by_hand: return table(kBoreLeftByHand, false);
    case CycleKind::case_bore: return table(kCaseBore, false);
    case CycleKind::bore_oriented: return table(kBoreOriented, false);
    case CycleKind::face_upwards: return table(kFaceUpwards, false);
  }
  return table(kNothing, false);
}

constexpr CycleTables all_tables() {
  CycleTables all{};
  for (unsigned i = 0; i < static_cast<unsigned>(CycleKind::count_); ++i) all.of[i] = table_of(static_cast<CycleKind>(i));
  return all;
}
}  // namespace

constexpr CycleTables kCycleTables = all_tables();

}  // namespace nc
