// SPDX-License-Identifier: Apache-2.0
// Moves: from words to curves in the compensation frame.
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/same_place.hpp"
#include "base/units.hpp"
#include "frame/rotary.hpp"
#include "interpret/by_hand.hpp"
#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/plane.hpp"
#include "interpret/program_map.hpp"
#include "interpret/work_rotation.hpp"

namespace nc {
namespace {

constexpr double kNoMotion = 1e-9;  // mm or deg
constexpr double kAnyFeed = 1e12;   // mm/min: feed_for() says with more than that that the axis turns as fast as it can

bool same_place(const AxisVec& a, const AxisVec& b, unsigned count) {
  for (unsigned i = 0; i < count; ++i)
    if (std::fabs(a[i] - b[i]) > kNoMotion) return false;
  return true;
}

/// It is written only where it changes, which it does in hardly any block: all axes are read right behind it.
inline void apply_length_to(State& state, unsigned axis) {
  const double length = axis == state.length_axis ? state.length_value : 0.0;
  if (state.applied[axis] != length) [[unlikely]] state.applied[axis] = length;
}

/// Applies the tool length to an axis when the axis is commanded (M700 12.2).
void apply_length(InForce& in, uint32_t commanded) {
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (((commanded >> i) & 1) == 0) continue;
    apply_length_to(in.state, i);
  }
}

/// The coordinates of `named` for the axes of its bits, those of `others` for the rest. The two of a pair are chosen at once: what is written one by one and read
/// in pairs right behind it, as every line would be, has to wait for the stores.
template <unsigned kAxes>
inline AxisVec choose(uint32_t axes, const AxisVec& named, const AxisVec& others) {
  static_assert(kAxes % 2 == 0 && sizeof(double) == sizeof(uint64_t));
  constexpr uint64_t kAll = ~uint64_t{0};
  static constexpr uint64_t kPair[4][2] = {{0, 0}, {kAll, 0}, {0, kAll}, {kAll, kAll}};
  AxisVec chosen;
  for (unsigned i = 0; i < kAxes; i += 2) {
    const uint64_t(&mask)[2] = kPair[axes >> i & 3];
    for (unsigned k = 0; k < 2; ++k)
      chosen[i + k] = std::bit_cast<double>((std::bit_cast<uint64_t>(named[i + k]) & mask[k]) | (std::bit_cast<uint64_t>(others[i + k]) & ~mask[k]));
  }
  return chosen;
}

/// `others`, but `to` on one axis: the same for the strokes of holes.
template <unsigned kAxes>
inline AxisVec with_one(unsigned axis, double to, const AxisVec& others) {
  struct Rows {
    uint64_t of[kMaxAxes][kMaxAxes] = {};
    constexpr Rows() {
      for (unsigned i = 0; i < kMaxAxes; ++i) of[i][i] = ~uint64_t{0};
    }
  };
  static constexpr Rows kMasks;
  const uint64_t(&mask)[kMaxAxes] = kMasks.of[axis];
  AxisVec chosen;
  for (unsigned i = 0; i < kAxes; ++i)
    chosen[i] = std::bit_cast<double>((std::bit_cast<uint64_t>(to) & mask[i]) | (std::bit_cast<uint64_t>(others[i]) & ~mask[i]));
  return chosen;
}

/// The shift from the compensation frame to machine coordinates: the zero point and the tool length that is applied.
AxisVec offset_in_force(const InForce& in) {
  AxisVec offset;
  const AxisVec& z = in.zero();
  for (unsigned i = 0; i < kMaxAxes; ++i) offset[i] = z[i] + in.state.applied[i];
  return offset;
}

Affine map_in_force(const InForce& in) { return Affine::translation(offset_in_force(in)); }

/// M700 12.4.4 (2): under radius compensation an absolute word leads back to the programmed path from where the axis has been moved by hand. By an incremental
/// word, or without a word, the axis stays as far beside the path as it is.
[[gnu::cold]] void lead_back_to_path(BlockInHand& in, Move& move) {
  const uint32_t absolute = in.words.target.axes() & ~in.words.target.incremental();
  for (unsigned i = 0; i < 2; ++i) {
    double& still = (absolute >> move.comp.axis[i] & 1) != 0 ? in.state.comp.by_hand[i] : move.comp.by_hand[i];
    still = 0;
  }
}

/// M700 12.4.4 (2): an absolute word leads back to the programmed path from beside it.
bool leads_back(const BlockInHand& in) {
  const Compensation& comp = in.state.comp;
  const uint32_t absolute = in.words.target.axes() & ~in.words.target.incremental();
  for (unsigned i = 0; i < 2; ++i)
    if ((absolute >> comp.axis[i] & 1) != 0 && std::fabs(comp.by_hand[i]) > kReached) return true;
  return false;
}

/// A line leads to where the axes stand already, and is none. Where it was the hand that has led them there, the program has come to its end all the same; under radius compensation it is a block
/// of the contour, whose corner has to be made: false.
bool stays_by_hand(BlockInHand& in, const AxisVec& place) {
  if (stands_beside(in.state.comp) && leads_back(in)) return false;
  if (in.state.by_hand) end_way_by_hand(in, place, place);
  return true;
}

/// Radius compensation starts and ends with a movement in its plane, not with one across it: until then the vector is not made, or still there. Where the
/// code alone waits, so does a start behind a movement across the plane.
[[gnu::cold]] void note_side(BlockContext& in, const AxisVec& start, const AxisVec& target, Move& move) {
  State& state = in.state;
  const unsigned h = state.comp.axis[0], v = state.comp.axis[1];
  const bool changes = state.comp.side != 0 && state.moved_side != 0;
  if (changes || start[h] != target[h] || start[v] != target[v])
    state.moved_side = state.comp.side;
  else if (state.moved_side == 0 && in.dialect->rules.compensation.code_alone_waits && start != target)
    move.comp.side = 0;
}

/// Begins a move, with everything that is the same for all moves. Inlined with begin_moved() where lines are made, because there are a handful in every hole.
/// The axes are at its end already (State::machine).
[[gnu::always_inline]] inline Move& begin_any_move(BlockContext& in, TransformId transform, const AxisVec& start, const AxisVec& target) {
  Move& move = in.emit_move(start, target);
  if (stands_beside(in.state.comp)) [[unlikely]] lead_back_to_path(in, move);
  if (in.state.by_hand) [[unlikely]] end_way_by_hand(in, start, target);
  if (in.state.mapped) map_compensation(in, move.comp);
  move.high_accuracy = in.state.high_accuracy;
  move.inch = in.state.modal.is(Function::inch);
  move.transform = transform;
  in.state.moves_since_comp_off = 1;
  if (in.state.moved_side != in.state.comp.side) [[unlikely]] note_side(in, start, target, move);
  if (leads_beside(in.state)) [[unlikely]] {
    in.state.moved_space = move.space = space_vector(in, in.state.machine);
    in.state.length_changed_by_handle = false;
  }
  return move;
}

[[gnu::noinline]] TransformId new_translation(BlockContext& in, const AxisVec& offset) { return in.transforms.intern(Affine::translation(offset)); }

Move& begin_move(BlockContext& in, const Affine& to_machine, const AxisVec& start, const AxisVec& target) {
  in.state.machine = to_machine.apply(target);
  return begin_any_move(in, in.transforms.intern(to_machine), start, target);
}

/// The shift from the compensation frame to the machine for the lines of a block, and where the next one begins.
template <unsigned kAxes>
struct Shifted {
  AxisVec offset, start;
  explicit Shifted(const InForce& in) {
    const AxisVec& z = in.zero();
    for (unsigned i = 0; i < kAxes; ++i) offset[i] = z[i] + in.state.applied[i];
    for (unsigned i = 0; i < kAxes; ++i) start[i] = in.state.machine[i] - offset[i];
  }
};

/// Begins a move whose map to the machine only shifts. In nearly every block the newest map is the same, and no new one is made.
template <unsigned kAxes>
[[gnu::always_inline]] inline Move& begin_moved(BlockContext& in, const Shifted<kAxes>& from, const AxisVec& target) {
  const Affine* newest = in.transforms.newest();
  const bool same = newest != nullptr && newest->translates_by(from.offset);
  const TransformId transform = same ? in.transforms.newest_id() : new_translation(in, from.offset);
  for (unsigned i = 0; i < kAxes; ++i) in.state.machine[i] = target[i] + from.offset[i];
  return begin_any_move(in, transform, from.start, target);
}

/// Gives a move its shape, where programmed coordinates are not those of the axes, and sets where the axes end. `before`: where they stand.
void finish_shaped(BlockContext& in, const MoveShape& what, const MoveFrame& frame, const AxisVec& before, Move& move) {
  move.shape = in.shapes.intern(what) + 1;
  const PlainMove plain{&move.start, &move.end, move.circular ? &move.circle : nullptr, move.plane_axis[0], move.plane_axis[1]};
  const AxisVec end = shaped_end(what, plain, frame.to_machine, before, in.axis_count, in.rotary);
  const AxisMap& map = what.map;
  for (unsigned i = 0; i < in.axis_count; ++i) {
    // For an axis that is held the program goes on from the commanded position; its real position is kept apart (M700 6.16).
    if (((map.frozen >> i) & 1) == 0) in.state.machine[i] = end[i];
  }
  if (map.kind != AxisMap::Kind::cylinder) return;
  // On a cylinder the positions that are shown are in degrees.
  move.work[map.rotary] /= map.scale;
  for (unsigned i = 0; i < 2; ++i)
    if (move.plane_axis[i] == map.rotary) move.work_center[i] /= map.scale;
}

void finish_mapped(BlockContext& in, const MoveFrame& frame, const AxisVec& before, Move& move) {
  if ((in.state.special & kSpecialMap) == 0) return;
  MoveShape shape;
  shape.map = in.state.map;
  finish_shaped(in, shape, frame, before, move);
}

/// M700 2.3: the position of a rotary axis is not a multiple of #2106, as it should be; in the plane of G12.1 the word is a length (6.10).
bool off_increment(const InForce& in, unsigned axis, double value) {
  const double unit = in.settings.index_increment[axis];
  if (unit <= 0 || ((in.rotary >> axis) & 1) == 0) return false;
  if (in.state.map.kind == AxisMap::Kind::polar && axis == in.state.map.rotary) return false;
  return std::fabs(value - unit * std::nearbyint(value / unit)) > 1e-6;
}

}  // namespace

double feed_mm_min(const InForce& in) {
  const bool inch = in.state.modal.is(Function::inch);
  return in.state.modal.feed * (inch ? kMillimetresPerInch : 1.0);
}

namespace {

/// How far the tool is from a turning axis, whose zero is that of the coordinates.
double distance_from(const InForce& in, unsigned turning, const AxisVec& at) {
  double squares = 0;
  constexpr Role kTurns[3] = {Role::turn_x, Role::turn_y, Role::turn_z};
  for (unsigned i = 0; i < 3; ++i) {
    const int axis = in.axis_called(basic_along(i));
    if (axis >= 0 && in.axis_called(kTurns[i]) != static_cast<int>(turning)) squares += at[static_cast<unsigned>(axis)] * at[static_cast<unsigned>(axis)];
  }
  return std::sqrt(squares);
}

/// DGSHAPE 2-5: F is the speed of the tool on the workpiece where the block begins; what it makes of the turning axis stays through the block. Infinite: as
/// fast as the axis can, at the highest position of Z. Where the tool stands on the axis F is in deg/min.
double surface_feed(const InForce& in, const AxisVec& start, const AxisVec& end) {
  const double feed = feed_mm_min(in);
  double straight = 0, round = 0, turned = 0;
  for (unsigned i = 0; i < in.axis_count; ++i) {
    const double way = end[i] - start[i];
    if (((in.rotary >> i) & 1) == 0) {
      straight += way * way;
      continue;
    }
    const double arc = way * std::numbers::pi / 180 * distance_from(in, i, start);
    turned += way * way;
    round += arc * arc;
  }
  if (turned == 0) return feed;
  const int z = in.axis_called(Role::basic_z);
  const bool highest = z >= 0 && std::fabs(in.state.machine[static_cast<unsigned>(z)] - in.reference(0, static_cast<unsigned>(z))) < kNoMotion;
  if (highest) round = 0;
  if (straight > 0) return feed * std::sqrt(straight / (straight + round));
  if (highest) return std::numeric_limits<double>::infinity();
  return round > 0 ? feed * std::sqrt(turned / round) : feed;
}

}  // namespace

namespace {

/// What one inch of F is along a way, given the squares of its linear and of its rotary part: a degree counts as a tenth of an inch there (M700 3.2 notes 5, 6).
double inch_of_feed(double linear2, double turned2) {
  constexpr double kDegreesPerInch = 10;
  if (turned2 <= kNoMotion * kNoMotion) return kMillimetresPerInch;
  if (linear2 <= kNoMotion * kNoMotion) return kDegreesPerInch;
  return std::sqrt((linear2 + turned2) / (linear2 / (kMillimetresPerInch * kMillimetresPerInch) + turned2 / (kDegreesPerInch * kDegreesPerInch)));
}

/// A degree is a part of an inch for the feed, and there are axes that turn.
bool inch_has_degrees(const InForce& in) { return in.rotary != 0 && in.state.modal.is(Function::inch) && in.dialect->rules.feed.inch_is_ten_degrees; }

/// Axes whose words are degrees. On a cylinder and in the plane of G12.1 F is in mm/min or inch/min along the programmed curve, whichever axes move
/// (M700 6.9 (6), 6.10 (5)).
uint32_t axes_in_degrees(const InForce& in) {
  const AxisMap& map = in.state.map;
  return map.kind == AxisMap::Kind::none ? in.rotary : in.rotary & ~(1u << map.rotary);
}

/// The same for the way of an arc and of the axes that go along with it.
double inch_of_arc(const InForce& in, const Move& move) {
  const double round = (move.circle.radius_start + move.circle.radius_end) / 2 * move.circle.sweep;
  double part[2] = {round * round, 0};
  const uint32_t turning = axes_in_degrees(in) & ~(1u << move.plane_axis[0] | 1u << move.plane_axis[1]);
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (i != move.plane_axis[0] && i != move.plane_axis[1]) part[turning >> i & 1] += (move.end[i] - move.start[i]) * (move.end[i] - move.start[i]);
  return inch_of_feed(part[0], part[1]);
}

}  // namespace

double feed_unit(const InForce& in, const AxisVec& start, const AxisVec& end) {
  if (!in.state.modal.is(Function::inch)) return 1;
  if (!inch_has_degrees(in)) return kMillimetresPerInch;
  const uint32_t turning = axes_in_degrees(in);
  double part[2] = {0, 0};
  for (unsigned i = 0; i < in.axis_count; ++i) part[turning >> i & 1] += (end[i] - start[i]) * (end[i] - start[i]);
  return inch_of_feed(part[0], part[1]);
}

double feed_for(const InForce& in, const AxisVec& start, const AxisVec& end) {
  if (in.rotary != 0 && in.dialect->rules.feed.rotary_by_radius) return surface_feed(in, start, end);
  return in.state.modal.feed * feed_unit(in, start, end);
}

AxisVec target_of_words(const BlockInHand& in) { return target_of_words(in, in.position()); }

namespace {

/// M700 14.13: absolute commands to rotating axes: turns the angles in `target` into positions of the axes, which count on over several turns.
void turn_within_range(const InForce& in, const AxisVec& position, uint32_t axes, AxisVec& target) {
  // In the plane of polar coordinate interpolation the word of the rotary axis is in millimetres (6.10).
  if (in.state.map.kind == AxisMap::Kind::polar) axes &= ~(1u << in.state.map.rotary);
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (((axes >> i) & 1) == 0) continue;
    target[i] = position[i] + turn_to(target[i], within_one_turn(position[i]), ((in.settings.short_cut >> i) & 1) != 0);
  }
}

inline AxisVec plain_target(const InForce& in, const AxisVec& position, const Targets& targets) {
  AxisVec target = position;
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (!targets.commands(i)) continue;
    target[i] = targets.counts_on(i) ? target[i] + targets[i] : targets[i];
  }
  const uint32_t rotary = targets.axes() & in.rotary & ~targets.incremental();
  if (rotary != 0 && in.settings.turning != 0) turn_within_range(in, position, rotary & in.settings.turning, target);
  return target;
}

}  // namespace

AxisVec target_of_words(const BlockInHand& in, const AxisVec& position) { return target_of(in, position, in.words.target); }

AxisVec target_of(const BlockInHand& in, const AxisVec& position, const Targets& targets) {
  if (!program_mapped(in)) return plain_target(in, position, targets);
  return from_program(in, plain_target(in, to_program(in, position), targets));
}

MoveFrame frame_of_move(InForce& in, const AxisVec& target, uint32_t commanded) {
  if (program_mapped(in) && commanded != 0) commanded = begin_mapped_move(in, commanded);
  apply_length(in, commanded);
  MoveFrame frame{map_in_force(in), {}, target};
  if ((in.state.special & kSpecialMap) != 0) {
    const AxisMap& map = in.state.map;
    frame.start = to_programmed(map, frame.to_machine, in.state.machine);
    if (map.kind == AxisMap::Kind::cylinder) frame.end[map.rotary] *= map.scale;
  } else {
    frame.start = frame.to_machine.apply_inverse(in.state.machine);
  }
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (((commanded >> i) & 1) == 0) frame.end[i] = frame.start[i];  // an axis that is not named stays where it is
  return frame;
}

namespace {

/// M700 7.9: after rapid traverse, and after cutting with G09 or in G61, the next block waits until the axes are in position, if the parameters ask for more
/// than that the command has come to rest. An in-position width of the block itself (,I ,J: 6.1, 6.2, 13.1.1) replaces those of the parameters.
inline void check_deceleration(BlockContext& in, nc_move_kind kind, double width = 0) {
  if (!in.settings.check_rapid && !in.settings.check_cutting && width == 0) [[likely]] return;
  const bool check = kind == NC_MOVE_RAPID ? in.settings.check_rapid : in.settings.check_cutting && asks_exact_stop(in);
  if (!check && width == 0) return;
  Gate& gate = in.emit(ItemKind::gate).gate;
  gate.kind = NC_GATE_IN_POSITION;
  gate.value = width;
}

/// Gives a move the corner at its end; the next block decides where the move really ends (contour/contour.hpp). A rounding lies in the plane in force.
[[gnu::noinline]] void set_corner(const InForce& in, Move& move, const LinearStyle& style) {
  const PlaneAxes plane = plane_axes(in);
  move.corner = style.corner;
  move.corner_mm = style.corner_mm;
  move.plane = plane.plane;
  move.plane_axis[0] = static_cast<uint8_t>(plane.h);
  move.plane_axis[1] = static_cast<uint8_t>(plane.v);
}

inline void set_style(BlockContext& in, Move& move, const LinearStyle& style) {
  if (in.settings.life_managed) [[unlikely]] count_tool_use(in, style.kind != NC_MOVE_RAPID);
  move.kind = style.kind;
  move.exact_stop = (style.exact_stop || style.kind == NC_MOVE_RAPID) && !style.flows;
  move.flows = style.flows;
  move.rule.check_reversal = in.settings.check_reversal && style.kind != NC_MOVE_RAPID;
  move.feed_mm_min = style.kind == NC_MOVE_RAPID ? 0 : style.feed_mm_min;
  move.skip_mask = style.skip_mask;
  move.skip_away = style.skip_away;
  move.unclamps = style.unclamps;
  move.skip_speeds = style.skip_speeds;
  if (style.special_feed) apply_special_feed(in, move);
  if (style.corner != Corner::none) [[unlikely]] set_corner(in, move, style);
  if (style.tapping) move.rule.tapping = true;
  if (style.kind == NC_MOVE_TAP) {
    move.feed_mm_rev = style.feed_mm_rev;
    move.tap_rev_min = static_cast<float>(style.tap_speed);
    move.tap_slope = static_cast<float>(style.tap_slope);
  }
  if (style.kind != NC_MOVE_THREAD) return;
  move.feed_mm_rev = style.feed_mm_rev;
  move.thread_angle = static_cast<float>(style.thread_angle);
}

/// M700 12.4.2 (3), (4): with a vector in force the tool stands beside the programmed point, and a block without vectors whose end is that point leads it there. Only
/// where an axis of the plane is commanded: one that lifts the tool does not draw it into the contour first.
bool stands_off(const InForce& in, uint32_t commanded) {
  const Compensation& comp = in.state.comp;
  return comp.side != 0 && (commanded & (1u << comp.axis[0] | 1u << comp.axis[1])) != 0;
}
/// The same of vectors in space (12.5) and along the tool (12.3), of a place that the axes themselves go to.
bool stands_off_place(const InForce& in, uint32_t commanded) {
  return stands_off(in, commanded) || (commanded != 0 && in.state.moved_space.on);
}

/// The vectors are away for this move. Those in the plane only where an axis of the plane is commanded, because an axis moves by no word of another one: who lifts the tool by G53 Z in
/// a contour would be drawn into the wall (14.4 (5): compensation is not cancelled). A thread is cut without radius compensation alone (6.7.1).
[[gnu::noinline]] void take_vectors_away(BlockContext& in, Move& move, uint32_t commanded) {
  move.comp.transparent = in.state.comp.side == 0 || stands_off(in, commanded);
  move.leaves = move.leaves && move.comp.transparent;
  move.leaves_space = move.kind != NC_MOVE_THREAD;
  if (move.leaves_space) in.state.moved_space = {};
}

void move_linear_mapped(BlockContext& in, const AxisVec& target, uint32_t commanded, const LinearStyle& style) {
  const MoveFrame frame = frame_of_move(in, target, commanded);
  if (same_place(frame.start, frame.end, in.axis_count) && !(style.transparent && stands_off(in, commanded))) return;
  const AxisVec before = in.state.machine;
  Move& move = begin_move(in, frame.to_machine, frame.start, frame.end);
  set_style(in, move, style);
  if (style.transparent) take_vectors_away(in, move, commanded);
  finish_mapped(in, frame, before, move);
  if (!style.checks_itself) check_deceleration(in, style.kind, style.in_position);
}

}  // namespace

namespace {

/// This is done in nearly every block: as frame_of_move() does, but without copying a MoveFrame, and for kAxes axes, of which the part system has no more.
template <unsigned kAxes>
void make_shifted_line(BlockContext& in, const AxisVec& target, uint32_t commanded, const LinearStyle& style) {
  const Shifted<kAxes> from(in);
  const AxisVec end = choose<kAxes>(commanded, target, from.start);  // an axis that is not named stays where it is
  if (same_place(from.start, end, in.axis_count) && !(style.transparent && stands_off(in, commanded)) && stays_by_hand(in, from.start)) return;
  Move& move = begin_moved(in, from, end);
  set_style(in, move, style);
  if (style.transparent) [[unlikely]] take_vectors_away(in, move, commanded);
  if (!style.checks_itself) check_deceleration(in, style.kind, style.in_position);
}

template <unsigned kAxes>
void make_stroke(BlockContext& in, unsigned axis, double to, const LinearStyle& style) {
  const Shifted<kAxes> from(in);
  Move& move = begin_moved(in, from, with_one<kAxes>(axis, to, from.start));
  set_style(in, move, style);
  if (!style.checks_itself) check_deceleration(in, style.kind, style.in_position);
}

}  // namespace

void move_linear(BlockContext& in, const AxisVec& target, uint32_t commanded, const LinearStyle& style) {
  if (program_mapped(in) && commanded != 0) commanded = begin_mapped_move(in, commanded);
  if ((in.state.special & kSpecialMap) != 0) return move_linear_mapped(in, target, commanded, style);
  apply_length(in, commanded);
  in.axis_count <= kFewAxes ? make_shifted_line<kFewAxes>(in, target, commanded, style) : make_shifted_line<kMaxAxes>(in, target, commanded, style);
}

bool goes_along_axis(InForce& in, unsigned axis, double to) {
  if (program_mapped(in) || (in.state.special & kSpecialMap) != 0) return true;
  apply_length_to(in.state, axis);
  return !(std::fabs(in.state.machine[axis] - (in.zero()[axis] + in.state.applied[axis]) - to) <= kNoMotion);
}

void move_axis(BlockContext& in, unsigned axis, double to, const LinearStyle& style) {
  if (program_mapped(in) || (in.state.special & kSpecialMap) != 0) {
    AxisVec target = in.position();
    target[axis] = to;
    return move_linear(in, target, 1u << axis, style);
  }
  in.axis_count <= kFewAxes ? make_stroke<kFewAxes>(in, axis, to, style) : make_stroke<kMaxAxes>(in, axis, to, style);
}

void move_nowhere(BlockContext& in, bool leads_space) {
  const MoveFrame frame = frame_of_move(in, AxisVec{}, 0);
  const AxisVec before = in.state.machine;
  const auto moves = in.state.moves_since_comp_off;
  const auto side = in.state.moved_side;
  Move& move = begin_move(in, frame.to_machine, frame.start, frame.start);
  in.state.moves_since_comp_off = moves;
  in.state.moved_side = in.state.comp.has_vector && in.state.comp.side != 0 ? in.state.comp.side : side;  // 12.4.3: the vector of I, J acts at once
  move.leads_space = leads_space;
  move.kind = in.state.modal.is(Function::rapid) ? NC_MOVE_RAPID : NC_MOVE_LINE;
  move.exact_stop = move.kind == NC_MOVE_RAPID;
  if (move.kind != NC_MOVE_RAPID) set_modal_feed(in, move, feed_mm_min(in));
  finish_mapped(in, frame, before, move);
}

static void move_machine_by(BlockContext& in, const AxisVec& machine, uint32_t commanded, uint32_t bare, bool leaves) {
  for (unsigned i = 0; i < in.axis_count && !in.dialect->rules.length.shifts_reading; ++i)
    if (((commanded & bare) >> i & 1) != 0) in.state.applied[i] = 0;
  const Affine to_machine = map_in_force(in);
  const AxisVec start = to_machine.apply_inverse(in.state.machine);
  AxisVec end = to_machine.apply_inverse(machine);
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (((commanded >> i) & 1) == 0) end[i] = start[i];
  if (same_place(start, end, in.axis_count) && !stands_off_place(in, commanded)) return;
  const AxisVec before = in.state.machine;
  Move& move = begin_move(in, to_machine, start, end);
  move.kind = NC_MOVE_RAPID;
  move.exact_stop = true;
  move.leaves = leaves;
  take_vectors_away(in, move, commanded);
  finish_mapped(in, MoveFrame{to_machine, start, end}, before, move);
  check_deceleration(in, NC_MOVE_RAPID);
}

void move_machine(BlockContext& in, const AxisVec& machine, uint32_t commanded, uint32_t bare) { move_machine_by(in, machine, commanded, bare, false); }

void leave_for_machine(BlockContext& in, const AxisVec& machine, uint32_t commanded) { move_machine_by(in, machine, commanded, ~uint32_t{0}, true); }

void emit_circular(BlockContext& in, const MoveFrame& frame, const PlaneAxes& plane, const Circle& circle, nc_move_kind kind) {
  const AxisVec before = in.state.machine;
  if (in.settings.life_managed) [[unlikely]] count_tool_use(in, true);
  Move& move = begin_move(in, frame.to_machine, frame.start, frame.end);
  move.kind = kind;
  move.circular = true;
  move.plane = plane.plane;
  move.plane_axis[0] = static_cast<uint8_t>(plane.h);
  move.plane_axis[1] = static_cast<uint8_t>(plane.v);
  move.circle = circle;
  move.work_center[0] = circle.center[0];
  move.work_center[1] = circle.center[1];
  move.plane_feed = kind == NC_MOVE_HELIX && in.settings.helix_plane_feed;  // M700 6.6: only for a helix; lines and arcs keep F
  move.exact_stop = asks_exact_stop(in);
  move.rule.check_reversal = in.settings.check_reversal;
  const bool in_plane = move.plane_feed && in.state.modal.is(Function::feed_per_minute);
  set_modal_feed(in, move, inch_has_degrees(in) && !in_plane ? in.state.modal.feed * inch_of_arc(in, move) : feed_mm_min(in));
  finish_mapped(in, frame, before, move);
  check_deceleration(in, kind);
}

Move& emit_shaped(BlockContext& in, const MoveFrame& frame, const MoveShape& shape, nc_move_kind kind) {
  const AxisVec before = in.state.machine;
  Move& move = begin_move(in, frame.to_machine, frame.start, frame.end);
  move.kind = kind;
  move.exact_stop = asks_exact_stop(in);
  move.rule.check_reversal = in.settings.check_reversal;
  finish_shaped(in, shape, frame, before, move);
  return move;
}

namespace {

constexpr double kTenthOfInch_mm = 2.54;

/// M700 3.2 note 5: in inch the arc of a linear and a rotary axis is made with a degree as a tenth of an inch, and with R in inch. So it is an arc on
/// a cylinder (6.9) on which a degree has that length.
class InchDegrees {
 public:
  InchDegrees(InForce& in, unsigned h, unsigned v) : state_(in.state), kept_(in.state.map), special_(in.state.special) {
    const uint32_t plane = 1u << h | 1u << v, turning = in.rotary & plane;
    on_ = in.dialect->rules.arc.degree_is_tenth_of_inch && turning != 0 && turning != plane && in.state.modal.is(Function::inch) && !in.state.map.active();
    if (!on_) return;
    state_.map.kind = AxisMap::Kind::cylinder;
    state_.map.rotary = static_cast<uint8_t>(std::countr_zero(turning));
    state_.map.scale = kTenthOfInch_mm;  // mm per degree
    state_.special |= kSpecialMap;
  }
  ~InchDegrees() {
    if (!on_) return;
    state_.map = kept_;
    state_.special = special_;
  }
  InchDegrees(const InchDegrees&) = delete;
  InchDegrees& operator=(const InchDegrees&) = delete;
  bool on() const { return on_; }

 private:
  State& state_;
  const AxisMap kept_;
  const uint8_t special_;
  bool on_ = false;
};

}  // namespace

namespace {

/// LinuxCNC G90.1: the centre words are the position of the centre, and both must be there.
Execution take_absolute_centre(BlockInHand& in, const PlaneAxes& plane, double center[2]) {
  const AxisVec position = in.position();
  for (unsigned i = 0; i < 2; ++i) {
    if (!in.words.has(plane.center[i])) return in.raise(Condition::center_missing, plane.center[i]);
    center[i] -= position[static_cast<unsigned>(i == 0 ? plane.h : plane.v)];
  }
  return Execution::done;
}

/// M700 3.2, format and note 5: in inch the centre word of a rotary axis is in degrees as its positions are, each of which then counts as a tenth of an inch
/// beside a linear axis. On a cylinder (6.9) and in the plane of G12.1 both words are lengths.
double centre_word(const BlockInHand& in, const PlaneAxes& plane, unsigned i) {
  const auto axis = static_cast<unsigned>(i == 0 ? plane.h : plane.v);
  const uint32_t turning = in.rotary & (1u << plane.h | 1u << plane.v);
  const bool degrees = (turning >> axis & 1) != 0 && in.dialect->rules.arc.degree_is_tenth_of_inch && in.state.modal.is(Function::inch) && !in.state.map.active();
  if (!degrees) return length_of(in, plane.center[i]);
  const double deg = length_value(in, in.words.written(plane.center[i]), true, false);
  return turning == 1u << axis ? deg * kTenthOfInch_mm : deg;
}

}  // namespace

Execution read_arc_words(BlockInHand& in, const PlaneAxes& plane, uint32_t commanded, ArcWords* of_block) {
  const auto h = static_cast<unsigned>(plane.h), v = static_cast<unsigned>(plane.v);
  const Command& w = in.words;
  const ArcRules& rules = in.dialect->rules.arc;
  ArcWords& words = *of_block;
  words.has_radius = w.has(Role::arc_radius);
  words.may_be_short = rules.short_radius_is_half_chord;
  if (words.has_radius) {
    words.radius = length_of(in, Role::arc_radius);
    for (unsigned i = 0; i < 2 && rules.radius_excludes_centre; ++i)
      if (w.has(plane.center[i])) return in.raise(Condition::two_words, plane.center[i], w.get(plane.center[i]));
    if (rules.radius_is_modal) in.state.arc_radius = words.radius;
    if (w.has(Role::arc_turns) && rules.turns_exclude_radius) return in.raise(Condition::format_error, Role::arc_turns);
  } else if (rules.radius_is_modal && in.state.arc_radius != 0 && !w.has(plane.center[0]) && !w.has(plane.center[1])) {
    words.has_radius = true;
    words.radius = in.state.arc_radius;
  } else {
    for (unsigned i = 0; i < 2; ++i)
      if (w.has(plane.center[i])) words.center[i] = centre_word(in, plane, i);
    for (unsigned i = 0; i < 2 && rules.centre_by_quadrant; ++i)
      if (words.center[i] < 0) return in.raise(Condition::arc_center, plane.center[i], w.get(plane.center[i]));
    if (in.state.modal.is(Function::centre_absolute)) {
      const Execution did = take_absolute_centre(in, plane, words.center);
      if (did != Execution::done) return did;
    }
  }
  if (w.has(Role::arc_turns) && (!words.has_radius || rules.turns_count_last) && !has_words_of_call(in)) {
    const double turns = w.get(Role::arc_turns);
    words.turns_count_last = rules.turns_count_last;
    if (!whole_number(turns, &words.turns) || words.turns > in.dialect->rules.range.most_arc_turns || (words.turns == 0 && rules.turns_count_last)) return in.raise(Condition::value_range, Role::arc_turns, turns);
  }
  // M700 P113: no word of the block belongs to the plane in force, but a centre word belongs to another plane: a plane code has been forgotten.
  const bool of_plane = words.has_radius || w.has(plane.center[0]) || w.has(plane.center[1]) || ((commanded >> h) & 1) != 0 || ((commanded >> v) & 1) != 0;
  if (!of_plane && w.any({Role::vector_x, Role::vector_y, Role::vector_z})) return in.raise_mode(Condition::plane_mismatch, Mode::motion);
  return Execution::done;
}

/// By how much the radius at the end may differ, mm. LinuxCNC G2: also by a share of the radius.
static double arc_tolerance(const InForce& in, const ArcWords& words) {
  const FamilyParameters& family = *in.dialect->parameters;
  const double tolerance = in.settings.arc_tolerance;
  if (family.arc_tolerance_most_mm == 0) return tolerance;
  const double radius = words.has_radius ? std::fabs(words.radius) : std::hypot(words.center[0], words.center[1]);
  return std::fmin(std::fmax(tolerance, family.arc_tolerance_of_radius * radius), family.arc_tolerance_most_mm);
}

/// M700 12.4.1: compensation starts and is cancelled with a straight movement, also when it was commanded in a block before.
bool starts_or_ends_compensation(const InForce& in) { return (in.state.comp.side != 0) != (in.state.moved_side != 0); }

bool keeps_vector(const BlockInHand& in) {
  const Compensation& comp = in.state.comp;
  if (comp.side != 0 || in.state.moved_side == 0) return false;
  const AxisVec position = in.position(), target = target_of_words(in, position);
  return position[comp.axis[0]] == target[comp.axis[0]] && position[comp.axis[1]] == target[comp.axis[1]];
}

/// Where the centre of an arc of the block lies, by programmed coordinates, whose quadrants count.
static bool find_centre(const BlockInHand& in, const PlaneAxes& plane, const AxisVec& target, uint32_t commanded, bool ccw, double center[2]) {
  const AxisVec position = in.position();
  AxisVec end = position;
  const uint32_t moved = program_mapped(in) ? moved_axes(in, commanded) : commanded;
  for (unsigned i = 0; i < in.axis_count; ++i)
    if ((moved >> i & 1) != 0) end[i] = target[i];
  const AxisVec from = program_mapped(in) ? to_program(in, position) : position;
  const AxisVec to = program_mapped(in) ? as_programmed_end(in, end) : end;
  const double start[2] = {from[static_cast<unsigned>(plane.h)], from[static_cast<unsigned>(plane.v)]};
  const double finish[2] = {to[static_cast<unsigned>(plane.h)], to[static_cast<unsigned>(plane.v)]};
  return center_of_quadrant(start, finish, ccw, in.settings.arc_tolerance, center);
}

/// Series 8 G55, G57: what has been programmed before stays programmed, so that the axes do not stand where the first arc is meant to begin.
static bool stands_beside_start(const BlockInHand& in, const PlaneAxes& plane) {
  if (!in.state.map_begins || !in.dialect->rules.rotation.about_zero) return false;
  const auto h = static_cast<unsigned>(plane.h), v = static_cast<unsigned>(plane.v);
  const AxisVec position = in.position();
  const AxisVec start = from_program(in, to_program(in, position));
  return std::hypot(start[h] - position[h], start[v] - position[v]) > kReached;
}

Execution move_arc(BlockContext& in, const AxisVec& target, uint32_t commanded, bool ccw) {
  const PlaneAxes plane = plane_axes(in);
  if (plane.h < 0 || plane.v < 0) return in.raise_mode(Condition::plane_mismatch, Mode::motion);
  if (stands_beside_start(in, plane)) return in.raise_mode(Condition::not_accepted, Mode::motion);
  ArcWords words;
  const Execution did = read_arc_words(in, plane, commanded, &words);
  if (did != Execution::done) return did;
  if (in.dialect->rules.arc.centre_by_quadrant && !words.has_radius && !find_centre(in, plane, target, commanded, ccw, words.center))
    return in.raise_mode(Condition::arc_center, Mode::motion);
  return move_arc_by(in, plane, target, commanded, words, ccw);
}

/// M700 12.5: the ends of an arc are displaced, its centre is not; their distances from it have to agree all the same. By how much they differ; without end
/// where one of them lies in the centre.
static double displaced_apart(const InForce& in, const MoveFrame& frame, unsigned h, unsigned v, const Circle& circle) {
  const SpaceVector end = space_vector(in, frame.to_machine.apply(frame.end));
  const auto radius = [&circle, h, v](const AxisVec& at, const SpaceVector& vector) {
    double d[2] = {at[h] - circle.center[0], at[v] - circle.center[1]};
    for (unsigned i = 0; vector.on && i < 3; ++i) {
      if (vector.axis[i] == h) d[0] += vector.v[i];
      if (vector.axis[i] == v) d[1] += vector.v[i];
    }
    return std::hypot(d[0], d[1]);
  };
  return circle_apart(radius(frame.start, in.state.moved_space), radius(frame.end, end));
}

Execution move_arc_by(BlockContext& in, const PlaneAxes& plane, const AxisVec& target, uint32_t commanded, ArcWords words, bool ccw) {
  if (starts_or_ends_compensation(in)) return in.raise_mode(Condition::arc_in_compensation_start, Mode::radius);
  // M700 12.4.4 (2): an arc in absolute words would be another one than is programmed, by R no less than about a centre.
  if (stands_beside(in.state.comp) && leads_back(in)) [[unlikely]] return in.raise_mode(Condition::arc_by_hand, Mode::motion);
  if (in.state.length_changed_by_handle) [[unlikely]] move_nowhere(in, true);  // M700 12.3: both ends of an arc lie on a circle, so the new vector is gone to first
  const auto h = static_cast<unsigned>(plane.h), v = static_cast<unsigned>(plane.v);
  if (!in.dialect->rules.arc.takes_rotary_axes && (commanded & in.rotary) != 0) return in.raise_axis(Condition::illegal_axis, first_of(commanded & in.rotary));
  const InchDegrees scope(in, h, v);
  // The blocks before and behind do not have this length of a degree, so neither compensation nor a map of the program can be used.
  if (scope.on() && (in.state.comp.side != 0 || program_mapped(in))) return in.raise(Condition::no_function, in.axis_words.word(in.state.map.rotary));
  if (program_mapped(in)) {
    if (tilts_plane(in, h, v)) return in.raise_mode(Condition::plane_mismatch, Mode::motion);  // 13.21
    const bool uneven = scaled_unevenly(in, h, v);
    // HX 15.2.2 prints an arc by R; one about a centre would be no circle any more, also where its ends happen to lie on one.
    if (uneven && !(in.dialect->rules.scaling.arcs_may_be_uneven && words.has_radius)) return in.raise_mode(Condition::arc_deviation, Mode::motion);  // 13.19 (4)
    words.radius *= std::fmax(std::fabs(scale_of(in, h)), uneven ? std::fabs(scale_of(in, v)) : 0);
    map_arc(in, h, v, words.center, &ccw);
  }
  const MoveFrame frame = frame_of_move(in, target, commanded);
  const double from[2] = {frame.start[h], frame.start[v]}, to[2] = {frame.end[h], frame.end[v]};
  Circle circle;
  bool straight = false;
  const Condition bad = make_circle(from, to, words, ccw, arc_tolerance(in, words), &circle, &straight);
  if (bad != Condition::none) return in.raise(bad, words.has_radius ? Role::arc_radius : plane.center[0], words.has_radius ? words.radius : circle.radius_end);
  if (straight && !words.has_radius && in.dialect->rules.arc.centre_by_quadrant) return in.raise_mode(Condition::arc_center, Mode::motion);
  if (straight && words.has_radius && in.dialect->rules.arc.closed_by_radius_is_fault) return in.raise(Condition::arc_center, Role::arc_radius, words.radius);
  if (straight) {
    // There is no circle: the axes go along a line, also those outside of the plane.
    LinearStyle style;
    style.feed_mm_min = feed_for(in, frame.start, frame.end);
    style.special_feed = special_feed(in);
    style.exact_stop = asks_exact_stop(in);
    move_linear(in, target, commanded, style);
    return Execution::done;
  }
  if (leads_beside(in.state)) {
    const double apart = displaced_apart(in, frame, h, v, circle);
    const Role word = words.has_radius ? Role::arc_radius : plane.center[0];
    if (!std::isfinite(apart)) return in.raise(Condition::arc_displaced, word);
    if (apart > arc_tolerance(in, words) + kRadiusRounding_mm) return in.raise(Condition::arc_displaced, word, apart);
  }
  bool helix = false;
  for (unsigned i = 0; i < in.axis_count; ++i) helix = helix || (i != h && i != v && std::fabs(frame.end[i] - frame.start[i]) > kNoMotion);
  emit_circular(in, frame, plane, circle, helix ? NC_MOVE_HELIX : NC_MOVE_ARC);
  return Execution::done;
}

/// Makes the motions that are not plain_motion().
Execution move_by_function(BlockContext& in, Function motion, const AxisVec& target, uint32_t commanded) {
  // A vector in space displaces lines and circles (offset/space.hpp).
  if (leads_beside(in.state) && motion != Function::thread) return in.raise_mode(Condition::not_in_compensation, Mode::motion);
  switch (motion) {
    case Function::thread: return move_thread(in, target, commanded);
    case Function::spiral_cw:
    case Function::spiral_ccw: return move_spiral(in, target, commanded, motion == Function::spiral_ccw);
    case Function::exponential_positive:
    case Function::exponential_negative: return move_exponential(in, target, commanded, motion == Function::exponential_negative);
    case Function::space_arc_first:
    case Function::space_arc_second: return move_space_arc(in, target);
    case Function::nurbs: return move_nurbs(in, target);
    default: return in.raise_mode(Condition::internal, Mode::motion);
  }
}

/// M700 9.3 (3): without interpolation (#1086) the other axes of the block do not wait until its index tables are unclamped; the tables move after them.
void move_rapid(BlockContext& in, const AxisVec& target, uint32_t axes) {
  LinearStyle style;
  style.kind = NC_MOVE_RAPID;
  const uint32_t tables = axes & in.settings.index_axes;
  if (tables != 0 && tables != axes && in.settings.rapid_by_axis && in.state.comp.side == 0 && (in.state.special & kSpecialMap) == 0) {
    style.unclamps = static_cast<uint8_t>(tables);
    move_linear(in, target, axes & ~tables, style);
    style.unclamps = 0;
    axes = tables;
  }
  style.in_position = in.words.in_position;
  move_linear(in, target, axes, style);
}

Execution check_index_positions(BlockInHand& in) {
  const Command& w = in.words;
  for (unsigned i = 0; (w.target.axes() & in.rotary) != 0 && i < in.axis_count; ++i) {
    if (!w.target.commands(i)) continue;
    // M700 9.3 (8): a table that stands between two positions (moved by hand, after a reset) does not reach one by an increment of whole steps.
    const bool between = ((w.target.incremental() & in.settings.index_axes) >> i & 1) != 0 && off_increment(in, i, in.position()[i] + w.target[i]);
    if (!between && !off_increment(in, i, w.target[i])) continue;
    return in.raise_axis(Condition::index_increment, i, w.target[i]);
  }
  return Execution::done;
}

/// Takes ,C or ,R of the block (M700 13.7).
static Execution take_corner(BlockInHand& in, Function motion, LinearStyle* style) {
  const Command& w = in.words;
  const Role word = corner_word(w);
  if (motion == Function::rapid || motion == Function::thread) return in.raise(Condition::corner_motion, word, w.corner_size.value);
  if (is_arc(motion) && means_spiral(in)) return in.raise(Condition::format_error, word, w.corner_size.value);  // 6.13 (2): not with a spiral of type 2
  if (motion != Function::linear && !(in.settings.corner_arcs && is_arc(motion))) return in.raise(Condition::corner_arc, word, w.corner_size.value);
  const PlaneAxes plane = plane_axes(in);
  if (plane.h < 0 || plane.v < 0) return in.raise_mode(Condition::plane_mismatch, Mode::motion);
  double amount = length_value(in, w.corner_size, false, true);
  if (amount < 0) return in.raise(Condition::value_range, word, w.corner_size.value);
  if (program_mapped(in)) {  // 13.7.1: the corner is scaled, too
    const auto h = static_cast<unsigned>(plane.h), v = static_cast<unsigned>(plane.v);
    // A chamfer would have a leg of its own for each axis; a rounding is an arc by R.
    const bool arc = in.dialect->rules.scaling.arcs_may_be_uneven && w.corner != Corner::chamfer;
    if (scaled_unevenly(in, h, v) && !arc) return in.raise(Condition::corner_uneven, word, w.corner_size.value);
    amount *= std::fmax(std::fabs(scale_of(in, h)), std::fabs(scale_of(in, v)));
  }
  if (!(amount > 0)) return Execution::done;  // no corner is cut
  style->corner = w.corner;
  style->corner_mm = amount;
  return Execution::done;
}

/// An arc with ,C or ,R, on a machine that cuts corners beside arcs.
static Execution move_arc_to_corner(BlockContext& in, const AxisVec& target, bool ccw, const LinearStyle& style) {
  const Command& w = in.words;
  const unsigned before = in.items_made();
  const Execution did = move_arc(in, target, w.target.axes(), ccw);
  if (did == Execution::fault && in.fault.condition == Condition::arc_deviation && in.settings.spiral_type_2 && !w.has(Role::arc_radius))
    return in.raise(Condition::format_error, corner_word(w), w.corner_size.value);  // its radii make it a spiral of type 2 (6.13)
  if (did != Execution::done) return did;
  for (unsigned i = in.items_made(); i > before; --i) {
    Item& item = in.item_made(i - 1);
    if (item.kind != ItemKind::move || !item.move.circular) continue;
    set_corner(in, item.move, style);
    return did;
  }
  return in.raise(Condition::corner_short, corner_word(w), w.corner_size.value);  // an arc of no radius
}

Execution move_by_words(BlockContext& in) {
  const Command& w = in.words;
  LinearStyle style;
  const Function motion = in.state.modal.of(Mode::motion);
  const bool arc = is_arc(motion), ccw = motion == Function::arc_ccw, thread = motion == Function::thread;
  const bool arc_words = w.any({Role::arc_radius, Role::vector_x, Role::vector_y, Role::vector_z});
  const bool plain = plain_motion(motion);
  if (w.corner != Corner::none) [[unlikely]] {
    const Execution did = take_corner(in, motion, &style);
    if (did != Execution::done) return did;
  }
  if (w.target.axes() == 0 && style.corner != Corner::none) return in.raise(Condition::corner_short, corner_word(w), w.corner_size.value);
  if (w.target.axes() == 0 && !((arc || !plain) && (arc_words || thread))) return Execution::done;
  if (w.target.axes() == 0 && !w.auxiliary.empty() && has_words_of_call(in)) return Execution::done;  // the words are those of the call, and no arc
  if ((in.state.special & kSpecialMap) != 0 && in.state.map.kind != AxisMap::Kind::none) {
    const Execution did = check_mill_move(in, w.target.axes());
    if (did != Execution::done) return did;
  }
  if (const Execution did = check_index_positions(in); did != Execution::done) return did;
  // M700 13.1.1: ,J belongs to fixed cycles, whose words are ignored beside a code of a motion (precaution (4)).
  if (w.in_position_drill > 0 && w.cycle == nullptr) return in.raise(Condition::illegal_address, Role::vector_y, w.in_position_drill);
  // The start of the block is needed only for words that count from there (an axis without a word stays), for the feed of rotary axes, for a rotated
  // figure, in which one word moves two axes, and for curves. The end of an arc in space counts from its middle point.
  const bool mapped = program_mapped(in);
  const bool halfway = !plain && in.state.arc_step == ArcStep::middle_given;
  const AxisVec position = halfway                                                    ? in.points[in.state.arc_points + 1].at
                           : w.target.incremental() != 0 || in.rotary != 0 || mapped || !plain ? in.position()
                                                                                      : AxisVec{};
  const AxisVec target = mapped ? target_of_words(in, position) : plain_target(in, position, w.target);
  if ((in.state.special & kSpecialStitch) != 0 && is_line(motion)) return move_stitch(in, target, w.target.axes());
  if (motion == Function::rapid) {
    move_rapid(in, target, w.target.axes());
    return Execution::done;
  }
  if (w.in_position > 0 && motion != Function::linear) return in.raise(Condition::illegal_address, Role::vector_x, w.in_position);
  if (thread || is_exponential(motion)) return move_by_function(in, motion, target, w.target.axes());
  if (!in.dialect->rules.feed.no_way_needs_none || motion != Function::linear || target != in.position()) {
    const Execution fed = check_feed(in, motion);
    if (fed != Execution::done) return fed;
  }
  if (!plain) return move_by_function(in, motion, target, w.target.axes());
  if (arc && style.corner != Corner::none) return move_arc_to_corner(in, target, ccw, style);
  if (arc && in.settings.spiral_type_2 && means_spiral(in)) return move_spiral(in, target, w.target.axes(), ccw);
  if (arc) {
    const Execution did = move_arc(in, target, w.target.axes(), ccw);
    // M700 6.13: in type 2, radii that differ by more than the tolerance make a spiral of less than one turn (L1 when omitted).
    const bool spiral = did == Execution::fault && in.fault.condition == Condition::arc_deviation && in.settings.spiral_type_2 && !w.has(Role::arc_radius);
    return spiral && arc_words ? move_spiral(in, target, w.target.axes(), ccw) : did;
  }
  style.feed_mm_min = feed_for(in, position, target);
  if (style.feed_mm_min > kAnyFeed) [[unlikely]] {
    move_rapid(in, target, w.target.axes());
    return Execution::done;
  }
  style.special_feed = special_feed(in);
  style.exact_stop = asks_exact_stop(in);
  style.in_position = style.exact_stop ? w.in_position : 0;  // it acts only where there is a deceleration check
  // The line on which the axes reach another rotation (13.21) does not belong to a spline.
  if ((in.state.special & kSpecialSpline) != 0 && !in.state.work_turn_pending) return move_spline(in, target, w.target.axes(), style);
  const unsigned before = in.items_made();
  move_linear(in, target, w.target.axes(), style);
  const bool nowhere = style.corner != Corner::none && in.items_made() == before;  // a line of no length has no corner
  return nowhere ? in.raise(Condition::corner_short, corner_word(w), w.corner_size.value) : Execution::done;
}

}  // namespace nc
