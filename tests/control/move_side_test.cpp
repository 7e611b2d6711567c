// SPDX-License-Identifier: Apache-2.0
// nc_move_side(): the side is that of the codes and the amount in force, whatever the vectors of the move are.
#include <gtest/gtest.h>

#include "support/drive.hpp"

namespace nc::test {
namespace {

/// The sides of the moves of a program, one letter for each: - L R S; behind L and R the names of the plane's axes where it is not XY.
std::string sides(Bench& bench, const std::string& text) {
  bench.start(text);
  std::string all;
  nc_item item;
  for (nc_status status = NC_OK; status == NC_OK || status == NC_WAITING || status == NC_BUDGET;) {
    status = nc_pull(bench.control(), 0, 100, &item);
    if (status != NC_OK) continue;
    nc_side side = NC_SIDE_NONE;
    uint8_t plane_axis[2] = {99, 99};
    const nc_status known = nc_move_side(bench.control(), 0, &side, plane_axis);
    EXPECT_EQ(known, item.kind == NC_ITEM_MOVE ? NC_OK : NC_E_STATE);
    if (known != NC_OK) continue;
    all += "-LRS"[side];
    const bool to_a_side = side == NC_SIDE_LEFT || side == NC_SIDE_RIGHT;
    EXPECT_EQ(plane_axis[0] == 99, !to_a_side);
    if (to_a_side && (plane_axis[0] != 0 || plane_axis[1] != 1)) (all += "XYZ"[plane_axis[0] % 3]) += "XYZ"[plane_axis[1] % 3];
  }
  return all;
}

TEST(MoveSide, IsThatOfTheCodeAndTheAmount) {
  Bench bench;
  bench.tool(1, 3).tool(2, -3);
  const std::string wall = " G1 X0 Y0 F500\nY20.\nX20.\nY0\nG40 X10. Y-10.\nX0\nM30\n";  // three walls to the right, the tool outside left of them
  EXPECT_EQ(sides(bench, "G90 G17 G0 X-10. Y20.\nG41 D1" + wall).substr(0, 2), "-L");
  for (const char* code : {"G41 D1", "G42 D2"}) {
    const std::string got = sides(bench, std::string("G90 G17 G0 X-10. Y20.\n") + code + wall);
    EXPECT_EQ(got.find('R'), std::string::npos) << got;
    EXPECT_EQ(got.substr(got.size() - 2), "--") << got;  // the way out, and what is behind it
  }
  for (const char* code : {"G42 D1", "G41 D2"}) {
    const std::string got = sides(bench, std::string("G90 G17 G0 X-10. Y20.\n") + code + wall);
    EXPECT_EQ(got.find('L'), std::string::npos) << got;
    EXPECT_NE(got.find('R'), std::string::npos) << got;
  }
  EXPECT_EQ(sides(bench, "G90 G17 G0 X-10. Y20.\nG41 D0" + wall), "-------");  // nothing is in force
}

TEST(MoveSide, SaysThePlane) {
  Bench bench;
  bench.tool(1, 3);
  EXPECT_EQ(sides(bench, "G90 G18 G0 Z-10. X20.\nG42 D1 G1 Z0 F500\nZ20.\nG40 Z30.\nM30\n"), "-RZXRZX-");
}

TEST(MoveSide, AVectorInSpaceHasNone) {
  Bench bench;
  bench.tool(1, 3);
  EXPECT_EQ(sides(bench, "G90 G17 G0 X-10.\nG41 D1 G1 X0 I0 J1. K0 F500\nX20.\nG40 X30.\nX40.\nM30\n"), "-SS--");
}

TEST(MoveSide, IsRefusedWhereThereIsNone) {
  Bench bench;
  nc_side side = NC_SIDE_NONE;
  uint8_t plane_axis[2];
  EXPECT_EQ(nc_move_side(nullptr, 0, &side, plane_axis), NC_E_ARGUMENT);
  EXPECT_EQ(nc_move_side(bench.control(), 1, &side, plane_axis), NC_E_ARGUMENT);
  EXPECT_EQ(nc_move_side(bench.control(), 0, nullptr, plane_axis), NC_E_ARGUMENT);
  EXPECT_EQ(nc_move_side(bench.control(), 0, &side, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_move_side(bench.control(), 0, &side, plane_axis), NC_E_STATE) << "nothing has been pulled";
}

}  // namespace
}  // namespace nc::test
