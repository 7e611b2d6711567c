// SPDX-License-Identifier: Apache-2.0
// A signal that ends a program is noted, named, and becomes its exit status.
#include "runtime/end_signal.hpp"

#include <gtest/gtest.h>

namespace {

using nc::rt::end_signal;

// Restores the signal handlers that the test program had.
class EndSignal : public testing::Test {
 protected:
  void TearDown() override {
    for (const int number : {SIGHUP, SIGQUIT, SIGPIPE}) std::signal(number, SIG_DFL);
  }
};

TEST_F(EndSignal, IsNotedAndForgottenByTheNextCall) {
  nc::rt::catch_end_signals({SIGHUP, SIGQUIT});
  EXPECT_EQ(end_signal(), 0);
  ASSERT_EQ(std::raise(SIGHUP), 0);
  EXPECT_EQ(end_signal(), SIGHUP);
  EXPECT_EQ(*nc::rt::end_signal_place(), SIGHUP);
  ASSERT_EQ(std::raise(SIGQUIT), 0);
  EXPECT_EQ(end_signal(), SIGQUIT);
  nc::rt::catch_end_signals({SIGHUP});
  EXPECT_EQ(end_signal(), 0);
}

TEST_F(EndSignal, APipeWithoutAReaderIsNone) {
  nc::rt::catch_end_signals({});
  ASSERT_EQ(std::raise(SIGPIPE), 0);
  EXPECT_EQ(end_signal(), 0);
}

TEST_F(EndSignal, HasANameAndAStatus) {
  EXPECT_STREQ(nc::rt::signal_name(SIGINT), "SIGINT");
  EXPECT_STREQ(nc::rt::signal_name(SIGHUP), "SIGHUP");
  EXPECT_STREQ(nc::rt::signal_name(SIGQUIT), "SIGQUIT");
  EXPECT_STREQ(nc::rt::signal_name(SIGTERM), "SIGTERM");
  EXPECT_EQ(nc::rt::exit_status_of_signal(SIGINT), 130);
  EXPECT_EQ(nc::rt::exit_status_of_signal(SIGTERM), 143);
}

}  // namespace
