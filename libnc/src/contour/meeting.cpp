// SPDX-License-Identifier: Apache-2.0
// The derivations stand in docs/compensation.md.
#include "contour/meeting.hpp"
#include "base/units.hpp"

#include <cmath>
#include <initializer_list>

namespace nc {
namespace {

constexpr double kNoLength_mm = 1e-9;
/// A line that passes a circle by less than this touches it: words have their last digit at a micrometre, and a slope its at a thousandth of a
/// degree.
constexpr double kTouches_mm = 1e-6;

PlanePoint operator+(PlanePoint a, PlanePoint b) { return {a.h + b.h, a.v + b.v}; }
PlanePoint operator-(PlanePoint a, PlanePoint b) { return {a.h - b.h, a.v - b.v}; }
PlanePoint operator*(double k, PlanePoint a) { return {k * a.h, k * a.v}; }
double dot(PlanePoint a, PlanePoint b) { return a.h * b.h + a.v * b.v; }
double cross(PlanePoint a, PlanePoint b) { return a.h * b.v - a.v * b.h; }
double norm(PlanePoint a) { return std::hypot(a.h, a.v); }
PlanePoint left_of(PlanePoint a) { return {-a.v, a.h}; }

PlanePoint along(const SlopedLine& line) {
  PlanePoint u;
  direction_of(line.angle_deg, &u.h, &u.v);
  return u;
}

/// Angle of an arc from one point to another about a centre, 0 to 2 pi in its sense.
double sweep_of(PlanePoint center, PlanePoint from, PlanePoint to, bool ccw) {
  const PlanePoint a = from - center, b = to - center;
  double sweep = std::atan2(cross(a, b), dot(a, b));
  if (!ccw) sweep = -sweep;
  return sweep < -1e-12 ? sweep + 2 * kPi : std::fmax(sweep, 0);
}

Meeting nowhere() {
  Meeting meeting;
  meeting.bad = Condition::geometric_contact;
  return meeting;
}

/// Keeps the better of the solutions that it is shown.
class Choice {
 public:
  explicit Choice(double radius) : longer_(radius < 0) {}
  void offer(PlanePoint at, PlanePoint center, double sweep) {
    const bool fits = longer_ ? sweep >= kPi - 1e-9 : sweep <= kPi + 1e-9;
    if (found_ && (fits == fits_ ? sweep >= sweep_ : !fits)) return;
    found_ = true;
    fits_ = fits;
    sweep_ = sweep;
    best_.at = at;
    best_.center = center;
  }
  Meeting best() const { return found_ && fits_ ? best_ : nowhere(); }

 private:
  bool longer_, found_ = false, fits_ = false;
  double sweep_ = 0;
  Meeting best_;
};

}  // namespace

void direction_of(double angle_deg, double* cosine, double* sine) {
  const double angle = std::remainder(angle_deg, 360);
  const double quarters = angle / 90;
  if (quarters == std::nearbyint(quarters)) {
    const auto quarter = static_cast<int>(quarters) & 3;
    *cosine = quarter == 0 ? 1 : quarter == 2 ? -1 : 0;
    *sine = quarter == 1 ? 1 : quarter == 3 ? -1 : 0;
    return;
  }
  *cosine = std::cos(angle * (kPi / 180));
  *sine = std::sin(angle * (kPi / 180));
}

Meeting meet_lines(const SlopedLine& first, const SlopedLine& second) {
  Meeting meeting;
  const double apart = std::fabs(std::remainder(first.angle_deg - second.angle_deg, 180));
  if (apart <= 1 + 1e-9) {
    meeting.bad = Condition::geometric_parallel;
    return meeting;
  }
  const PlanePoint u = along(first), w = along(second);
  meeting.at = first.through + (cross(second.through - first.through, w) / cross(u, w)) * u;
  return meeting;
}

Meeting meet_line_and_circle(const SlopedLine& line, const KnownCircle& circle, bool longer) {
  const PlanePoint u = along(line), to_center = circle.center - line.through;
  const double radius = norm(circle.on - circle.center), foot = dot(to_center, u), away = std::fabs(cross(u, to_center));
  if (!(radius > kNoLength_mm) || away > radius + kTouches_mm) return nowhere();
  const double half = std::sqrt(std::fmax(0, (radius - away) * (radius + away)));
  const double one = foot - half, other = foot + half;
  Meeting meeting;
  meeting.center = circle.center;
  meeting.at = line.through + ((std::fabs(one) <= std::fabs(other)) != longer ? one : other) * u;
  return meeting;
}

Meeting touch_line_and_circle(const SlopedLine& line, const KnownCircle& circle, bool arc_first) {
  const double radius = std::fabs(circle.radius);
  if (!(radius > kNoLength_mm)) return nowhere();
  Choice choice(circle.radius);
  // Along the line as its angle says, or where that touches nothing the other way. The circle lies to the left of travel when it goes round
  // counter-clockwise.
  for (const double way : {1.0, -1.0}) {
    if (way < 0 && choice.best().bad == Condition::none) break;
    const PlanePoint u = way * along(line), side = (circle.ccw ? radius : -radius) * left_of(u);
    // The centre is at that distance beside the line, and by the radius away from the point: through + t u + side.
    const PlanePoint from = line.through + side - circle.on;
    const double foot = -dot(from, u), away = std::fabs(cross(u, from));
    if (away > radius + kTouches_mm) continue;
    const double half = std::sqrt(std::fmax(0, (radius - away) * (radius + away)));
    for (const double t : {foot - half, foot + half}) {
      // The line leads to the touching point where the arc is the second block, away from it where it is the first.
      if (arc_first ? t > kNoLength_mm : t < -kNoLength_mm) continue;
      const PlanePoint touch = line.through + t * u, center = touch + side;
      const double sweep = arc_first ? sweep_of(center, circle.on, touch, circle.ccw) : sweep_of(center, touch, circle.on, circle.ccw);
      choice.offer(touch, center, sweep);
    }
  }
  return choice.best();
}

Meeting touch_circles(const KnownCircle& first, const KnownCircle& second, double tolerance) {
  const bool outside = first.ccw != second.ccw;
  const KnownCircle& centred = first.by_radius ? second : first;
  const KnownCircle& other = first.by_radius ? first : second;
  const double radius = norm(centred.on - centred.center);
  const double other_radius = other.by_radius ? std::fabs(other.radius) : norm(other.on - other.center);
  if (centred.by_radius || !(radius > kNoLength_mm) || !(other_radius > kNoLength_mm)) return nowhere();
  const double apart = outside ? radius + other_radius : std::fabs(radius - other_radius);
  const auto touch = [&](PlanePoint center) {
    const PlanePoint d = center - centred.center;
    const double distance = norm(d);
    // From inside the smaller circle lies towards the far side of the larger one.
    const double way = outside || radius > other_radius ? radius : -radius;
    return centred.center + (way / distance) * d;
  };
  if (!other.by_radius) {
    const double distance = norm(other.center - centred.center);
    if (std::fabs(distance - apart) > tolerance + 1e-9 || !(distance > kNoLength_mm)) return nowhere();
    Meeting meeting;
    meeting.center = other.center;
    meeting.at = touch(other.center);
    return meeting;
  }
  // The centre of the other one: at `apart` from the centre and at its radius from its point.
  const PlanePoint d = other.on - centred.center;
  const double distance = norm(d);
  if (!(distance > kNoLength_mm) || !(apart > kNoLength_mm)) return nowhere();
  const double foot = (apart * apart - other_radius * other_radius + distance * distance) / (2 * distance);
  const double squares = (apart - foot) * (apart + foot);
  if (squares < -2 * apart * kTouches_mm) return nowhere();
  const double height = std::sqrt(std::fmax(0, squares));
  const PlanePoint e = (1 / distance) * d;
  Choice choice(other.radius);
  for (const double side : {height, -height}) {
    const PlanePoint center = centred.center + foot * e + side * left_of(e), at = touch(center);
    choice.offer(at, center, &other == &first ? sweep_of(center, other.on, at, other.ccw) : sweep_of(center, at, other.on, other.ccw));
  }
  return choice.best();
}

double gap_of_circles(const KnownCircle& first, const KnownCircle& second) {
  const double r1 = norm(first.on - first.center), r2 = norm(second.on - second.center);
  return std::fabs(norm(second.center - first.center) - (first.ccw != second.ccw ? r1 + r2 : std::fabs(r1 - r2)));
}

Circle part_of_circle(PlanePoint start, PlanePoint end, PlanePoint center, bool ccw) {
  Circle circle;
  circle.center[0] = center.h;
  circle.center[1] = center.v;
  circle.radius_start = norm(start - center);
  circle.radius_end = norm(end - center);
  circle.angle_start = std::atan2(start.v - center.v, start.h - center.h);
  const double sweep = sweep_of(center, start, end, ccw);
  circle.sweep = ccw ? sweep : -sweep;
  return circle;
}

PlanePoint center_of_radius(PlanePoint start, PlanePoint end, double radius, bool ccw) {
  const PlanePoint chord = end - start;
  const double half = norm(chord) / 2, height = std::sqrt(std::fmax(0, (std::fabs(radius) - half) * (std::fabs(radius) + half)));
  const double side = ccw == (radius > 0) ? height : -height;
  return start + 0.5 * chord + (side / (2 * half)) * left_of(chord);
}

}  // namespace nc
