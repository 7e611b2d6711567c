// SPDX-License-Identifier: Apache-2.0
// Any bytes as a program: the first two bytes choose the dialect, the parameters and how the world answers, the rest is the text. It is
// pulled with rewinds in between, or fed to a machine for some cycles. Nothing may crash, hang, lose a serial, or give a position that
// is no number.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "nc/nc.h"

namespace {

constexpr unsigned kMaxItems = 2000, kMaxIdle = 500, kCycles = 600;

struct Release {
  void operator()(void* memory) const { std::free(memory); }
};

/// Ends the run and names the line of this file whose requirement does not hold, so that the log alone tells what was found.
void require(bool holds, int line = __builtin_LINE()) {
  if (holds) return;
  std::fprintf(stderr, "ERROR: what program_fuzz.cpp requires in line %d does not hold\n", line);
  std::abort();
}

void require_finite(const nc_axes& axes, int line = __builtin_LINE()) {
  for (const double v : axes.v) require(std::isfinite(v), line);
}

struct Chosen {
  nc_dialect dialect;
  uint8_t options, world;
};

nc_config configuration(const Chosen& chosen) {
  nc_config config;
  nc_config_init(&config);
  config.dialect = static_cast<uint8_t>(chosen.dialect);
  config.look_ahead = 64;
  config.programs = 4;
  config.tool_offsets = 20;
  config.work_offsets = 4;
  config.window_bytes = 512;
  nc_system_config& system = config.system[0];
  system.axis_count = 4;
  for (unsigned i = 0; i < 4; ++i) {
    nc_axis_config& axis = system.axis[i];
    axis.name = "XYZA"[i];
    axis.rotary = i == 3;
    axis.rapid = 200;
    axis.max_velocity = 150;
    axis.max_acceleration = 2000;
    axis.in_position = 0.01;
    if ((chosen.options & 1) != 0) {
      axis.soft_limited = true;
      axis.soft_min = -500;
      axis.soft_max = 500;
    }
  }
  return config;
}

void set_parameters(nc_control* control, const Chosen& chosen) {
  auto set = [&](const char* key, bool on, const char* yes = "1", const char* no = "0") {
    require(nc_parameter_set(control, 0, key, 0, on ? yes : no) == NC_OK);
  };
  const uint8_t o = chosen.options;
  if (chosen.dialect == NC_DIALECT_M700) {
    set("1078", (o & 2) != 0);
    set("1037", (o & 4) != 0, "2", "1");
    set("1229/bit2", (o & 8) != 0);
    set("8102", (o & 16) != 0);
    set("8103", (o & 32) != 0);
    set("1080", (o & 64) != 0);
    set("8101", (o & 64) != 0);
    set("macro_extensions", (o & 1) != 0);
    set("1112", (o & 32) != 0);
    set("1113", (o & 8) != 0);
    set("1229/bit0", (o & 16) != 0);
    set("7202", (o & 2) != 0, "1", "3");
    // G120 calls O7, M50 calls O8, D calls O7 with its value in #130.
    constexpr const char* kCalls[][2] = {{"7201", "120"}, {"7203", "7"}, {"7001", "50"}, {"7003", "8"}, {"7401", "1"},
                                         {"7402", "D"},   {"7403", "0"}, {"7404", "7"},  {"7405", "130"}};
    for (const auto& call : kCalls) require(nc_parameter_set(control, 0, call[0], 0, call[1]) == NC_OK);
    require(nc_parameter_set(control, 0, "2106", 'A', (o & 2) != 0 ? "5" : "0") == NC_OK);
    require(nc_parameter_set(control, 0, "8213", 'A', (o & 16) != 0 ? "0" : (o & 8) != 0 ? "1" : (o & 32) != 0 ? "2" : "3") == NC_OK);
  } else if (chosen.dialect == NC_DIALECT_ISO || chosen.dialect == NC_DIALECT_SERIES8) {
    set("power_on_unit", (o & 2) != 0, "inch", "mm");
  } else if (chosen.dialect == NC_DIALECT_HX) {
    for (const char* key : {"3072", "3120", "3128", "3147"}) set(key, (o & 2) != 0);
    for (const char* key : {"3144", "3146", "3155", "23474"}) set(key, (o & 8) != 0);
    // G120 and M50 call O9010 and O9020, T calls O9000; factors, an overrun and a reference position of an axis.
    constexpr const char* kValues[][2] = {{"3085", "120"}, {"3095", "50"}, {"3105", "1"}, {"3108", "1500"}, {"3117", "30"}, {"3061", "-1"}, {"22097", "5"}};
    for (const auto& value : kValues) require(nc_parameter_set(control, 0, value[0], 0, value[1]) == NC_OK);
  } else {
    set("interpretation", (o & 2) != 0, "calculator", "conventional");
    set("startup", (o & 8) != 0, "B", "A");
  }
  for (unsigned n = 1; n <= 20; ++n) {
    for (unsigned column = 0; column < 4; ++column)
      require(nc_tool_offset_set(control, n, static_cast<nc_tool_column>(column), 0.3 * n - 2) == NC_OK);
  }
  if ((o & 4) != 0) nc_switches_set(control, 0, 0xaa, 0);
}

nc_world world_for(const nc_axes& machine, const nc_item& sync, uint8_t seed) {
  nc_world world{};
  world.machine = machine;
  for (unsigned i = 0; i < NC_WORDS; ++i) world.input[i] = (seed * 2654435761u) >> (i * 3) ^ static_cast<uint32_t>(sync.serial);
  world.clock_ms = 1767225600000 + static_cast<int64_t>(sync.serial) * 60000;
  world.power_on_ms = static_cast<double>(sync.serial) * 7;
  world.run_ms = static_cast<double>(sync.serial);
  return world;
}

/// Offline: the items come in order, all numbers are finite, every sync is answered; now and then it rewinds to the last mark.
void pull(nc_control* control, const Chosen& chosen) {
  uint64_t serial = 0, last_mark = 0;
  nc_axes machine{}, from{}, at_mark{};
  unsigned idle = 0, rewinds = 0;
  bool ended = false;
  for (unsigned items = 0; items < kMaxItems && idle < kMaxIdle; ++items) {
    nc_item item;
    const nc_status status = nc_pull(control, 0, 16, &item);
    if (status == NC_BUDGET) {
      ++idle;
      continue;
    }
    if (status != NC_OK) {
      require(status == NC_ENDED || status == NC_ALARMED);
      require(ended);  // the end is an item
      nc_alarm alarm;
      require((nc_alarm_get(control, 0, &alarm) == NC_OK) == (status == NC_ALARMED));
      if (status == NC_ALARMED) require(alarm.code[0] != 0 && alarm.detail.s[0] != 0 && alarm.source.line > 0);
      nc_source calls[NC_MAX_CALLS];
      const unsigned count = nc_alarm_calls_get(control, 0, calls, NC_MAX_CALLS);
      require(count <= NC_MAX_CALLS && (count != 0) == (status == NC_ALARMED));
      for (unsigned i = 0; i < count; ++i) require(calls[i].depth == i && calls[i].line > 0);
      require(count == 0 || (calls[count - 1].line == alarm.source.line && calls[count - 1].file == alarm.source.file));
      return;
    }
    require(!ended);
    require(item.serial == serial + 1);
    if ((chosen.world & 16) != 0 && (item.serial * 7 + chosen.world) % 11 < 2) {  // the interrupt signal comes and goes
      bool take_back = false;
      require(nc_interrupt_signal(control, 0, (item.serial * 7 + chosen.world) % 11 == 0, &take_back) == NC_OK);
      if (take_back) continue;  // the item was not executed: its serial comes again
    }
    serial = item.serial;
    if (item.kind == NC_ITEM_MOVE) {
      const nc_move& m = item.u.move;
      require_finite(m.work);
      require_finite(m.machine);
      require_finite(m.machine_start);
      require(std::isfinite(m.length) && m.length > 0 && std::isfinite(m.sweep_deg) && std::isfinite(m.radius));
      require(m.kind == NC_MOVE_RAPID || m.feed_mm_min > 0 || m.feed_mm_rev > 0);
      from = m.machine_start;
      machine = m.machine;
    } else if (item.kind == NC_ITEM_SYNC) {
      nc_world world = world_for(machine, item, chosen.world);
      if ((item.u.sync.what & NC_SYNC_SKIP) != 0 && (item.serial + chosen.world) % 2 == 0) {
        for (unsigned i = 0; i < NC_MAX_AXES; ++i) world.skip_machine.v[i] = (from.v[i] + machine.v[i]) / 2;
        world.machine = machine = world.skip_machine;
        world.skipped = true;
      }
      require(nc_answer(control, 0, &world) == NC_OK);
    } else if (item.kind == NC_ITEM_MARK) {
      require_finite(item.u.mark.work);
      if (item.u.mark.report) last_mark = serial, at_mark = machine;
      nc_modal modal;
      require(nc_modal_get(control, 0, item.u.mark.modal, &modal) == NC_OK);
    } else if (item.kind == NC_ITEM_END) {
      require_finite(item.u.end.work);
      ended = true;
    }
    if (last_mark != 0 && !ended && rewinds < 50 && (serial * 31 + chosen.world) % 23 == 0) {
      require(nc_rewind(control, 0, last_mark) == NC_OK);
      serial = last_mark;
      machine = at_mark;
      ++rewinds;
    }
  }
}

/// Online: a machine that follows and completes everything, and is stopped and started again.
void cycle(nc_control* control, const Chosen& chosen) {
  nc_inputs in{};
  nc_outputs out{};
  for (unsigned n = 0; n < kCycles; ++n) {
    in.cycle_start = n % 10 == 1;
    in.feed_hold = ((n + chosen.world) >> 6) % 7 == 3;
    in.single_block = (chosen.world & 1) != 0 && (n >> 7) % 2 == 0;
    in.optional_stop = (chosen.world & 2) != 0;
    in.fin = n % 5 == 4;
    in.macro_interrupt = (chosen.world & 16) != 0 && n % 83 == 40;
    in.reset = (chosen.world & 4) != 0 && n == kCycles / 2;
    in.feed_override = 0.5 + 0.25 * ((n >> 5) % 5);
    in.rapid_override = 1;
    in.spindle[0].rev_per_s = 20;
    in.skip = n % 97 == 50 ? 1 : 0;
    in.input[0] = n;
    nc_feed(control, 64);
    if ((chosen.world & 8) != 0 && n % 301 == 300) nc_recalculate(control, 0);
    nc_cycle(control, &in, &out);
    require_finite(out.command);
    require_finite(out.velocity);
    nc_event event;
    while (nc_event_poll(control, 0, &event, nullptr) == NC_OK) require_finite(event.machine);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size < 2) return 0;
  // Bit 0 of the first and bit 6 of the second byte choose among the other families.
  const nc_dialect with_bit = (data[1] & 0x40) != 0 ? NC_DIALECT_SERIES8 : NC_DIALECT_HX, without = (data[1] & 0x40) != 0 ? NC_DIALECT_ISO : NC_DIALECT_DGSHAPE;
  const nc_dialect other = (data[0] & 1) != 0 ? with_bit : without;
  const Chosen chosen{(data[0] & 0x80) != 0 ? other : NC_DIALECT_M700, static_cast<uint8_t>(data[0] & 0x7f), data[1]};
  const std::string text(reinterpret_cast<const char*>(data + 2), size - 2);
  const nc_config config = configuration(chosen);
  const size_t bytes = nc_memory_required(&config);
  require(bytes != 0);
  // The same memory for all inputs: nc_create() must work with any contents.
  static const std::unique_ptr<void, Release> memory(std::aligned_alloc(64, size_t{1} << 22));
  require(memory != nullptr && bytes <= size_t{1} << 22);
  nc_control* control = nc_create(&config, memory.get(), bytes, nullptr);
  require(control != nullptr);
  set_parameters(control, chosen);
  unsigned file = 0;
  require(nc_program_add_text(control, "O9999.nc", text.data(), text.size(), &file) == NC_OK);
  require(nc_program_select(control, 0, file) == NC_OK);
  if ((chosen.world & 0x80) != 0) {
    cycle(control, chosen);
  } else {
    pull(control, chosen);
  }
  return 0;
}
