// SPDX-License-Identifier: Apache-2.0
// Where a contour lies decides nothing: with another work offset the last binary digits of its coordinates are others, and the tool goes the same way, or stops with
// the same alarm in the same block. On a grid lines are parallel, walls as far apart as the tool is thick, ends of vectors on each other: what a comparison without
// a tolerance leaves to rounding.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "path_builder.hpp"

namespace nc::test {
namespace {

using Random = std::mt19937_64;

int pick(Random& random, int n) { return std::uniform_int_distribution<>(0, n - 1)(random); }
double um(double count) { return count / 1000; }

/// A block in whole micrometres, as its words say it.
struct Block {
  int h = 0, v = 0;
  int i = 0, j = 0;
  int turning = 0;  ///< 1 counter-clockwise, -1 clockwise, 0 a line
  int side = 1;
  int radius = 0;  ///< of the tool
  bool bends = false;  ///< G39
};

struct GridContour {
  std::vector<Block> blocks;
  bool avoid = false, type_b = false, walls = false;
};

/// Blocks shorter and longer than the tool, more often along the axes than not, some of them longer or shorter by a last digit; arcs are a quarter, a half or three
/// quarters of a circle.
GridContour grid_contour(Random& random) {
  constexpr int kGrids[] = {1, 500, 1000};
  const int grid = kGrids[pick(random, 3)];
  GridContour contour;
  const int amount = grid == 1 ? 1 + pick(random, 8000) : grid * (1 + pick(random, 8));
  contour.avoid = pick(random, 4) != 0;
  contour.type_b = pick(random, 4) == 0;
  contour.walls = pick(random, 4) == 0;
  const int unit = grid == 1 ? std::max(amount / 4, 1) : grid;
  const bool tame = pick(random, 2) == 0;
  const int digits = pick(random, 3);
  const auto last_digit = [&] { return digits == 0 && pick(random, 4) == 0 ? pick(random, 3) - 1 : 0; };
  const auto length = [&] {
    if (pick(random, tame ? 60 : 24) == 0) return 1 + pick(random, 3);
    if (!tame && grid == 1 && pick(random, 2) == 0) return 1 + pick(random, 8 * unit);
    return std::max(1, (tame ? 4 : 1) * unit * (1 + pick(random, pick(random, 3) == 0 ? 24 : 6)) + last_digit());
  };
  Block at;
  at.side = pick(random, 2) == 0 ? 1 : -1;
  at.radius = std::max(1, amount + last_digit());
  const bool changes = pick(random, 5) == 0;
  contour.blocks.push_back(at);  // the start
  int way_h = 1, way_v = 0;
  for (int count = 4 + pick(random, 9); count > 0; --count) {
    const int turn = pick(random, 5);  // the path turns left, right, goes on or comes back; or leads anywhere on the grid
    if (turn <= 1) {
      const int sign = turn == 0 ? 1 : -1, h = way_h;
      way_h = -sign * way_v;
      way_v = sign * h;
    } else if (turn == 2) {
      way_h = pick(random, 3) - 1;
      way_v = way_h == 0 ? 2 * pick(random, 2) - 1 : pick(random, 3) - 1;
    }
    Block block = at;
    block.turning = 0;
    block.bends = changes && pick(random, 5) == 0;
    if (changes && pick(random, 8) == 0) block.side = -block.side;
    if (changes && pick(random, 8) == 0) block.radius = std::max(1, amount - pick(random, 2) * unit + last_digit());
    if (pick(random, 3) == 0) {
      const int r = length(), turning = 2 * pick(random, 2) - 1, quarters = 1 + pick(random, 3);
      int spoke_h = turning * r * way_v, spoke_v = -turning * r * way_h;  // from the centre to the start: the arc begins along the way
      if (pick(random, 3) == 0) {
        spoke_h = (2 * pick(random, 2) - 1) * r;
        spoke_v = pick(random, 2) * r;
      }
      block.turning = turning;
      block.i = -spoke_h;
      block.j = -spoke_v;
      for (int n = 0; n < quarters; ++n) {
        const int h = spoke_h;
        spoke_h = -turning * spoke_v;
        spoke_v = turning * h;
      }
      block.h = at.h + block.i + spoke_h;
      block.v = at.v + block.j + spoke_v;
    } else if (pick(random, 5) == 0) {
      block.h = at.h + (2 * pick(random, 2) - 1) * length();
      block.v = at.v + (2 * pick(random, 2) - 1) * length();
    } else {
      const int l = length();
      block.h = at.h + l * way_h;
      block.v = at.v + l * way_v;
    }
    contour.blocks.push_back(at = block);
  }
  return contour;
}

PathBuilder path_at(const GridContour& contour, int h, int v) {
  PathBuilder path(um(-20000 + h), um(-15000 + v));
  path.comp.check = true;
  path.comp.avoid = contour.avoid;
  path.comp.type_b = contour.type_b;
  path.comp.walls = contour.walls;
  // As the interpreter does it: the words first, then the offset of the coordinate system.
  const auto place = [](int word, int zero) { return um(word) + um(zero); };
  for (const Block& block : contour.blocks) {
    path.side(block.side, um(block.radius));
    Compensation once = path.comp;
    once.corner_arc = block.bends;
    path.one_shot(once);
    if (block.turning == 0)
      path.line(place(block.h, h), place(block.v, v));
    else
      path.arc(block.turning > 0, place(block.h, h), place(block.v, v), um(block.i), um(block.j));
  }
  const Block& last = contour.blocks.back();
  path.cancel().line(place(last.h + 30000, h), place(last.v + 17000, v)).end();
  return path;
}

std::string text_of(const GridContour& contour) {
  std::string text = std::string(contour.avoid ? " avoid" : "") + (contour.type_b ? " B" : "") + (contour.walls ? " walls" : "");
  for (const Block& block : contour.blocks) {
    text += "\n" + std::string(block.turning > 0 ? "G3" : block.turning < 0 ? "G2" : "G1") + " X" + std::to_string(block.h) + " Y" + std::to_string(block.v);
    text += std::string(block.side > 0 ? " G41 " : " G42 ") + "r " + std::to_string(block.radius) + (block.bends ? " G39" : "");
    if (block.turning != 0) text += " I" + std::to_string(block.i) + " J" + std::to_string(block.j);
  }
  return text;
}

Vec2 direction(const Move& move, Vec2 point) {
  if (!move.circular) return unit({move.end[0] - move.start[0], move.end[1] - move.start[1]});
  return std::copysign(1.0, move.circle.sweep) * left_of(unit(point - Vec2{move.circle.center[0], move.circle.center[1]}));
}
Vec2 direction_at_end(const Move& move) { return direction(move, {move.end[0], move.end[1]}); }

/// At an angle at which it is known where they meet: curves that touch but for a last digit do so somewhere along them.
bool meets_the_next(const std::vector<Move>& moves, size_t i) {
  return i + 1 >= moves.size() || std::abs(cross(direction_at_end(moves[i]), direction(moves[i + 1], {moves[i].end[0], moves[i].end[1]}))) > 1e-3;
}

/// Without lines that are hardly longer than a move has to be (kNoLength): a line of a micrometre in front of an inner corner may end where it begins but for 1e-9 mm, and last digits make that a move or none.
std::vector<Move> longer_moves_of(const std::vector<Item>& items) {
  std::vector<Move> moves = moves_of(items);
  std::erase_if(moves, [](const Move& move) { return !move.circular && std::hypot(move.end[0] - move.start[0], move.end[1] - move.start[1]) < 1e-8; });
  return moves;
}

/// Nothing, or how the two runs differ.
std::string difference(const std::vector<Item>& here, const std::vector<Item>& there, double h, double v) {
  const Item* const alarm = alarm_of(here);
  const Item* const other = alarm_of(there);
  const auto told = [](const Item* item) { return item == nullptr ? std::string("none") : std::to_string(static_cast<int>(item->alarm.condition)) + " in line " + std::to_string(item->source.line); };
  if (told(alarm) != told(other)) return "alarm " + told(alarm) + ", and there " + told(other);
  const std::vector<Move> moves = longer_moves_of(here), others = longer_moves_of(there);
  if (moves.size() != others.size()) return std::to_string(moves.size()) + " moves, and there " + std::to_string(others.size());
  for (size_t i = 0; i < moves.size(); ++i) {
    const Vec2 off = {others[i].end[0] - h - moves[i].end[0], others[i].end[1] - v - moves[i].end[1]};
    const double along = norm(off), beside = std::abs(cross(direction_at_end(moves[i]), off));
    if (!(beside < 1e-6) || !(along < (meets_the_next(moves, i) ? 1e-6 : 1e-4))) return "move " + std::to_string(i) + " is off by " + std::to_string(1e6 * along) + " nm, " + std::to_string(1e6 * beside) + " beside its way";
    if (moves[i].circular != others[i].circular) return "move " + std::to_string(i) + " is an arc at one place only";
    if (moves[i].circular && std::abs(moves[i].circle.sweep - others[i].circle.sweep) > 1e-3) return "move " + std::to_string(i) + " goes another way round";
  }
  return "";
}

std::vector<Item> run_at(const GridContour& contour, int h, int v) {
  StageWithMemory stage(64);
  return run_stage(stage, path_at(contour, h, v).items);
}

unsigned long number(const char* name, unsigned long otherwise) {
  const char* const text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoul(text, nullptr, 10);
}

// NC_FIRST_SEED, NC_SEEDS: other contours, or more of them; NC_SHOW=1 prints them.
TEST(Place, WhereAContourLiesDecidesNothing) {
  constexpr int kFar_um = 1000000;
  const unsigned long first = number("NC_FIRST_SEED", 0), count = number("NC_SEEDS", 40000);
  unsigned alarms = 0, different = 0;
  for (unsigned long seed = first; seed < first + count; ++seed) {
    Random random(seed);
    const GridContour contour = grid_contour(random);
    const std::vector<Item> here = run_at(contour, 0, 0);
    alarms += alarm_of(here) != nullptr ? 1 : 0;
    for (int place = 0; place < 3; ++place) {
      const int h = pick(random, 2 * kFar_um + 1) - kFar_um, v = pick(random, 2 * kFar_um + 1) - kFar_um;
      const std::string differs = difference(here, run_at(contour, h, v), um(h), um(v));
      if (differs.empty()) continue;
      ++different;
      ADD_FAILURE() << "seed " << seed << " at " << h << ", " << v << ": " << differs << (std::getenv("NC_SHOW") != nullptr ? "\n" + text_of(contour) : "");
      break;
    }
  }
  EXPECT_EQ(different, 0u);
  EXPECT_LE(alarms, std::max(count * 9 / 10, 1ul));
  RecordProperty("alarms", static_cast<int>(alarms));
}

}  // namespace
}  // namespace nc::test
