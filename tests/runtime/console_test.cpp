// SPDX-License-Identifier: Apache-2.0
// What the terminal shows: where a program ends, percentages, states in words.
#include "runtime/console.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace {

std::uint64_t lines_of(const std::string& text) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("nc-console-" + std::to_string(getpid()));
  std::ofstream(path, std::ios::binary) << text;
  std::string error;
  const auto program = nc::rt::ProgramText::open_file(path.string(), {}, &error);
  const std::uint64_t lines = program == nullptr ? 0 : nc::rt::estimate_lines(program.get(), NC_DIALECT_M700);
  std::filesystem::remove(path);
  return lines;
}

TEST(EstimateLines, CountsToTheEndCode) {
  EXPECT_EQ(lines_of("G0\nG1\nM30\nO1\nM99\n"), 3u);
  EXPECT_EQ(lines_of("G0\nm2\nO1\n"), 2u);
  EXPECT_EQ(lines_of("G0\n(M30)\nM300\nM20 M02\n"), 4u);
  EXPECT_EQ(lines_of("G0\nG1\nG2\n"), 4u) << "no end code: all of it";
  EXPECT_EQ(lines_of(""), 0u);
}

TEST(EstimateLines, LargeFilesAreEstimated) {
  std::string text;
  while (text.size() < (65u << 20)) text += "G1 X1.000 Y2.000 Z3.000 (31)\n";
  const double lines = static_cast<double>(lines_of(text));
  EXPECT_NEAR(lines, static_cast<double>(text.size()) / 29.0, static_cast<double>(text.size()) / 29.0 * 0.01);
}

TEST(Percent, StaysInRange) {
  EXPECT_EQ(nc::rt::percent_done(5, 0), 0u);
  EXPECT_EQ(nc::rt::percent_done(50, 200), 25u);
  EXPECT_EQ(nc::rt::percent_done(500, 200), 100u);
}

TEST(StateText, SaysWhyNothingMoves) {
  nc_outputs out{};
  EXPECT_EQ(nc::rt::state_text(out), "idle");
  out.state = NC_STATE_RUNNING;
  EXPECT_EQ(nc::rt::state_text(out), "running");
  out.rapid = true;
  EXPECT_EQ(nc::rt::state_text(out), "rapid");
  out.cause = NC_CAUSE_FIN;
  out.strobe = out.fin_wait = 5;
  out.m = 6;
  out.t = 12;
  EXPECT_EQ(nc::rt::state_text(out), "waits for FIN of M06 T12");
  out.strobe = 0;  // FIN1 is still on and has to go off
  EXPECT_EQ(nc::rt::state_text(out), "waits for FIN of M T to go off");
  out.fin_wait = 0;
  EXPECT_EQ(nc::rt::state_text(out), "waits for FIN to go off");
  out.cause = NC_CAUSE_OVERRIDE_ZERO;
  EXPECT_EQ(nc::rt::state_text(out), "override 0 %");
  out.state = NC_STATE_HOLD;
  EXPECT_EQ(nc::rt::state_text(out), "feed hold");
  out.state = NC_STATE_ALARM;
  EXPECT_EQ(nc::rt::state_text(out), "alarm");
}

}  // namespace
