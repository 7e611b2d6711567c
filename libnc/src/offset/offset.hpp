// SPDX-License-Identifier: Apache-2.0
// Tool radius compensation: a stage of the stream. Moves go in with their programmed geometry, come out with
// the geometry of the tool centre; every other item goes through in its place (M700 12.4, DGSHAPE G39-G42).
//
// How it works. Between two blocks that move in the plane there is a *joint*. A joint has one or more
// *vectors*, each leading from the programmed point to a point of the tool centre (corner.hpp finds them).
// The last vector of a joint is where the next block starts. So a block's compensated geometry is: programmed
// start + vector of the joint before, programmed end + first vector of the joint behind; straight moves
// (Move.connecting) lead through the other vectors and belong to the block before the joint. A block is held
// until the joint at its end is known. Vectors, not points, are carried from block to block: a coordinate
// system that is shifted in the middle of a contour does not disturb them (M700 12.4.2, G92).
//
// What the interpreter sends:
//
// 1. Every move commanded while G41/G42 is modal carries comp.side != 0, with its block's own D, axis pair,
//    check and type. G40 and D0 are side 0.
// 2. A block with G38-G42 that does not move at all sends a move *without length* (start == end) that carries
//    its compensation, so that the stage sees the command: G41 alone (vector perpendicular at the start of
//    the next block), G41/G42 or G38 with I J K alone, G39 alone, G40 alone or with I J K. Such moves are
//    used up here, they never come out.
// 3. I J K: has_vector alone = G41/G42, the vector stands at right angles to `vector`; has_vector with
//    hold_vector = G38, it lies along `vector`; hold_vector alone = G38 without I J K. All of them, and
//    corner_arc (G39), stand on the move of their block only.
// 4. corner_arc with has_vector on a move without length = DGSHAPE G39 X Y: an arc about the corner up to the
//    normal of `vector`.
// 5. Item::block_end on the mark of every block that counts as a block of look-ahead.
#pragma once

#include "base/fixed.hpp"
#include "offset/contour_memory.hpp"
#include "offset/corner.hpp"
#include "offset/interference.hpp"
#include "stream/stream.hpp"

namespace nc {

/// What is needed to go on compensating from the end of a block: the small part of the stage's state that a
/// checkpoint keeps.
struct OffsetResume {
  bool active = false;
  bool pending = false;     ///< G41/G42 was commanded, no vector has been made yet
  uint8_t idle_blocks = 0;  ///< blocks without movement in the plane up to here
  Compensation comp;
  AxisVec programmed;            ///< end of the last block, compensation frame
  AxisVec compensated;           ///< where the tool centre really is
  double vector[2] = {0, 0};     ///< from the programmed to the compensated end, as the stage goes on with it: a difference of the two is rounded
  double direction[2] = {0, 0};  ///< tangent of the last block at its end, unit
  ContourMemory::State contour;  ///< what the check of the whole contour has seen
  double level = 0;  ///< its level across the plane
  bool commanded = true;  ///< the vector may lie anywhere: what begins with it is not checked against it
  bool cancelled = false; ///< G40 was commanded, no movement in the plane has taken the vector away yet
  bool trim = false;      ///< an arc that comes next loses what is beyond a full circle
  double approach[2] = {0, 0};  ///< lines without a direction since the last joint
  bool side_changed = false;    ///< ... and what stands between them has changed the side
  bool given = true;            ///< the vector goes by no block behind it
  double feed_scale = 0;
};

inline bool in_force(const OffsetResume& resume) { return resume.active; }

class OffsetStage {
 public:
  /// Room for items; a power of two, so that the numbers of items may wrap.
  static constexpr unsigned kHeld = 128;
  using Rule = NoRule;
  using Resume = OffsetResume;
  /// `contour_blocks`: the longest contour that the check of its walls can take.
  void create(unsigned contour_blocks, Arena& arena) {
    held_ = arena.make<Held>(kHeld);
    contour_ = arena.make<ContourMemory::State>(kHeld);
    memory_.create(contour_blocks, arena);
  }
  /// A move that is compensated.
  bool takes(const Item& item, NoRule, bool) const { return item.move.comp.side != 0; }
  /// Room for one more push (a push may make several items ready).
  bool can_push() const;
  /// Takes an item; false: there is no room for it, pop() first.
  bool push(const Item& item, NoRule = {});
  /// Next finished item, false when the stage has none or must see more first.
  bool pop(Item& out) { return (has_rest_ || first_ != released_) && pop_ready(out); }
  /// Forget everything held; compensation off.
  void reset();
  /// State right behind the mark that pop() has just given: to be asked for before the next pop().
  OffsetResume resume_point() const;
  void restore(const OffsetResume& resume);
  /// Vectors, not points, are carried on.
  void displaced() {}
  /// True when nothing is held and compensation is off: items may bypass the stage.
  bool idle() const { return count_ == 0 && !has_rest_ && mode_ == Mode::off && !failed_ && vector_ == Vec2{}; }

 private:
  /// Items held back while looking ahead over five blocks: macro statements between two movements are no blocks, but each of them has a mark.
  static constexpr unsigned kLookAheadItems = kHeld - 8;
  static constexpr unsigned kChain = 5;  ///< moving blocks that the interference check wants to see at once
  static constexpr unsigned kLookAheadBlocks = kPreRead;
  /// This many blocks without movement close the contour (M700 12.4.2).
  static constexpr uint8_t kIdleLimit = 4;

  /// off: no compensation. pending: commanded, not begun. on: vectors are carried (they may be zero).
  enum class Mode : uint8_t { off, pending, on };
  /// What pop() does with an item. pass: nothing. carried: shifted by the vector in force. section: its ends
  /// get their vectors. command: used up.
  enum class Role : uint8_t { pass, carried, section, command };

  struct Held {
    Item item;
    Role role = Role::pass;
    bool has_lead = false;    ///< displacement before the move, from the vector in force to `lead`
    bool lead_arc = false;    ///< on an arc about the programmed point
    bool straight = false;    ///< what the interference check leaves of an arc is a line, or a point
    bool inner = false;       ///< section: the joint at its end is a corner that the tool cuts from the inside (M700 7.10)
    bool behind_inner = false;  ///< section: so is the one at its start
    bool trim = false;        ///< an arc longer than a full circle loses the part beyond (M700 12.4.2)
    bool trim_next = false;   ///< section: ... of the one behind, whose side is another
    bool commanded = true;    ///< section: the vector at its end may lie anywhere
    bool alone = false;       ///< section: that vector goes by no block behind it
    bool bound_next = false;  ///< section: the one behind has a joint that depends on this one
    bool passed = false;      ///< marks: a read that comes behind it has gone in front of it
    ContourMemory::Doubt doubt;  ///< section: what was in doubt about the contour when its path was settled
    Vec2 approach;            ///< marks: lines without a direction since the joint
    bool side_changed = false, given = true;  ///< marks
    Mode mode = Mode::off;    ///< marks: state behind them
    uint8_t idle_blocks = 0;  ///< marks
    bool cancelled = false;   ///< marks
    bool in_contour = false;  ///< marks: contour_ has what the check of the walls has seen
    double level = 0;  ///< marks
    Vec2 lead;
    Vec2 lead_from;           ///< the vector in force before it
    Vec2 direction;           ///< moves of a contour: tangent at their end; zero: they do not move in the plane
    bool lead_crosses = false;  ///< ... which lies on the other side
    ContourJoint joint;  ///< section: at its end
  };

  /// An arc about a corner that ends where its words lead to (DGSHAPE G39). The way of the block behind, which it would cut otherwise, is compared with it.
  struct Turn {
    bool made = false;     ///< the next block of the contour is the one behind it
    bool waits = false;    ///< it is held until this block has been read
    uint32_t index = 0;    ///< of the arc
    Vec2 vector;           ///< at its end
    nc_source source{};
  };

  /// Where the arc of G39 at the end of the block that is open has been commanded: in that block, or in one of its own behind it.
  struct Bend {
    uint32_t index = 0;
    nc_source source{};
  };

  // Intake: push() and what it decides (offset.cpp).
  void let_pass(const Item& sync);
  void keep_state(Held* mark);
  void intake_move(Held* held);
  void intake_carried(Held* held);
  bool intake_without_direction(Held* held, double offset_before, Leg* begin, Leg* end);
  void intake_uncompensated(Held* held);
  void bend_behind(uint32_t index, const Item& corner);
  void feed_bend(uint32_t index, const Item& corner);
  void intake_command(Held* held);
  void turn_start(Section* start, const Held& turn);
  bool turn_fits(const Section& behind);
  void lead(Held* held, Vec2 vector);
  bool look_at_step(const Held& held);
  void intake_section(Held* held, const Leg& begin, const Leg& end);
  void join(const Section& behind, Held* held_behind);
  void join_pair(Section* before, const Section& behind, Held* held_behind);
  bool goes_on(const Section& before, const Section& behind, const Compensation& comp_behind);
  Section* waiting();
  bool decide_waiting();
  bool find_joint(const Section& before, const Compensation& comp_before, const Section& behind, const Compensation& comp_behind, ContourJoint* joint) const;
  bool check_joints(unsigned last_call);
  bool look_at_left_out(unsigned sections);
  bool look_at_walls(unsigned sections);
  unsigned first_too_near(unsigned sections, Clearance* found);
  uint32_t stop_at(uint32_t index, Item* alarm);
  void read_wall(Section* section, const nc_source& source);
  void count_block_end();
  bool interferes(unsigned* at);
  void close();
  void settle(unsigned n);
  /// All in front of the chain may go, but for an arc whose block behind is still to be read.
  void wait_for_chain() { released_ = turn_.waits ? turn_.index : chain_.empty() ? next_index() : chain_[0].index; }
  void make_room();
  unsigned may_release() const;
  void release(unsigned sections);
  void stop_by(uint32_t index, const Item& because);
  void fail(uint32_t index, Condition condition, const nc_source& source);
  uint32_t next_index() const { return first_ + count_; }
  Held& held_at(uint32_t index) { return held_[index % kHeld]; }
  Held& new_slot(uint32_t index, const Item& item);
  ContourMemory::State& contour_at(const Held& held) { return contour_[&held - held_]; }
  ChainStart chain_start() const { return {chain_start_, start_commanded_, start_erased_, chain_start_block_}; }
  Section* open() { return chain_.empty() || chain_.back().jointed ? nullptr : &chain_.back(); }

  // Outlet: pop() (outlet.cpp).
  bool pop_ready(Item& out);
  bool pop_move(Held* held, Item& out);
  bool pop_lead(const Held& held, Item& out);
  bool pop_shifted(const Held& held, Vec2 end_vector, Item& out);
  void pop_connecting(const Held& held, Item& out);
  void slow_behind_corner(Item& out);
  void drop_front();
  void note_move(const Held& held, const AxisVec& compensated_end);
  void note_section(const Held& held);
  void note_mark(const Held& held);

  Held* held_ = nullptr;   ///< kHeld; item number i lies in held_[i % kHeld]
  ContourMemory::State* contour_ = nullptr;  ///< kHeld
  uint32_t count_ = 0;     ///< of items held
  Chain chain_;            ///< sections whose items are not released
  uint32_t first_ = 0;     ///< index of the front of held_
  uint32_t released_ = 0;  ///< items below this index may be popped
  uint32_t blocks_ = 0;
  Mode mode_ = Mode::off;
  uint8_t idle_blocks_ = 0;
  bool moved_ = false;   ///< the present block has moved in the plane, or commands compensation (G41, G42): neither counts as idle
  bool cancelled_ = false;  ///< G40 alone: the vector is still there, and what is commanded next is a start
  bool failed_ = false;  ///< an alarm of this stage ended the stream
  Compensation comp_;    ///< of the last section
  Vec2 tail_;            ///< vector at the end of everything decided
  Vec2 chain_start_;     ///< vector at the start of chain_[0]
  uint32_t chain_start_block_ = 0;  ///< Section::block of the one that ends there
  Vec2 approach_;        ///< of the next section
  Turn turn_;
  Bend bend_;
  bool unchecked_ = false;     ///< the last section has not been compared with those in front
  bool given_ = true;          ///< restored: the vector goes by no block behind it
  bool side_changed_ = false;  ///< a block without a direction in front of the next section has changed the side
  bool amount_changed_ = false;  ///< ... or the amount
  bool start_commanded_ = true;  ///< it may lie anywhere
  bool start_erased_ = false;    ///< ContourJoint::last_erased of the joint that it belongs to
  bool trim_next_ = false;       ///< restored: the section that comes
  ContourMemory memory_;
  double level_ = 0, level_end_ = 0;  ///< of the last move, across the plane

  bool lead_done_ = false;    ///< of the front item
  bool has_rest_ = false;     ///< the first part of a move has been given, and `rest_` comes next
  Item rest_;
  uint8_t connecting_ = 0;    ///< connecting moves of the front item given, 0 = the move itself not yet
  Vec2 vector_;               ///< in force where pop() stands
  uint8_t axis_[2] = {0, 1};  ///< its plane
  Vec2 direction_;  ///< tangent at the end of the last move
  bool out_commanded_ = true, out_trim_ = false, out_alone_ = false;
  bool bound_ = false;      ///< the blocks behind cannot be read again from here: a joint of theirs depends on one in front
  ContourMemory::Doubt doubt_;
  double feed_scale_ = 0;  ///< FeedRule::scale of the last move: what is inserted behind it goes on at its speed (M700 7.5 (4))
  /// Behind the last mark; `comp`, `programmed` and `compensated` are those of the last move.
  OffsetResume resume_;
};

}  // namespace nc
