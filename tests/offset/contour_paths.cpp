// SPDX-License-Identifier: Apache-2.0
// The control's side of oracle_test.py: runs programs one behind the other and writes the path of the tool. Starting a process for each program
// would take longer than all that is done with it.
//
//   contour_paths < PROGRAMS
//
// A program ends with a line "%". A line "!KEY VALUE" in it sets a parameter from this program on. Of each program it writes what it does, in its
// order, and a line "." at its end:
//
//   m LINE START END [CENTER SWEEP]   a move of a block of that line: coordinates X Y Z (of the centre X Y) in mm, the angle of an arc in degrees,
//                                     counter-clockwise positive
//   a LINE CODE                       the alarm that ends it
#include <cstdio>
#include <iostream>
#include <string>

#include "support/pull.hpp"

namespace nc::test {
namespace {

void write(const nc_item& item) {
  const nc_move& m = item.u.move;
  std::printf("m %u", item.source.line);
  for (const nc_axes& point : {m.machine_start, m.machine}) std::printf(" %.12g %.12g %.12g", point.v[0], point.v[1], point.v[2]);
  if (m.plane != NC_PLANE_NONE) std::printf(" %.12g %.12g %.15g", m.machine_center[0], m.machine_center[1], m.sweep_deg);
  std::printf("\n");
}

void run(Bench* bench, const std::string& program) {
  nc_reset(bench->control(), 0);
  const Outcome done = bench->run(program);
  for (const Step& step : done.steps)
    if (step.item.kind == NC_ITEM_MOVE) write(step.item);
  if (!done.alarm.empty()) std::printf("a %u %s\n", done.alarm_line, done.alarm.c_str());
  std::printf(".\n");
}

}  // namespace
}  // namespace nc::test

int main() {
  nc::test::Bench bench;
  bench.param("CONTOUR_CHECK", "1").param("corner_ii", "1");
  std::string line, program;
  while (std::getline(std::cin, line)) {
    if (line[0] == '!') {
      const size_t blank = line.find(' ');
      bench.param(line.substr(1, blank - 1).c_str(), line.substr(blank + 1).c_str());
      continue;
    }
    if (line != "%") {
      program += line + '\n';
      continue;
    }
    nc::test::run(&bench, program);
    program.clear();
  }
  return 0;
}
