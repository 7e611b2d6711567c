// SPDX-License-Identifier: Apache-2.0
// Tables that part systems share: a write that the machine has executed in one part system is seen by the others, in the order of execution, and
// a part system takes back only its own writes (M700 13.4).
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "part_system_pair.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

TEST(SharedTables, ToolDataOfTheOtherPartSystem) {
  Pair pair;
  pair.run(1, "#2001=5\nM30");
  pair.run(0, "G0 G43 H1 Z1.\n#101=#2001\nM30");
  EXPECT_EQ(pair.machine(0).v[2], 6);
  EXPECT_EQ(pair.var(0, 101), 5);
  EXPECT_EQ(pair.bench.tool_now(1), 5);
  pair.bench.param("1037", "2");
  pair.run(0, "G10 L10 P1 R7.\nG10 L12 P2 R3.\nM30");
  pair.run(1, "G91 G10 L10 P1 R1.\nG90 G43 H1 G0 Z1.\nM30");
  EXPECT_EQ(pair.machine(1).v[2], 9) << "7 and the amount of G91";
  EXPECT_EQ(pair.bench.tool_now(2, NC_TOOL_RADIUS), 3);
}

TEST(SharedTables, AllThatIsShared) {  // M700 13.4, 13.5.5
  Bench bench(NC_DIALECT_M700, [](nc_config& c) {
    two_systems(c);
    c.variable_ranges[0] = {400, 499};
    c.extended_variables = true;
  });
  bench.run("#100=1 #400=2 #500=3 #900000=4\nSETVN501[DEPTH]\nG10 L70\nP1303 D110\nG11\n#110=5 #111=6\nM30");
  const auto value = [&](unsigned system, uint32_t number) {
    double v = 0;
    bool vacant = true;
    nc_variable_get(bench.control(), system, number, &v, &vacant);
    return vacant ? -1 : v;
  };
  EXPECT_EQ(value(1, 100), 1) << "#1303 makes what the first part system has common to all";
  EXPECT_EQ(value(1, 400), 2);
  EXPECT_EQ(value(1, 500), 3);
  EXPECT_EQ(value(1, 900000), 4);
  EXPECT_EQ(value(1, 110), 5);
  EXPECT_EQ(value(1, 111), -1);
  double last = 0;
  EXPECT_EQ(nc_parameter_get(bench.control(), 1, "1303", 0, &last), NC_OK);
  EXPECT_EQ(last, 110);
  Pair pair;  // a name of a variable that the other part system has given
  pair.run(0, "SETVN501[DEPTH]\nM30");
  pair.run(1, "[#DEPTH]=4\nM30");
  pair.expect(501, 4);
}

TEST(SharedTables, TheRangesAreThoseOfTheFamily) {  // HX 14.4: #100 to #199 and #200 to #699; which of them are shared no parameter says
  Pair pair(NC_DIALECT_HX);
  pair.run(0, "#150=1\n#200=2\n#450=3\n#500=4\n#699=5\nM30\n");
  EXPECT_TRUE(std::isnan(pair.var(1, 150)));
  pair.expect(200, 2);
  pair.expect(450, 3);
  pair.expect(500, 4);
  pair.expect(699, 5);
}

TEST(SharedTables, OnePartSystemDoesNotWait) {
  Bench bench;
  const Outcome one = bench.run("#500=1\n#2001=3\n#501=#500+#2001\nM30");
  for (const Step& step : one.steps) EXPECT_NE(step.item.kind, NC_ITEM_SYNC);
  Pair pair;
  pair.run(0, "#500=1\n#2001=3\n#101=2\n#102=#101\nM30");
  EXPECT_EQ(pair.syncs[0], 0u) << "nothing shared is read";
  for (const char* read : {"#101=#500", "#101=#2001", "IF[#500 EQ 1]GOTO1\nN1", "G0 X#500", "G65 P1 A#500", "POPEN\nDPRNT[#500[42]]\nPCLOS", "#[#500+100]=1"}) {
    SCOPED_TRACE(read);
    Pair reader;
    reader.bench.add("O1", "M99\n");
    reader.bench.var(500, 1);
    reader.run(0, std::string(read) + "\nM30");
    EXPECT_EQ(reader.syncs[0], 1u);
  }
  pair.run(0, "G0 X1.\n#101=#500\nM30");
  nc_item item{};
  pair.select(0, "#101=#500\nM30");
  ASSERT_EQ(nc_pull(pair.control(), 0, 10, &item), NC_OK);
  EXPECT_EQ(item.kind, NC_ITEM_SYNC);
  EXPECT_EQ(item.u.sync.what, NC_SYNC_SHARED);
}

/// #1303 in a program decides what is shared from its block on. What comes before it is executed with what was shared until then, also where the machine
/// is far behind.
TEST(SharedTables, AProgramChangesWhatIsShared) {
  for (const bool online : {false, true}) {
    SCOPED_TRACE(online);
    Pair more;  // #101 becomes common with the value of the first part system
    nc_variable_set(more.control(), 0, 101, 3, false);
    more.select(1, "#101=5\nG1 X4. F1000\nG10 L70\nP1303 D199\nG11\n#102=6\nM30");
    more.select(0, "G4 X0.1\n#140=#101\nG4 X1.\n#1=#500\n#141=#101\n#142=#102\nM30");  // #500 waits for the machine
    if (online) {
      more.start(3);
      more.to_the_end();
    } else {
      more.finish(1);
      more.finish(0);
    }
    EXPECT_EQ(more.var(0, 140), 3);
    EXPECT_EQ(more.var(0, 141), 3) << "it was system 2's own when #101=5 was executed";
    EXPECT_EQ(more.var(0, 142), 6);
    more.expect(101, 3);
    if (!online) continue;
    Pair less;  // #101 is common until #1303 says otherwise
    less.bench.param("1303", "199");
    less.select(1, "#101=5\nG1 X4. F100\nG10 L70\nP1303 D100\nG11\nM30");
    less.select(0, "G4 X0.5\n#500=#101\nM30");
    less.start(3);
    less.to_the_end();
    EXPECT_EQ(less.var(0, 500), 5) << "the second part system still moves";
  }
}

/// The value before the first write comes back when both writes have been taken back, in whichever order.
TEST(SharedTables, BothGoBack) {
  for (const bool writer_first : {false, true}) {
    SCOPED_TRACE(writer_first);
    Pair pair;
    pair.bench.var(500, 9).tool(1, 9).param("1304", "600");
    const auto last_common = [&](unsigned system) {
      double last = 0;
      EXPECT_EQ(nc_parameter_get(pair.control(), system, "1304", 0, &last), NC_OK);
      return last;
    };
    pair.run(0, "#500=1\n#2001=1\nG10 L70\nP1304 D610\nG11\nM30");
    pair.run(1, "#500=2\n#2001=2\nG10 L70\nP1304 D620\nG11\nM30");
    ASSERT_EQ(nc_rewind(pair.control(), writer_first ? 0 : 1, 0), NC_OK);
    pair.expect(500, writer_first ? 2 : 1);
    EXPECT_EQ(pair.bench.tool_now(1), writer_first ? 2 : 1);
    for (unsigned system = 0; system < 2; ++system) EXPECT_EQ(last_common(system), writer_first ? 620 : 610);
    ASSERT_EQ(nc_rewind(pair.control(), writer_first ? 1 : 0, 0), NC_OK);
    pair.expect(500, 9);
    EXPECT_EQ(pair.bench.tool_now(1), 9);
    for (unsigned system = 0; system < 2; ++system) EXPECT_EQ(last_common(system), 600);
  }
  Pair pair;  // a value that the host has written in between is not changed
  pair.run(0, "#500=1\nM30");
  ASSERT_EQ(nc_variable_set(pair.control(), 0, 500, 7, false), NC_OK);
  pair.run(1, "#500=2\nM30");
  ASSERT_EQ(nc_rewind(pair.control(), 0, 0), NC_OK);
  pair.expect(500, 2);
  ASSERT_EQ(nc_rewind(pair.control(), 1, 0), NC_OK);
  pair.expect(500, 7);
  ASSERT_EQ(nc_reset(pair.control(), 0), NC_OK);
  pair.run(0, "#500=3\nM30");
  ASSERT_EQ(nc_reset(pair.control(), 0), NC_OK);  // it is taken back finally
  pair.finish(1);
  pair.expect(500, 2);
  ASSERT_EQ(nc_rewind(pair.control(), 1, 0), NC_OK);
  pair.expect(500, 3);
}

/// To go back farther than is remembered is refused, and nothing is changed.
TEST(SharedTables, TooFarBack) {
  Pair pair;
  pair.run(0, "#500=1\nM30");
  pair.run(1, "WHILE[#501LT9000]DO1\n#501=#501+1\nG4 P1\nEND1\nM30");
  EXPECT_EQ(nc_rewind(pair.control(), 1, 0), NC_E_NOT_FOUND);
  EXPECT_EQ(nc_rewind(pair.control(), 0, 0), NC_E_NOT_FOUND);
  pair.expect(500, 1);
  pair.expect(501, 9000);
}

TEST(SharedTables, GoingBackKeepsWhatTheOtherHasWritten) {
  for (const bool other_first : {false, true}) {
    SCOPED_TRACE(other_first);
    Pair pair;
    pair.bench.var(500, 9);
    pair.select(0, "#500=1\n#501=1\nM30");
    if (other_first) pair.run(1, "#500=2\nM30");
    pair.finish(0);
    if (!other_first) pair.run(1, "#500=2\nM30");
    pair.expect(500, other_first ? 1 : 2);
    pair.expect(501, 1);
    ASSERT_EQ(nc_rewind(pair.control(), 0, 0), NC_OK);
    pair.expect(500, 2);
    pair.expect(501, NAN);
    pair.finish(0);
    pair.expect(500, 1);
    pair.expect(501, 1);
  }
  Pair pair;  // MDI and a reset end programs of which all has been executed
  pair.run(0, "#500=1\n#501=1\nM30");
  pair.run(1, "#500=2\nM30");
  ASSERT_EQ(nc_mdi_load(pair.control(), 0, "#502=4", 6), NC_OK);
  pair.finish(0);
  ASSERT_EQ(nc_reset(pair.control(), 0), NC_OK);
  pair.expect(500, 2);
  pair.expect(501, 1);
  pair.expect(502, 4);
}

constexpr const char* kReadsAhead = "G1 X40. F1000\n#500=1\n#2001=1\nG1 X0\nM30";

TEST(SharedTables, WhatIsOnlyReadAheadIsNotSeen) {
  Pair pair;
  pair.select(0, kReadsAhead);
  pair.select(1, "G4 X0.5\nM30");
  pair.start(3);
  EXPECT_EQ(pair.var(0, 500), 1) << "read ahead";
  EXPECT_TRUE(std::isnan(pair.var(1, 500)));
  for (unsigned system = 0; system < 2; ++system) EXPECT_TRUE(std::isnan(pair.executed(system, 500)));
  pair.to_the_end();
  pair.expect(500, 1);
  EXPECT_EQ(pair.bench.tool_now(1), 1);
}

/// The first part system has read its own write ahead when the write of the second one is executed.
TEST(SharedTables, ResetBehindAWriteOfTheOther) {
  for (const bool reset : {false, true}) {
    SCOPED_TRACE(reset);
    Pair pair;
    pair.bench.var(500, 9).tool(1, 9);
    pair.select(0, kReadsAhead);
    pair.select(1, "#500=2\n#2001=2\nM30");
    pair.start(3);
    pair.cycles(30);
    EXPECT_EQ(pair.out[0].state, NC_STATE_RUNNING);
    EXPECT_EQ(pair.out[1].state, NC_STATE_IDLE);
    EXPECT_EQ(pair.var(0, 500), 1) << "what it is going to do comes behind";
    EXPECT_EQ(pair.var(1, 500), 2);
    for (unsigned system = 0; system < 2; ++system) EXPECT_EQ(pair.executed(system, 500), 2);
    if (reset) pair.reset(0);
    pair.to_the_end();
    pair.expect(500, reset ? 2 : 1);
    EXPECT_EQ(pair.bench.tool_now(1), reset ? 2 : 1);
  }
}

/// The same in single block: the reset comes when the first write of that part system has been executed, too.
TEST(SharedTables, SingleBlockAndReset) {
  Pair pair;
  pair.bench.param("8101", "1");
  pair.select(0, "#500=1\n#501=1\nG1 X40. F1000\n#500=3\n#501=3\nM30");
  pair.select(1, "G4 X0.1\n#500=2\nM30");
  pair.in[0].single_block = true;
  pair.start(3);
  pair.cycles(60);
  for (unsigned system = 0; system < 2; ++system) EXPECT_EQ(pair.executed(system, 500), 2);
  for (unsigned n = 0; n < 2; ++n) {
    pair.cycle(1);
    pair.cycles(5);
  }
  EXPECT_EQ(pair.executed(1, 501), 1);
  EXPECT_EQ(pair.executed(0, 500), 2);
  pair.reset(0);
  pair.expect(500, 2);
  pair.expect(501, 1);
}

TEST(SharedTables, AnInterruptTakesBackItsOwnOnly) {
  Pair pair;
  pair.bench.add("O1000", "#503=#500\nM99\n");
  pair.select(0, "M96 P1000\nG1 X40. F1000\n#500=1\n#501=1\nM97\nM30");
  pair.select(1, "G4 X0.1\n#500=2\nM30");
  pair.start(3);
  pair.cycles(60);
  ASSERT_EQ(pair.executed(0, 500), 2);
  pair.in[0].macro_interrupt = true;
  pair.cycles(5);
  pair.in[0].macro_interrupt = false;
  pair.to_the_end();
  pair.expect(503, 2);
  pair.expect(500, 1);
  pair.expect(501, 1);
}

TEST(SharedTables, ProgramsThatWaitForOneAnother) {
  for (const bool online : {false, true}) {
    SCOPED_TRACE(online);
    Pair pair;
    pair.select(0, "WHILE[#500 NE 1]DO1\nG4 X0.01\nEND1\n#2001=7\n#501=1\nM30");
    pair.select(1, "G4 X0.3\n#500=1\nWHILE[#501 NE 1]DO1\nG4 X0.01\nEND1\n#502=#2001\nG0 X#502\nM30");
    if (online) {
      pair.start(3);
      pair.to_the_end();
    } else {
      nc_item item{};
      bool more = true;
      for (unsigned n = 0; n < 1000 && more; ++n) {
        const bool first = pair.pull(0, &item), second = pair.pull(1, &item);
        more = first || second;
      }
      EXPECT_FALSE(more);
    }
    const double x = online ? pair.out[1].command.v[0] : pair.machine(1).v[0];
    EXPECT_EQ(x, 7);
    pair.expect(502, 7);
  }
}

/// Reading a shared variable and writing it in one block is one step for the other part systems, whatever the rhythm of both and of the feeder.
TEST(SharedTables, NoCountIsLost) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 dice(seed);
    const auto any = [&](unsigned least, unsigned most) { return std::uniform_int_distribution<unsigned>(least, most)(dice); };
    Pair pair;
    for (unsigned system = 0; system < 2; ++system) {
      const std::string wait = any(0, 3) == 0 ? "" : "G4 X0.00" + std::to_string(any(1, 9)) + "\n";
      pair.select(system, "#1=0\nWHILE [#1 LT 15] DO1\n" + wait + "#500=#500+1\nG65 P7 A#500\n#1=#1+1\nEND1\nM30\n");
    }
    pair.bench.add("O7", "#2007=#2007+1\nM99\n");
    ASSERT_EQ(nc_variable_set(pair.control(), 0, 500, 0, false), NC_OK);
    pair.run_unevenly(any);
    if (testing::Test::HasFatalFailure()) return;
    pair.expect(500, 30);
    double length = 0;
    EXPECT_EQ(nc_tool_offset_get(pair.control(), 7, NC_TOOL_LENGTH, &length), NC_OK);
    EXPECT_EQ(length, 30);
  }
}

TEST(SharedTables, TheHostWritesForAll) {
  Pair pair;
  nc_variable_set(pair.control(), 1, 500, 3, false);
  pair.expect(500, 3);
  nc_variable_set(pair.control(), 1, 100, 3, false);
  EXPECT_TRUE(std::isnan(pair.var(0, 100)));
  pair.bench.tool(4, 8);
  EXPECT_EQ(nc_variable_name_set(pair.control(), 502, "WIDTH"), NC_OK);
  EXPECT_EQ(nc_parameter_set(pair.control(), 1, "1304", 0, "500"), NC_OK);
  pair.run(1, "G0 G43 H4 Z0\n[#WIDTH]=6\nM30");
  EXPECT_EQ(pair.machine(1).v[2], 8);
  EXPECT_EQ(pair.var(1, 502), 6);
  EXPECT_TRUE(std::isnan(pair.var(0, 502))) << "it is no longer common";
  double last = 0;
  EXPECT_EQ(nc_parameter_get(pair.control(), 0, "1304", 0, &last), NC_OK);
  EXPECT_EQ(last, 500);
}

/// A parameter that a program has written ahead and the host sets then: also one of a single part system.
TEST(SharedTables, NoRewindTakesBackAParameterOfTheHost) {
  Pair pair;
  Bench one;
  for (nc_control* const control : {one.control(), pair.control()}) {
    const auto spiral_error = [control] {
      double value = 0;
      EXPECT_EQ(nc_parameter_get(control, 0, "8075", 0, &value), NC_OK);
      return value;
    };
    constexpr char kText[] = "G10 L70\nP8075 D5.\nG11\nM30";
    unsigned file = 0;
    ASSERT_EQ(nc_program_add_text(control, "sets", kText, sizeof kText - 1, &file), NC_OK);
    ASSERT_EQ(nc_program_select(control, 0, file), NC_OK);
    nc_item item{};
    while (nc_pull(control, 0, 100, &item) == NC_OK) {}
    EXPECT_EQ(spiral_error(), 5);
    EXPECT_EQ(nc_parameter_set(control, 0, "8075", 0, "7"), NC_OK);
    ASSERT_EQ(nc_rewind(control, 0, 0), NC_OK);
    EXPECT_EQ(spiral_error(), 7);
  }
}

/// There is room for 128 texts of parameters. One that a rewind can bring back keeps its place.
TEST(SharedTables, NoTextTakesThePlaceOfOneThatARewindBringsBack) {
  Bench bench;
  nc_control* const control = bench.control();
  const auto now = [control] {
    char key[24] = "", axis = 0, text[64] = "";
    double value = 0;
    for (unsigned place = 0; nc_parameter_next(control, 0, place, &place, key, &axis, &value, text) == NC_OK; ++place)
      if (std::string(key) == "50000") return std::string(text);
    return std::string();
  };
  ASSERT_EQ(nc_parameter_set(control, 0, "50000", 0, "ORIGINAL"), NC_OK);
  std::string program = "G10 L70\n";
  for (unsigned n = 0; n < 300; ++n) program += "P50000 <WORD" + std::to_string(n) + ">\n";
  bench.start(program + "G11\nM30");
  nc_item item{};
  std::map<uint64_t, std::string> at;  // what stands there behind each block
  unsigned syncs = 0;
  while (nc_pull(control, 0, 1000, &item) == NC_OK) {
    ASSERT_NE(item.kind, NC_ITEM_ALARM);
    if (item.kind == NC_ITEM_MARK) at[item.serial] = now();
    if (item.kind != NC_ITEM_SYNC) continue;
    ++syncs;
    const nc_world world{};
    ASSERT_EQ(nc_answer(control, 0, &world), NC_OK);
  }
  EXPECT_EQ(now(), "WORD299");
  EXPECT_EQ(syncs, 2U) << "each time that all places are taken";
  unsigned given_back = 0;
  for (auto mark = at.rbegin(); mark != at.rend(); ++mark) {
    if (nc_rewind(control, 0, mark->first) != NC_OK) break;  // too far back
    ASSERT_EQ(now(), mark->second);
    ++given_back;
  }
  EXPECT_GT(given_back, 30U);
}

// ---- two random programs ---------------------------------------------------------------------------------------------------

/// A write to a shared place, or a read of one into a local variable.
struct Access {
  enum Kind { variable, tool, name, read, other } kind = other;
  uint32_t place = 0;
  int value = 0;
};

struct Program {
  std::string text;
  std::map<uint32_t, Access> at;  ///< by line
};

class SharedDice {
 public:
  explicit SharedDice(uint32_t seed) : random_(seed) {}
  int draw(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool chance(int percent) { return draw(1, 100) <= percent; }

 private:
  std::mt19937 random_;
};

Program random_program(SharedDice& dice) {
  Program program;
  uint32_t line = 0;
  const auto add = [&](const std::string& block, const Access& access) {
    program.text += block + "\n";
    program.at[++line] = access;
  };
  for (int blocks = dice.draw(5, 40); blocks > 0; --blocks) {
    const auto place = static_cast<uint32_t>(dice.draw(0, 3));
    const int value = dice.draw(1, 999);
    const std::string number = std::to_string(value);
    switch (dice.draw(0, 9)) {
      case 0: add("G1 X" + std::to_string(dice.draw(0, 20)) + ". F6000", {}); break;
      case 1: add("G4 P" + std::to_string(dice.draw(1, 30)), {}); break;
      case 2: add("#120=" + number, {}); break;
      case 3: add("G90 G10 L10 P" + std::to_string(place + 1) + " R" + number + ".", {Access::tool, place + 1, value}); break;
      case 4: add("#" + std::to_string(2001 + place) + "=" + number, {Access::tool, place + 1, value}); break;
      case 5: add("#" + std::to_string(100 + place) + "=#" + std::to_string(500 + place), {Access::read, place, 0}); break;
      default: add("#" + std::to_string(500 + place) + "=" + number, {Access::variable, 500 + place, value}); break;
    }
  }
  program.text += "M30\n";
  return program;
}

/// The tables as they must be after the executed accesses.
class Model {
 public:
  void execute(unsigned system, uint64_t serial, const Access& access) {
    if (access.kind == Access::variable || access.kind == Access::tool) done_.push_back({system, serial, access});
  }
  void take_back(unsigned system, uint64_t serial) {
    std::erase_if(done_, [&](const Done& done) { return done.system == system && done.serial > serial; });
  }
  /// A program has ended, or was given up: its writes cannot be taken back any more.
  void forget(unsigned system) {
    for (Done& done : done_)
      if (done.system == system) done.serial = 0;
  }
  int value(Access::Kind kind, uint32_t place) const {
    int value = 0;
    for (const Done& done : done_)
      if (done.access.kind == kind && done.access.place == place) value = done.access.value;
    return value;
  }

 private:
  struct Done {
    unsigned system;
    uint64_t serial;
    Access access;
  };
  std::vector<Done> done_;
};

void expect_model(Pair& pair, const Model& model) {
  for (uint32_t number = 500; number < 504; ++number) {
    for (unsigned system = 0; system < 2; ++system) {
      const double value = pair.var(system, number);
      ASSERT_EQ(std::isnan(value) ? 0 : value, model.value(Access::variable, number)) << "#" << number << " in part system " << system + 1;
    }
  }
  // Both part systems: what the second one sees is read by a program.
  for (unsigned n = 1; n <= 4; ++n) ASSERT_EQ(pair.bench.tool_now(n), model.value(Access::tool, n)) << "tool " << n;
  pair.run(1, "#110=#2001 #111=#2002 #112=#2003 #113=#2004\nM30");
  for (unsigned n = 1; n <= 4; ++n) ASSERT_EQ(pair.var(1, 109 + n), model.value(Access::tool, n)) << "tool " << n << " in part system 2";
}

/// The two programs are pulled in turns, with stops, resets, other programs and rewinds.
TEST(SharedTables, RandomProgramsOffline) {
  unsigned reads = 0, ways_back = 0;
  const uint64_t count = seeds(400, 80);
  for (uint32_t seed = 0; seed < count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SharedDice dice(seed);
    Pair pair;
    Model model;
    Program program[2] = {random_program(dice), random_program(dice)};
    std::vector<uint64_t> of_system[2];  // the marks
    for (unsigned i = 0; i < 2; ++i) pair.select(i, program[i].text);
    nc_item item{};
    for (unsigned n = 0; n < 300; ++n) {
      const auto i = static_cast<unsigned>(dice.draw(0, 1));
      for (int items = dice.draw(1, 6); items > 0; --items) {
        const Model before = model;  // a block behind a sync is read only when the next item is pulled
        if (!pair.pull(i, &item)) break;
        const Access access = program[i].at[item.source.line];
        if (item.kind != NC_ITEM_MARK) continue;
        model.execute(i, item.serial, access);
        of_system[i].push_back(item.serial);
        if (access.kind != Access::read) continue;
        const double value = pair.var(i, 100 + access.place);
        ASSERT_EQ(std::isnan(value) ? 0 : value, before.value(Access::variable, 500 + access.place)) << "line " << item.source.line;
        ++reads;
      }
      if (dice.chance(4)) {
        ASSERT_EQ(nc_reset(pair.control(), i), NC_OK);
        model.forget(i);
        of_system[i].clear();
      } else if (dice.chance(4)) {
        ASSERT_EQ(nc_reset(pair.control(), i), NC_OK);
        program[i] = random_program(dice);
        pair.select(i, program[i].text);
        model.forget(i);
        of_system[i].clear();
      } else if (std::vector<uint64_t>& marks = of_system[i]; dice.chance(4) && marks.size() > 1) {
        marks.resize(static_cast<size_t>(dice.draw(1, static_cast<int>(marks.size()))));
        if (nc_rewind(pair.control(), i, marks.back()) == NC_OK) {
          model.take_back(i, marks.back());
          ++ways_back;
        }
      }
    }
    for (unsigned i = 0; i < 2; ++i) {
      while (pair.pull(i, &item))
        if (item.kind == NC_ITEM_MARK) model.execute(i, item.serial, program[i].at[item.source.line]);
    }
    pair.pull(0, &item);  // there is no item left, so that the last block of the other counts
    ASSERT_NO_FATAL_FAILURE(expect_model(pair, model));
  }
  EXPECT_GT(reads, 5 * count / 2);
  EXPECT_GT(ways_back, 5 * count / 2);
}

/// On the machine, with holds, single block, resets, and a feeder that runs only now and then.
TEST(SharedTables, RandomProgramsOnline) {
  unsigned writes = 0, resets = 0;
  const uint64_t count = seeds(150, 40);
  for (uint32_t seed = 0; seed < count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SharedDice dice(seed + 7000);
    Pair pair;
    Model model;
    const Program program[2] = {random_program(dice), random_program(dice)};
    for (unsigned i = 0; i < 2; ++i) pair.select(i, program[i].text);
    pair.start(3);
    const int feed_percent = dice.draw(20, 100);
    unsigned started = 0;
    for (unsigned n = 0; n < 400 || (!pair.idle() && n < 20000); ++n) {
      const bool calm = n >= 400;
      for (unsigned i = 0; i < 2; ++i) {
        pair.in[i].feed_hold = !calm && (pair.in[i].feed_hold ? !dice.chance(20) : dice.chance(2));
        pair.in[i].single_block = !calm && (pair.in[i].single_block ? !dice.chance(10) : dice.chance(3));
        pair.in[i].reset = !calm && dice.chance(1);
        resets += pair.in[i].reset;
        if (pair.out[i].state != NC_STATE_RUNNING && (!calm || pair.out[i].state != NC_STATE_IDLE) && dice.chance(30)) started |= 1u << i;
      }
      pair.cycle(started, calm || dice.chance(feed_percent));
      started = 0;
      for (const Pair::Mark& mark : pair.marks) {
        const auto found = program[mark.system].at.find(mark.line);
        if (found == program[mark.system].at.end()) continue;
        model.execute(mark.system, 0, found->second);
        writes += found->second.kind == Access::variable || found->second.kind == Access::tool;
      }
      pair.marks.clear();
      for (uint32_t number = 500; number < 504; ++number) {
        for (unsigned system = 0; system < 2; ++system) {
          const double value = pair.executed(system, number);
          ASSERT_EQ(std::isnan(value) ? 0 : value, model.value(Access::variable, number)) << "#" << number << " in part system " << system + 1 << " cycle " << n;
        }
      }
    }
    pair.cycles(3);
    ASSERT_TRUE(pair.idle());
    for (uint32_t number = 500; number < 504; ++number) {
      for (unsigned system = 0; system < 2; ++system) {
        const double value = pair.var(system, number);
        ASSERT_EQ(std::isnan(value) ? 0 : value, model.value(Access::variable, number)) << "#" << number << " in part system " << system + 1;
      }
    }
    for (unsigned n = 1; n <= 4; ++n) ASSERT_EQ(pair.bench.tool_now(n), model.value(Access::tool, n)) << "tool " << n;
  }
  EXPECT_GT(writes, 6 * count);
  EXPECT_GT(resets, count / 2);
}

}  // namespace
}  // namespace nc::test
