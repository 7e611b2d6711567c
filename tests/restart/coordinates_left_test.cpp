// SPDX-License-Identifier: Apache-2.0
// Coordinate systems and mirror images that a run has left in force, and a program that is begun inside behind it.
#include "restart_fixture.hpp"

namespace {

using namespace nc::rt;
using namespace nc::test::inside;

// What a run leaves in force of the coordinate systems outlives it (M700 9.1). The rest of the part is that of the run, so it is read with what the run was begun with.
class CoordinatesLeft : public Restart {
 protected:
  void by_mdi(const std::string& blocks) {
    ASSERT_EQ(mode(Mode::kMdi), Answer::kDone);
    ASSERT_EQ(runtime->load_mdi(blocks), Answer::kDone) << runtime->explain(Answer::kRefusedByControl);
    ASSERT_EQ(start(), Answer::kDone);
    ASSERT_TRUE(to_end());
    steps(5);
    ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  }
  // Runs the part once as a whole and once up to its line 3, with the machine and its coordinate systems as `head` leaves them.
  void stop_in(const std::string& part, const std::string& head = "G92.1 X0 Y0\nG52 X0 Y0\nG53 G0 X-20. Y-10.\n") {
    build();
    for (const bool whole : {true, false}) {
      ASSERT_NO_FATAL_FAILURE(by_mdi(head));
      ASSERT_NO_FATAL_FAILURE(select(part));
      machine->path.clear();
      ASSERT_EQ(start(), Answer::kDone);
      if (whole) {
        ASSERT_TRUE(to_end());
        whole_ = machine->path;
      } else {
        ASSERT_TRUE(until([&] { return out().source.line == 3 && out().velocity.v[0] != 0; }));
        steps(40);
        ASSERT_NO_FATAL_FAILURE(reset());
      }
    }
  }
  void expect_rest_of_whole() {
    ASSERT_NO_FATAL_FAILURE(come_to_place());
    EXPECT_EQ(restart().found.source.line, 3u);
    ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, kEveryEntry), Answer::kDone);
    ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
    for (const unsigned axis : {2u, 0u, 1u}) ASSERT_NO_FATAL_FAILURE(approach(axis));
    ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
    machine->path.clear();
    ASSERT_EQ(start(), Answer::kDone);
    ASSERT_TRUE(to_end());
    EXPECT_LT(most_beside(whole_, machine->path), kChord);
    for (unsigned a = 0; a < 3; ++a) EXPECT_NEAR(machine->path.back().v[a], whole_.back().v[a], 1e-9) << a;
  }
  // Of X, as the executed blocks have left it.
  double shift() {
    nc_restart_coordinates left{};
    EXPECT_EQ(runtime->look([&](nc_control* control) { (void)nc_restart_coordinates_get(control, 0, false, &left); }), Answer::kDone);
    return left.shift.v[0];
  }
  std::vector<nc_axes> whole_;
};
const char* const kShifted = "G90 G54 G0 X5. Y5.\nG92 X30.\nG1 X60. F1500.\nX30.\nM30\n";
const char* const kLocal = "G90 G54 G0 X5. Y5.\nG52 X10. Y12.\nG1 X60. F1500.\nX30. Y1.\nM30\n";

TEST_F(CoordinatesLeft, ByG92DoNotCountTwice) {
  ASSERT_NO_FATAL_FAILURE(stop_in(kShifted));
  ASSERT_EQ(find(RestartBy::kLastStop), Answer::kDone) << runtime->explain(Answer::kNoPlace);
  ASSERT_NO_FATAL_FAILURE(expect_rest_of_whole());
}

TEST_F(CoordinatesLeft, ByG52DoNotCountTwice) {
  ASSERT_NO_FATAL_FAILURE(stop_in(kLocal));
  ASSERT_EQ(find(RestartBy::kLastStop), Answer::kDone) << runtime->explain(Answer::kNoPlace);
  ASSERT_NO_FATAL_FAILURE(expect_rest_of_whole());
}

// The shift was in force before the run: the rest is cut with it.
TEST_F(CoordinatesLeft, OfTheBeginningCountAsInTheRun) {
  ASSERT_NO_FATAL_FAILURE(stop_in(kShifted, "G92.1 X0 Y0\nG53 G0 X-20. Y-10.\nG92 X0 Y7.\n"));
  ASSERT_NO_FATAL_FAILURE(by_mdi("G92.1 X0 Y0\n"));
  ASSERT_NO_FATAL_FAILURE(select(kShifted));
  ASSERT_EQ(find(RestartBy::kLastStop), Answer::kDone) << runtime->explain(Answer::kNoPlace);
  ASSERT_NO_FATAL_FAILURE(expect_rest_of_whole());
}

TEST_F(CoordinatesLeft, AreThoseOfBeforeWhereThePlaceIsGivenUp) {
  ASSERT_NO_FATAL_FAILURE(stop_in(kShifted));
  const double left = shift();
  for (int time = 0; time < 3; ++time) {
    ASSERT_EQ(find(RestartBy::kLastStop), Answer::kDone) << runtime->explain(Answer::kNoPlace);
    ASSERT_TRUE(until([&] { return restart().phase == RestartPhase::kFound; })) << restart().text;
    EXPECT_NEAR(restart().found.machine.v[0], 5, 1e-9) << time;
    if (time == 2) break;
    if (time == 0) {
      ASSERT_EQ(runtime->execute(CommandKind::kCancelRestart), Answer::kDone);
    } else {
      ASSERT_NO_FATAL_FAILURE(reset());
    }
    steps(20);
    EXPECT_NEAR(shift(), left, 1e-9) << time;
  }
  ASSERT_NO_FATAL_FAILURE(expect_rest_of_whole());
}

// Nobody has kept what the part was begun with: it is what a cycle start would begin with, and the operator says whether that is right.
TEST_F(CoordinatesLeft, AreAnEntryToBeConfirmedWhereTheBeginningIsNotKnown) {
  ASSERT_NO_FATAL_FAILURE(stop_in(kShifted));
  ASSERT_EQ(find(RestartBy::kLine, 3), Answer::kDone);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  const RestartStatus now = restart();
  ASSERT_EQ(now.list.entries().size(), 1u);
  EXPECT_EQ(now.list.text(now.list.entries()[0]), "shift of the workpiece coordinates X-25 in force at the beginning");
  EXPECT_EQ(now.list.open(), 1u);
  EXPECT_EQ(start(), Answer::kRestartOpen);
  ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, 0), Answer::kDone);
  EXPECT_EQ(start(), Answer::kRestartAxes);
  ASSERT_NO_FATAL_FAILURE(reset());
  ASSERT_NO_FATAL_FAILURE(by_mdi("G92.1 X0 Y0\n"));
  ASSERT_NO_FATAL_FAILURE(select(kShifted));
  ASSERT_EQ(find(RestartBy::kLine, 3), Answer::kDone);
  ASSERT_TRUE(until([&] { return restart().phase == RestartPhase::kFound; })) << restart().text;
  EXPECT_TRUE(restart().list.entries().empty());
  ASSERT_NO_FATAL_FAILURE(expect_rest_of_whole());
}

// plc.mirror mirrors about where the axis stands when the program is begun. Where that is not known it is where the axis stands now, and only the operator knows whether the part was begun there.
class Mirrored : public CoordinatesLeft {
 protected:
  void stop_in_mirrored() {
    build("[signals]\n\"plc.mirror.X\" = \"in0\"\n");
    machine->hold(config.points.find("in0"), 1);
    steps(5);
    ASSERT_NO_FATAL_FAILURE(by_mdi("G53 G0 X-30. Y-10.\n"));
    ASSERT_NO_FATAL_FAILURE(select(kMirrored));
    ASSERT_EQ(start(), Answer::kDone);
    ASSERT_TRUE(until([&] { return out().source.line == 3 && out().velocity.v[0] != 0; }));
    steps(40);
    ASSERT_NO_FATAL_FAILURE(reset());
  }
  static constexpr const char* kMirrored = "G90 G54 G0 X5. Y5.\nG1 Y7. F1500.\nN30 X60. F1500.\nX30.\nM30\n";
};

TEST_F(Mirrored, APlaceByNumberSaysAboutWhatItIsMirrored) {
  ASSERT_NO_FATAL_FAILURE(stop_in_mirrored());
  ASSERT_EQ(find(RestartBy::kLastStop), Answer::kDone) << runtime->explain(Answer::kNoPlace);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  EXPECT_TRUE(restart().list.entries().empty());
  EXPECT_NEAR(restart().found.machine.v[0], -65, 1e-9) << "5 mirrored about -30";
  ASSERT_NO_FATAL_FAILURE(reset());
  for (const RestartBy by : {RestartBy::kLine, RestartBy::kSequence, RestartBy::kBlock}) {
    ASSERT_EQ(find(by, by == RestartBy::kLine ? 3 : by == RestartBy::kSequence ? 30 : 2), Answer::kDone);
    ASSERT_NO_FATAL_FAILURE(come_to_place());
    const RestartStatus now = restart();
    ASSERT_EQ(now.list.entries().size(), 1u);
    char text[120];
    std::snprintf(text, sizeof text, "mirror image by the machine about X%.10g, where the axis stands now", out().command.v[0]);
    EXPECT_EQ(now.list.text(now.list.entries()[0]), text);
    EXPECT_EQ(start(), Answer::kRestartOpen);
    ASSERT_NO_FATAL_FAILURE(reset());
  }
}

// The switch is not where it was in the run.
TEST_F(Mirrored, AStopOfARunThatWasMirroredOtherwiseIsSaid) {
  ASSERT_NO_FATAL_FAILURE(stop_in_mirrored());
  machine->hold(config.points.find("in0"), 0);
  steps(5);
  EXPECT_EQ(find(RestartBy::kLastStop), Answer::kNoPlace);
  EXPECT_NE(runtime->explain(Answer::kNoPlace).find("mirror"), std::string::npos) << runtime->explain(Answer::kNoPlace);
  machine->hold(config.points.find("in0"), 1);
  steps(5);
  ASSERT_EQ(find(RestartBy::kLastStop), Answer::kDone) << runtime->explain(Answer::kNoPlace);
}

}  // namespace
