// SPDX-License-Identifier: Apache-2.0
// Dry run (M700 7.4 note 4): feeds of the machine act in the place of those of the program.
#pragma once

namespace nc {

/// Speeds along the path, mm/s, the override included; below 0: what the program commands acts.
struct DryFeeds {
  double cut = -1, rapid = -1;

  bool operator==(const DryFeeds&) const = default;
  bool on() const { return cut >= 0; }
  double of(bool rapid_move) const { return rapid_move ? rapid : cut; }
  /// What is faster than any axis: the limits of the axes alone act.
  static constexpr double kUnbound = 1e6;
};

/// A motion that goes by `from` may be slowed down by going by `to`.
inline bool slows(const DryFeeds& from, const DryFeeds& to) {
  const auto one = [](double a, double b) { return a != b && (a < 0 || b < 0 || b < a); };
  return one(from.cut, to.cut) || one(from.rapid, to.rapid);
}

}  // namespace nc
