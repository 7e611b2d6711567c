// SPDX-License-Identifier: Apache-2.0
// Random programs of the cycles of HX (12), block by block: Z, R, Q, P, I, J and F stay known behind the code of another cycle, G80 and the codes of motions forget
// them, K, G90 and G91, G98 and G99 from block to block. Beside each block the test writes down what the sections say, and docs/decisions.md where their text is lost.
#include "naive_writer.hpp"

namespace nc::test {
namespace {

constexpr double kHxBack = 0.75;  // PI 129
constexpr int kRigid = 842, kRigidReverse = 843;

class HxWriter : public NaiveWriter {
 public:
  explicit HxWriter(uint64_t seed) : NaiveWriter(seed) {
    line("G21 G90 G94 G98");
    line("S500");
    line("M03");
    list.push_back("S500"), m(3);
    feed_ = 150;
    move();
    line("F150");
  }
  void write(unsigned blocks) {
    for (unsigned n = 0; n < blocks; ++n) block();
    line("G80");
    line("M30");
    m(30);
  }

 private:
  void block() {
    if (code_ == 0) return chance(0.7) ? begin() : move();
    switch (pick(12)) {
      case 0: return g91_ = !g91_, line(g91_ ? "G91" : "G90");
      case 1: return to_r_ = !to_r_, line(to_r_ ? "G99" : "G98");
      case 2: return end();
      case 3: return move();
      case 4: return line("G04 X0.25"), dwell(0.25);
      case 5:
      case 6: return begin();
      default: return hole_block("");
    }
  }
  void end() {
    line("G80");
    code_ = 0;
  }
  /// "G00, G01, G02, G03": a code of a motion ends the mode as G80 does.
  void move() {
    const std::array<double, 3> to{number(-50, 50), number(-50, 50), number(6, 25)};
    line("G90 G00" + word('X', to[0]) + word('Y', to[1]) + word('Z', to[2]));
    g91_ = false;
    code_ = 0;
    go("rapid", to);
  }
  void begin() {
    static constexpr int kCodes[] = {73, 74, 76, 81, 82, 83, 84, kRigid, kRigidReverse, 85, 86, 87, 88, 89};
    if (code_ == 0) {
      initial_ = at_[2];
      has_levels_ = has_shift_ = false;
      p_ = q_ = 0;
    }
    const bool was_upwards = code_ == 87;
    code_ = kCodes[pick(14)];
    std::string block;
    if (chance(0.3)) to_r_ = chance(0.5), block = to_r_ ? "G99 " : "G98 ";
    if (chance(0.3)) g91_ = chance(0.5), block += g91_ ? "G91 " : "G90 ";
    block += code_ == kRigid ? "G84.2" : code_ == kRigidReverse ? "G84.3" : "G" + std::to_string(code_);
    hole_block(block, was_upwards != (code_ == 87));
  }
  bool taps() const { return code_ == 74 || code_ == 84 || code_ == kRigid || code_ == kRigidReverse; }
  bool rigid() const { return code_ == kRigid || code_ == kRigidReverse; }

  void hole_block(std::string block, bool others = false) {
    bool drills = false, given[2] = {};
    double by[2] = {};
    for (unsigned i = 0; i < 2; ++i) {
      if (!(given[i] = chance(0.6))) continue;
      by[i] = number(-20, 20);
      block += word("XY"[i], by[i]);
      drills = true;
    }
    if (others || !has_levels_ || chance(0.2)) {
      z_from_r_ = r_from_initial_ = g91_;
      if (code_ == 87) {
        r_ = g91_ ? -number(40, 50) : number(-30, -20);
        z_ = g91_ ? number(1, 9) : number(-19, -5);
      } else {
        r_ = g91_ ? -number(0, 5) : number(0.5, 4);
        z_ = g91_ ? -number(1, 12) : number(-9, 0);
      }
      has_levels_ = true;
      block += word('Z', z_) + word('R', r_);
      drills = true;
    }
    if (code_ == 73 || code_ == 83) {
      if (q_ == 0 || chance(0.2)) block += word('Q', q_ = number(0.8, 5));
    }
    if ((code_ == 76 || code_ == 87) && (!has_shift_ || chance(0.2))) {
      if (!has_shift_ || chance(0.5)) block += word('I', shift_[0] = number(0.1, 1));
      if (!has_shift_ || chance(0.5)) block += word('J', shift_[1] = number(-1, 1));
      has_shift_ = true;
    }
    if (chance(0.25)) {
      const unsigned ms = 10 * pick(60);
      p_ = ms / 1000.;
      block += " P" + std::to_string(ms);
    }
    if (chance(0.1)) {
      feed_ = 50. + 10 * pick(50);
      block += " F" + brief(feed_);
    }
    unsigned count = 1;
    if (chance(0.25)) block += " K" + std::to_string(count = pick(4));
    if (!drills) block += word('Z', z_), z_from_r_ = g91_, drills = true;
    if (z_from_r_ != r_from_initial_ || (code_ != 87 && z_from_r_ && z_ > 0)) block += word('R', r_ = level_of_r()), r_from_initial_ = g91_;
    if (!sound()) block += repaired();
    line(block);
    const std::array<double, 3> from = at_;
    for (unsigned n = 0; n < count; ++n) {
      std::array<double, 3> over = at_;
      for (unsigned i = 0; i < 2; ++i)
        if (given[i]) over[i] = g91_ ? from[i] + (n + 1) * by[i] : by[i];
      go("rapid", over);
      hole();
    }
  }
  double level_of_r() { return code_ == 87 ? (g91_ ? -45. : -25.) : (g91_ ? -1. : 2.); }
  double r() const { return r_from_initial_ ? initial_ + r_ : r_; }
  double bottom() const { return z_from_r_ ? r() + z_ : z_; }
  /// A Z that was written in the other distance mode may lie on the other side of R.
  bool sound() const { return code_ == 87 ? bottom() > r() + 0.1 && bottom() < initial_ : bottom() < r() - 0.1; }
  std::string repaired() {
    z_ = code_ == 87 ? (g91_ ? 5. : -15.) : (g91_ ? -4. : -6.);
    r_ = level_of_r();
    z_from_r_ = r_from_initial_ = g91_;
    return word('Z', z_) + word('R', r_);  // the later one of two words of a letter counts
  }

  void shift(double sign, const char* kind) { go(kind, {at_[0] + sign * shift_[0], at_[1] + sign * shift_[1], at_[2]}, kind[0] == 'l' ? " F" + brief(feed_) : ""); }
  void tap_z(double z) {
    if (rigid()) return go("tap", {at_[0], at_[1], z}, " F" + brief(feed_) + " lead " + brief(feed_ / 500));
    feed_z(z);
  }
  void hole() {
    const double back = to_r_ ? r() : initial_;
    if (code_ == 87) return back_bore();
    rapid_z(r());
    if (code_ == 73 || code_ == 83) return pecks(back);
    if (taps()) return tap(back);
    feed_z(bottom());
    if (code_ == 82 || code_ == 88 || code_ == 89) dwell(p_);
    if (code_ == 85 || code_ == 89) feed_z(r());
    if (code_ == 76) m(19), shift(1, "line");
    if (code_ == 86 || code_ == 88) m(5);
    if (code_ == 88) list.push_back("stop");
    rapid_z(back);
    if (code_ == 76) shift(-1, "rapid");
    if (code_ == 76 || code_ == 86 || code_ == 88) m(3);
  }
  void pecks(double back) {
    const double top = r(), end = bottom();
    for (double depth = top; depth != end;) {
      if (depth != top) {
        if (code_ == 83) rapid_z(top);
        rapid_z(std::fmin(depth + kHxBack, top));
      }
      depth = depth - q_ > end + 1e-9 ? depth - q_ : end;
      feed_z(depth);
    }
    rapid_z(back);
  }
  void tap(double back) {
    const bool left = code_ == 74 || code_ == kRigidReverse;
    tap_z(bottom()), dwell(p_);
    if (!rigid()) m(left ? 3 : 4);
    tap_z(r()), dwell(p_);
    if (!rigid()) m(left ? 4 : 3);
    rapid_z(back);
  }
  void back_bore() {
    m(19), shift(1, "rapid"), rapid_z(r()), shift(-1, "line"), m(3);
    feed_z(bottom());
    m(19), shift(1, "rapid"), rapid_z(initial_), shift(-1, "rapid"), m(3);
  }

  int code_ = 0;
  bool g91_ = false, to_r_ = false, has_levels_ = false, has_shift_ = false, z_from_r_ = false, r_from_initial_ = false;
  double z_ = 0, r_ = 0, p_ = 0, q_ = 0, shift_[2] = {}, initial_ = 0;
};

TEST(HxSequence, RandomProgramsAreMadeAsTheSectionsSay) {
  Bench bench(NC_DIALECT_HX);
  bench.param("3129", "0.75");
  compare_programs<HxWriter>(bench, 400, 30);
}

}  // namespace
}  // namespace nc::test
