// SPDX-License-Identifier: Apache-2.0
// nc_look_executed(): in the middle of a run it shows the tables as the executed blocks have left them, and the look changes nothing.
#include <gtest/gtest.h>

#include "support/pull.hpp"
#include "support/random_program.hpp"

namespace nc::test {
namespace {

constexpr uint32_t kPrograms = 40;

std::function<void(nc_config&)> machine(uint32_t look_ahead) {
  return [look_ahead](nc_config& c) {
    c.look_ahead = look_ahead;
    c.cycle_s = 0.004;
    for (unsigned i = 0; i < 3; ++i) {
      c.system[0].axis[i].rapid = 2000;
      c.system[0].axis[i].max_velocity = 1500;
      c.system[0].axis[i].max_acceleration = 50000;
    }
  };
}

void prepare(Bench& bench, const RandomProgram& program) {
  for (unsigned n = 1; n <= 9; ++n) bench.tool(n, 0.2 * n);
  bench.work_offset(1, {1, 2, 3}).param("8103", "1").param("8013", "0.5").param("8012", "0.3");
  for (size_t i = 0; i < program.subs.size(); ++i) bench.add("O" + std::to_string(i + 1), program.subs[i]);
}

/// Everything that is kept while the power is off, as text.
std::string tables(const nc_control* control) {
  std::string all;
  double value = 0;
  for (unsigned n = 1; n <= 20; ++n)
    for (unsigned column = 0; column < 4; ++column)
      if (nc_tool_offset_get(control, n, static_cast<nc_tool_column>(column), &value) == NC_OK) all += brief(value) + " ";
  for (unsigned index : {0u, 1u, 2u, 3u, 4u, 5u, 6u, 101u, 102u})
    for (unsigned axis = 0; axis < 3; ++axis)
      if (nc_work_offset_get(control, 0, index, axis, &value) == NC_OK) all += brief(value) + " ";
  uint32_t number = 0;
  for (; nc_variable_next(control, 0, number, &number, &value) == NC_OK; ++number) all += std::to_string(number) + "=" + brief(value) + " ";
  char name[8] = "", key[24] = "", text[64] = "", axis = 0;
  for (number = 500; number < 520; ++number)
    if (nc_variable_name_get(control, number, name) == NC_OK && name[0] != 0) all += std::to_string(number) + name + " ";
  for (unsigned place = 0; nc_parameter_next(control, 0, place, &place, key, &axis, &value, text) == NC_OK; ++place)
    all += std::string(key) + (axis != 0 ? std::string(1, axis) : "") + "=" + brief(text[0] != 0 ? 0 : value) + text + " ";
  return all;
}

std::string executed(nc_control* control) {
  std::string all;
  nc_look_executed(control, [](void* to, const nc_control* c) { *static_cast<std::string*>(to) = tables(c); }, &all);
  return all;
}

/// Runs for so many cycles; returns the serial of the last block end that was executed, 0 if there is none.
uint64_t run_for(Bench& bench, const std::string& text, unsigned cycles, nc_outputs* out) {
  bench.start(text);
  nc_control* control = bench.control();
  nc_inputs in{};
  in.feed_override = in.rapid_override = 1;
  in.spindle[0].rev_per_s = 50;
  uint64_t last = 0;
  for (unsigned n = 0; n < cycles; ++n) {
    nc_feed(control, 100);
    in.cycle_start = n == 2;
    in.fin = out->strobe != 0;
    nc_cycle(control, &in, out);
    nc_event event;
    uint64_t dropped = 0;
    while (nc_event_poll(control, 0, &event, &dropped) == NC_OK)
      if (event.kind == NC_ITEM_MARK) last = event.serial;
  }
  return last;
}

TEST(Executed, ALookShowsWhatTheExecutedBlocksHaveDone) {
  unsigned inside = 0, ahead = 0;
  for (uint32_t seed = 0; seed < 3 * kPrograms; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const RandomProgram program = ProgramMaker(seed + 2600, false).make();
    Bench online(NC_DIALECT_M700, machine(128));
    prepare(online, program);
    nc_outputs out{};
    const uint64_t last = run_for(online, program.main, 4 + seed * seed % 397, &out);
    const std::string read = tables(online.control());
    const std::string seen = executed(online.control());
    ASSERT_EQ(tables(online.control()), read) << "the look has changed something";
    ASSERT_EQ(executed(online.control()), seen);
    if (out.state == NC_STATE_IDLE) continue;
    Bench offline(NC_DIALECT_M700, machine(128));
    prepare(offline, program);
    offline.start(program.main);
    Step step;
    step.item.serial = 0;
    while (step.item.serial < last && offline.pull(&step) >= NC_OK) {
    }
    inside += last > 0 && step.item.serial == last;
    ahead += seen != read;
    nc_reset(offline.control(), 0);  // takes back what the interpreter has read beyond that item
    ASSERT_EQ(seen, tables(offline.control())) << "behind item " << last;
  }
  EXPECT_GT(inside, kPrograms);
  EXPECT_GT(ahead, kPrograms / 2) << "something had been read ahead";
}

TEST(Executed, EveryKindOfWrite) {
  for (const char* ahead : {"G10 L2 P1 Y3.", "G10 L20 P2 X4.", "#5222=3", "#500=7", "#100=1", "#501=#0", "SETVN500[NAME]", "G10 L10 P1 R50.", "#2001=5",
                            "G10 L70\nP8075 D0.5\nG11", "G10 L70\nP2037 A2 D-3.\nG11"}) {
    SCOPED_TRACE(ahead);
    Bench bench(NC_DIALECT_M700, machine(64));
    bench.tool(1, 10).param("8075", "0.25").var(501, 9);
    const std::string before = tables(bench.control());
    nc_outputs out{};
    run_for(bench, std::string("G1 X100. F1000\n") + ahead + "\nG1 X0\nM30", 50, &out);
    ASSERT_EQ(out.state, NC_STATE_RUNNING);
    EXPECT_NE(tables(bench.control()), before);
    EXPECT_EQ(executed(bench.control()), before);
    Bench done(NC_DIALECT_M700, machine(64));
    done.tool(1, 10).param("8075", "0.25").var(501, 9);
    run_for(done, std::string(ahead) + "\nG1 X100. F1000\nM30", 50, &out);
    ASSERT_EQ(out.state, NC_STATE_RUNNING);
    EXPECT_NE(executed(done.control()), before) << "it has been executed";
    EXPECT_EQ(executed(done.control()), tables(done.control()));
  }
}

TEST(Executed, WithoutARunItIsWhatIsThere) {
  Bench bench;
  bench.var(500, 3);
  EXPECT_EQ(executed(bench.control()), tables(bench.control()));
  nc_look_executed(nullptr, [](void*, const nc_control*) { FAIL(); }, nullptr);
  nc_look_executed(bench.control(), nullptr, nullptr);
  char key[24] = "", text[64] = "", axis = 0;
  unsigned place = 7;
  double value = 0;
  EXPECT_EQ(nc_parameter_next(bench.control(), 0, 100000, &place, key, &axis, &value, text), NC_E_NOT_FOUND);
  EXPECT_EQ(nc_parameter_next(bench.control(), 9, 0, &place, key, &axis, &value, text), NC_E_ARGUMENT);
  EXPECT_EQ(nc_parameter_next(bench.control(), 0, 0, &place, nullptr, &axis, &value, text), NC_E_ARGUMENT);
  EXPECT_EQ(nc_parameter_next(bench.control(), 0, 0, nullptr, key, &axis, &value, text), NC_E_ARGUMENT);
  EXPECT_EQ(place, 7u);
}

TEST(Executed, TheNextParameterIsOneThatIsSet) {
  Bench bench;
  bench.param("8075", "0.25");
  EXPECT_EQ(bench.run("G10 L70\nP8013 D2\nG11\nM30").alarm, "");
  ASSERT_EQ(bench.rewind(0, nc_axes{}), NC_OK);  // the program has set #8013, which is taken back
  bench.param("1037", "2");
  char key[24] = "", text[64] = "", axis = 0;
  unsigned place = 0;
  double value = 0;
  std::string keys;
  for (; nc_parameter_next(bench.control(), 0, place, &place, key, &axis, &value, text) == NC_OK; ++place)
    keys += std::string(key) + "=" + brief(value) + " ";
  EXPECT_EQ(keys, "8075=0.25 1037=2 ");
}

}  // namespace
}  // namespace nc::test
