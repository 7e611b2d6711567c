// SPDX-License-Identifier: Apache-2.0
// Feed functions (M700 7): what F means in each feed mode, which feed a cutting block must have, and what a cutting move gets. Everything except the plain
// feed per minute is behind one bit of State::special, so that ordinary blocks take no time for it.
#pragma once

#include "interpret/motion.hpp"

namespace nc {

/// M700 7.3: the F is F0 to F5 without a point, and #1079 makes that a one-digit feed.
bool is_feed_digit(const BlockInHand& in, double raw);

/// Takes the F of the block by the feed mode in force (7.2 to 7.5).
Execution take_feed_word(BlockInHand& in);

/// The block has changed the feed mode; `before` was in force (7.4, 7.5). To be called when all codes of the block are in force.
Execution change_feed_mode(BlockInHand& in, Function before);

/// The block has changed the cutting mode; `before` was in force (7.8 to 7.12).
void change_cutting_mode(BlockContext& in, Function before);
/// Tells the scan what of tapping is in force (nc_tapping_bits); `strokes`: what follows is between R and R again (13.1.1).
void announce_tapping(BlockContext& in, bool strokes);

/// The function or mode may not be used with inverse time feed (7.5, relation with other functions (4), (5)): P125.
bool refused_in_inverse_time(Function function);
Execution check_inverse_time_block(BlockInHand& in);
/// The feed mode is G93: by the last code for it that has been found in the block in hand so far, or else the one in force.
bool inverse_time_so_far(const BlockInHand& in);

Execution check_special_feed(BlockInHand& in, Function motion);
void apply_special_feed(BlockContext& in, Move& move);

inline bool special_feed(const InForce& in) { return (in.state.special & kSpecialFeed) != 0 || in.settings.corners_always; }

/// A cutting move of the function `motion` is about to be made: checks that there is a feed.
inline Execution check_feed(BlockInHand& in, Function motion) {
  if (special_feed(in)) return check_special_feed(in, motion);
  return in.state.modal.feed <= 0 ? in.raise(Condition::no_feed, Role::feed) : Execution::done;
}

/// Gives a cutting move, whose geometry is known, the modal feed with everything that belongs to it; `mm_min` is F as a feed per minute.
inline void set_modal_feed(BlockContext& in, Move& move, double mm_min) {
  move.feed_mm_min = mm_min;
  if (special_feed(in)) apply_special_feed(in, move);
}

/// The cut in hand ends with an exact stop, by G09 or G61 (7.7, 7.8). G09 does not count in the tapping mode (7.11 (2)), which has replaced G61, nor
/// while bit 2 of #3004 is set (13.5.10).
inline bool asks_exact_stop(const BlockInHand& in) {
  if (in.dialect->rules.motion.second_code_rests && in.state.modal.number[static_cast<unsigned>(Mode::motion)] != 0) return true;
  const Function mode = in.state.modal.of(Mode::cutting);
  return mode == Function::exact_stop_mode || (in.words.exact_stop && mode != Function::tapping_mode && (in.state.disabled & NC_DISABLE_EXACT_STOP) == 0);
}

}  // namespace nc
