// SPDX-License-Identifier: Apache-2.0
// Random programs of the cycles of DGSHAPE, block by block, most of them with words left out: without Z nothing is drilled, without R it is the initial level,
// without P there is no dwell, K in G90 and G91, G98 and G99 from block to block. Beside each block the test writes down what its page (G80 to G89) says.
#include "naive_writer.hpp"

namespace nc::test {
namespace {

class DgshapeWriter : public NaiveWriter {
 public:
  explicit DgshapeWriter(uint64_t seed) : NaiveWriter(seed) {
    line("%");
    line("G90 G98 M03 F150.");
    feed_ = 150;
    m(3);
    move();
  }
  void write(unsigned blocks) {
    for (unsigned n = 0; n < blocks; ++n) block();
    line("G80");
    line("M02");
    m(2);
  }

 private:
  void block() {
    if (code_ == 0) return chance(0.7) ? begin() : move();
    switch (pick(10)) {
      case 0: return g91_ = !g91_, line(g91_ ? "G91" : "G90");
      case 1: return to_r_ = !to_r_, line(to_r_ ? "G99" : "G98");
      case 2: return end();
      case 3:
      case 4: return begin();
      default: return hole_block("");
    }
  }
  void end() {
    line("G80");
    code_ = 0;
  }
  void move() {
    if (code_ != 0) end();
    const std::array<double, 3> to{number(-50, 50), number(-50, 50), number(6, 25)};
    line("G90 G00" + word('X', to[0]) + word('Y', to[1]) + word('Z', to[2]));
    g91_ = false;
    go("rapid", to);
  }
  /// "The initial level is the Z-axis tool position in effect before the fixed cycle was specified."
  void begin() {
    static constexpr int kCodes[] = {81, 82, 83, 85, 86, 89};
    if (code_ == 0 && at_[2] < 6) move();  // R lies below it, and Z below R
    if (code_ == 0) initial_ = at_[2];
    code_ = kCodes[pick(6)];
    has_z_ = has_r_ = false;
    p_ = q_ = 0;
    std::string block;
    if (chance(0.3)) to_r_ = chance(0.5), block = to_r_ ? "G99 " : "G98 ";
    if (chance(0.3)) g91_ = chance(0.5), block += g91_ ? "G91 " : "G90 ";
    hole_block(block + "G" + std::to_string(code_));
  }
  void hole_block(std::string block) {
    const bool begins = !block.empty();
    bool drills = false, given[2] = {};
    double by[2] = {};
    for (unsigned i = 0; i < 2; ++i) {
      if (!(given[i] = chance(0.6))) continue;
      by[i] = number(-20, 20);
      block += word("XY"[i], by[i]);
      drills = true;
    }
    if (chance(begins ? 0.7 : 0.15)) {
      has_z_ = true;
      z_ = g91_ ? -number(1, 12) : number(-9, 0);
      z_from_r_ = g91_;
      block += word('Z', z_);
      drills = true;
    }
    if (chance(begins ? 0.7 : 0.15)) {
      has_r_ = true;
      r_ = g91_ ? -number(0, 5) : number(0.5, 4);
      r_from_initial_ = g91_;
      block += word('R', r_);
      drills = true;
    }
    if (!drills && !begins) return;
    if (!drills) {  // Q, P and K where there is no hole are an alarm
      block += word('X', by[0] = number(-20, 20));
      given[0] = true;
    }
    if (code_ == 83 && (begins || chance(0.2))) block += word('Q', q_ = number(0.8, 5));
    if ((code_ == 82 || code_ == 89) && chance(0.4)) {
      const unsigned ms = 10 * pick(60);
      p_ = ms / 1000.;
      block += " P" + std::to_string(ms);
    }
    unsigned count = 1;
    if (chance(0.25)) block += " K" + std::to_string(count = pick(4));
    line(block);
    const std::array<double, 3> from = at_;
    for (unsigned n = 0; n < count; ++n) {
      std::array<double, 3> over = at_;
      for (unsigned i = 0; i < 2; ++i)
        if (given[i]) over[i] = g91_ ? from[i] + (n + 1) * by[i] : by[i];
      go("rapid", over);
      if (has_z_) hole();
    }
  }
  void hole() {
    const double r = !has_r_ ? initial_ : r_from_initial_ ? initial_ + r_ : r_, bottom = z_from_r_ ? r + z_ : z_, back = to_r_ ? r : initial_;
    rapid_z(r);
    if (code_ == 83) {
      for (double depth = r; depth != bottom;) {
        if (depth != r) rapid_z(r), rapid_z(std::fmin(depth + 1, r));  // "The d value is fixed at 1 mm"
        depth = depth - q_ > bottom + 1e-9 ? depth - q_ : bottom;
        feed_z(depth);
      }
      return rapid_z(back);
    }
    feed_z(bottom);
    if (code_ == 82 || code_ == 89) dwell(p_);
    if (code_ == 85 || code_ == 89) feed_z(r);
    if (code_ == 86) m(5);
    rapid_z(back);
    if (code_ == 86) m(3);
  }

  int code_ = 0;
  bool g91_ = false, to_r_ = false, has_z_ = false, has_r_ = false, z_from_r_ = false, r_from_initial_ = false;
  double z_ = 0, r_ = 0, p_ = 0, q_ = 0, initial_ = 0;
};

TEST(DgshapeSequence, RandomProgramsAreMadeAsThePageSays) {
  Bench bench(NC_DIALECT_DGSHAPE);
  compare_programs<DgshapeWriter>(bench, 400, 30);
}

}  // namespace
}  // namespace nc::test
