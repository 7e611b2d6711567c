// SPDX-License-Identifier: Apache-2.0
// The load of a bus with worst-case bit stuffing: how many axes are possible with which SYNC period.
#include "hal/canopen/bus_load.hpp"

#include <gtest/gtest.h>

namespace {

using namespace nc::hal::canopen;

BusMap axes(unsigned count, unsigned sync_us) {
  BusMap bus;
  bus.sync_us = sync_us;
  for (unsigned n = 0; n < count; ++n) {
    NodeMap node;
    node.id = n + 1;
    node.axes.emplace_back();
    bus.nodes.push_back(node);
  }
  return bus;
}

TEST(BusLoad, BitsOfAFrame) {
  EXPECT_EQ(worst_bits(0), 55u);
  EXPECT_EQ(worst_bits(6), 115u);
  EXPECT_EQ(worst_bits(7), 125u);
  EXPECT_EQ(worst_bits(8), 135u);
}

TEST(BusLoad, ThreeAxesRunAtOneMillisecondAndSixAtTwo) {
  EXPECT_LE(bus_load(axes(3, 1000)).share, kMostLoad);
  EXPECT_GT(bus_load(axes(4, 1000)).share, kMostLoad);
  EXPECT_LE(bus_load(axes(6, 2000)).share, kMostLoad);
  EXPECT_GT(bus_load(axes(8, 2000)).share, kMostLoad);
  EXPECT_NEAR(bus_load(axes(3, 1000)).share, 0.745, 0.005);  // heartbeats beside SYNC and PDOs
  EXPECT_NEAR(bus_load(axes(4, 1000)).share, 0.975, 0.005);
}

TEST(BusLoad, TheArithmeticIsSaid) {
  EXPECT_EQ(bus_load(axes(4, 1000)).arithmetic,
            "SYNC 55 + 8 PDOs of 6 bytes, 115 each + heartbeats 3.2 = 978.2 bits with worst-case stuffing, of 1000 bits in 1000 us at 1000000 bit/s: 97.8 %");
}

TEST(BusLoad, AProbeCostsALongerAndAnotherPdo) {
  BusMap bus = axes(1, 1000);
  const double before = bus_load(bus).share;
  bus.nodes[0].axes[0].skip_signal = 1;
  EXPECT_NEAR(bus_load(bus).share - before, (135.0 - 115 + 115) / 1000, 1e-9);
}

// An SDO exchange is two frames of 135 bits.
TEST(BusLoad, TheSlowPartTakesWhatIsLeft) {
  EXPECT_EQ(slow_every(axes(1, 1000)), 1u);
  const BusMap full = axes(3, 1000);
  const unsigned every = slow_every(full);
  EXPECT_GE(every, 2u);
  EXPECT_LE(bus_load(full).share + 0.270 / every, 0.95);
}

}  // namespace
