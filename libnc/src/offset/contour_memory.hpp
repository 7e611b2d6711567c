// SPDX-License-Identifier: Apache-2.0
// The whole contour between the start of radius compensation and its end: does the path of the tool anywhere come nearer than the radius to any of
// the blocks (m700: CONTOUR_CHECK)? It is asked when a block is read, of the paths before it, and when the path of a block is settled, of all blocks
// that have been read; so each pair is looked at once, those of the pre-read before the machine moves.
//
// What is a wall. Every cutting block between the start and the end of compensation, but for the way in and the way out, which the path of the
// contour crosses: up to three blocks behind the start, if the contour later comes back to where they end (then it is closed there), and up to
// three blocks between a point where the contour has closed and the block that ends compensation, or the start of another contour, which closes, too. Until that is known a path that comes too
// near to such blocks is kept in mind, and is an alarm at the end of the contour at the latest.
//
// A contour that closes on another level behind that one, a terrace, has ways in and out of its own: up to three blocks on its level in front of where it closes, and up to three behind
// that, in front of a way to another depth.
//
// What is not compared: a path with its own wall (but for the arc of G39, and for a block one of whose vectors is given or erased), blocks below it (along the axis across the plane; of a way down along
// the contour all are on one level), and beside a change of
// side the stretches of the block before and the block behind that the path of the other cuts from there on; where the tool stands on the contour without a vector, all of these two.
//
// How near a path may come. By the smaller one of the two amounts where they differ, and in a block with another amount, in which it changes evenly (M700 12.4.6), by what it is there:
// at a joint that of the block in front holds for both.
//
// Blocks and paths lie in two rows (box_row.hpp) of a fixed size. A contour that is longer is an alarm where it leaves the memory, never a block that
// is not looked at.
#pragma once

#include "offset/box_row.hpp"
#include "offset/walls.hpp"

namespace nc {

/// fits: nothing comes too near. enters: something does. full: the contour is longer than the memory.
enum class Clearance : uint8_t { fits, enters, full };

class ContourMemory {
 public:
  static constexpr unsigned kWay = 3;  ///< the most blocks of a way in, or out
  static constexpr unsigned kOpen = 2;  ///< blocks beside the start or the cancel whose end may lie where the tool comes or leaves

  /// The block whose path comes too near to a wall. It stands far in front of the block in which that is certain, and is the one to be changed.
  struct Culprit {
    nc_source source{};
    bool way = false;  ///< it starts compensation, or ends it
  };
  static constexpr unsigned kBehind = kWay + 1;  ///< place of the first of `doubts` among the culprits, behind those of `suspects`
  static constexpr unsigned kCulprits = kBehind + kWay;

  /// What the ray from the start of the contour to its end has swept up to some point, which tells whether it goes round something between two of them.
  struct Swept {
    double area = 0, way = 0;
  };

  /// What a checkpoint keeps: the contour as far as it has been read.
  struct State {
    bool open = false;       ///< between the start and the end of compensation
    bool overlong = false;
    uint64_t first = 0;      ///< number of its first block
    uint64_t first_path = 0; ///< ... and of its first path
    bool with_start = true;  ///< the first block is that of a start
    bool turned = false;     ///< it has closed by whole turns of a helix alone, which are a way in where it closes again
    uint64_t end = 0;        ///< ... of the next block
    uint64_t closure = 0;    ///< of the block in which the contour has closed last; 0: not yet
    uint64_t ways = 0;       ///< of the first block behind it that neither goes along the contour once more nor is a rapid: up to kWay blocks from there on may be a way out, or one to another contour
    uint32_t steps = 0;      ///< steps in front of the next block (step())
    uint8_t joints = 0;      ///< how many of `joint` are there
    uint8_t away = 0;        ///< bit i: the contour has left joint i
    uint8_t closed = 0;      ///< bit i: ... and has come back to it, when it first closed
    uint8_t suspects = 0;    ///< bit i: a path comes too near to block i behind the start, which has to be a way in, or out
    uint8_t doubts = 0;      ///< bit i: ... to block `ways` + i
    Culprit culprit[kCulprits];  ///< whose path it is, of each of the suspects and of the doubts
    double offset = 0;       ///< of the last block that has one
    double level = 0;        ///< across the plane, at its end
    uint32_t descent = 0;    ///< counts the ways down along the contour, which end where it goes up, changes its level by itself, or goes on down from a level on which it has closed
    uint64_t level_first = 0;   ///< number of the first block of those on one level up to here
    bool level_terrace = false; ///< behind one on which the contour has closed
    uint64_t level_ring = 0;    ///< number of the block to whose start they have come back first,
    uint64_t level_closed = 0;  ///< ... and of the one with which they have done so last; 0: not yet
    Vec2 at;                 ///< programmed end of the last block; the contour counts from its own start
    Swept swept;             ///< ... at its end
    Vec2 joint[kWay + 1];    ///< ends of the start block and of the first three behind it
    Swept at_joint[kWay + 1];
  };

  void create(unsigned blocks, Arena& arena) {
    walls_.create(blocks, arena);
    paths_.create(blocks, arena);
  }
  /// What comes next is another program.
  void reset() { state_.open = state_.overlong = false; }
  const State& state() const { return state_; }
  void restore(const State& state);
  /// What of the blocks in front is in doubt when a path has been settled. That is later than the end of its block has been read.
  struct Doubt {
    uint64_t first = 0;    ///< the contour that it is about
    uint64_t ways = 0;
    uint8_t suspects = 0, doubts = 0;
    Culprit culprit[kCulprits];
  };
  Doubt doubt() const;
  /// The state at the end of a block, with what is in doubt since: of blocks behind it nothing.
  static State with(State state, const Doubt& doubt);
  /// A path has come too near to blocks that have to be a way in or out, which is not known yet.
  bool suspects() const { return state_.open && (state_.suspects != 0 || state_.doubts != 0); }
  /// Whose path that is; nullptr: of none.
  const Culprit* suspect() const;
  /// What the last call has found too near is another block's path; nullptr: that of the block itself.
  const Culprit* culprit() const { return culprit_; }

  /// A block has been read; `section->number` becomes its number. Its path comes later.
  Clearance read(Section* section);
  /// The same of a line that begins this far beside its programmed start, because the axes were moved by hand there: the wall is the programmed line, and the
  /// path leads back to its end.
  Clearance read_by_hand(Section* section, Vec2 beside);
  /// The path of the block is settled: it begins with this vector, which the program may have given.
  Clearance settle(const Section& section, Vec2 from, bool from_given, const nc_source& source);
  /// A block without movement has given a vector (I J K, M700 12.4.3 (4); G39 of DGSHAPE): the tool goes there from the one before, where the contour stands.
  struct Step {
    Vec2 from, to;
    bool bends = false;  ///< on an arc about the corner
    double offset = 0;   ///< signed, of what is commanded
    Vec2 approach;       ///< from the last joint to where the contour stands
    bool crosses = false;  ///< from the other side
    nc_source source{};
  };
  Clearance step(const Step& step);

 private:
  struct Wall {
    Piece piece;
    double offset = 0;  ///< 0: it is none
    double before = 0;  ///< that at its start: of the block in front of it
    double slop = 0;
    double low = 0, high = 0;
    uint32_t descent = 0;
    Swept swept;            ///< at its start
    bool across = false;    ///< it leads to a contour that has closed on its level, or from there to another depth
  };
  struct Path {
    Piece piece;
    uint64_t number = 0;  ///< of its block
    nc_source source{};
    double offset = 0, slop = 0;
    double unsure = kLastDigit_mm;  ///< what the last digit of its words makes
    double before = 0;    ///< the offset at its start
    double low = 0, high = 0;
    uint32_t descent = 0;
    bool from_contour = false, to_contour = false;  ///< without a vector
    bool starts = false, cancels = false, bends = false;  ///< bends: an arc about the corner behind the block
    bool crosses_own = false;  ///< the move of a block, one of whose ends is given, or has lost its vector: it need not lie beside its own wall
    bool prolongs = false;     ///< a piece of a lengthened joint: it leads straight on, and an arc beside it may come back to it
    bool of_joint = false;     ///< what is inserted at the corner behind the block
    bool of_next = false;      ///< the last piece of a lengthened joint: it lies beside the block behind, and so is compared like that one's path
    Vec2 contour;         ///< starts, cancels: where the tool comes to the contour, or leaves it
  };

  void begin(bool with_start);
  uint64_t behind_start(uint64_t number) const { return number - state_.first + (state_.with_start ? 0 : 1); }
  Swept go_on(const Section& section);
  void follow(const Section& section, uint64_t number, Vec2 start, const Swept& before);
  bool ends_turn(const Section& section, Vec2 start, uint64_t number) const;
  void add_joints(uint64_t place, Vec2 start, const Swept& before);
  bool goes_to_another_depth(const Section& section);
  bool comes_back(uint64_t number, uint64_t from, uint64_t* ring) const;
  bool goes_round(const Swept& since, Vec2 place) const;
  bool turns_out(uint64_t ring, uint64_t number) const;
  bool goes_along(uint64_t number) const;
  void note_closed(uint64_t number);
  void wait_from(uint64_t number);
  bool closes_on_level(uint64_t number, uint64_t* ring) const;
  void note_another(uint64_t number);
  void note_closed_level(uint64_t number);
  void leads_across(uint64_t from, uint64_t to);
  bool is_way_in(uint64_t number) const;
  static bool across_contour(const Path& path, uint64_t number);
  bool enters(const Path& path, uint64_t number, const Wall& wall) const;
  /// The tool on its way to the other side, over the block behind a change of side, or back over the one in front of it.
  struct Crossing {
    double cut = 0;        ///< part of that block, from the joint on, which the paths up to here have crossed
    bool unbroken = true;  ///< all of these paths lies in the crossing
  };
  static double margin_of(const Path& path, const Wall& wall) { return kEnters_mm + path.slop + wall.slop; }
  static bool enters_beyond_change(const Path& path, uint64_t number, const Wall& wall, Crossing* crossing);
  void go_on_crossing(const Path& path);
  bool enters_in_front(const Path& ahead, const Path& path);
  double amount_before(const Section& section) const;
  static bool at_its_own_corner(const Path& path, uint64_t number);
  bool blame(uint64_t number, const Path& path);
  bool no_way(uint64_t cancel);
  Clearance take(const Path& path);

  BoxRow<Wall> walls_;
  BoxRow<Path> paths_;
  State state_;
  Crossing crossing_;  ///< of the block in front, by the path that is being settled
  const Culprit* culprit_ = nullptr;
  bool certain_ = false;  ///< with the block that is read it has shown that one in doubt is a wall
  Culprit in_front_;  ///< one that has nothing to do with ways in and out
};

}  // namespace nc
