// SPDX-License-Identifier: Apache-2.0
// Radius compensation of arcs that a CAM system has rounded: no larger than the last digits, ending beside their circle, beginning or ending in
// their centre. The path of the tool has no gap, stays beside the programmed one, and no axis moves faster than it can.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/drive.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

struct Point {
  double x = 0, y = 0;
};

double apart(Point a, Point b) { return std::hypot(a.x - b.x, a.y - b.y); }

double from_segment(Point p, Point a, Point b) {
  const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const double t = square > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0, 1.0) : 0.0;
  return apart(p, {a.x + t * dx, a.y + t * dy});
}

double from_path(Point p, const std::vector<Point>& path) {
  double least = INFINITY;
  for (size_t i = 1; i < path.size(); ++i) least = std::min(least, from_segment(p, path[i - 1], path[i]));
  return least;
}

constexpr unsigned kSamples = 24;  ///< of each move

struct Path {
  std::vector<Point> points;
  std::string alarm;
  double gap = 0;          ///< the largest between the end of a move and the start of the next, or within a move
  double longest = 0;      ///< longest move
  std::vector<std::string> text;
};

/// The path of a program, as nc_move_point() shows it.
Path path_of(Bench& bench, const std::string& text) {
  bench.start(text);
  Path path;
  Point at;
  path.points.push_back(at);
  Step step;
  nc_status status;
  while ((status = bench.pull(&step)) == NC_OK || status == NC_BUDGET) {
    if (status != NC_OK || step.item.kind != NC_ITEM_MOVE) continue;
    const nc_move& m = step.item.u.move;
    path.gap = std::max(path.gap, apart(at, {m.machine_start.v[0], m.machine_start.v[1]}));
    path.longest = std::max(path.longest, m.length);
    for (unsigned k = 0; k <= kSamples; ++k) {
      nc_axes axes{};
      if (nc_move_point(bench.control(), 0, k / double{kSamples}, &axes) != NC_OK) break;
      const Point p{axes.v[0], axes.v[1]};
      path.gap = std::max(path.gap, apart(at, p) - (k == 0 ? 0 : m.length / kSamples));
      path.points.push_back(p);
      at = p;
    }
    path.gap = std::max(path.gap, apart(at, {m.machine.v[0], m.machine.v[1]}));
  }
  nc_alarm alarm{};
  if (nc_alarm_get(bench.control(), 0, &alarm) == NC_OK) path.alarm = alarm.code;
  return path;
}

/// The largest step of an axis in one cycle, divided by the step that its velocity allows.
double worst_step(const std::string& text, double radius, double tolerance, bool optimal, std::string* alarm, bool* ended) {
  Bench bench(NC_DIALECT_M700, [&](nc_config& c) {
    c.cycle_s = 0.001;
    c.motion_mode = optimal ? NC_MOTION_OPTIMAL : NC_MOTION_TRAPEZOID;
    c.look_ahead = 64;
    for (unsigned i = 0; i < 3; ++i) {
      nc_axis_config& axis = c.system[0].axis[i];
      axis.rapid = axis.max_velocity = 100;
      axis.max_acceleration = 3000;
      axis.max_jerk = optimal ? 100000 : 0;
    }
  });
  bench.tool(4, radius);
  bench.param("1084", brief(tolerance).c_str());
  Drive drive(bench, text);
  double worst = 0;
  nc_axes last = drive.out.command;
  for (unsigned i = 0; i < 60000 && !drive.ended; ++i) {
    drive.press_start();
    drive.step();
    for (unsigned axis = 0; axis < 3; ++axis) {
      const double step = std::fabs(drive.out.command.v[axis] - last.v[axis]);
      worst = std::max(worst, std::isfinite(step) ? step / 0.1 : INFINITY);
    }
    last = drive.out.command;
  }
  *alarm = drive.alarm();
  *ended = drive.ended;
  return worst;
}

std::string program(const std::string& arc, const char* side = "G41") {
  return std::string(side) + " D4 G1 X10. F2000\nG91 G1 X10.\n" + arc + "\nG1 X10. Y2.\nG40 G1 X10.\nM30\n";
}

TEST(TinyArcs, AnArcFromItsCentreIsTheLineToItsEnd) {
  Bench bench;
  bench.param("1084", "0.1");
  const Outcome run = bench.run("G91 G3 X0.004 Y0.0007 I0 J0 F100\nG2 X0.03 I0.03\nG2 X-0.02 Z-1. I-0.02\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path(), (std::vector<std::string>{"line 0.004 0.0007 0 F100", "line 0.034 0.0007 0 F100", "line 0.014 0.0007 -1 F100"}));
  EXPECT_EQ(Bench().param("1084", "0.01").run("G91 G3 X0.02 I0 J0 F100\nM30").alarm, "P70");  // farther away than the tolerance it is no arc
}

TEST(TinyArcs, NothingButWhatIsProgrammedIsCut) {
  unsigned whole = 0;
  for (const char* side : {"G41", "G42"}) {
    for (const char* arc : {"G3 X0.004 Y0.0007 I0 J0", "G2 X0.004 Y0.0007 I0 J0", "G3 X0.03 I0.03", "G2 X0.02 Y-0.03 I0.02 J-0.03",
                            "G3 X0.004 Y0.0007 I0 J0 Z-1.", "G3 X1.65 Y1.6 I0 J1.6", "G2 X1.65 Y-1.6 I0 J-1.6", "G3 X1.6 Y1.6 J1.6"}) {
      Bench bench;
      bench.tool(4, 1.6).param("1084", "0.1");
      const Path compensated = path_of(bench, program(arc, side));
      const bool inside = compensated.alarm == "P153";  // a block shorter than the tool is wide, on its inner side
      EXPECT_TRUE(compensated.alarm.empty() || inside) << side << " " << arc << " " << compensated.alarm;
      whole += !inside;
      Bench plain;
      plain.param("1084", "0.1");
      const Path programmed = path_of(plain, program(arc, "G40"));
      EXPECT_LT(compensated.gap, 1e-9) << side << " " << arc;
      for (const Point& p : compensated.points)
        ASSERT_LT(from_path(p, programmed.points), 1.6 * 1.415) << side << " " << arc << " at " << p.x << " " << p.y;
      for (const bool optimal : {false, true}) {
        std::string alarm;
        bool ended = false;
        EXPECT_LT(worst_step(program(arc, side), 1.6, 0.1, optimal, &alarm, &ended), 1.001) << side << " " << arc << " optimal " << optimal;
        EXPECT_TRUE(ended);
        EXPECT_EQ(alarm, compensated.alarm);
      }
    }
  }
  EXPECT_GE(whole, 5u);
}

/// A word with three decimals, as a CAM system prints it.
std::string word(char letter, double value) {
  const double rounded = std::nearbyint(value * 1000) / 1000;
  return letter + brief(rounded) + (rounded == std::floor(rounded) ? "." : "") + ' ';
}

/// A contour of lines and arcs, nearly all of them tiny, tangential or in any direction. Except for some blocks it turns
/// away from the tool, so that most contours are possible. `side` is the code that is written, `left` tells on which side the tool is.
std::string random_contour(std::mt19937_64& random, const char* side, bool left, double tolerance) {
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
  const auto pick = [&](int n) { return std::uniform_int_distribution<>(0, n - 1)(random); };
  std::string text = std::string(side) + " D4 G1 X10. F2000\nG91\n";
  double heading = 0;
  const int inward = pick(2) == 0 ? 1000 : 8;  // one contour in two has blocks that turn towards the tool
  const double outward = left ? -1 : 1;
  for (int i = 0; i < 8; ++i) {
    heading += pick(inward) == 0 ? between(-3, 3) : outward * (pick(3) == 0 ? between(0, 3) : between(0, 0.5));
    if (pick(2) == 0) {
      const double length = pick(3) == 0 ? between(0.001, 0.02) : between(0.5, 12);
      text += "G1 " + word('X', length * std::cos(heading)) + word('Y', length * std::sin(heading)) + "\n";
      continue;
    }
    const bool ccw = pick(inward) == 0 ? left : !left;
    const double s = ccw ? 1 : -1, r = pick(4) == 0 ? 0 : pick(4) == 0 ? between(0, 3) : between(0, 0.01);
    double sweep = pick(5) == 0 ? 6.2831853 : between(0.05, 6.2), end_r = r + (pick(2) == 0 ? between(-tolerance, tolerance) : 0);
    if (pick(6) == 0) end_r = 0;
    if (end_r < 0 || std::fabs(end_r - r) > tolerance - 0.002) end_r = r;
    // The words are rounded to thousandths of a millimetre, so the radii differ as in real programs. Where no movement is left the check of
    // interference sees fewer blocks than it should (M700 12.4.8).
    const double from = heading - s * 1.5707963;  // the radius vector at the start
    const std::string to = word('X', -r * std::cos(from) + end_r * std::cos(from + s * sweep)) +
                           word('Y', -r * std::sin(from) + end_r * std::sin(from + s * sweep));
    const std::string center = word('I', -r * std::cos(from)) + word('J', -r * std::sin(from)), off = pick(8) == 0 ? word('Z', between(-1, 1)) : "";
    const bool by_radius = pick(6) == 0;
    if (to == "X0. Y0. " && (by_radius || center == "I0. J0. ")) continue;
    text += (ccw ? "G3 " : "G2 ") + to + off + (by_radius ? word('R', (pick(2) == 0 ? 1 : -1) * (0.001 + r)) : center) + "\n";
    heading += s * sweep;
  }
  return text + "G40 G1 X10.\nM30\n";
}

TEST(TinyArcs, RandomContoursStayBesideTheProgrammedPath) {
  unsigned whole = 0;
  const unsigned contours = sanitized() ? 80 : 800;
  for (unsigned seed = 0; seed < contours; ++seed) {
    std::mt19937_64 random(seed), same(seed);
    const double radius = std::uniform_real_distribution<>(0.1, 5)(random);
    std::uniform_real_distribution<>(0.1, 5)(same);
    const double tolerance = seed % 4 < 2 ? 0.1 : 1;
    const char* const side = seed % 2 == 0 ? "G41" : "G42";
    const char* const avoid = seed % 3 == 0 ? "1" : "0";
    const std::string text = random_contour(random, side, seed % 2 == 0, tolerance);
    Bench bench, plain;
    bench.tool(4, radius).param("1084", brief(tolerance).c_str()).param("8102", avoid);
    plain.param("1084", brief(tolerance).c_str());
    const Path compensated = path_of(bench, text), programmed = path_of(plain, random_contour(same, "G40", seed % 2 == 0, tolerance));
    if (compensated.alarm == "") {
      ++whole;
    } else {
      const std::string& a = compensated.alarm;
      EXPECT_TRUE(a == "P152" || a == "P153" || a == "P71" || a == "P70") << a << "\n" << text;
    }
    ASSERT_LT(compensated.gap, 1e-9) << "seed " << seed << " radius " << radius << "\n" << text;
    ASSERT_LT(programmed.gap, 1e-9) << "seed " << seed << "\n" << text;
    // The corner of two lines is up to sqrt(2) radii away; up to ten radii if the avoidance of interference joins two lines.
    const double reach = *avoid == '1' ? 10 : 1.4143;
    double worst = 0;
    for (const Point& p : compensated.points) worst = std::max(worst, from_path(p, programmed.points));
    ASSERT_LT(worst, radius * reach + 2 * tolerance) << "seed " << seed << " radius " << radius << "\n" << text;
  }
  EXPECT_GT(whole, contours / 6);
}

TEST(TinyArcs, NoAxisJumpsAtARandomContour) {
  unsigned whole = 0;
  const unsigned contours = sanitized() ? 20 : 200;
  for (unsigned seed = 0; seed < contours; ++seed) {
    std::mt19937_64 random(seed);
    const double radius = std::uniform_real_distribution<>(0.1, 5)(random);
    const double tolerance = seed % 4 < 2 ? 0.1 : 1;
    const std::string text = random_contour(random, seed % 2 == 0 ? "G41" : "G42", seed % 2 == 0, tolerance);
    std::string alarm;
    bool ended = false;
    for (const bool optimal : {false, true}) {
      ASSERT_LT(worst_step(text, radius, tolerance, optimal, &alarm, &ended), 1.001) << "seed " << seed << " radius " << radius << " optimal " << optimal << "\n" << text;
      ASSERT_TRUE(ended) << "seed " << seed << " radius " << radius << " optimal " << optimal << "\n" << text;
      whole += alarm.empty();
    }
  }
  EXPECT_GT(whole, sanitized() ? 0 : contours / 5);
}

}  // namespace
}  // namespace nc::test
