// SPDX-License-Identifier: Apache-2.0
// A stand-in for libgpiod 1.6 in test_hal: the functions that hal/gpio/gpiod1_chip.cpp calls, as the header of that version describes them, for chips
// that the test makes. The linker prefers functions of the test program to those of the library. The tests show that the library is called correctly,
// but not what a kernel does.
#pragma once

#include <string>
#include <vector>

namespace nc::test {

struct StandInLine {
  std::string name;   // empty = unnamed
  std::string owner;  // another consumer; empty = free
  int level = 0;      // active = 1, as the library counts
  // As requested:
  std::string consumer;
  bool output = false;
  bool edges = false;
  int flags = 0;
  unsigned request = 0;  // number of the request, 0 = none
  struct Edge {
    bool rising = false;
    long seconds = 0, nanoseconds = 0;
  };
  std::vector<Edge> kept;  // edges that have not been read
};

struct StandInChip {
  std::string name, label;
  std::vector<StandInLine> lines;
  bool gone = false;  // pulled out while it is open
  int open_error = 0;  // errno of opening this one
};

struct StandIn {
  std::vector<StandInChip> chips;
  int open_error = 0;     // errno of every open
  int request_error = 0;  // errno of requests
  unsigned requests_before = 0;  // so many requests succeed before the error
  unsigned requests = 0, reads = 0, writes = 0;
  int open = 0;           // chips that are open
};

// The simulated computer of the running test.
StandIn& stand_in();

}  // namespace nc::test
