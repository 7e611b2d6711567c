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
  place.cause = "reset";
  return place;
}

TEST(RestartPlace, ComesBackAsItWas) {
  ProgramPlace unknown_text = place();
  unknown_text.hash.clear();
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

TEST(RestartPlace, WhatMakesNoSenseIsNone) {
  std::vector<ProgramPlace> found;
  for (const char* line : {"restart 1", "restart 1 2", "restart x 2 -", "begun XY 1", "begun X nan", "begun X", "cause"})
    EXPECT_FALSE(decode_places(std::string("ncplace 1\nsystem 0\n") + line + "\nend\n", &found)) << line;
}

}  // namespace
