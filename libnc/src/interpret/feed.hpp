// SPDX-License-Identifier: Apache-2.0
// Feed functions (M700 7): what F means in each feed mode, what a cutting block must have, and what its move takes along. Everything
// beside the plain feed per minute hides behind one bit of State::special, so that ordinary blocks pay nothing for it.
#pragma once

#include "interpret/motion.hpp"

namespace nc {

/// M700 7.3: F0 to F5 without a point, where #1079 says so.
bool is_feed_digit(const BlockContext& in, double raw);

/// The F of the block, by the feed mode in force (7.2 to 7.5).
Execution take_feed_word(BlockContext& in);

/// The block has changed the feed mode; `before` was in force (7.4, 7.5). Call when all codes of the block are in force.
Execution change_feed_mode(BlockContext& in, Function before);

/// The block has changed the cutting mode (7.8 to 7.12).
void change_cutting_mode(BlockContext& in, Function before);
/// Tells the scan what of tapping is in force (nc_tapping_bits); `strokes`: what follows is between R and R again (13.1.1).
void announce_tapping(BlockContext& in, bool strokes);

/// Functions and modes that exclude inverse time feed (7.5, relation with other functions (4), (5)): P125.
bool refused_in_inverse_time(Function function);
Execution check_inverse_time_block(BlockContext& in);
/// G93 is in force for the codes behind it in the block in hand.
bool inverse_time_so_far(const BlockContext& in);

Execution check_special_feed(BlockContext& in, Function motion);
void apply_special_feed(BlockContext& in, Move& move);

inline bool special_feed(const BlockContext& in) { return (in.state.special & kSpecialFeed) != 0; }

/// A cutting move of the function `motion` is about to be made: is there a feed?
inline Execution check_feed(BlockContext& in, Function motion) {
  if (special_feed(in)) return check_special_feed(in, motion);
  return in.state.modal.feed <= 0 ? in.raise(Condition::no_feed, Role::feed) : Execution::done;
}

/// The modal feed and all that goes with it, on a cutting move whose geometry is known; `mm_min` is F as a feed per minute.
inline void set_modal_feed(BlockContext& in, Move& move, double mm_min) {
  move.feed_mm_min = mm_min;
  if (special_feed(in)) apply_special_feed(in, move);
}

/// G09 or G61 for the cut in hand (7.7, 7.8); not in the tapping mode (7.11 (2)), which has taken the place of G61, and G09 not where
/// #3004 bit 2 says so (13.5.10).
inline bool asks_exact_stop(const BlockContext& in) {
  const Function mode = in.state.modal.of(Mode::cutting);
  return mode == Function::exact_stop_mode || (in.words.exact_stop && mode != Function::tapping_mode && (in.state.control_3004 & 4) == 0);
}

}  // namespace nc
