// SPDX-License-Identifier: Apache-2.0
// The distance of a point from the path of a program. If the search misses the nearest place the result is too large, never too small.
#pragma once

#include "interpolate/test_machine.hpp"

namespace nc::test {

class PathDistance {
 public:
  PathDistance(const Program& program, unsigned axis_count) : axes_(axis_count) {
    for (const Record& r : program.records) {
      if (r.kind != ItemKind::move || !(r.segment.curve.length > 0)) continue;
      Part part;
      part.serial = r.serial;
      part.curve = &r.segment.curve;
      curve_bounds(*part.curve, axes_, &part.low, &part.high);
      const bool line = !part.curve->circular && part.curve->shape == nullptr;
      for (int n = 0; n <= (line ? 0 : kPlaces); ++n) part.place.push_back(curve_position(*part.curve, part.curve->length * n / kPlaces, axes_));
      parts_.push_back(std::move(part));
    }
  }

  /// The distance from the moves near the record `serial`. A result below `enough` need not be the least one.
  double near(Serial serial, const AxisVec& p, double enough) const {
    const auto here = std::lower_bound(parts_.begin(), parts_.end(), serial, [](const Part& a, Serial s) { return a.serial < s; });
    const long at = here - parts_.begin(), count = static_cast<long>(parts_.size());
    double least = HUGE_VAL;
    for (long off = 0; off < kNear && least > enough; ++off) {
      for (const long k : {at + off, at - off}) {
        if (k >= 0 && k < count && box2(parts_[static_cast<size_t>(k)], p) < least * least)
          least = std::min(least, from(parts_[static_cast<size_t>(k)], p));
      }
    }
    return least;
  }

 private:
  static constexpr int kPlaces = 64;
  static constexpr long kNear = 120;
  struct Part {
    Serial serial = 0;
    const Curve* curve = nullptr;
    AxisVec low, high;
    std::vector<AxisVec> place;  ///< points of the curve at equal steps
  };

  double box2(const Part& part, const AxisVec& p) const {
    double sum = 0;
    for (unsigned i = 0; i < axes_; ++i) {
      const double off = std::max({part.low[i] - p[i], p[i] - part.high[i], 0.0});
      sum += off * off;
    }
    return sum;
  }
  double between(const AxisVec& a, const AxisVec& b) const {
    double sum = 0;
    for (unsigned i = 0; i < axes_; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum);
  }
  double from(const Part& part, const AxisVec& p) const {
    const Curve& c = *part.curve;
    if (part.place.size() == 1) {
      double along = 0, length2 = 0;
      for (unsigned i = 0; i < axes_; ++i) along += (p[i] - c.start[i]) * c.delta[i], length2 += c.delta[i] * c.delta[i];
      return between(curve_position(c, std::clamp(along / length2, 0.0, 1.0) * c.length, axes_), p);
    }
    double off[kPlaces + 1], least = HUGE_VAL;
    for (size_t n = 0; n <= kPlaces; ++n) least = std::min(least, off[n] = between(part.place[n], p));
    const double coarse = least, step = c.length / kPlaces;
    for (size_t n = 0; n <= kPlaces; ++n) {
      const bool lowest = (n == 0 || off[n] <= off[n - 1]) && (n == kPlaces || off[n] <= off[n + 1]);
      if (lowest && off[n] <= coarse + step) least = std::min(least, nearest(c, step * static_cast<double>(n), p));
    }
    return least;
  }
  /// Newton's method for the foot of the perpendicular.
  double nearest(const Curve& c, double s, const AxisVec& p) const {
    double least = HUGE_VAL;
    for (int n = 0; n < 8; ++n) {
      const CurvePoint q = curve_evaluate(c, s, axes_);
      least = std::min(least, between(q.position, p));
      double slope = 0, bend = 0;
      for (unsigned i = 0; i < axes_; ++i) {
        slope += (q.position[i] - p[i]) * q.d1[i];
        bend += q.d1[i] * q.d1[i] + (q.position[i] - p[i]) * q.d2[i];
      }
      const double next = std::clamp(s - slope / (bend > 0 ? bend : 1), 0.0, c.length);
      if (std::fabs(next - s) < 1e-10) break;
      s = next;
    }
    return least;
  }

  unsigned axes_;
  std::vector<Part> parts_;
};

}  // namespace nc::test
