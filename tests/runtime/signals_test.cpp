// SPDX-License-Identifier: Apache-2.0
// The table of signals: its rows are complete, its names differ, and docs/signals.md was made from it.
#include "runtime/signals/signal_table.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "places/places.hpp"
#include "test_config.hpp"

namespace {

using namespace nc::rt;

TEST(Signals, EveryRowIsComplete) {
  for (unsigned r = 0; r < kSignalCount; ++r) {
    const SignalRow& row = kSignals[r];
    EXPECT_NE(std::string(row.meaning), "") << row.name;
    EXPECT_NE(std::string(row.timing), "") << row.name;
    EXPECT_EQ(row.read != nullptr, row.direction == SignalDirection::kFromNc) << row.name;
    EXPECT_EQ(row.write != nullptr, row.direction == SignalDirection::kToNc) << row.name;
    const bool numbered = row.scope == SignalScope::kNumbered || row.scope == SignalScope::kNumberedControl;
    EXPECT_EQ(row.count != 0, numbered) << row.name;
    const std::string name = row.name;
    const bool active_low = name.size() > 2 && name.substr(name.size() - 2) == "_n";
    EXPECT_EQ(active_low, row.safe == 1 && row.type == nc::ladder::DeviceType::kBit) << row.name;
  }
}

TEST(Signals, NamesOfAMachineDiffer) {
  const Config config = nc::test::parse_or_fail(nc::test::base_toml());
  std::set<std::string> names;
  for (const Signal& signal : machine_signals(config.nc)) EXPECT_TRUE(names.insert(signal.name).second) << signal.name;
  for (const char* name : {"nc.m_strobe", "nc.position.X", "plc.skip.8", "plc.alarm.1", "plc.fin1"})
    EXPECT_EQ(names.count(name), 1u) << name;
}

// With the safe values the NC does the same as without a ladder: none of them holds, starts or changes anything.
TEST(Signals, SafeValuesAskForNothing) {
  const Config config = nc::test::parse_or_fail(nc::test::base_toml());
  nc_inputs in[NC_MAX_SYSTEMS] = {};
  in[0].feed_override = 0.7;
  in[0].single_block = true;
  LadderRequests requests;
  LadderImage image{};
  image.nc_in = in;
  image.requests = &requests;
  for (const Signal& signal : machine_signals(config.nc))
    if (signal.row->write != nullptr) signal.row->write(signal.row->safe, &image, signal.system, signal.index);
  EXPECT_FALSE(in[0].feed_hold || in[0].interlock || in[0].fin || in[0].fin2 || in[0].cycle_start || in[0].reset);
  EXPECT_TRUE(in[0].single_block) << "the operator's switch stays";
  EXPECT_EQ(in[0].skip, 0u);
  EXPECT_EQ(in[0].feed_override, 0.7);
  EXPECT_FALSE(requests.cycle_start || requests.reset || requests.mode[0] || requests.mode[1] || requests.mode[2]);
  EXPECT_EQ(requests.alarm, 0u);
}

TEST(Signals, TheDocumentIsMadeOfTheTable) {
  std::ifstream file(nc::test::kSourceDir + "/docs/signals.md");
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_NE(text.str().find(signal_document()), std::string::npos)
      << "docs/signals.md must hold the tables below:\n"
      << signal_document();
}

}  // namespace
