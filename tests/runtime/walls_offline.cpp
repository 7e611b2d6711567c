// SPDX-License-Identifier: Apache-2.0
// See walls_offline.hpp.
#include "walls_offline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <memory>

#include "hal/sim/input_script.hpp"
#include "runtime/macro_interface.hpp"

namespace nc::test {
namespace {

constexpr double kSamePoint = 1e-9;  // mm

struct FreeMemory {
  void operator()(void* memory) const { std::free(memory); }
};

double distance(const nc_axes& a, const nc_axes& b) {
  double most = 0;
  for (unsigned i = 0; i < NC_MAX_AXES; ++i) most = std::max(most, std::abs(a.v[i] - b.v[i]));
  return most;
}

// The machine of the offline run: its inputs come from the script, its skips from the recording.
class World {
 public:
  World(const rt::Config& config, const Recording& machine)
      : macro_(config.macro, {}), script_(config.sim.script), machine_(machine) {
    for (unsigned p = 0; p < config.points.size(); ++p) points_.value[p] = config.points.at(p).initial;
  }
  // An item is being executed.
  void see(const nc_item& item) {
    const bool strobe = item.kind == NC_ITEM_ACTION && item.u.action.kind == NC_ACTION_M;
    const auto m = strobe ? static_cast<std::uint32_t>(item.u.action.value) : 0;
    script_.step(0, item.source, strobe, m, &points_);
    if (strobe) script_.step(0, item.source, false, m, &points_);
  }
  nc_world answer(std::uint64_t serial, const nc_axes& here, const Pulled& last) const {
    nc_world world{};
    world.machine = here;
    world.clock_ms = rt::VirtualClock::kEpochMs;
    macro_.gather(points_, world.input);
    const auto found = machine_.syncs.find(serial);
    if (last.skip && found != machine_.syncs.end() &&
        distance(found->second.machine, last.end) > kSamePoint) {
      world.skipped = true;
      world.machine = found->second.machine;
      world.skip_machine = found->second.skip_machine;
    } else {
      world.skip_machine = here;
    }
    return world;
  }

 private:
  rt::MacroInterface macro_;
  hal::InputScript script_;
  hal::PointImage points_;
  const Recording& machine_;
};

}  // namespace

Listing pull_offline(const rt::Config& config, const std::string& text, const Operator& op,
                     const Recording& machine) {
  Listing listing;
  const std::size_t size = (nc_memory_required(&config.nc) + 63) / 64 * 64;
  const std::unique_ptr<void, FreeMemory> memory(std::aligned_alloc(64, size));
  nc_status status = NC_OK;
  nc_control* control = nc_create(&config.nc, memory.get(), size, &status);
  EXPECT_EQ(status, NC_OK);
  if (control == nullptr) return listing;
  for (const rt::ConfigError& error : rt::apply_config(config, control)) ADD_FAILURE() << error.text();
  unsigned file = 0;
  EXPECT_EQ(nc_program_add_text(control, "main.nc", text.data(), text.size(), &file), NC_OK);
  nc_switches_set(control, 0, op.optional_skip, 0);
  EXPECT_EQ(nc_program_select(control, 0, file), NC_OK);

  World world(config, machine);
  nc_axes here = config.start[0];
  Pulled last_skip;
  nc_item item;
  while ((status = nc_pull(control, 0, 10000, &item)) == NC_OK) {
    world.see(item);
    Pulled pulled{item.serial, item.kind, item.source.line, here, false, {}, {}};
    if (item.kind == NC_ITEM_MOVE) {
      here = pulled.machine = item.u.move.machine;
      pulled.skip = item.u.move.kind == NC_MOVE_SKIP;
      pulled.start = item.u.move.machine_start;
      pulled.end = item.u.move.machine;
      if (pulled.skip) last_skip = pulled;
    } else if (item.kind == NC_ITEM_SYNC) {
      ++listing.syncs;
      const bool skip = (item.u.sync.what & NC_SYNC_SKIP) != 0;
      const nc_world now = world.answer(item.serial, here, skip ? last_skip : Pulled{});
      listing.skips += now.skipped;
      here = pulled.machine = now.machine;
      if (skip) last_skip = {};
      EXPECT_EQ(nc_answer(control, 0, &now), NC_OK);
    } else if (item.kind == NC_ITEM_ALARM) {
      nc_alarm alarm{};
      EXPECT_EQ(nc_alarm_get(control, 0, &alarm), NC_OK);
      listing.alarm = alarm.code;
      listing.alarm_line = alarm.source.line;
    } else if (item.kind == NC_ITEM_END) {
      listing.ended = item.u.end.ok;
    }
    listing.items.push_back(pulled);
  }
  EXPECT_EQ(status, listing.alarm.empty() ? NC_ENDED : NC_ALARMED);
  for (unsigned w = 0; w < NC_WORDS; ++w) nc_interface_output_get(control, 0, w, &listing.interface_output[w]);
  std::uint32_t number = 0;
  double value = 0;
  for (std::uint32_t from = 0; nc_variable_next(control, 0, from, &number, &value) == NC_OK; from = number + 1)
    listing.variables[number] = value;
  return listing;
}

namespace {

// A skip move that the signal ended: its end is on the line, and inside the solid by no more than the way of braking and
// of the servo lag.
void expect_on_line(const Executed& done, const Pulled& move) {
  double length2 = 0, along = 0;
  for (unsigned i = 0; i < NC_MAX_AXES; ++i) {
    const double d = move.end.v[i] - move.start.v[i];
    length2 += d * d;
    along += d * (done.machine.v[i] - move.start.v[i]);
  }
  ASSERT_GT(length2, 0);
  const double t = along / length2;
  EXPECT_GE(t, -1e-12);
  EXPECT_LE(t, 1 + 1e-12);
  nc_axes foot{};
  for (unsigned i = 0; i < NC_MAX_AXES; ++i)
    foot.v[i] = move.start.v[i] + t * (move.end.v[i] - move.start.v[i]);
  EXPECT_LT(distance(foot, done.machine), kSamePoint) << "line " << move.line;
}

}  // namespace

void expect_same(const Recording& online, const Listing& offline, const rt::Config& config) {
  for (const std::string& violation : online.violations) ADD_FAILURE() << violation;
  EXPECT_EQ(online.dropped, 0u);
  EXPECT_EQ(online.alarm, offline.alarm);
  EXPECT_EQ(online.alarm_line, offline.alarm_line);
  ASSERT_EQ(online.items.size(), offline.items.size())
      << "last online line " << (online.items.empty() ? 0 : online.items.back().line);
  // In the optimal mode corners are rounded within the tolerance.
  const double same_point = config.nc.motion_mode == NC_MOTION_OPTIMAL ? config.nc.path_tolerance + kSamePoint : kSamePoint;
  for (std::size_t i = 0; i < online.items.size(); ++i) {
    const Executed& done = online.items[i];
    const Pulled& pulled = offline.items[i];
    ASSERT_EQ(done.serial, pulled.serial) << "item " << i << " line " << pulled.line;
    ASSERT_EQ(int{done.kind}, int{pulled.kind}) << "serial " << done.serial << " line " << pulled.line;
    ASSERT_EQ(done.line, pulled.line) << "serial " << done.serial;
    if (pulled.skip)
      expect_on_line(done, pulled);
    else
      ASSERT_LT(distance(done.machine, pulled.machine), same_point)
          << "serial " << done.serial << " line " << pulled.line << " kind " << int{done.kind};
  }
  if (offline.alarm.empty()) {
    EXPECT_EQ(online.variables, offline.variables);
    EXPECT_TRUE(online.ended_ok);
    // The image on the machine is that of the interpreter, both for words that are mapped and for those that are not.
    for (unsigned w = 0; w < NC_WORDS; ++w)
      EXPECT_EQ(online.interface_output[w], offline.interface_output[w]) << w;
  }
  EXPECT_GE(config.nc.system_count, 1);
}

}  // namespace nc::test
