// SPDX-License-Identifier: Apache-2.0
// Items for the fairing stage as the interpreter makes them, and its output as short texts.
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "fairing/fairing.hpp"

namespace nc::test {

struct Point {
  double x = 0, y = 0, z = 0;
};

inline AxisVec axes_of(const Point& p) {
  AxisVec a;
  a[0] = p.x, a[1] = p.y, a[2] = p.z;
  return a;
}

inline double gap(const AxisVec& a, const AxisVec& b) { return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]); }

inline Item line_item(const Point& from, const Point& to) {
  Item item;
  item.kind = ItemKind::move;
  new (&item.move) Move(axes_of(from), axes_of(to), Compensation{});
  item.move.high_accuracy = kHighAccuracyOn | kFineSegmentsOn;
  item.move.feed_mm_min = 1000;
  return item;
}

inline Item mark_item(BlockSeq seq) {
  Item item;
  new (&item.mark) Mark();
  item.mark.seq = seq;
  return item;
}

inline Item action_item() {
  Item item;
  item.kind = ItemKind::action;
  new (&item.action) Action();
  return item;
}

inline Item end_item() {
  Item item;
  item.kind = ItemKind::end;
  new (&item.end) End();
  return item;
}

/// A line and a mark for each point behind the first, then the end.
inline std::vector<Item> polyline(const std::vector<Point>& points) {
  std::vector<Item> items;
  for (size_t i = 1; i < points.size(); ++i) {
    items.push_back(line_item(points[i - 1], points[i]));
    items.push_back(mark_item(i));
  }
  items.push_back(end_item());
  return items;
}

inline FairingRule fairing_rule(double length, double angle_deg = 10) {
  FairingRule rule;
  rule.fairing = length > 0;
  rule.length_mm = length;
  rule.corner_cos = std::cos(angle_deg * M_PI / 180);
  return rule;
}

/// A stage with its memory, for three axes.
struct Stage : FairingStage {
  explicit Stage(uint32_t rotary = 0) : memory(32768) {
    Arena arena(memory.data(), memory.size());
    create(3, rotary, arena);
    if (arena.overflowed()) std::abort();
  }
  std::vector<char> memory;
};

struct Passed {
  std::vector<Item> items;
  std::vector<FairingResume> resume;  ///< the state after each of them
  size_t most_ahead = 0;              ///< largest number of items that were in the stage at a time
};

/// Passes items through the stage as PartSystem does: items that are ready come out before more go in.
inline Passed pass(FairingStage& stage, const std::vector<Item>& items, const FairingRule& rule, size_t first = 0) {
  Passed passed;
  Item out;
  for (size_t i = first; i < items.size();) {
    if (stage.pop(out)) {
      passed.items.push_back(out);
      passed.resume.push_back(stage.resume_point());
      continue;
    }
    if (stage.push(items[i], rule)) ++i;
    passed.most_ahead = std::max(passed.most_ahead, i - first - passed.items.size());
  }
  while (stage.pop(out)) {
    passed.items.push_back(out);
    passed.resume.push_back(stage.resume_point());
  }
  return passed;
}

inline Passed pass(const std::vector<Item>& items, const FairingRule& rule) {
  Stage stage;
  return pass(stage, items, rule);
}

/// Items as text, as "10.025,0.05 | 1 2 20,0 | 3": the ends of lines, and behind a | the marks after them.
inline std::string text_of(const std::vector<Item>& items) {
  std::string all;
  for (const Item& item : items) {
    if (!all.empty()) all += ' ';
    char text[80];
    switch (item.kind) {
      case ItemKind::move:
        std::snprintf(text, sizeof text, "%.6g,%.6g", std::nearbyint(item.move.end[0] * 1e9) / 1e9 + 0.0, std::nearbyint(item.move.end[1] * 1e9) / 1e9 + 0.0);
        all += text;
        break;
      case ItemKind::mark: all += '|' + std::to_string(item.mark.seq); break;
      case ItemKind::end: all += "end"; break;
      default: all += "other"; break;
    }
  }
  return all;
}

inline std::vector<const Move*> moves_of(const std::vector<Item>& items) {
  std::vector<const Move*> all;
  for (const Item& item : items)
    if (item.kind == ItemKind::move) all.push_back(&item.move);
  return all;
}

}  // namespace nc::test
