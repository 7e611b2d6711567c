// SPDX-License-Identifier: Apache-2.0
// Random programs of lines only, as post-processors make them.
#pragma once

#include "interpolate/random_program.hpp"

namespace nc::test {

enum class LineShape : unsigned { walk, right_angles, hatch, cut_hatch, waves, squares, zigzag, circle_then_hatch, mixed_feeds, count };
inline const char* name_of(LineShape s) {
  static constexpr const char* kName[] = {"walk", "right_angles", "hatch", "cut_hatch", "waves", "squares", "zigzag", "circle_then_hatch", "mixed_feeds"};
  return kName[static_cast<unsigned>(s)];
}

/// The points of a polyline, and for each the feed in mm/s of the line that leads to it and whether the axes rest there.
struct LineProgram {
  std::vector<AxisVec> point{AxisVec{}};
  std::vector<double> feed{0};
  std::vector<bool> stop{false};

  void to(double x, double y, double z, double f) {
    AxisVec p;
    p[0] = x;
    p[1] = y;
    p[2] = z;
    if (p == point.back()) return;
    point.push_back(p);
    feed.push_back(f);
    stop.push_back(false);
  }
  void keep(size_t points) { point.resize(points), feed.resize(points), stop.resize(points); }
  void by(double x, double y, double f) { to(point.back()[0] + x, point.back()[1] + y, point.back()[2], f); }
  double length(size_t k) const {
    double sum = 0;
    for (unsigned i = 0; i < 3; ++i) sum += (point[k][i] - point[k - 1][i]) * (point[k][i] - point[k - 1][i]);
    return std::sqrt(sum);
  }
  AxisVec direction(size_t k) const {
    AxisVec d;
    for (unsigned i = 0; i < 3; ++i) d[i] = (point[k][i] - point[k - 1][i]) / length(k);
    return d;
  }
  /// |t2 - t1| at a point between two lines.
  double turn(size_t k) const {
    const AxisVec a = direction(k), b = direction(k + 1);
    double sum = 0;
    for (unsigned i = 0; i < 3; ++i) sum += (b[i] - a[i]) * (b[i] - a[i]);
    return std::sqrt(sum);
  }
};

namespace line_program_detail {
using random_program_detail::log_uniform;
using random_program_detail::pick;
using random_program_detail::uniform;

/// Adds a line in parts of about `part` mm; 0 = undivided.
inline void in_parts(LineProgram& p, double x, double y, double part, double f) {
  const unsigned parts = part > 0 ? 1 + static_cast<unsigned>(std::hypot(x, y) / part) : 1;
  const double x0 = p.point.back()[0], y0 = p.point.back()[1], z = p.point.back()[2];
  for (unsigned n = 1; n <= parts; ++n) p.to(x0 + x * n / parts, y0 + y * n / parts, z, f);
}
inline void hatch(LineProgram& p, std::mt19937_64& rng, unsigned rows, double part, double f) {
  const double wide = log_uniform(rng, 0.5, 30), pitch = log_uniform(rng, 0.05, 1);
  for (unsigned n = 0; n < rows; ++n) {
    in_parts(p, n % 2 == 0 ? wide : -wide, 0, part, f);
    p.by(0, pitch, f);
  }
}
}  // namespace line_program_detail

inline LineProgram line_program(LineShape shape, std::mt19937_64& rng) {
  using namespace line_program_detail;
  LineProgram p;
  const double f = log_uniform(rng, 10, 250);
  const unsigned lines = 20 + static_cast<unsigned>(log_uniform(rng, 5, 1500));
  double heading = uniform(rng, -3, 3);
  switch (shape) {
    case LineShape::walk: {
      const double step = log_uniform(rng, 0.01, 3), bend = log_uniform(rng, 0.01, 1);
      for (unsigned n = 0; n < lines; ++n) {
        heading += uniform(rng, -bend, bend);
        const double l = step * log_uniform(rng, 0.3, 3);
        p.by(l * std::cos(heading), l * std::sin(heading), f);
      }
      break;
    }
    case LineShape::right_angles: {
      const double step = log_uniform(rng, 0.02, 3);
      unsigned side = 0;
      for (unsigned n = 0; n < lines; ++n) {
        side += pick(rng, 2) ? 1 : 3;
        const double l = step * log_uniform(rng, 0.5, 4), angle = side % 4 * std::numbers::pi / 2;
        p.by(l * std::cos(angle), l * std::sin(angle), f);
      }
      break;
    }
    case LineShape::hatch: hatch(p, rng, 1 + pick(rng, 300), 0, f); break;
    case LineShape::cut_hatch: hatch(p, rng, 1 + pick(rng, 120), uniform(rng, 0.5, 2), f); break;
    case LineShape::waves: {
      const double step = log_uniform(rng, 0.02, 1), high = log_uniform(rng, 0.01, 5), long_ = log_uniform(rng, 1, 30);
      for (unsigned n = 1; n <= lines; ++n) p.to(step * n, high * std::sin(6.283 * step * n / long_), 0, f);
      break;
    }
    case LineShape::squares: {
      const double pitch = log_uniform(rng, 0.1, 2), part = pick(rng, 2) ? uniform(rng, 0.5, 2) : 0;
      for (unsigned n = 0; n < std::min(lines, 160u); ++n) {
        const double l = pitch * (n / 2 + 1), angle = n % 4 * std::numbers::pi / 2;
        in_parts(p, l * std::cos(angle), l * std::sin(angle), part, f);
      }
      break;
    }
    case LineShape::zigzag: {
      const double wide = log_uniform(rng, 0.05, 10), pitch = log_uniform(rng, 0.02, 1);
      for (unsigned n = 0; n < std::min(lines, 400u); ++n) p.by(n % 2 ? -wide : wide, pitch, f);
      break;
    }
    case LineShape::circle_then_hatch: {
      const double radius = log_uniform(rng, 0.5, 20);
      const unsigned n = 20 + pick(rng, 200);
      for (unsigned k = 1; k <= n; ++k) {
        const double angle = 2 * std::numbers::pi * k / n;
        p.to(radius * std::sin(angle), radius * (1 - std::cos(angle)), 0, f);
      }
      hatch(p, rng, 1 + pick(rng, 120), 0, f);
      break;
    }
    default: {
      for (unsigned n = 0; n < std::min(lines, 300u); ++n) {
        if (pick(rng, 3)) heading += uniform(rng, -1.6, 1.6);
        const double l = log_uniform(rng, 0.02, 10);
        p.by(l * std::cos(heading), l * std::sin(heading), log_uniform(rng, 5, 250));
      }
    }
  }
  return p;
}

}  // namespace nc::test
