// SPDX-License-Identifier: Apache-2.0
// Named I/O points: the list of names (fixed after start-up) and the process image they index.
//
// Every signal of the machine has a name. A point is a bit or a 32-bit word and has one direction, seen from
// the control: an input comes from the machine, an output goes to it. The image is a plain array of 32-bit
// values, one per point, so that a scan never searches, allocates or locks; a bit point holds 0 or 1.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace nc::hal {

inline constexpr unsigned kMaxPoints = 1024;

enum class PointType : std::uint8_t { kBit, kWord };
enum class PointDirection : std::uint8_t { kInput, kOutput };  // seen from the control

struct Point {
  std::string name;
  PointType type = PointType::kBit;
  PointDirection direction = PointDirection::kInput;
  std::uint32_t initial = 0;  // value before anyone has written it, and the safe value when the runtime stops
  std::uint8_t bus = 0;       // the bus that carries it: 0 = the machine's Hal, n = the n-th PointBus (hal/point_bus.hpp)
  std::string meaning = {};   // for monitors and listings
};

// The list of points, which is not changed after the configuration; the index of a point is its place in the image.
class PointTable {
 public:
  // False when the name is taken or the table is full.
  bool add(Point point) {
    if (find(point.name) >= 0 || points_.size() >= kMaxPoints) return false;
    points_.push_back(std::move(point));
    return true;
  }
  // Index of a name, -1 when there is none.
  int find(std::string_view name) const {
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (points_[i].name == name) return static_cast<int>(i);
    return -1;
  }
  unsigned size() const { return static_cast<unsigned>(points_.size()); }
  const Point& at(unsigned index) const { return points_[index]; }

 private:
  std::vector<Point> points_;
};

// The process image: one value per point.
struct PointImage {
  std::uint32_t value[kMaxPoints] = {};
  // 1: the value is the one that the machine has now. 0: the bus does not answer, and the value is the one that is configured for
  // that case. It is not set for points of the machine's own Hal, which are good while Feedback::lost is off.
  std::uint8_t good[kMaxPoints] = {};
};

}  // namespace nc::hal
