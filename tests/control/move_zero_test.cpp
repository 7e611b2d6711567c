// SPDX-License-Identifier: Apache-2.0
// nc_move_zero(): the end of a move less its zero is the place on the workpiece that the program names, whatever offsets and tool lengths
// change between the moves.
#include <gtest/gtest.h>

#include "support/drive.hpp"

namespace nc::test {
namespace {

/// The zeros of the moves of a program, as "1 2 13"; end points that are not right are added to `wrong`.
std::vector<std::string> zeros(Bench& bench, const std::string& text, std::string* wrong) {
  bench.start(text);
  std::vector<std::string> all;
  nc_item item;
  nc_axes machine{}, zero{};
  for (nc_status status = NC_OK; status == NC_OK || status == NC_WAITING || status == NC_BUDGET;) {
    status = nc_pull(bench.control(), 0, 100, &item);
    if (status != NC_OK) continue;
    if (item.kind != NC_ITEM_MOVE) {
      if (nc_move_zero(bench.control(), 0, &zero) != NC_E_STATE) *wrong += " a zero of an item that is no move";
      continue;
    }
    if (nc_move_zero(bench.control(), 0, &zero) != NC_OK) *wrong += " no zero of a move";
    if (nc_move_point(bench.control(), 0, 1, &machine) != NC_OK) *wrong += " no end of a move";
    std::string place;
    for (unsigned i = 0; i < 3; ++i) {
      place += (i == 0 ? "" : " ") + brief(zero.v[i]);
      if (std::fabs(machine.v[i] - zero.v[i] - item.u.move.work.v[i]) > 1e-9) *wrong += " axis " + std::to_string(i) + " in line " + std::to_string(item.source.line);
    }
    all.push_back(place);
  }
  return all;
}

TEST(MoveZero, FollowsOffsetsAndTheToolLengthAsItIsApplied) {
  Bench bench;
  bench.work_offset(1, {1, 2, 3}).work_offset(2, {-10, 0, 0.5}).tool(5, 10).tool(6, -2);
  std::string wrong;
  EXPECT_EQ(zeros(bench,
                  "G90 G54 G0 X4.\n"          // the zero of G54
                  "G43 H5 Z20.\n"             // with the length, which this move applies
                  "X5.\n"
                  "G55 X6. Y1. Z7.\n"         // another system
                  "G52 X3.\nG1 X1. F600\n"    // a local one in it
                  "G52 X0.\nG92 Y4.\nY5.\n"   // what stands at Y 1 is called 4
                  "G92.1 Y0\nG44 H6 Z1.\n"
                  "G49 Z2.\n"
                  "M30\n",
                  &wrong),
            (std::vector<std::string>{"1 2 3", "1 2 13", "1 2 13", "-10 0 10.5", "-7 0 10.5", "-10 -3 10.5", "-10 0 2.5", "-10 0 0.5"}));
  EXPECT_EQ(wrong, "");
}

/// Maps of the program, which act before compensation, change the path but not its zero; the tool radius is part of the path, too.
TEST(MoveZero, MapsOfTheProgramAndTheRadiusLeaveIt) {
  Bench bench;
  bench.work_offset(1, {1, 2, 3}).tool(4, 1.5, NC_TOOL_RADIUS);
  std::string wrong;
  for (const std::string& zero : zeros(bench,
                                       "G90 G54 G0 X0 Y0\nG68 X0 Y0 R90.\nG1 X5. F600\nG2 X9. R2.\nG69\n"
                                       "G51.1 X1.\nG1 X4.\nG50.1 X0\nG51 X0 Y0 P2.\nX3. Y1.\nG50\n"
                                       "G41 D4 X10. Y10.\nX20.\nY0\nG40 X0\nM30\n",
                                       &wrong))
    EXPECT_EQ(zero, "1 2 3");
}

TEST(MoveZero, IsRefusedWhereThereIsNone) {
  Bench bench;
  nc_axes zero{};
  EXPECT_EQ(nc_move_zero(nullptr, 0, &zero), NC_E_ARGUMENT);
  EXPECT_EQ(nc_move_zero(bench.control(), 1, &zero), NC_E_ARGUMENT);
  EXPECT_EQ(nc_move_zero(bench.control(), 0, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_move_zero(bench.control(), 0, &zero), NC_E_STATE) << "nothing has been pulled";
  Drive drive(bench, "G90 G1 X5. F600\nM30\n");
  for (unsigned n = 0; n < 50; ++n) {
    drive.press_start();
    drive.step();
  }
  ASSERT_EQ(drive.out.state, NC_STATE_RUNNING);
  EXPECT_EQ(nc_move_zero(bench.control(), 0, &zero), NC_E_STATE) << "the machine runs";
}

}  // namespace
}  // namespace nc::test
