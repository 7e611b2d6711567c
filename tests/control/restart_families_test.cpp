// SPDX-License-Identifier: Apache-2.0
// Random programs of each family that change a mode in nearly every block, begun inside at each of their blocks: modes, feed, speed, tool and place are those of the whole run there to the last bit,
// and so are the ends of all moves behind it; or the place is refused.
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <sstream>

#include "support/seeds.hpp"
#include "support/watched_machine.hpp"

namespace nc::test {
namespace {

constexpr unsigned kFamilyAxes = 3;

// Blocks that some families know, and others not at all or otherwise: those that a family refuses are left out of its program.
class FamilyBlocks {
 public:
  FamilyBlocks(nc_dialect dialect, std::uint32_t seed) : dialect_(dialect), random_(seed) {}
  std::vector<std::string> make() {
    std::vector<std::string> blocks;
    if (dialect_ == NC_DIALECT_DGSHAPE) blocks = {"%", "O0001"};
    head_ = blocks.size() + 2;
    blocks.push_back("G90 G0 X0. Y0. Z5.");
    blocks.push_back("G1 F600. X1.");
    for (int n = number(12, 30); n > 0; --n) blocks.push_back(block());
    blocks.push_back("M30");
    return blocks;
  }
  std::size_t head() const { return head_; }

 private:
  int number(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  std::string place(int reach = 6) {
    std::string text = std::to_string(number(-reach * 1000, reach * 1000) / 1000.0);
    return text.substr(0, text.size() - 3);
  }
  std::string xy() { return " X" + place() + " Y" + place(); }
  std::string block() {
    switch (number(0, 40)) {
      case 0: return "G5" + std::to_string(number(4, 9));
      case 1: return "G52" + xy();
      case 2: return "G92" + xy();
      case 3: return "G18";
      case 4: return "G19";
      case 5: return "G17";
      case 6: return dialect_ == NC_DIALECT_SERIES8 ? "G70" : "G20";
      case 7: return dialect_ == NC_DIALECT_SERIES8 ? "G71" : "G21";
      case 8: return "G68 X1. Y1. R" + place(90);
      case 9: return "G69";
      case 10: return "G51 X0. Y0. P" + std::string(dialect_ == NC_DIALECT_HX ? "1500" : "1.5");
      case 11: return "G50";
      case 12: return "G43 H" + std::to_string(number(1, 3)) + " Z" + place(4);
      case 13: return "G49";
      case 14: return "G41 D1 G1" + xy();
      case 15: return "G40 G1" + xy();
      case 16: return "T" + std::to_string(number(1, 6)) + " M6";
      case 17: return "T" + std::to_string(number(1, 6));
      case 18: return "M6";
      case 19: return "S" + std::to_string(number(500, 1500)) + " M" + std::to_string(number(3, 5));
      case 20: return "M" + std::to_string(number(7, 9));
      case 21: return "G91";
      case 22: return "G90";
      case 23: return "F" + std::to_string(number(300, 900)) + ".";
      case 24: return "G81" + xy() + " Z-2. R1. F200.";
      case 25: return "G80";
      case 26: return "G98";
      case 27: return "G99";
      case 28: return "G2" + xy() + " R9.";
      case 29: return "G10 L2 P" + std::to_string(number(1, 3)) + xy();
      case 30: return "G53 G0 Z" + place(9);
      case 31: return "G28 Z" + place(9);
      case 32: return "G16";
      case 33: return "G15";
      case 34: return dialect_ == NC_DIALECT_SERIES8 ? "G55 R" + place(90) : "G92.1";
      case 35: return dialect_ == NC_DIALECT_SERIES8 ? "G57 R1.5" : "G51.1 X" + place();
      case 36: return dialect_ == NC_DIALECT_SERIES8 ? "G56" : "G50.1 X0.";
      default: return std::string(number(0, 1) == 0 ? "G0" : "G1") + xy() + (number(0, 2) == 0 ? " Z" + place(3) : "");
    }
  }
  nc_dialect dialect_;
  std::mt19937 random_;
  std::size_t head_ = 0;
};

std::string joined(const std::vector<std::string>& blocks) {
  std::string text;
  for (const std::string& block : blocks) text += block + "\n";
  return text;
}

struct WholeOfFamily {
  std::vector<nc_axes> ends;          // of moves
  std::vector<size_t> behind;         // [n]: number of moves in front of the end of block n
  std::vector<nc_axes> places;        // [n]: at the end of block n
  std::vector<nc_modal> modal;
};

class FamilyMachine : public WatchedMachine {
 public:
  FamilyMachine(nc_dialect dialect, const std::string& text) : WatchedMachine(dialect, "XYZ", {200, 200, 200}, false, 40) {
    prepare(bench);
    drive = std::make_unique<Drive>(bench, text);
    step(3);
  }
  static void prepare(Bench& bench) { bench.tool(1, 1.5).tool(2, 2.5).tool(3, 3.25).work_offset(1, {1, 2, 3}).work_offset(2, {-4, 5, 0.5}); }
  nc_status find(std::uint64_t blocks) {
    nc_restart_found_init(&found);
    nc_restart_place place;
    nc_restart_place_init(&place);
    place.number = blocks;
    place.start_given = true;
    const nc_status begun = nc_restart_begin(bench.control(), 0, &place, nullptr);
    if (begun != NC_OK) return begun;
    nc_status status = NC_BUDGET;
    for (unsigned n = 0; n < 100000 && status == NC_BUDGET; ++n) status = nc_restart_find(bench.control(), 0, 30, &found);
    return status;
  }
  bool until_stop() {
    step(12);
    for (unsigned n = 0; n < 400000 && (drive->out.state == NC_STATE_RUNNING || drive->out.state == NC_STATE_MANUAL); ++n) step();
    step(3);
    return drive->out.state != NC_STATE_RUNNING;
  }
  void bring_axes() {
    for (unsigned i = 0; i < kFamilyAxes; ++i) {
      drive->in.manual[i] = {NC_MANUAL_RETURN, 0, 0};
      for (unsigned n = 0; n < 20000 && (n < 3 || drive->out.state == NC_STATE_MANUAL); ++n) step();
      drive->in.manual[i] = {};
      step(2);
    }
  }
  nc_restart_found found{};
};

struct Counted {
  unsigned begun = 0, nowhere = 0;
};

std::string words(const nc_modal& m) {
  std::ostringstream text;
  text.precision(17);
  for (int code : m.code) text << code << ' ';
  text << "F" << m.feed << " S" << m.spindle << " T" << m.tool << " D" << m.d << " H" << m.h << " M" << m.m << " B" << m.b;
  return text.str();
}

// The whole run, of a program without the blocks that the family refuses.
bool whole(nc_dialect dialect, std::vector<std::string>* blocks, WholeOfFamily* run) {
  for (unsigned tries = 0; tries < 60; ++tries) {
    Bench bench(dialect, [](nc_config& c) { axes("XYZ")(c); });
    FamilyMachine::prepare(bench);
    const Outcome done = bench.run(joined(*blocks));
    if (!done.alarm.empty()) {
      if (done.alarm_line == 0 || done.alarm_line >= blocks->size()) return false;
      blocks->erase(blocks->begin() + static_cast<std::ptrdiff_t>(done.alarm_line) - 1);
      continue;
    }
    *run = {};
    for (const Step& step : done.steps) {
      if (step.item.kind == NC_ITEM_MOVE) run->ends.push_back(step.item.u.move.machine);
      if (step.item.kind != NC_ITEM_MARK || !step.item.u.mark.report) continue;
      run->behind.push_back(run->ends.size());
      run->places.push_back(step.machine);
      run->modal.push_back(step.modal);
    }
    return true;
  }
  return false;
}

// From each block on the program is that of the whole run.
void begin_at_each(nc_dialect dialect, const std::string& text, const WholeOfFamily& run, Counted* counted) {
  for (std::uint64_t n = 1; n + 1 < run.behind.size(); ++n) {
    SCOPED_TRACE("behind " + std::to_string(n) + " blocks");
    FamilyMachine part(dialect, text);
    const nc_status status = part.find(n);
    if (status == NC_E_NOT_FOUND || status == NC_ENDED) {
      ++counted->nowhere;
      continue;
    }
    ASSERT_EQ(status, NC_OK) << part.drive->alarm();
    ++counted->begun;
    for (unsigned a = 0; a < kFamilyAxes; ++a) EXPECT_EQ(part.found.machine.v[a], run.places[n - 1].v[a]) << a;
    nc_modal modal = NC_INIT(nc_modal);
    ASSERT_EQ(nc_modal_get(part.bench.control(), 0, part.found.modal, &modal), NC_OK);
    EXPECT_EQ(words(modal), words(run.modal[n - 1]));
    part.press();
    ASSERT_TRUE(part.until_stop());
    ASSERT_EQ(part.drive->out.cause, NC_CAUSE_RESTART) << part.drive->alarm();
    part.bring_axes();
    part.press();
    ASSERT_TRUE(part.until_stop());
    ASSERT_TRUE(part.drive->ended) << part.drive->alarm() << " line " << part.drive->out.source.line << " cause " << int{part.drive->out.cause};
    const std::vector<nc_axes> ends = part.drive->ends();
    const size_t first = run.behind[n - 1];
    ASSERT_EQ(ends.size(), run.ends.size() - first);
    for (size_t i = 0; i < ends.size(); ++i)
      for (unsigned a = 0; a < kFamilyAxes; ++a) ASSERT_NEAR(ends[i].v[a], run.ends[first + i].v[a], 1e-9) << "move " << i << " axis " << a;
    EXPECT_LT(part.worst, 1.001);
  }
}

class RestartFamilies : public testing::TestWithParam<nc_dialect> {};
INSTANTIATE_TEST_SUITE_P(Each, RestartFamilies, testing::Values(NC_DIALECT_M700, NC_DIALECT_DGSHAPE, NC_DIALECT_ISO, NC_DIALECT_HX, NC_DIALECT_SERIES8), [](const auto& dialect) {
  return std::string(std::array{"M700", "Dgshape", "Iso", "Hx", "Series8"}[dialect.param]);
});

TEST_P(RestartFamilies, AtEachBlockAmidModes) {
  Counted counted;
  unsigned programs = 0;
  const auto from = static_cast<std::uint32_t>(wish("NC_FIRST_SEED", 1));
  for (std::uint32_t seed = from; seed < from + seeds(6, 2); ++seed) {
    SCOPED_TRACE(seed);
    std::vector<std::string> blocks = FamilyBlocks(GetParam(), seed).make();
    WholeOfFamily run;
    if (!whole(GetParam(), &blocks, &run) || run.behind.size() < 4) continue;
    ++programs;
    const std::string text = joined(blocks);
    SCOPED_TRACE(text);
    ASSERT_NO_FATAL_FAILURE(begin_at_each(GetParam(), text, run, &counted));
  }
  EXPECT_GT(counted.begun, programs);
  EXPECT_LE(counted.nowhere, counted.begun / 4);
  std::printf("%u programs, %u begun inside, %u where blocks hang together\n", programs, counted.begun, counted.nowhere);
}

// Four blocks without a movement in the plane end the start without a vector. A mirror image among them leads the tool to the other side in front of the next block, also where it is read again from
// in front of them: whether a block behind the start comes in time is not known at its mark.
TEST(RestartAmidModes, AMirrorImageBehindAStartWithoutAVector) {
  std::vector<std::string> blocks = {"G1 F600. X1.", "G41 D1 G1 X-1.387 Y-5.873", "G51.1 X-2.960", "G28 Z-5.432", "G90", "T4 M6", "G2 X4.882 Y-5.404 R9.", "M30"};
  WholeOfFamily run;
  ASSERT_TRUE(whole(NC_DIALECT_M700, &blocks, &run));
  ASSERT_EQ(blocks.size(), 8u) << "none is refused";
  ASSERT_EQ(run.ends.size(), 6u) << "with the way to the other side";
  Counted counted;
  ASSERT_NO_FATAL_FAILURE(begin_at_each(NC_DIALECT_M700, joined(blocks), run, &counted));
  EXPECT_EQ(counted.begun, 6u);
}

}  // namespace
}  // namespace nc::test
