// SPDX-License-Identifier: Apache-2.0
// Tool radius compensation: compensated segments per second through the stage, with the interference check and with the option that looks at the
// walls. The target is 2 million.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <vector>

#include "offset/offset.hpp"

namespace {

using namespace nc;

/// A closed contour of lines and arcs that winds in and out, block by block as the interpreter sends it.
std::vector<Item> contour(unsigned blocks, bool arcs, bool walls) {
  std::vector<Item> items;
  Compensation comp;
  comp.side = 1;
  comp.radius = 2;
  comp.check = true;
  comp.walls = walls;
  AxisVec at;
  double heading = 0;
  for (unsigned i = 0; i < blocks; ++i) {
    Item item;
    item.kind = ItemKind::move;
    AxisVec to = at;
    if (arcs && i % 2 == 1) {
      const double radius = 12, sweep = i % 4 == 1 ? 0.4 : -0.4, sense = sweep > 0 ? 1 : -1;
      const double center[2] = {at[0] - sense * radius * std::sin(heading), at[1] + sense * radius * std::cos(heading)};
      const double from = std::atan2(at[1] - center[1], at[0] - center[0]);
      to[0] = center[0] + radius * std::cos(from + sweep);
      to[1] = center[1] + radius * std::sin(from + sweep);
      item.move = Move(at, to, comp);
      item.move.kind = NC_MOVE_ARC;
      item.move.circular = true;
      item.move.plane = Plane::xy;
      item.move.circle = {{center[0], center[1]}, radius, radius, from, sweep};
      heading += sweep;
    } else {
      heading += i % 4 < (arcs ? 1 : 2) ? 0.3 : -0.3;
      to[0] += 10 * std::cos(heading);
      to[1] += 10 * std::sin(heading);
      item.move = Move(at, to, comp);
    }
    items.push_back(item);
    Item mark;
    mark.kind = ItemKind::mark;
    mark.block_end = true;
    items.push_back(mark);
    at = to;
  }
  return items;
}

void compensate(benchmark::State& state, bool arcs, bool walls, unsigned blocks = 1000) {
  const std::vector<Item> items = contour(blocks, arcs, walls);
  const auto stage = std::make_unique<OffsetStage>();
  constexpr unsigned kContour = 100010;
  Arena measure;
  stage->create(kContour, measure);
  const auto memory = std::make_unique_for_overwrite<std::max_align_t[]>(measure.used() / sizeof(std::max_align_t) + 64);
  Arena arena(memory.get(), measure.used());
  stage->create(kContour, arena);
  Item out;
  for (auto _ : state) {
    stage->reset();
    size_t moves = 0;
    for (const Item& item : items) {
      while (!stage->push(item)) {
        while (stage->pop(out)) moves += out.kind == ItemKind::move;
      }
      while (stage->pop(out)) moves += out.kind == ItemKind::move;
    }
    if (moves < blocks * 9 / 10) state.SkipWithError("the contour has ended in an alarm");
    benchmark::DoNotOptimize(moves);
  }
  state.SetItemsProcessed(static_cast<int64_t>(state.iterations()) * blocks);
}

void lines(benchmark::State& state) { compensate(state, false, false); }
void lines_and_arcs(benchmark::State& state) { compensate(state, true, false); }
void lines_with_walls(benchmark::State& state) { compensate(state, false, true); }
void lines_and_arcs_with_walls(benchmark::State& state) { compensate(state, true, true); }
void a_long_contour_with_walls(benchmark::State& state) { compensate(state, true, true, 100000); }
BENCHMARK(a_long_contour_with_walls);
BENCHMARK(lines);
BENCHMARK(lines_and_arcs);
BENCHMARK(lines_with_walls);
BENCHMARK(lines_and_arcs_with_walls);

}  // namespace
