// SPDX-License-Identifier: Apache-2.0
// The ASCII frames of slcan, and the port through a pseudo terminal.
#include "hal/canopen/slcan_port.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>
#include <unistd.h>

#include "hal/canopen/socket_port.hpp"

namespace {

using namespace nc::hal::canopen;

std::vector<CanFrame> read_all(const std::string& text) {
  SlcanReader reader;
  std::vector<CanFrame> frames;
  CanFrame frame;
  for (const char c : text)
    if (reader.take(c, &frame)) frames.push_back(frame);
  return frames;
}

TEST(Slcan, AFrameIsWhatItSays) {
  CanFrame frame;
  frame.id = 0x60A;
  frame.length = 3;
  frame.data[0] = 0x01;
  frame.data[1] = 0xAB;
  frame.data[2] = 0xF0;
  char text[32];
  const std::string written(text, slcan_text(frame, text));
  EXPECT_EQ(written, "t60A301ABF0\r");
  const auto back = read_all(written + "t0800\rt1236" + "0102030405061234\r");  // with a time stamp
  ASSERT_EQ(back.size(), 3u);
  EXPECT_EQ(back[0].id, 0x60A);
  EXPECT_EQ(back[0].data[1], 0xAB);
  EXPECT_EQ(back[1].id, 0x080);
  EXPECT_EQ(back[1].length, 0);
  EXPECT_EQ(back[2].length, 6);
}

TEST(Slcan, WhatIsNoFrameIsPassedOver) {
  EXPECT_TRUE(read_all("z\r\a\rT0000060A0\rt\rt60A9\rt60A30\rtXYZ0\rt8000\rt60A201\a").empty());
  EXPECT_EQ(read_all(std::string(500, 'A') + "\rt0800\r").size(), 1u);
}

TEST(Slcan, ThroughAPseudoTerminal) {
  const int master = posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(master, 0);
  ASSERT_EQ(grantpt(master), 0);
  ASSERT_EQ(unlockpt(master), 0);
  const auto port = make_port(std::string("slcan:") + ptsname(master), 1'000'000);
  std::string error;
  ASSERT_TRUE(port->open(&error)) << error;
  char text[64] = {};
  ASSERT_EQ(read(master, text, sizeof text), 7);
  EXPECT_EQ(std::string(text), "C\rS8\rO\r");
  CanFrame frame;
  frame.id = 0x80;
  EXPECT_TRUE(port->send(frame));
  ASSERT_EQ(read(master, text, sizeof text), 6);
  EXPECT_EQ(std::string(text, 6), "t0800\r");
  EXPECT_FALSE(port->receive(&frame));
  ASSERT_EQ(write(master, "t1812", 5), 5);
  EXPECT_FALSE(port->receive(&frame));
  ASSERT_EQ(write(master, "64F5\r", 5), 5);
  bool got = false;
  for (int i = 0; i < 1000 && !got; ++i) {
    got = port->receive(&frame);
    if (!got) poll(nullptr, 0, 1);
  }
  EXPECT_TRUE(got);
  EXPECT_EQ(frame.id, 0x181);
  EXPECT_EQ(frame.data[0], 0x64);
  EXPECT_EQ(frame.data[1], 0xF5);
  port->close();
  close(master);
}

TEST(Slcan, WhatCannotBeOpenedSaysWhy) {
  std::string error;
  EXPECT_FALSE(make_port("slcan:/nowhere/tty", 1'000'000)->open(&error));
  EXPECT_EQ(error, "/nowhere/tty: No such file or directory");
  EXPECT_FALSE(make_port("slcan:/dev/null", 123)->open(&error));
  EXPECT_EQ(error, "slcan has no bit rate of 123 bit/s");
  EXPECT_FALSE(SocketPort("an_interface_name_that_is_too_long").open(&error));
  EXPECT_EQ(error, "no interface can have this name");
  EXPECT_FALSE(SocketPort("nocan9").open(&error));  // there is no CAN, or no such interface
  EXPECT_FALSE(error.empty());
}

}  // namespace
