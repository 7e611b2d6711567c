// SPDX-License-Identifier: Apache-2.0
// Random programs of the cycles of Series 8, block by block: which words stay known in the mode and behind G80, a change of the cycle in the mode, layers of G87
// and the way out of their hole, places by G49 and G50, G91 of X and Y, the length by D. Beside each block the test writes down the sequence that the pages
// G81 to G89 print, without the control's tables and state; what the pages leave open is as docs/series8.md says.
#include "naive_writer.hpp"

namespace nc::test {
namespace {

constexpr double kClearance = 1.27;  // G83: 0.050"
constexpr double kSeries8Length[3] = {0, 5.5, 12.25};

class Series8Writer : public NaiveWriter {
 public:
  explicit Series8Writer(uint64_t seed) : NaiveWriter(seed) {
    reverse_ = chance(0.5);
    line("G90G71");
    line(std::string(reverse_ ? "M04" : "M03") + "S600F" + brief(feed_ = 150));
    list.push_back("S600"), m(turning());
    move();
  }
  void write(unsigned blocks) {
    for (unsigned n = 0; n < blocks; ++n) block();
    line("G80");
    line("M30");
    m(30);
  }

 private:
  int turning() const { return reverse_ ? 4 : 3; }
  double level(double z) const { return z + length_; }

  void block() {
    if (code_ == 0) return chance(0.7) ? begin() : move();
    switch (pick(12)) {
      case 0: return g91_ = !g91_, line(g91_ ? "G91" : "G90");
      case 1: return line("G04X.25"), dwell(0.25);
      case 2: return in_hole_ ? hole_block("", false) : end();
      case 3: return in_hole_ ? hole_block("", false) : move();
      case 4: return pattern();
      case 5:
      case 6: return begin();
      default: return hole_block("", false);
    }
  }
  void end() {
    line("G80");
    code_ = 0;
  }
  void move() {
    const std::array<double, 3> to{number(-50, 50), number(-50, 50), number(6, 25)};
    line("G90G00" + word('X', to[0]) + word('Y', to[1]) + word('Z', to[2]));
    g91_ = false;
    code_ = 0;
    in_hole_ = false;
    go("rapid", {to[0], to[1], level(to[2])});
  }
  void begin() {
    static constexpr int kCodes[] = {81, 82, 83, 84, 85, 86, 87, 88, 89};
    int code = kCodes[pick(9)];
    if (in_hole_ && (code == 89 || code == 83)) code = 81;  // the bottom of that hole for the level from which it begins, and I above the layer
    const bool upwards = code == 89 || upwards_ || (code == 83 && r_ < 0.5);
    code_ = code;
    start_ = at_[2];
    hole_block("G" + std::to_string(code), upwards);
    upwards_ = code_ == 89;
  }

  /// `levels`: R and Z have to be given, because those that are known are no levels of this cycle.
  void hole_block(std::string block, bool levels) {
    const bool begins = !block.empty();
    bool given[2] = {}, drills = false;
    std::array<double, 3> over = at_;
    for (unsigned i = 0; i < 2; ++i) {
      if (!(given[i] = chance(in_hole_ ? 0.3 : 0.6))) continue;
      const double by = number(-20, 20);
      block += word("XY"[i], by);
      over[i] = g91_ ? at_[i] + by : by;
      drills = true;
    }
    if (begins && !drills) block += word('X', at_[0] + 1), over[0] = g91_ ? 2 * at_[0] + 1 : at_[0] + 1, drills = true;  // its words alone are an alarm
    const bool stays = std::fabs(over[0] - at_[0]) < 1e-9 && std::fabs(over[1] - at_[1]) < 1e-9, layer = in_hole_ && stays;
    bool own_r = false;
    const double r_before = r_, z_before = z_;
    if (!g91_) {  // in G91 the pages do not say from where a level counts
      const bool both = levels || !known_ || layer;
      if (both || chance(0.25)) {
        r_ = code_ == 89 ? number(-30, -20) : layer ? number(z_ - 1, z_ + 1.5) : number(0.5, 4.5);
        own_r = true;
        if (!both && !(r_ > z_)) r_ = r_before;
        block += word('R', r_);
        drills = true;
      }
      if (both || chance(0.25)) {
        z_ = code_ == 89 ? number(-18, -5) : layer ? r_ - number(0.5, 4) : number(-15, -2);
        z_ = std::round(z_ * 1000) / 1000;
        block += word('Z', z_);
        drills = true;
      }
    }
    const bool needs_r = in_hole_ && !stays && r_ < way_out_ - 1e-9 && !own_r;
    if ((g91_ && (levels || !known_ || layer)) || needs_r || (z_ > r_) != (code_ == 89)) {
      r_ = r_before, z_ = z_before;
      return give_up(begins);
    }
    if (!drills) return;
    known_ = true;
    block += own_words(begins);
    if (chance(0.1)) {
      feed_ = 50. + 10 * pick(50);
      block += " F" + brief(feed_);
    }
    if (begins && (code_ == 81 || code_ == 82 || code_ == 85) && !in_hole_ && chance(0.3)) {
      const unsigned d = pick(3);
      block += " D" + std::to_string(d);
      length_ = kSeries8Length[d];
    }
    line(block);
    go_over(over);
    hole();
  }
  /// The block would be an alarm: another one in its place.
  void give_up(bool begins) {
    if (!begins) return;
    line("G80");
    code_ = 0;
    in_hole_ = false;
    move();
  }
  std::string own_words(bool begins) {
    std::string words;
    const bool dwells = code_ == 82 || code_ >= 84;
    if (code_ == 84 && begins) p_ = 0;  // a tap has no dwell in its steps: that of the cycle before is none of its own
    if (dwells && code_ != 87 && ((begins && code_ != 84) || chance(0.2))) {
      p_ = chance(0.3) ? 0 : number(0.1, 2);
      words += word('P', p_);
    }
    if (code_ == 83 && (begins || chance(0.2))) words += word('I', first_ = number(-4, -0.1));
    if (code_ == 83 && (begins || chance(0.2))) words += word('J', step_ = number(0.7, 5));
    if (code_ >= 88 && (begins || chance(0.2))) words += word('I', shift_[0] = number(0.1, 1));
    if (code_ >= 88 && (begins || chance(0.2))) words += word('J', shift_[1] = number(-1, 1));
    if (code_ == 84 && (begins || chance(0.2))) words += word('K', lead_ = number(0.5, 2));
    return words;
  }
  void pattern() {
    if (g91_ || (z_ > r_) != (code_ == 89) || code_ == 89) return;
    const double x = number(-20, 20), y = number(-20, 20), i = number(1, 9), j = number(1, 9);
    if (in_hole_ && r_ < way_out_ - 1e-9) return;
    const bool left = chance(0.5);
    line((left ? "G49" : "G50") + word('X', x) + word('Y', y) + word('I', i) + word('J', j));
    const double places[4][2] = {{x, y}, {left ? x + i : x, left ? y : y + j}, {x + i, y + j}, {left ? x : x + i, left ? y + j : y}};
    for (const auto& place : places) {
      go_over({place[0], place[1], at_[2]});
      hole();
    }
  }

  /// "1. Move to the position specified for XYA at the rapid traverse rate"; out of the hole of a G87 first.
  void go_over(std::array<double, 3> over) {
    const bool stays = std::fabs(over[0] - at_[0]) < 1e-9 && std::fabs(over[1] - at_[1]) < 1e-9;
    if (in_hole_ && !stays) {
      rapid_z(std::fmax(level(std::fmax(way_out_, r_)), at_[2]));
      in_hole_ = false;
    }
    over[2] = at_[2];
    go("rapid", over);
  }
  void tap_z(double z) { go("tap", {at_[0], at_[1], z}, " F" + brief(600 * lead_) + " lead " + brief(lead_)); }
  void shift(double sign) { go("rapid", {at_[0] + sign * shift_[0], at_[1] + sign * shift_[1], at_[2]}); }
  void hole() {
    const double r = level(r_), bottom = level(z_);
    if (code_ == 89) return face_upwards(r, bottom);
    rapid_z(r);
    if (code_ == 83) return pecks(r, bottom);
    if (code_ == 84) return tap_z(bottom), dwell(p_), tap_z(r), dwell(p_);
    feed_z(bottom);
    if (code_ == 87) {
      if (!in_hole_) way_out_ = r_;
      in_hole_ = true;
      return;
    }
    in_hole_ = false;
    if (code_ != 81) dwell(p_);
    if (code_ == 85) return feed_z(r);
    if (code_ == 86 || code_ == 88) m(5);
    if (code_ == 88) m(19), shift(1);
    rapid_z(r);
    if (code_ == 88) shift(-1);
    if (code_ == 86 || code_ == 88) m(turning());
  }
  void pecks(double r, double bottom) {
    in_hole_ = false;
    double depth = std::fmax(level(first_), bottom);
    feed_z(depth);
    while (depth > bottom + 1e-9) {
      rapid_z(r);
      rapid_z(std::fmin(depth + kClearance, r));
      depth = depth - step_ > bottom + 1e-9 ? depth - step_ : bottom;
      feed_z(depth);
    }
    rapid_z(r);
  }
  void face_upwards(double r, double end) {
    m(5), m(19), shift(1), rapid_z(r), shift(-1), m(turning());
    feed_z(end), dwell(p_), feed_z(r);
    m(5), m(19), shift(1), rapid_z(start_), shift(-1), m(turning());
  }

  int code_ = 0;
  bool reverse_ = false, g91_ = false, known_ = false, upwards_ = false, in_hole_ = false;
  double r_ = 0, z_ = 0, p_ = 0, first_ = 0, step_ = 0, lead_ = 0, shift_[2] = {}, way_out_ = 0, length_ = 0, start_ = 0;
};

TEST(Series8Sequence, RandomProgramsAreMadeAsThePagesSay) {
  Bench bench(NC_DIALECT_SERIES8);
  for (unsigned d = 1; d < 3; ++d) bench.tool(d, kSeries8Length[d], NC_TOOL_LENGTH);
  compare_programs<Series8Writer>(bench, 400, 30);
}

}  // namespace
}  // namespace nc::test
