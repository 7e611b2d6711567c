// SPDX-License-Identifier: Apache-2.0
// The time-optimal law on polylines, without a machine around it: smooths them, writes the smoothed path as a path
// file, so that the reference solver can work on the same geometry, and prints the time that the law needs.
//
//   law_of_lines POLYLINES OUT.path [V A J TOLERANCE]
//
// POLYLINES: for each stretch between two rests the number of its vertices, then for each vertex x y z in mm and the
// feed of the line that ends there in mm/s (0 = no feed; at the first vertex it is ignored). Exit status: 0; 1 after a
// message.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "motion/optimal/profile.hpp"
#include "motion/optimal/smooth.hpp"
#include "motion/optimal/windows.hpp"

namespace {

using nc::AxisVec;
using nc::optimal::Limits;
using nc::optimal::Piece;
using nc::optimal::Windows;

constexpr unsigned kAxes = 3, kTerms = 6, kMostVertices = 4'000'000;
constexpr double kSpacing = 0.5;  // of knots, mm

struct Stretch {
  std::vector<AxisVec> vertex;
  std::vector<double> length, feed;
};

struct Result {
  double seconds = 0.0, wall = 0.0;
  size_t lines = 0, pieces = 0;
};

int complain(const std::string& what) {
  std::fprintf(stderr, "law_of_lines: %s\n", what.c_str());
  return 1;
}

// Reads the next stretch. False at the end of the file, and when the file is damaged, which sets *bad.
bool read_stretch(std::FILE* in, Stretch* stretch, bool* bad) {
  unsigned count = 0;
  const int got = std::fscanf(in, "%u", &count);
  if (got == EOF) return false;
  *bad = got != 1 || count < 2 || count > kMostVertices;
  *stretch = {};
  for (unsigned k = 0; k < count && !*bad; ++k) {
    double p[kAxes] = {}, feed = 0.0;
    *bad = std::fscanf(in, "%lf %lf %lf %lf", &p[0], &p[1], &p[2], &feed) != 4;
    AxisVec v;
    for (unsigned i = 0; i < kAxes; ++i) v[i] = p[i];
    if (k > 0) {
      const AxisVec& last = stretch->vertex.back();
      stretch->length.push_back(std::hypot(p[0] - last[0], p[1] - last[1], p[2] - last[2]));
      stretch->feed.push_back(feed > 0 ? feed : HUGE_VAL);
    }
    stretch->vertex.push_back(v);
  }
  return !*bad;
}

std::vector<Piece> smoothed(const Stretch& stretch, double tolerance) {
  const unsigned vertices = static_cast<unsigned>(stretch.vertex.size()), knots = 64 * vertices + 64;
  std::vector<double> u(vertices), knot(knots);
  std::vector<AxisVec> control(knots + 3);
  std::vector<unsigned> corner(knots);
  std::vector<nc::optimal::SmoothCell> cell(knots);
  std::vector<Piece> pieces(knots);
  nc::optimal::SmoothRequest request;
  request.line = {stretch.vertex.data(), stretch.length.data(), stretch.feed.data(), vertices};
  request.tolerance = tolerance;
  request.spacing = kSpacing;
  request.axis_count = kAxes;
  const nc::optimal::SmoothRoom room{u.data(),      vertices,     knot.data(), control.data(),
                                     corner.data(), cell.data(), knots};
  const auto work = std::make_unique<nc::optimal::Work>();
  pieces.resize(work->now(nc::optimal::smooth(*work, request, room, pieces.data(), knots)));
  return pieces;
}

// The path file wants coefficients for a parameter from 0 to 1, a Piece has them for its length in mm.
void write_pieces(const std::vector<Piece>& pieces, std::FILE* out) {
  for (const Piece& p : pieces) {
    std::fprintf(out, "poly %.17g %u", std::isfinite(p.feed) ? p.feed : 0.0, kTerms - 1);
    for (unsigned i = 0; i < kAxes; ++i) {
      double scale = 1.0;
      for (unsigned d = 0; d < kTerms; ++d, scale *= p.length) std::fprintf(out, " %.17g", p.c[d][i] * scale);
    }
    std::fputc('\n', out);
  }
  std::fputs("rest\n", out);
}

// False when no law was found.
bool time_of(const std::vector<Piece>& pieces, const Limits& limits, Windows* windows, double* seconds) {
  const auto work = std::make_unique<nc::optimal::Work>();
  windows->start(pieces.data(), static_cast<unsigned>(pieces.size()), limits);
  while (work->now(windows->next(*work)))
    for (unsigned k = 0; k < windows->keep(); ++k)
      *seconds += nc::optimal::cell_seconds(windows->law(), windows->mesh(), k);
  return !windows->failed();
}

int run(std::FILE* in, std::FILE* out, const Limits& limits, double tolerance) {
  std::fputs("nc-path 1\naxes X Y Z\n", out);
  const auto windows = std::make_unique<Windows>();
  Result result;
  Stretch stretch;
  bool bad = false;
  while (read_stretch(in, &stretch, &bad)) {
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<Piece> pieces = smoothed(stretch, tolerance);
    if (pieces.empty()) return complain("no room for the smoothed path");
    if (!time_of(pieces, limits, windows.get(), &result.seconds)) return complain("no law was found");
    result.wall += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    result.lines += stretch.length.size();
    result.pieces += pieces.size();
    write_pieces(pieces, out);
  }
  if (bad) return complain("the polylines are damaged");
  std::printf("time %.6f s, %zu lines, %zu pieces, %.3f s to find it\n", result.seconds, result.lines,
              result.pieces, result.wall);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 7) return complain("usage: law_of_lines POLYLINES OUT.path [V A J TOLERANCE]");
  double number[4] = {250, 2000, 50000, 0.01};
  for (int i = 3; i < argc; ++i) number[i - 3] = std::strtod(argv[i], nullptr);
  for (const double n : number)
    if (!(n > 0)) return complain("limits and tolerance must be above 0");
  Limits limits;
  limits.axis_count = kAxes;
  for (unsigned i = 0; i < kAxes; ++i) {
    limits.velocity[i] = limits.rapid[i] = number[0];
    limits.acceleration[i] = number[1];
    limits.jerk[i] = number[2];
  }
  std::FILE* in = std::fopen(argv[1], "re");
  if (in == nullptr) return complain(std::string(argv[1]) + ": cannot be opened");
  std::FILE* out = std::fopen(argv[2], "we");
  if (out == nullptr) {
    std::fclose(in);
    return complain(std::string(argv[2]) + ": cannot be written");
  }
  int status = run(in, out, limits, number[3]);
  std::fclose(in);
  if (std::fclose(out) != 0) status = complain(std::string(argv[2]) + ": cannot be written");
  return status;
}
