// SPDX-License-Identifier: Apache-2.0
#include "offset/contour_memory.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <type_traits>

#include "base/units.hpp"

namespace nc {

static_assert(std::is_trivially_copyable_v<ContourMemory>);

namespace {

/// Ends of walls this near to where the tool comes to the contour belong to that joint.
constexpr double kSameJoint_mm = 0.01;
/// A part is at least as large as the square of so many radii of the tool.
constexpr double kLeastPart = 0.05;

uint64_t apart(uint64_t a, uint64_t b) { return a > b ? a - b : b - a; }

}  // namespace

void ContourMemory::begin(bool with_start) {
  state_ = State{};
  state_.first = state_.end = walls_.end();
  state_.first_path = paths_.end();
  state_.with_start = with_start;
  state_.open = true;
}

ContourMemory::State ContourMemory::with(State state, const Doubt& doubt) {
  if (doubt.first != state.first) return state;
  for (unsigned place = 0; place <= kWay; ++place) {
    const uint64_t number = state.first + place - (state.with_start ? 0 : 1);
    if (number >= state.end || (doubt.suspects & ~state.suspects & 1u << place) == 0) continue;
    state.suspects = static_cast<uint8_t>(state.suspects | 1u << place);
    state.culprit[place] = doubt.culprit[place];
  }
  for (unsigned i = 0; i < kWay; ++i) {
    const uint64_t number = doubt.ways + i, place = number - state.ways;
    if ((doubt.doubts >> i & 1) == 0 || state.ways == 0 || number < state.ways || number >= state.end || place >= kWay || (state.doubts >> place & 1) != 0) continue;
    state.doubts = static_cast<uint8_t>(state.doubts | 1u << place);
    state.culprit[kBehind + place] = doubt.culprit[kBehind + i];
  }
  return state;
}

ContourMemory::Doubt ContourMemory::doubt() const {
  Doubt doubt{state_.first, state_.ways, state_.suspects, state_.doubts, {}};
  if (doubt.doubts != 0 || doubt.suspects != 0) std::copy_n(state_.culprit, kCulprits, doubt.culprit);
  return doubt;
}

const ContourMemory::Culprit* ContourMemory::suspect() const {
  for (unsigned place = 0; place <= kWay; ++place)
    if ((state_.suspects >> place & 1) != 0) return &state_.culprit[place];
  return state_.doubts != 0 ? &state_.culprit[kBehind + static_cast<unsigned>(std::countr_zero(state_.doubts))] : nullptr;
}

void ContourMemory::restore(const State& state) {
  culprit_ = nullptr;
  state_ = state;
  if (!state.open) return;
  // Where the contour is not in this memory, another control has read it, or too much has been read since: it cannot be checked any more.
  state_.overlong = state.overlong || walls_.end() < state.end || !walls_.keeps(state.first);
  if (state_.overlong) return;
  walls_.cut(state.end);
  // The steps in front of the next block count with it, and come before its own path.
  uint64_t kept = paths_.end();
  const auto behind = [&](uint64_t number) { return kept > 0 && paths_.keeps(kept - 1) && paths_[kept - 1].number >= number; };
  while (behind(state.end)) --kept;
  const uint64_t last = paths_.end();
  for (unsigned steps = state.steps; steps > 0 && kept < last && paths_[kept].number == state.end; --steps) ++kept;
  paths_.cut(kept);
}

/// To the end of a block; gives what has been swept at its start.
ContourMemory::Swept ContourMemory::go_on(const Section& section) {
  const Vec2 start = state_.at + section.approach, end = start + section.delta;
  Swept& swept = state_.swept;
  swept.area += 0.5 * cross(state_.at, start);
  const Swept before = swept;
  swept.area += 0.5 * cross(start, end);
  if (section.begin.curvature != 0) {
    const double radius = 0.5 * (std::abs(1 / section.begin.curvature) + std::abs(1 / section.end.curvature));
    swept.area += 0.5 * radius * radius * (section.sweep - std::sin(section.sweep));
    swept.way += radius * std::abs(section.sweep);
  } else {
    swept.way += norm(section.delta);
  }
  state_.at = end;
  return before;
}

/// Has it gone round something since, from this place, to which it is back again? A spike, out and back on one line, is wider than the last digits by nothing, and what is as small as a burr to the tool is no part.
/// The ring is closed by the line back to its place: without that the ray has swept what lies between the gap and the start of the contour, however far away, and a block of a micrometre would be a ring by itself.
bool ContourMemory::goes_round(const Swept& since, Vec2 place) const {
  const double least = kLeastPart * std::abs(state_.offset), area = state_.swept.area - since.area + 0.5 * cross(state_.at, place);
  return std::abs(area) > std::max(kCloses_mm * (state_.swept.way - since.way), least * least);
}

/// The joint at the end of a block: where the contour is, and whether it has closed.
void ContourMemory::follow(const Section& section, uint64_t number, Vec2 start, const Swept& before) {
  if (section.cancel && !section.transparent) return;
  const bool round = std::abs(section.sweep) > kPi && norm(start - wall_of(section, start).center) > kAway_mm;
  const bool first = state_.closure == 0 || state_.turned;
  bool closes = false;
  for (unsigned i = 0; i < state_.joints; ++i) {
    const double from_joint = norm(state_.at - state_.joint[i]);
    if (from_joint > kAway_mm || (round && norm(start - state_.joint[i]) <= kAway_mm)) state_.away = static_cast<uint8_t>(state_.away | 1u << i);
    if ((state_.away >> i & 1) == 0 || from_joint > kCloses_mm || !goes_round(state_.at_joint[i], state_.joint[i])) continue;
    if (first) {  // the way in ends where the contour first closes
      state_.closed = static_cast<uint8_t>(state_.closed | 1u << i);
      for (unsigned k = 1; k <= i; ++k) state_.suspects = static_cast<uint8_t>(state_.suspects & ~(1u << k));
    } else if ((2u << i) <= state_.closed) {  // a point of the way in, where the way out ends
      continue;
    } else {  // one behind the first contour: what leads there is a link (note_another())
      leads_across(state_.ways, state_.first + i + (state_.with_start ? 1 : 0));
    }
    closes = true;  // of another round, too: what is behind the last one may be a way out
  }
  if (closes) {
    note_closed(number);
    state_.turned = first && ends_turn(section, start, number);
  }
  if (behind_start(number) <= kWay) add_joints(behind_start(number), start, before);
}

/// Is it a whole turn of a helix, or the second arc of one?
bool ContourMemory::ends_turn(const Section& section, Vec2 start, uint64_t number) const {
  const Piece last = wall_of(section, start);
  const bool climbs = std::abs(section.level_end - section.level) > kLevel_mm;
  if (!last.round || norm(section.delta) <= kCloses_mm) return last.round && climbs;
  if (number == state_.first) return false;
  const Wall& before = walls_[number - 1];
  const Piece& other = before.piece;
  if (!other.round || norm(other.from - last.to) > kCloses_mm || norm(other.center - last.center) > kAway_mm || other.sweep * last.sweep <= 0) return false;
  return climbs || before.high - before.low > kLevel_mm;
}

void ContourMemory::add_joints(uint64_t place, Vec2 start, const Swept& before) {
  for (uint64_t i = state_.joints; i <= place; ++i) {
    state_.joint[i] = i < place ? start : state_.at;
    state_.at_joint[i] = i < place ? before : state_.swept;
  }
  state_.joints = static_cast<uint8_t>(place + 1);
}

/// A contour ends with this block. What is in doubt in front of it is neither a way out nor one to another contour.
void ContourMemory::note_closed(uint64_t number) {
  state_.closure = number;
  wait_from(number + 1);
}

/// From this block on it is not known whether a few of them are a way. Those before that are still in doubt are none.
void ContourMemory::wait_from(uint64_t number) {
  if (state_.doubts != 0 && !certain_) {
    certain_ = true;
    in_front_ = state_.culprit[kBehind + static_cast<unsigned>(std::countr_zero(state_.doubts))];
  }
  state_.ways = number;
  state_.doubts = 0;
}

/// By a plunge, up, or down from a contour that has closed on its level: that one is a terrace with a depth of its own, and what lies below it ends there.
bool ContourMemory::goes_to_another_depth(const Section& section) {
  const bool by_itself = std::abs(section.level - state_.level) > kLevel_mm, up = section.level_end > section.level + kLevel_mm, down = section.level_end < section.level - kLevel_mm;
  if (!by_itself && !up && !down) return false;
  const bool another = by_itself || up || state_.level_closed != 0;
  state_.level_first = section.number + (up || down ? 1 : 0);
  if (state_.level_closed != 0 && state_.closure != 0) {
    leads_across(state_.ways, section.number);
    wait_from(up ? section.number : state_.level_first);  // what leads up may be a way out
  }
  state_.level_ring = state_.level_closed = 0;
  state_.level_terrace = state_.closure != 0;
  return another;
}

/// Does this block, the last one that has been read, come back to the start of one on its level, from block `from` on?
bool ContourMemory::comes_back(uint64_t number, uint64_t from, uint64_t* ring) const {
  const Piece& last = walls_[number].piece;
  Box end;
  end.take(last.to);
  return walls_.any(from, end.grown(kCloses_mm), [&](uint64_t first, const Wall& wall) {
    const Piece& piece = wall.piece;
    *ring = first;
    return wall.offset != 0 && norm(piece.from - last.to) <= kCloses_mm && goes_round(wall.swept, piece.from);
  });
}

bool ContourMemory::closes_on_level(uint64_t number, uint64_t* ring) const {
  if (state_.level_first > number) return false;
  const Piece& last = walls_[number].piece;
  *ring = number;
  if (last.round && std::abs(last.sweep) > kPi && norm(last.to - last.from) <= kCloses_mm) return last.radius > kAway_mm;
  return comes_back(number, std::max(state_.level_first, state_.level_ring), ring);
}

/// Are these blocks, which come back to where they began, the turn of a way out? It bends to the side of the tool, and comes out of what is in front of it without a corner.
bool ContourMemory::turns_out(uint64_t ring, uint64_t number) const {
  if (number > ring + 1) return false;
  for (uint64_t k = ring; k <= number; ++k) {
    const Piece& piece = walls_[k].piece;
    if (!piece.round || piece.sweep * walls_[k].offset <= 0 || !goes_straight_on(walls_[k - 1].piece, piece)) return false;
  }
  return walls_[ring - 1].offset != 0;
}

/// Does a block go along the contour once more, behind where it has closed?
bool ContourMemory::goes_along(uint64_t number) const {
  if (state_.closure == 0 || walls_[number].offset == 0) return false;
  const Piece& piece = walls_[number].piece;
  Box start;
  start.take(piece.from);
  return walls_.any(state_.first, start.grown(kAway_mm), [&](uint64_t earlier, const Wall& wall) { return earlier <= state_.closure && !is_way_in(earlier) && !wall.across && wall.offset * walls_[number].offset > 0 && lies_along(piece, wall.piece); });
}

/// Another contour behind one that has closed on its level: up to three blocks lead there from the one before, and where it has closed, it is no way out.
void ContourMemory::note_another(uint64_t number) {
  uint64_t ring = 0;
  if (state_.closure == 0 || state_.turned || number <= state_.closure || !comes_back(number, state_.closure + 1, &ring) || turns_out(ring, number)) return;
  leads_across(state_.ways, ring);
  note_closed(number);
  if (state_.level_closed != 0) state_.level_closed = number;
}

void ContourMemory::note_closed_level(uint64_t number) {
  uint64_t ring = 0;
  const bool from_start = state_.level_first <= state_.first + 1;  // where the first contour closes is known (follow()), which spares nearly all programs the search
  if (from_start ? state_.closure != number : state_.level_closed != 0) return note_another(number);
  if (!from_start && !closes_on_level(number, &ring)) return;
  if (state_.level_closed == 0) {
    state_.level_ring = ring;
    if (state_.level_terrace) {  // the first contour has its own ways in, and closes as they say (follow())
      leads_across(ring - state_.ways <= kWay ? state_.ways : state_.level_first, ring);  // on another level between the two, too
      note_closed(number);
    }
  }
  state_.level_closed = number;
}

/// These blocks, no more than three, are a way in or out: they are no walls.
void ContourMemory::leads_across(uint64_t from, uint64_t to) {
  if (to <= from || to - from > kWay) return;
  for (uint64_t number = from; number < to; ++number) {
    walls_.at(number).across = true;
    if (behind_start(number) <= kWay) state_.suspects = static_cast<uint8_t>(state_.suspects & ~(1u << behind_start(number)));
  }
  for (uint64_t number = std::max(from, state_.ways); number < std::min(to, state_.ways + kWay); ++number) state_.doubts = static_cast<uint8_t>(state_.doubts & ~(1u << (number - state_.ways)));
}

bool ContourMemory::is_way_in(uint64_t number) const { return behind_start(number) <= kWay && state_.closed >> behind_start(number) != 0; }

/// The path comes too near to this block. True: it is a wall; else that shows later.
bool ContourMemory::blame(uint64_t number, const Path& path) {
  if (is_way_in(number)) return false;
  const uint64_t place = behind_start(number);
  const Culprit culprit{path.source, path.starts || path.cancels};
  if (place <= kWay && (state_.closure == 0 || state_.turned)) {  // the contour may still come back to where it ends
    if ((state_.suspects >> place & 1) == 0) state_.culprit[place] = culprit;
    state_.suspects = static_cast<uint8_t>(state_.suspects | 1u << place);
    return false;
  }
  if (state_.closure == 0 || number < state_.ways || number >= state_.ways + kWay) {
    in_front_ = culprit;
    return true;
  }
  const uint64_t behind = number - state_.ways;
  if ((state_.doubts >> behind & 1) == 0) state_.culprit[kBehind + behind] = culprit;
  state_.doubts = static_cast<uint8_t>(state_.doubts | 1u << behind);
  return false;
}

/// At the end of the contour: blocks in doubt that are neither a way in nor one out. A way out begins where the contour has closed, or where it goes along it no more.
bool ContourMemory::no_way(uint64_t cancel) {
  const bool way_out = state_.closure != 0 && cancel <= state_.ways + kWay;
  for (unsigned place = 0; place <= kWay; ++place) {
    if ((state_.suspects >> place & 1) == 0) continue;
    if (way_out && state_.first + place - (state_.with_start ? 0 : 1) >= state_.ways) continue;
    culprit_ = &state_.culprit[place];
    return true;
  }
  if (way_out || state_.doubts == 0) return false;
  culprit_ = suspect();
  return true;
}

/// Between the path and the wall, which are neighbours, lies a joint at which the tool stands on the contour.
bool ContourMemory::across_contour(const Path& path, uint64_t number) { return number < path.number ? path.from_contour : path.to_contour; }

/// What is inserted at a corner leads round it: it cuts neither of the two blocks there, be they a part of the contour or of a way in or out.
bool ContourMemory::at_its_own_corner(const Path& path, uint64_t number) { return path.of_joint && (number == path.number || number == path.number + 1); }

/// The path of one of the two blocks beside a change of side, and the other block. On its way to the other side the tool has to cross the contour (M700 12.4.2): it cuts the block from the joint on up to where the
/// path is the radius away from it. What it cuts beyond a gap is a wall as others are, and so is all of the block for what of the path lies beyond one.
bool ContourMemory::enters_beyond_change(const Path& path, uint64_t number, const Wall& wall, Crossing* crossing) {
  const double margin = margin_of(path, wall);
  const bool behind = number > path.number;  // the wall; the joint is where it begins and the path ends
  const Amount of_path{std::abs(path.before), std::abs(path.offset)}, of_wall{std::abs(wall.before), std::abs(wall.offset)};
  const double clear = std::max({of_path.start, of_path.end, of_wall.start, of_wall.end}) + margin;
  const auto rest_of = [](Amount amount, bool from_start, double part) {
    const double at = (from_start ? part : 1 - part) * (amount.end - amount.start) + amount.start;
    return from_start ? Amount{at, amount.end} : Amount{amount.start, at};
  };
  if (!crossing->unbroken) return comes_nearer(path.piece, of_path, wall.piece, of_wall, margin);
  double cut = crossing->cut;
  if (cut < 1) cut += (1 - cut) * stretch_beside(without_stretch(wall.piece, behind, cut), behind, path.piece, clear);
  const double crosses = stretch_beside(path.piece, !behind, wall.piece, clear);
  *crossing = {cut, crosses >= 1};
  if (cut < 1 && comes_nearer(path.piece, of_path, without_stretch(wall.piece, behind, cut), rest_of(of_wall, behind, cut), margin)) return true;
  return crosses < 1 && comes_nearer(without_stretch(path.piece, !behind, crosses), rest_of(of_path, !behind, crosses), wall.piece, of_wall, margin);
}

/// The path of a block behind a change of side, or what is inserted behind it, is settled: what is inserted next goes on with its crossing of the block in front of the change.
void ContourMemory::go_on_crossing(const Path& path) {
  if (path.number <= state_.first) return;
  const Wall& wall = walls_[path.number - 1];
  if (path.offset * wall.offset < 0) enters_beyond_change(path, path.number - 1, wall, &crossing_);
}

/// The path of a block in front of a change of side is settled. The last line that is inserted at its start lies in front of it, so only now is known whether it goes on with its crossing of the block behind the
/// change.
bool ContourMemory::enters_in_front(const Path& ahead, const Path& path) {
  const uint64_t number = path.number + 1;
  if (number >= state_.end || path.offset * walls_[number].offset >= 0) return false;
  const Wall& wall = walls_[number];
  if (wall.across || across_contour(path, number) || wall.low > ahead.high + kLevel_mm || ahead.low > wall.high + kLevel_mm) return false;
  Crossing crossing;
  enters_beyond_change(path, number, wall, &crossing);
  return enters_beyond_change(ahead, number, wall, &crossing) && blame(number, ahead);
}

bool ContourMemory::enters(const Path& path, uint64_t number, const Wall& wall) const {
  if (wall.offset == 0 || wall.across) return false;
  // The cutter cuts all that is above its tip, so what has been cut above a path is a wall for it; a block above it that comes later is a way across the part. A wall
  // that ends below the tip is none; but where a contour goes down as it goes along (a helix, a ramp), its walls reach up to where it came from, the level moves at its
  // top included: a way in there cuts what the contour below it leaves standing.
  if (wall.low > path.high + kLevel_mm && number > path.number) return false;
  // A wall that slopes down from the level of a path of another depth stands no higher than that.
  const bool slopes_from_there = number > path.number && wall.high - wall.low > kLevel_mm && path.low >= wall.high - kLevel_mm;
  if (path.descent != wall.descent && (path.low > wall.high + kLevel_mm || slopes_from_there)) return false;
  const uint64_t between = apart(path.number + (path.of_next ? 1 : 0), number);
  // A path lies beside its own wall. The arc of G39 at an inner corner turns into it, and one with an end that the program gives may lead through it. The tangent of
  // an arc, by which a corner is lengthened, comes near to the other end of that arc where it turns by more than half a circle.
  if (between == 0 && !path.bends && !path.crosses_own && !(path.prolongs && wall.piece.round)) return false;
  if (between == 1 && across_contour(path, number)) return false;
  OpenEnds open;
  double margin = margin_of(path, wall);
  if (between == 1 && path.offset * wall.offset < 0) {
    if (path.of_next) return false;  // asked when the path of its block is settled
    Crossing crossing;
    if (path.of_joint && number < path.number) crossing = crossing_;  // what is inserted behind a block goes on with its crossing
    return enters_beyond_change(path, number, wall, &crossing);
  }
  if (between <= kOpen && (path.starts ? number > path.number : path.cancels && number < path.number)) {
    open.from = norm(wall.piece.from - path.contour) <= kSameJoint_mm;
    open.to = norm(wall.piece.to - path.contour) <= kSameJoint_mm;
    if (open.from && open.to && !wall.piece.round) return false;
    const double amount = std::min(std::abs(path.offset), std::abs(open.from ? wall.before : wall.offset));
    if (open.from || open.to) margin += path.unsure;  // the words of both have one: a way at right angles that is as long as the radius is so but for two digits
    if (cuts_end({path.piece, path.starts, amount, margin}, wall.piece, open)) return true;
  }
  const Amount of_path{std::abs(path.before), std::abs(path.offset)}, of_wall{std::abs(wall.before), std::abs(wall.offset)};
  return comes_nearer(path.piece, of_path, wall.piece, of_wall, margin, open);
}

/// The offset at the start of a block that has been read (M700 12.4.6); that of the block itself where it is not reached from another amount on the same side.
double ContourMemory::amount_before(const Section& section) const {
  return section.start || !(state_.offset * section.offset > 0) ? section.offset : state_.offset;
}

Clearance ContourMemory::read(Section* section) {
  culprit_ = nullptr;
  certain_ = false;
  if (state_.open && section->start && no_way(state_.end)) return Clearance::enters;  // G40 without a movement has ended the contour in front of it
  if (!state_.open || section->start) begin(section->start);
  section->number = walls_.end();
  if (state_.overlong || !walls_.keeps(state_.first)) {
    state_.overlong = true;
    return Clearance::full;
  }
  const bool another_depth = goes_to_another_depth(*section);
  const Vec2 start = state_.at + section->approach;
  section->contour_start = start;
  const Swept swept = go_on(*section);
  follow(*section, section->number, start, swept);
  state_.end = section->number + 1;
  state_.steps = 0;
  Wall wall;
  wall.piece = wall_of(*section, start);
  wall.before = amount_before(*section);
  if (another_depth) ++state_.descent;
  state_.level = section->level_end;
  section->descent = wall.descent = state_.descent;
  wall.low = std::min(section->level, section->level_end);
  wall.high = std::max(section->level, section->level_end);
  if (section->offset != 0 && !section->cancel) state_.offset = section->offset;
  if (!section->start && !section->cancel && section->cuts) wall.offset = section->offset;
  wall.slop = slop_of(wall.piece);
  wall.swept = swept;
  const Box box = box_of(wall.piece);
  walls_.push(wall, box);
  if (wall.offset != 0) note_closed_level(section->number);
  if (certain_) {
    culprit_ = &in_front_;
    return Clearance::enters;
  }
  if (section->number == state_.ways && (!section->cuts || goes_along(section->number))) ++state_.ways;
  if (wall.offset == 0) return Clearance::fits;
  const bool near = paths_.any(state_.first_path, box.grown(std::max(std::abs(wall.offset), std::abs(wall.before))), [&](uint64_t, const Path& path) {
    if (!enters(path, section->number, wall)) return false;
    if (blame(section->number, path)) culprit_ = &in_front_;
    return true;  // the first one tells for all
  });
  return near && culprit_ != nullptr ? Clearance::enters : Clearance::fits;
}

Clearance ContourMemory::read_by_hand(Section* section, Vec2 beside) {
  const Vec2 way = section->delta;
  state_.at = state_.at - beside;
  section->delta = way + beside;
  const Clearance found = read(section);
  section->delta = way;
  section->contour_start = section->contour_start + beside;
  return found;
}

Clearance ContourMemory::settle(const Section& section, Vec2 from, bool from_given, const nc_source& source) {
  culprit_ = nullptr;
  Path path;
  path.number = section.number;
  path.source = source;
  path.offset = section.cancel ? state_.offset : section.offset;
  path.before = section.cancel ? path.offset : walls_[section.number].before;
  path.low = std::min(section.level, section.level_end);
  path.high = std::max(section.level, section.level_end);
  path.descent = section.descent;
  path.starts = section.start;
  path.cancels = section.cancel;
  const bool to_given = section.commanded && !section.cancel;
  from_given = from_given && !section.cancel;
  // Where no vector has been made, or it has been taken away (G28), the tool stands on the contour, as at a start: that is no wall which it cuts. A vector
  // that the program gives is another matter: whatever it leads into is cut.
  path.from_contour = from_given && from == Vec2{};
  path.to_contour = to_given && section.joint.v[0] == Vec2{};
  const Vec2 start = section.contour_start, end = start + section.delta;
  path.slop = slop_of(wall_of(section, start)) + enters_of(section.inch) - kEnters_mm;
  path.unsure = unsure_of(section.inch);
  path.contour = section.start ? end : start;
  Clearance found = Clearance::fits;
  const auto add = [&](Path next_path, const Piece& piece) {
    next_path.piece = piece;
    const Clearance next = take(next_path);
    if (next != Clearance::fits && found != Clearance::full) found = next;
  };
  crossing_ = {};
  Path ahead_of_it;
  if (paths_.end() > state_.first_path) ahead_of_it = paths_[paths_.end() - 1];
  if (section.led) {
    Piece lead;
    lead.from = start + section.led_from;
    lead.to = start + from;
    Path ahead = path;
    ahead.starts = ahead.from_contour = section.led_from == Vec2{};
    ahead.contour = start;
    ahead.crosses_own = section.led_turns;
    ahead.offset = ahead.before;
    ahead.to_contour = from_given;
    add(ahead, lead);
  }
  path.crosses_own = (from_given && !path.from_contour) || (to_given && !path.to_contour) || section.oblique || section.by_hand;
  path.piece = path_of(section, start, from, section.joint.v[0]);
  if (ahead_of_it.of_next && ahead_of_it.number + 1 == section.number && enters_in_front(ahead_of_it, path)) found = Clearance::enters;
  add(path, path.piece);
  go_on_crossing(path);
  path.from_contour = path.crosses_own = false;
  path.before = path.offset;
  path.bends = section.joint.corner_arc;
  for (unsigned k = 1; k < section.joint.n; ++k) {
    path.of_joint = true;
    path.prolongs = section.joint.lengthened;
    path.of_next = section.joint.lengthened && k + 1 == section.joint.n;
    path.piece = way_at(end, section.joint.v[k - 1], section.joint.v[k], path.bends, section.offset);
    add(path, path.piece);
    go_on_crossing(path);
  }
  if (!section.cancel || section.transparent) return found;
  const bool no_way_in_or_out = no_way(section.number);
  if (found == Clearance::enters) {
    in_front_ = {source, true};
    culprit_ = &in_front_;
  } else if (found != Clearance::fits) {
    culprit_ = nullptr;
  }
  state_.open = false;
  return found == Clearance::fits && no_way_in_or_out ? Clearance::enters : found;
}

Clearance ContourMemory::step(const Step& step) {
  if (!state_.open) begin(false);
  culprit_ = nullptr;
  if (state_.overlong || !walls_.keeps(state_.first)) return Clearance::full;
  Path path;
  path.number = state_.end;
  path.source = step.source;
  path.offset = path.before = step.offset;
  path.low = path.high = state_.level;
  path.descent = state_.descent;
  path.contour = state_.at + step.approach;
  // From the contour it is a start; else it cuts what it leads through, be it the block before it or the one behind.
  path.starts = path.from_contour = step.from == Vec2{};
  path.to_contour = step.to == Vec2{};
  path.bends = step.bends;
  path.crosses_own = !path.starts && !path.to_contour && !step.crosses;
  path.piece = way_at(path.contour, step.from, step.to, step.bends, step.offset);
  if (path.offset != 0) ++state_.steps;
  return take(path);
}

/// A piece of a path: all walls that have been read.
Clearance ContourMemory::take(const Path& path) {
  if (!paths_.keeps(state_.first_path)) return Clearance::full;
  const Box box = box_of(path.piece);
  if (path.offset == 0) return Clearance::fits;
  paths_.push(path, box);
  const bool near = walls_.any(state_.first, box.grown(std::max(std::abs(path.offset), std::abs(path.before))), [&](uint64_t number, const Wall& wall) { return enters(path, number, wall) && (at_its_own_corner(path, number) || blame(number, path)); });
  return near ? Clearance::enters : Clearance::fits;
}

}  // namespace nc
