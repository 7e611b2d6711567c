// SPDX-License-Identifier: Apache-2.0
// Two part systems on one bench, offline and on the machine.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/pull.hpp"

namespace nc::test {

inline void two_systems(nc_config& c) {
  c.look_ahead = 64;
  c.cycle_s = 0.004;
  c.system_count = 2;
  c.system[1] = c.system[0];
}

/// Two part systems on one bench.
class Pair {
 public:
  explicit Pair(nc_dialect dialect = NC_DIALECT_M700) : bench(dialect, two_systems) {}

  void select(unsigned system, const std::string& text) {
    EXPECT_EQ(nc_program_select(control(), system, bench.add("main" + std::to_string(system), text)), NC_OK);
  }
  nc_control* control() { return bench.control(); }
  /// The value of a variable for a part system, with what it has read ahead; NaN = vacant.
  double var(unsigned system, uint32_t number) {
    double value = 0;
    bool vacant = false;
    EXPECT_EQ(nc_variable_get(control(), system, number, &value, &vacant), NC_OK);
    return vacant ? NAN : value;
  }
  /// The same value as the executed blocks have left it.
  double executed(unsigned system, uint32_t number) {
    struct Look {
      unsigned system;
      uint32_t number;
      double value;
      bool vacant;
    } look{system, number, 0, false};
    nc_look_executed(
        control(),
        [](void* user, const nc_control* seen) {
          Look& to = *static_cast<Look*>(user);
          nc_variable_get(seen, to.system, to.number, &to.value, &to.vacant);
        },
        &look);
    return look.vacant ? NAN : look.value;
  }
  void expect(uint32_t number, double value) {
    for (unsigned system = 0; system < 2; ++system) {
      EXPECT_EQ(brief(var(system, number)), brief(value)) << "#" << number << " in part system " << system + 1;
    }
  }

  // ---- offline
  /// Pulls the next item, and answers a sync; false if there is none.
  bool pull(unsigned system, nc_item* item) {
    nc_status status = NC_BUDGET;
    while (status == NC_BUDGET) status = nc_pull(control(), system, 100, item);
    if (status != NC_OK) return false;
    if (item->kind == NC_ITEM_MOVE) machine_[system] = item->u.move.machine;
    if (item->kind == NC_ITEM_SYNC) {
      nc_world world{};
      world.machine = machine_[system];
      EXPECT_EQ(nc_answer(control(), system, &world), NC_OK);
      ++syncs[system];
    }
    if (item->kind == NC_ITEM_ALARM) ADD_FAILURE() << "alarm in part system " << system + 1;
    return true;
  }
  void finish(unsigned system) {
    nc_item item{};
    while (pull(system, &item)) {
    }
  }
  void run(unsigned system, const std::string& text) {
    select(system, text);
    finish(system);
  }
  nc_axes machine(unsigned system) const { return machine_[system]; }

  // ---- online
  nc_inputs in[2] = {};
  nc_outputs out[2] = {};
  unsigned syncs[2] = {};
  struct Mark {
    unsigned system;
    uint32_t line;
  };
  std::vector<Mark> marks;  ///< the executed blocks of both part systems, in the order of execution
  /// One cycle of the machine; `start`: bit n starts part system n.
  void cycle(unsigned start = 0, bool feed = true) {
    if (feed) nc_feed(control(), 100);
    for (unsigned i = 0; i < 2; ++i) {
      in[i].feed_override = in[i].rapid_override = 1;
      in[i].cycle_start = (start >> i & 1) != 0;
      in[i].fin = out[i].strobe != 0;
    }
    nc_cycle(control(), in, out);
    nc_event event;
    uint64_t dropped = 0;
    for (unsigned i = 0; i < 2; ++i) {
      while (nc_event_poll(control(), i, &event, &dropped) == NC_OK)
        if (event.kind == NC_ITEM_MARK) marks.push_back({i, event.source.line});
    }
  }
  void cycles(unsigned count) {
    for (unsigned n = 0; n < count; ++n) cycle();
  }
  void start(unsigned systems) {
    cycles(2);
    cycle(systems);
    cycle();
  }
  /// Starts both part systems and drives them to their ends, fed by `any(0, n)` as it falls: often late, and a little at a time.
  template <class Any>
  void run_unevenly(const Any& any) {
    nc_inputs given[2] = {};
    nc_outputs got[2] = {};
    bool running = true;
    for (unsigned n = 0; running && n < 20000; ++n) {
      for (unsigned system = 0; system < 2; ++system) {
        given[system].cycle_start = n == 2;
        given[system].fin = got[system].strobe != 0;
      }
      if (any(0, 3) != 0) nc_feed(control(), any(1, 60));
      nc_cycle(control(), given, got);
      running = n < 10 || got[0].state != NC_STATE_IDLE || got[1].state != NC_STATE_IDLE;
    }
    ASSERT_FALSE(running);
    while (nc_feed(control(), 1000) == NC_BUDGET) {
    }
  }
  bool idle() const { return out[0].state == NC_STATE_IDLE && out[1].state == NC_STATE_IDLE; }
  void to_the_end() {
    for (unsigned n = 0; n < 20000 && !idle(); ++n) cycle();
    EXPECT_TRUE(idle());
    cycles(2);
  }
  void reset(unsigned system) {
    in[system].reset = true;
    cycles(3);
    in[system].reset = false;
    cycles(2);
  }

  Bench bench;

 private:
  nc_axes machine_[2] = {};
};

}  // namespace nc::test
