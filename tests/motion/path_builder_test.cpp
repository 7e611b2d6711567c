// SPDX-License-Identifier: Apache-2.0
// Random lines become pieces. Whatever the corners are, position, first and second derivative are continuous from piece to piece, the pieces stay
// within the tolerance, and rest only where the lines reverse.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <vector>

#include "at_once.hpp"
#include "interpolate/line_program.hpp"
#include "motion/optimal/path_builder.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

using optimal::PathBuilder;
using optimal::Piece;

constexpr double kPeriod = 0.005;

struct Found {
  std::string wrong;
  unsigned pieces = 0, rests = 0;
  double off = 0;  ///< largest distance from the lines, as a part of the tolerance
  double missed = 0;  ///< distance from the end, mm
};

/// The builder with a ring of records, which is filled while the pieces are passed.
class Bench {
 public:
  Bench(const LineProgram& lines, double tolerance, uint32_t capacity, double feed_mm_rev) : lines_(lines), tolerance_(tolerance) {
    config_ = standard_config(3);
    Program p(config_);
    for (size_t k = 1; k < lines.point.size(); ++k) p.line(lines.point[k], lines.feed[k]);
    p.end();
    all_ = std::move(p.records);
    for (Record& r : all_) r.segment.feed_mm_rev = feed_mm_rev;
    u_.push_back(0);
    for (size_t k = 1; k < lines.point.size(); ++k) u_.push_back(u_.back() + all_[k - 1].segment.curve.length);
    ring_.resize(capacity);
    passed_.resize(capacity);
    store_.passed = passed_.data();
    store_.record_mask = capacity - 1;
    for (unsigned i = 0; i < 3; ++i) {
      limits_.velocity[i] = limits_.rapid[i] = 250;
      limits_.acceleration[i] = 2000;
      limits_.jerk[i] = 50000;
    }
    memory_.resize(8u << 20);
    Arena arena(memory_.data(), memory_.size());
    builder_.create(limits_, tolerance, kPeriod, ring_.data(), &store_, arena);
    if (arena.overflowed()) found_.wrong = "memory";
    AxisVec start;
    builder_.restart(0, 0, start, 0, 0);
  }

  const std::vector<Piece>& pieces() const { return pieces_; }
  Found run() {
    uint32_t tail = 0, head = 0;
    for (unsigned still = 0; found_.wrong.empty() && still < 3;) {
      while (head != all_.size() && head - tail < ring_.size()) ring_[head % ring_.size()] = all_[head], ++head;
      const bool more = at_once([&](optimal::Work& work) { return builder_.take(work, head); });
      look();
      // The axes pass all pieces that there are, and the records that they pass become free.
      while (tail != builder_.taken() && passed_[tail % passed_.size()] <= gone_) ++tail;
      still = more || seen_ != before_ ? 0 : still + 1;
      before_ = seen_;
      if (still == 2 && head != all_.size()) {
        found_.wrong = "stands with " + std::to_string(head - tail) + " records before it";
      }
    }
    if (found_.wrong.empty() && !(std::fabs(gone_ - u_.back()) <= 1e-6)) found_.wrong = "ends at " + std::to_string(gone_) + " of " + std::to_string(u_.back());
    // The axes are set to the exact end, so that a difference there would be a jump in one cycle, with its jerk.
    const AxisVec end = evaluate(last_, last_.length, 3).position;
    for (unsigned i = 0; i < 3 && found_.wrong.empty(); ++i) {
      const double missed = std::fabs(end[i] - lines_.point.back()[i]);
      found_.missed = std::max(found_.missed, missed);
      if (missed > 2e-11) found_.wrong = "misses its end by " + std::to_string(1e12 * missed) + "e-12";
    }
    return found_;
  }

 private:
  /// Checks new pieces, and frees those before the last one.
  void look() {
    for (; seen_ != builder_.head() && found_.wrong.empty(); ++seen_) {
      const Piece& p = store_.piece_at(seen_);
      if (found_.pieces++ > 0) meets(p);
      if (std::fabs(builder_.start_of(seen_) - gone_) > 1e-6) found_.wrong = "piece begins elsewhere";
      near(p);
      gone_ = builder_.start_of(seen_) + p.length;
      found_.rests += p.rest_behind ? 1u : 0u;
      last_ = p;
      pieces_.push_back(p);
    }
    builder_.free_pieces(seen_);
  }
  void meets(const Piece& p) {
    const CurvePoint a = evaluate(last_, last_.length, 3), b = evaluate(p, 0, 3);
    const double shorter = std::min(last_.length, p.length);
    for (unsigned i = 0; i < 3; ++i) {
      if (std::fabs(a.position[i] - b.position[i]) > 1e-9) found_.wrong = "a jump";
      if (last_.rest_behind) continue;
      if (std::fabs(a.d1[i] - b.d1[i]) > 1e-6) found_.wrong = "a corner of " + std::to_string(a.d1[i] - b.d1[i]);
      if (std::fabs(a.d2[i] - b.d2[i]) > 1e-6 * (1 + std::fabs(a.d2[i])) + 1e-11 / (shorter * shorter)) found_.wrong = "a step of the curvature";
    }
  }
  /// Measures the distance from the place with the same u, which is never less than that from the nearest place.
  void near(const Piece& p) {
    constexpr int kPlaces = 24;
    for (int n = 1; n <= kPlaces; ++n) {
      const double x = p.length * n / kPlaces, u = gone_ + x;
      while (edge_ + 2 < u_.size() && u_[edge_ + 1] < u) ++edge_;
      const double share = (u - u_[edge_]) / (u_[edge_ + 1] - u_[edge_]);
      const AxisVec q = evaluate(p, x, 3).position;
      double off2 = 0;
      for (unsigned i = 0; i < 3; ++i) {
        const double d = q[i] - lines_.point[edge_][i] - share * (lines_.point[edge_ + 1][i] - lines_.point[edge_][i]);
        off2 += d * d;
      }
      if (tolerance_ > 0) found_.off = std::max(found_.off, std::sqrt(off2) / tolerance_);
      if (std::sqrt(off2) > tolerance_ + 1e-9) found_.wrong = "is " + std::to_string(1e3 * std::sqrt(off2)) + " um off at " + std::to_string(u);
    }
  }

  const LineProgram& lines_;
  double tolerance_;
  ExecutorConfig config_;
  std::vector<Record> all_, ring_;
  std::vector<double> passed_, u_;
  std::vector<std::byte> memory_;
  optimal::Limits limits_;
  optimal::PlanStore store_;
  PathBuilder builder_;
  Found found_;
  Piece last_;
  std::vector<Piece> pieces_;
  uint32_t seen_ = 0, before_ = 0;
  double gone_ = 0;
  size_t edge_ = 0;
};

constexpr double kTolerance[] = {0.01, 0.001, 0.1, 1e-4, 1, 0.01, 1e-5, 0};
constexpr uint32_t kCapacity[] = {256, 1024, 16384};

std::string wrong_in(const LineProgram& lines, double tolerance, uint32_t capacity, Found* found, std::vector<Piece>* pieces = nullptr, double feed_mm_rev = 0) {
  auto bench = std::make_unique<Bench>(lines, tolerance, capacity, feed_mm_rev);
  *found = bench->run();
  if (pieces != nullptr) *pieces = bench->pieces();
  unsigned rests = 1;  // the end
  for (size_t k = 1; k + 1 < lines.point.size(); ++k) rests += lines.turn(k) > (tolerance > 0 ? 1.99 : 1e-9) ? 1u : 0u;
  if (found->wrong.empty() && found->rests > rests) return std::to_string(found->rests) + " rests instead of " + std::to_string(rests);
  return found->wrong;
}

/// The knots beside the reversal are so near to one another that rounding turns the line after it by 1e-12.
TEST(PathBuilder, ALongLineBehindAReversalEndsWhereItShould) {
  std::mt19937_64 rng(1);
  for (unsigned n = 0; n < 200; ++n) {
    LineProgram lines;
    const double far = random_program_detail::log_uniform(rng, 20, 2000), back = random_program_detail::log_uniform(rng, 20, 2000);
    lines.to(-far, 0, 0, 100);
    lines.to(back - far, 0, 0, 100);
    Found found;
    EXPECT_EQ(wrong_in(lines, kTolerance[n % 8], 256, &found), "") << far << ' ' << back << ", tolerance " << kTolerance[n % 8];
    EXPECT_LE(found.missed, 4e-12);
  }
}

/// NC_SEEDS=100000 runs so many seeds, NC_FIRST=7 begins with seed 7.
TEST(PathBuilder, PiecesOfRandomLinesGoOnInOneAnother) {
  const uint64_t from = wish("NC_FIRST", 0), count = seeds(1000, 18);
  const unsigned shapes = static_cast<unsigned>(LineShape::count);
  uint64_t wrong = 0, pieces = 0;
  double off = 0;
  for (uint64_t seed = from; seed < from + count && wrong < 20; ++seed) {
    std::mt19937_64 rng(seed);
    const LineShape shape = static_cast<LineShape>(seed % shapes);
    const LineProgram lines = line_program(shape, rng);
    const double tolerance = kTolerance[seed / shapes % 8];
    const uint32_t capacity = kCapacity[seed / shapes / 8 % 3];
    Found found;
    const std::string text = wrong_in(lines, tolerance, capacity, &found);
    EXPECT_TRUE(text.empty()) << text << "; seed " << seed << ": " << name_of(shape) << ", " << lines.point.size() - 1 << " lines, tolerance " << tolerance
                              << ", capacity " << capacity;
    wrong += text.empty() ? 0 : 1;
    pieces += found.pieces;
    off = std::max(off, found.off);
  }
  std::printf("%llu programs, %llu pieces, %llu wrong, %.4f of the tolerance\n", static_cast<unsigned long long>(count), static_cast<unsigned long long>(pieces),
              static_cast<unsigned long long>(wrong), off);
}

/// Lines along a curve, with noise of any size compared with the tolerance.
LineProgram noisy_program(std::mt19937_64& rng) {
  using namespace random_program_detail;
  using std::numbers::pi;
  LineProgram lines;
  const double step = log_uniform(rng, 0.005, 0.5), noise = log_uniform(rng, 1e-4, 0.03), high = log_uniform(rng, 0.01, 3), wave = log_uniform(rng, 1, 30);
  const double radius = log_uniform(rng, 2, 50), f = log_uniform(rng, 10, 250);
  const bool round = pick(rng, 2) != 0, jumps = pick(rng, 4) == 0;
  std::normal_distribution<double> draw(0, noise);
  const unsigned count = 50 + static_cast<unsigned>(log_uniform(rng, 10, 1500));
  for (unsigned n = 1; n <= count; ++n) {
    const double u = step * n, edge = jumps && n % 97 == 0 ? 20 * noise : 0;
    const double z = high * std::sin(2 * pi * u / wave) + draw(rng) + edge;
    if (round) {
      lines.to(radius * std::sin(u / radius) + draw(rng), radius * (1 - std::cos(u / radius)) + draw(rng), z, f);
    } else {
      lines.to(u, draw(rng), z, f);
    }
  }
  return lines;
}

TEST(PathBuilder, PiecesOfNoisyLinesGoOnInOneAnother) {
  const uint64_t from = wish("NC_FIRST", 0), count = seeds(600, 18);
  uint64_t wrong = 0;
  for (uint64_t seed = from; seed < from + count && wrong < 20; ++seed) {
    std::mt19937_64 rng(seed);
    const LineProgram lines = noisy_program(rng);
    const double tolerance = kTolerance[seed % 8];
    const uint32_t capacity = kCapacity[seed / 8 % 3];
    Found found;
    const std::string text = wrong_in(lines, tolerance, capacity, &found);
    EXPECT_TRUE(text.empty()) << text << "; seed " << seed << ": " << lines.point.size() - 1 << " lines, tolerance " << tolerance << ", capacity " << capacity;
    wrong += text.empty() ? 0 : 1;
  }
}

/// Lines that follow a circle within the tolerance become that circle: the curvature shows nothing of the lines.
TEST(PathBuilder, LinesOfACircleBendAsTheCircleDoes) {
  constexpr double kRadius = 20;
  for (const double step : {0.05, 0.5, 1.0, 1.4}) {  // at 1.4 mm they are 12 um away from it in the middle
    LineProgram lines;
    for (unsigned n = 1; n * step < 60; ++n) lines.to(kRadius * std::sin(n * step / kRadius), kRadius * (1 - std::cos(n * step / kRadius)), 0, 100);
    Found found;
    std::vector<Piece> pieces;
    EXPECT_EQ(wrong_in(lines, 0.01, 16384, &found, &pieces), "") << step;
    double u = 0, off = 0, bend = 0;
    for (const Piece& p : pieces) {
      if (u > 10 && u < 45) {
        const CurvePoint q = evaluate(p, 0, 3);
        off = std::max(off, std::fabs(std::hypot(q.d2[0], q.d2[1]) * kRadius - 1));
        bend = std::max(bend, kRadius * kRadius * std::hypot(q.d3[0], q.d3[1]));
      }
      u += p.length;
    }
    EXPECT_LT(off, 0.03) << step;
    EXPECT_LT(bend, 1.5) << step;  // 1 on the circle itself
  }
}

/// A feed per revolution does not tell the distance in a second; its knots are as far apart as those of a feed of the same number per minute.
TEST(PathBuilder, AFeedPerRevolutionMakesNoMoreKnots) {
  LineProgram lines;
  for (unsigned n = 1; n <= 300; ++n) lines.to(0.5 * n, 4 * std::sin(0.12 * n), 0, 60);
  Found by_minute, by_turns;
  EXPECT_EQ(wrong_in(lines, 0.01, 16384, &by_minute), "");
  EXPECT_EQ(wrong_in(lines, 0.01, 16384, &by_turns, nullptr, 1.2), "");
  EXPECT_LT(by_turns.pieces, 1.1 * by_minute.pieces);
}

/// With only sharp corners a hatch can be divided on the straight lines between them, however many rows wait.
TEST(PathBuilder, AHatchOfAnyNumberOfRowsRestsNowhere) {
  for (const unsigned rows : {67u, 68u, 69u, 70u, 100u, 137u, 300u, 2000u}) {
    for (const double part : {0.0, 1.0}) {
      LineProgram lines;
      for (unsigned n = 0; n < rows; ++n) {
        line_program_detail::in_parts(lines, n % 2 == 0 ? 20 : -20, 0, part, 200);
        lines.by(0, 0.3, 200);
      }
      Found found;
      EXPECT_EQ(wrong_in(lines, 0.01, 16384, &found), "") << rows << " rows in lines of " << part;
      EXPECT_EQ(found.rests, 1u) << rows << " rows in lines of " << part;
    }
  }
}

/// A straight line is divided seven spacings before its end. Here a spacing is four of its equal parts, so that this place is a vertex except for
/// rounding.
TEST(PathBuilder, AStraightLineInEqualPartsIsCutBesideItsVertices) {
  for (uint64_t seed = 0; seed < 300; ++seed) {
    std::mt19937_64 rng(seed);
    LineProgram lines;
    const double part = random_program_detail::uniform(rng, 0.05, 2), feed = random_program_detail::log_uniform(rng, 50, 250);
    for (unsigned k = 0; k < 900; ++k) {
      const double angle = k / 300 * std::numbers::pi / 2;
      lines.by(part * std::cos(angle), part * std::sin(angle), feed);
    }
    Found found;
    EXPECT_EQ(wrong_in(lines, 0.01, 256, &found), "") << seed;
    EXPECT_EQ(found.rests, 1u) << seed;
  }
}

/// The distance of knots depends on the feeds of the lines near them: a slow line far away makes no more knots.
TEST(PathBuilder, ASlowLineDoesNotSpoilWhatLiesFarAway) {
  const auto pieces_with = [](double slow) {
    LineProgram lines;
    lines.to(0, 0, 5, slow);
    for (unsigned n = 1; n <= 400; ++n) lines.to(0.5 * n, 20 * (1 - std::cos(0.005 * n)), 5, 130);
    Found found;
    EXPECT_EQ(wrong_in(lines, 0.01, 16384, &found), "");
    return found.pieces;
  };
  EXPECT_LT(pieces_with(1), pieces_with(130) + 12);
}

/// Without a tolerance the lines are not changed: collinear ones are one line, and every corner is a rest.
TEST(PathBuilder, WithoutAToleranceOnlyCornersAreRests) {
  LineProgram lines;
  for (unsigned n = 0; n < 20; ++n) {
    for (unsigned k = 0; k < 10; ++k) lines.by(n % 2 == 0 ? 1 : 0, n % 2 == 0 ? 0 : 1, 100);
  }
  Found found;
  EXPECT_EQ(wrong_in(lines, 0, 1024, &found), "");
  EXPECT_EQ(found.pieces, 200u);
  EXPECT_EQ(found.rests, 20u);
}

}  // namespace
}  // namespace nc::test
