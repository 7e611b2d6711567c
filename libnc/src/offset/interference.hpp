// SPDX-License-Identifier: Apache-2.0
// The interference check of M700 12.4.8: among the blocks read ahead, do the vectors at two joints cross?
// Then the blocks between the joints cannot be machined. Either it is an alarm, or they are left out and the
// blocks around them are joined directly.
#pragma once

#include <cmath>

#include "base/fixed.hpp"
#include "base/same_place.hpp"
#include "offset/corner.hpp"
#include "stream/stream.hpp"

namespace nc {

/// A block that moves in the plane, as far as the joints at its two ends need it.
struct Section {
  uint32_t index = 0;  ///< of its item
  uint32_t block = 0;  ///< count of blocks when it came
  Leg begin, end;
  Vec2 approach;             ///< its start - the joint before: lines between them that have no direction (kNoDirection_mm)
  Vec2 delta;                ///< programmed end - programmed start
  double offset = 0;         ///< signed, mm
  double sweep = 0;          ///< of an arc, rad, counter-clockwise positive
  ContourJoint joint;        ///< at its end

  // The flags lie together, and all is 256 bytes, so that a block is found in the ring without a multiplication.
  bool jointed = false;      ///< `joint` is known
  bool commanded = false;    ///< by I J K, hold, cancel, ...: never erased (M700 12.4.3 precaution (2))
  bool holds = false;        ///< ... namely that of the joint before (G38)
  bool start = false;        ///< start block: does not run along an offset curve
  bool cancel = false;       ///< nor does a block without compensation at its end
  bool vanished = false;     ///< an arc whose offset circle does not exist
  bool dead = false;         ///< left out by the avoidance: start and end of its compensated path coincide
  bool oblique = false;      ///< has lost a vector of its own: the way between those that are left does not lie beside the block, and is a line
  bool merge_first = false;  ///< lengthened corner: this line runs straight into joint.v[1]
  bool merge_last = false;   ///< the line behind comes straight out of joint.v[2]
  bool check = false, walls = false, avoid = false;
  bool bound = false;        ///< a comparison with a block in front has changed its joint, or left it out: it is not read again without that block

  // For the memory of the contour (contour_memory.hpp), which `walls` asks for.
  bool transparent = false;   ///< `cancel`, but compensation goes on behind it
  bool cuts = false;          ///< not a rapid
  bool led = false;           ///< a displacement to the first vector goes before it, from led_from
  bool led_turns = false;     ///< ... which is one of another contour on the same side
  bool settled = false;       ///< its path has been looked at
  bool inch : 1 = false;      ///< its words are in inch (unsure_of())
  bool by_hand : 1 = false;   ///< it begins where the axes were moved by hand, and leads back to its end
  bool alone : 1 = false;     ///< its joint has been made without a block behind it
  bool part : 1 = false;      ///< a line of micrometres that is a part of what goes on before and behind it (tiny_line.hpp): it has no direction to keep
  uint32_t descent = 0;       ///< of the contour, which it belongs to
  uint64_t number = 0;        ///< in that memory
  Vec2 contour_start;         ///< programmed start, counted from the start of the contour
  double level = 0, level_end = 0;  ///< across the plane
  Vec2 led_from;

  /// What a new block does not get words of its own for (OffsetStage::intake_section()) is as it was made: in this order a few steps clear all of it. The vectors of
  /// a joint that has none are not looked at.
  void renew() {
    joint.n = 0;
    joint.corner_arc = joint.lengthened = joint.first_erased = joint.last_erased = false;
    jointed = commanded = holds = start = cancel = vanished = dead = oblique = merge_first = merge_last = check = walls = avoid = bound = transparent = cuts = led = led_turns = settled = false;
    part = alone = false;
    descent = 0;
    number = 0;
    contour_start = {};
  }
};
static_assert(sizeof(Section) == 256);

/// Does a line that begins or ends with this vector run parallel to its programmed one? Not where another amount, or the program, has made the vector.
inline bool runs_beside(const Section& line, Vec2 vector) { return std::abs(dot(vector, left_of(line.end.u)) - line.offset) <= kNoLength; }

/// The blocks under consideration, in order. Only the last one may not be jointed yet, and the one in front of it where that may be a part of its neighbours (tiny_line.hpp). They lie in a ring, so that those in front go without the others
/// being moved.
class Chain {
 public:
  /// A block that comes lets those go that have three behind them; an arc that only the avoidance can leave out waits for two more, and behind a block
  /// that is left out they wait for one more.
  static constexpr unsigned kMost = 8;
  unsigned size() const { return size_; }
  bool empty() const { return size_ == 0; }
  void clear() { keep_front(0); }
  Section& operator[](unsigned i) { return ring_[(front_ + i) % kMost]; }
  const Section& operator[](unsigned i) const { return ring_[(front_ + i) % kMost]; }
  Section& back() { return (*this)[size_ - 1]; }
  const Section& back() const { return (*this)[size_ - 1]; }
  /// The place of the block that comes: it is made there, and is not one of the chain until push_back().
  Section& next() { return (*this)[size_]; }
  /// The same, renewed.
  Section& new_next() {
    next().renew();
    return next();
  }
  void push_back() {
    const Section& section = next();
    vanishes_ = vanishes_ || section.vanished;
    changed_ = changed_ || section.holds;
    walls_ = walls_ || section.walls;
    ++size_;
  }
  void push_back(const Section& section) {
    next() = section;
    push_back();
  }
  void drop_front(unsigned count) {
    front_ = (front_ + count) % kMost;
    compared_ = compared_ > count ? compared_ - count : 0;
    keep_front(size_ - count);
  }
  void keep_front(unsigned count) {
    size_ = count;
    if (compared_ > size_) compared_ = size_;
    if (size_ == 0) vanishes_ = changed_ = walls_ = left_out_ = false;
  }
  /// False: none of them asks for its walls.
  bool may_have_walls() const { return walls_; }
  /// A vector has been erased.
  void note_change() { changed_ = true; }
  /// False: since the chain was empty no vector of it has been erased, and none is held.
  bool may_have_changed() const { return changed_; }
  /// The avoidance has left one of the blocks out.
  void note_left_out() { left_out_ = true; }
  /// False: since the chain was empty it has left none out.
  bool may_have_left_out() const { return left_out_; }
  /// So many at the front need not be compared again: the vectors at their ends, as they all stand now, cross none of those in front of them.
  unsigned compared() const { return compared_; }
  void note_compared(unsigned count) { compared_ = count; }
  /// False: none of the blocks is an arc whose offset circle does not exist.
  bool may_have_vanished() const { return vanishes_; }

 private:
  Section ring_[kMost];
  unsigned front_ = 0, size_ = 0, compared_ = 0;
  bool vanishes_ = false, changed_ = false, walls_ = false, left_out_ = false;
};

enum class Finding : uint8_t { none, alarm };

/// Where chain[0] starts.
struct ChainStart {
  Vec2 vector;
  bool commanded = false;  ///< it may lie anywhere
  bool erased = false;     ///< as ContourJoint::last_erased
  uint32_t block = 0;      ///< Section::block of the block that ends there
};

/// Blocks that are read ahead, that of the first joint included (M700 12.4.1, 12.4.8).
inline constexpr unsigned kPreRead = 5;

/// Checks the joints of the chain against each other and repairs what may be repaired. An interference that blocks still to come may repair is left for the next call;
/// `last_call` = sections below this number cannot wait any longer. On alarm *at is the section before which
/// the program stops.
Finding check_interference(Chain* chain, unsigned last_call, const ChainStart& start, unsigned* at);

}  // namespace nc
