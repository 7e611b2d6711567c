// SPDX-License-Identifier: Apache-2.0
// Places of programs as they are kept: with what a restart needs, without it, and damaged.
#include <gtest/gtest.h>

#include "runtime/retain/place.hpp"

namespace {

using namespace nc::rt;

ProgramPlace place() {
  ProgramPlace place;
  place.program = "part with spaces.nc";
  place.line = 7;
  place.at = {{'X', 1.5}, {'Y', -3}};
  place.restartable = true;
  place.blocks = 123456789012;
  place.size = 77;
  place.hash = std::string(64, 'a');
  place.begun = {{'X', 0.1}, {'Y', 1.0 / 3}};
  place.coordinates = {true, true, {{0, 'X', -1.0 / 3}, {1, 'Z', 2}, {7, 'Y', 1e-9}}};
  place.coordinates.mirror_known = true;
  place.coordinates.mirrored = "XZ";
  place.cause = "reset";
  return place;
}

TEST(RestartPlace, ComesBackAsItWas) {
  ProgramPlace unknown_text = place();
  unknown_text.hash.clear();
  unknown_text.coordinates.mirrored.clear();
  const std::vector<ProgramPlace> places = {place(), unknown_text};
  std::vector<ProgramPlace> found;
  const std::string bytes = encode_places(places);
  ASSERT_TRUE(decode_places(bytes, &found)) << bytes;
  EXPECT_EQ(found, places);
  for (std::size_t cut = 1; cut + 1 < bytes.size(); ++cut) EXPECT_FALSE(decode_places(bytes.substr(0, cut), &found)) << cut;
}

TEST(RestartPlace, OfAnOlderVersionTellsNoBlocks) {
  std::vector<ProgramPlace> found;
  ASSERT_TRUE(decode_places("ncplace 1\nsystem 0\nprogram part.nc\nblock 12 0 0 11\nat X 1.5\nend\n", &found));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FALSE(found[0].restartable);
  EXPECT_EQ(found[0].line, 12u);
}

TEST(RestartPlace, OfAnOlderVersionDoesNotKnowTheCoordinateSystems) {
  std::vector<ProgramPlace> found;
  ASSERT_TRUE(decode_places("ncplace 1\nsystem 0\nprogram part.nc\nblock 12 0 0 11\nat X 1.5\nrestart 14 812 -\nbegun X 0\ncause reset\nend\n", &found));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].restartable);
  EXPECT_FALSE(found[0].coordinates.known);
  EXPECT_FALSE(found[0].coordinates.mirror_known);
}

TEST(RestartPlace, CoordinateSystemsAreNamedByTheirCodes) {
  nc_restart_coordinates left{};
  EXPECT_EQ(coordinates_text(coordinate_rows(left, "XYZ")), "");
  left.shift.v[0] = 30;
  left.local[0].v[1] = -12.5;
  left.local[5].v[2] = 1;
  left.polar = true;
  const CoordinatesBegun rows = coordinate_rows(left, "XYZ");
  EXPECT_EQ(coordinates_text(rows), "shift of the workpiece coordinates X30, local system in workpiece coordinates 1 Y-12.5, local system in workpiece coordinates 6 Z1, polar coordinates");
  const nc_restart_coordinates again = coordinates_of(rows, "XYZ");
  EXPECT_EQ(coordinate_rows(again, "XYZ"), rows);
  nc_restart_coordinates now = left;
  now.local[5].v[2] = 3;  // somebody has changed it since
  const nc_restart_coordinates back = coordinates_without({}, left, now);
  EXPECT_EQ(coordinates_text(coordinate_rows(back, "XYZ")), "local system in workpiece coordinates 6 Z3");
}

TEST(RestartPlace, WhatMakesNoSenseIsNone) {
  std::vector<ProgramPlace> found;
  for (const char* line : {"restart 1", "restart 1 2", "restart x 2 -", "begun XY 1", "begun X nan", "begun X", "cause", "coordinates", "coordinates x", "coordinate 0 X 1", "coordinates 0\ncoordinate 8 X 1",
                           "coordinates 0\ncoordinate 0 XY 1", "coordinates 0\ncoordinate 0 X nan", "coordinates 0\ncoordinate 0 X", "mirrored", "mirrored XYZABCUVWXYZABCUVWXYZABCUVW"})
    EXPECT_FALSE(decode_places(std::string("ncplace 1\nsystem 0\n") + line + "\nend\n", &found)) << line;
}

}  // namespace
