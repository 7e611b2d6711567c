// SPDX-License-Identifier: Apache-2.0
// Callers that were compiled with other headers: their structs end earlier than those of this library, or have more members at the end.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <limits>
#include <memory>

#include "nc/nc.h"

namespace {

// ---- structs as an older header could have had them: only the first members -------------------------------------------------

struct OldConfig {
  uint32_t struct_size;
  uint8_t dialect, system_count;
  nc_system_config system[NC_MAX_SYSTEMS];
  double cycle_s;
  uint32_t look_ahead;
  uint32_t programs;
};
static_assert(offsetof(OldConfig, programs) == offsetof(nc_config, programs));

struct alignas(nc_inputs) OldInputs {
  uint32_t struct_size;
  bool cycle_start, feed_hold, reset, single_block, optional_stop, fin, fin2, interlock, alarm, recalculate, macro_interrupt;
  uint32_t mirror, unclamped, skip;
  uint32_t input[NC_WORDS];
};
static_assert(offsetof(OldInputs, input) == offsetof(nc_inputs, input));

struct OldOutputs {
  uint32_t struct_size;
  nc_axes command, velocity;
  uint32_t output[NC_WORDS], output_written[NC_WORDS];
  uint8_t state, cause;
};
static_assert(offsetof(OldOutputs, cause) == offsetof(nc_outputs, cause));

/// The whole structs of the first version with this SONAME.
struct alignas(nc_inputs) FirstInputs {
  unsigned char bytes[offsetof(nc_inputs, tool_broken) + sizeof(nc_inputs::tool_broken)];
};
struct alignas(nc_outputs) FirstOutputs {
  unsigned char bytes[offsetof(nc_outputs, tool_group) + sizeof(nc_outputs::tool_group)];
};

struct OldWorld {
  uint32_t struct_size;
  nc_axes machine, skip_machine;
  uint32_t input[NC_WORDS];
};
static_assert(offsetof(OldWorld, input) == offsetof(nc_world, input));

struct OldEvent {
  uint32_t struct_size;
  uint64_t serial;
  nc_source source;
};
static_assert(offsetof(OldEvent, source) == offsetof(nc_event, source));

struct OldAlarm {
  uint32_t struct_size;
  char code[16];
  char message[64];
};
static_assert(offsetof(OldAlarm, message) == offsetof(nc_alarm, message));

struct OldItem {
  uint32_t struct_size;
  uint64_t serial;
  nc_source source;
  uint8_t kind;
};
static_assert(offsetof(OldItem, kind) == offsetof(nc_item, kind));

/// The bytes behind a struct of the caller, which nobody may change.
constexpr uint64_t kGuard = 0x5a5aa5a55a5aa5a5;

template <class Old>
struct Guarded {
  Old old{};
  uint64_t behind = kGuard;
  Guarded() { old.struct_size = sizeof(Old); }
};

/// A struct as a newer header could have it.
template <class T>
struct Newer {
  T known{};
  double later = 0;
  Newer() { known.struct_size = sizeof(Newer); }
};

template <class T, class Struct>
T* as(Struct* other) {
  return reinterpret_cast<T*>(other);
}

// ---- a control ----------------------------------------------------------------------------------------------------------------

struct Free {
  void operator()(void* p) const { std::free(p); }
};

struct Control {
  explicit Control(const nc_config& config) {
    const size_t size = (nc_memory_required(&config) + 63) / 64 * 64;
    memory.reset(std::aligned_alloc(64, size));
    control = nc_create(&config, memory.get(), size, nullptr);
  }
  void program(const char* text, unsigned system = 0) {
    unsigned file = 0;
    ASSERT_EQ(nc_program_add_text(control, system == 0 ? "a" : "b", text, std::strlen(text), &file), NC_OK);
    ASSERT_EQ(nc_program_select(control, system, file), NC_OK);
  }
  std::unique_ptr<void, Free> memory;
  nc_control* control = nullptr;
};

nc_config small(uint8_t systems = 1) {
  nc_config c;
  nc_config_init(&c);
  c.look_ahead = 64;
  c.window_bytes = 1024;
  c.system_count = systems;
  for (unsigned i = 0; i < systems; ++i) {
    c.system[i] = c.system[0];
    for (unsigned k = 0; k < 3; ++k) c.system[i].axis[k].max_velocity = 100;
  }
  return c;
}

TEST(StructSize, ATapOfAnotherVersionIsTakenAndGiven) {
  Control c(small());
  nc_tap tap = NC_INIT(nc_tap);
  tap.axis = 1;
  tap.turns_per_mm = 1;
  tap.speed = -5;
  tap.struct_size = 2;
  EXPECT_EQ(nc_tap_set(c.control, 0, &tap), NC_E_ARGUMENT) << "no size";
  EXPECT_EQ(nc_tap_get(c.control, 0, &tap), NC_E_ARGUMENT);
  tap.struct_size = offsetof(nc_tap, acceleration);
  tap.acceleration = 77;
  EXPECT_EQ(nc_tap_set(c.control, 0, &tap), NC_OK);
  tap.axis = 0;
  nc_inputs in;
  nc_inputs_init(&in);
  nc_outputs out;
  nc_outputs_init(&out);
  EXPECT_EQ(nc_cycle(c.control, &in, &out), NC_OK);
  EXPECT_EQ(nc_tap_get(c.control, 0, &tap), NC_OK);
  EXPECT_EQ(tap.axis, 1);
  EXPECT_EQ(tap.acceleration, 77) << "is not touched";
  tap.struct_size = offsetof(nc_tap, spindles);
  tap.spindles = 9;
  EXPECT_EQ(nc_tap_get(c.control, 0, &tap), NC_OK);
  EXPECT_EQ(tap.acceleration, 0);
  EXPECT_EQ(tap.spindles, 9) << "is not touched";
}

TEST(StructSize, InitSetsIt) {
  nc_config config;
  std::memset(static_cast<void*>(&config), 0x55, sizeof config);
  nc_config_init(&config);
  EXPECT_EQ(config.struct_size, sizeof config);
  nc_inputs inputs;
  inputs.struct_size = 3;
  inputs.cycle_start = true;
  nc_inputs_init(&inputs);
  EXPECT_EQ(inputs.struct_size, sizeof inputs);
  EXPECT_FALSE(inputs.cycle_start);
  EXPECT_EQ(inputs.feed_override, 1);
  EXPECT_EQ(inputs.rapid_override, 1);
  nc_world world;
  world.struct_size = 3;
  nc_world_init(&world);
  EXPECT_EQ(world.struct_size, sizeof world);
}

TEST(StructSize, AnOlderConfigurationHasTheDefaultsBehindItsEnd) {
  Guarded<OldConfig> older;
  nc_config_init_sized(as<nc_config>(&older.old), sizeof(OldConfig));
  EXPECT_EQ(older.behind, kGuard);
  EXPECT_EQ(older.old.struct_size, sizeof(OldConfig));
  EXPECT_EQ(older.old.look_ahead, 1024u);
  older.old.look_ahead = 64;
  older.old.programs = 8;
  nc_config same;
  nc_config_init(&same);
  same.look_ahead = 64;
  same.programs = 8;
  EXPECT_EQ(same.contour_blocks, 3800u);
  EXPECT_EQ(same.retract_overlap, 0);
  EXPECT_EQ(same.tap_most_apart, 2);
  EXPECT_NE(nc_memory_required(&same), 0u);
  EXPECT_EQ(nc_memory_required(as<const nc_config>(&older.old)), nc_memory_required(&same));
}

TEST(StructSize, BehindTheCallersEndNothingIsReadOrWritten) {
  nc_config config = small();
  config.struct_size = offsetof(nc_config, vendor_codes);
  config.vendor_code_count = 77;  // in an older program these are other data
  config.kinematics[0] = reinterpret_cast<const nc_kinematics*>(1);
  EXPECT_EQ(nc_config_check(&config, nullptr), NC_OK);
  Control c(config);
  nc_inputs in;
  nc_inputs_init(&in);
  nc_outputs out;
  out.struct_size = offsetof(nc_outputs, joint);
  out.joint_faults = 77;
  out.joint.v[0] = 5;
  EXPECT_EQ(nc_cycle(c.control, &in, &out), NC_OK);
  EXPECT_EQ(out.joint_faults, 77);
  EXPECT_EQ(out.joint.v[0], 5);
  // The last member, and a caller that has it.
  static_assert(offsetof(nc_outputs, handle_dropped) == (offsetof(nc_outputs, joint_faults) + alignof(nc_outputs)) / alignof(nc_outputs) * alignof(nc_outputs));
  out.struct_size = offsetof(nc_outputs, handle_dropped);
  out.handle_dropped = 88;
  in.manual[0] = {NC_MANUAL_HANDLE, 0, 1e6};
  EXPECT_EQ(nc_cycle(c.control, &in, &out), NC_OK);
  EXPECT_EQ(out.handle_dropped, 88u);
  out.struct_size = offsetof(nc_outputs, spindle_turns);
  out.spindle_turns = 99;
  out.spindle_synchronous = 7;
  EXPECT_EQ(nc_cycle(c.control, &in, &out), NC_OK);
  EXPECT_EQ(out.spindle_turns, 99);
  EXPECT_EQ(out.spindle_synchronous, 7);
  out.struct_size = sizeof out;
  EXPECT_EQ(nc_cycle(c.control, &in, &out), NC_OK);
  EXPECT_EQ(out.handle_dropped, 1u);
}

TEST(StructSize, InputsOfAnOlderProgramHaveSoftLimits) {
  // A program of 0.1: `unlimited` came later, and what lies behind the program's struct is not read.
  static_assert(offsetof(nc_inputs, unlimited) == offsetof(nc_inputs, clock_ms) + sizeof(int64_t));
  nc_config config = small();
  config.system[0].axis[0].soft_limited = true;
  config.system[0].axis[0].soft_min = -0.5;
  config.system[0].axis[0].soft_max = 0.5;
  config.system[0].axis[0].rapid = 100;
  config.system[0].axis[0].max_acceleration = 1000;
  for (const bool old : {true, false}) {
    Control c(config);
    nc_inputs in;
    nc_inputs_init(&in);
    if (old) in.struct_size = offsetof(nc_inputs, unlimited);
    in.unlimited = 1;
    in.manual[0] = {NC_MANUAL_JOG, 50, 0};
    nc_outputs out;
    nc_outputs_init(&out);
    for (int n = 0; n < 200; ++n) ASSERT_EQ(nc_cycle(c.control, &in, &out), NC_OK);
    if (old) {
      EXPECT_EQ(out.command.v[0], 0.5);
    } else {
      EXPECT_GT(out.command.v[0], 5);
    }
  }
}

TEST(StructSize, ANewerConfigurationIsTakenWhileItAsksForNothingNew) {
  Newer<nc_config> newer;
  nc_config_init_sized(&newer.known, sizeof newer);
  EXPECT_EQ(newer.known.struct_size, sizeof newer);
  EXPECT_NE(nc_memory_required(&newer.known), 0u);
  newer.later = 1;
  EXPECT_EQ(nc_memory_required(&newer.known), 0u);
  nc_config_fault fault;
  EXPECT_EQ(nc_config_check(&newer.known, &fault), NC_E_ARGUMENT);
  EXPECT_STREQ(fault.field, "struct_size");
  nc_config_init_sized(&newer.known, sizeof newer);
  EXPECT_EQ(newer.later, 0);
}

TEST(StructSize, SizesThatAreNone) {
  for (const uint32_t size : {1u, 3u, 0x10001u, 0xffffffffu}) {
    nc_config config = small();
    config.struct_size = size;
    EXPECT_EQ(nc_memory_required(&config), 0u);
    Control c(small());
    nc_inputs in{};
    nc_outputs out{};
    in.struct_size = size;
    EXPECT_EQ(nc_cycle(c.control, &in, &out), NC_E_ARGUMENT) << size;
    in.struct_size = sizeof in;
    out.struct_size = size;
    out.cause = 77;
    EXPECT_EQ(nc_cycle(c.control, &in, &out), NC_E_ARGUMENT) << size;
    EXPECT_EQ(out.cause, 77);
    nc_item item;
    item.struct_size = size;
    EXPECT_EQ(nc_pull(c.control, 0, 1, &item), NC_E_ARGUMENT);
    nc_event event;
    event.struct_size = size;
    EXPECT_EQ(nc_event_poll(c.control, 0, &event, nullptr), NC_E_ARGUMENT);
    nc_alarm alarm;
    alarm.struct_size = size;
    EXPECT_EQ(nc_alarm_get(c.control, 0, &alarm), NC_E_ARGUMENT);
    nc_program_info info;
    info.struct_size = size;
    EXPECT_EQ(nc_program_get(c.control, 0, &info), NC_E_ARGUMENT);
    nc_modal modal;
    modal.struct_size = size;
    EXPECT_EQ(nc_modal_get(c.control, 0, 0, &modal), NC_E_ARGUMENT);
    nc_world world{};
    world.struct_size = size;
    EXPECT_EQ(nc_answer(c.control, 0, &world), NC_E_ARGUMENT);
    nc_function function;
    nc_system_variable variable;
    nc_parameter parameter;
    function.struct_size = variable.struct_size = parameter.struct_size = size;
    EXPECT_EQ(nc_function_row(NC_DIALECT_M700, 0, &function), NC_E_ARGUMENT);
    EXPECT_EQ(nc_system_variable_row(NC_DIALECT_M700, 0, &variable), NC_E_ARGUMENT);
    EXPECT_EQ(nc_parameter_row(NC_DIALECT_M700, 0, &parameter), NC_E_ARGUMENT);
  }
}

struct OldFunction {
  uint32_t struct_size;
  char code[8];
  uint8_t group;
};
static_assert(offsetof(OldFunction, group) == offsetof(nc_function, group));

struct OldVariable {
  uint32_t struct_size;
  uint32_t first, last;
};
static_assert(offsetof(OldVariable, last) == offsetof(nc_system_variable, last));

struct OldParameter {
  uint32_t struct_size;
  const char* key;
  uint32_t first;
};
static_assert(offsetof(OldParameter, first) == offsetof(nc_parameter, first));

/// The row of a table as this header has it, as an older one has it, and as a newer one that keeps what this library does not know.
template <class Old, class Row, class Ask, class Same>
void expect_rows(Ask ask, Same same) {
  for (unsigned index = 0; index < 5; ++index) {
    Row now;
    Guarded<Old> older;
    Newer<Row> newer;
    newer.later = 5;
    ASSERT_EQ(ask(index, &now), NC_OK);
    ASSERT_EQ(ask(index, as<Row>(&older.old)), NC_OK);
    ASSERT_EQ(ask(index, &newer.known), NC_OK);
    EXPECT_EQ(now.struct_size, sizeof now);
    EXPECT_EQ(older.old.struct_size, sizeof(Old));
    EXPECT_EQ(older.behind, kGuard);
    EXPECT_EQ(newer.later, 5);
    EXPECT_TRUE(same(now, older.old)) << index;
    EXPECT_TRUE(same(now, newer.known)) << index;
  }
}

TEST(StructSize, RowsOfTables) {
  expect_rows<OldFunction, nc_function>([](unsigned index, nc_function* row) { return nc_function_row(NC_DIALECT_M700, index, row); },
                                        [](const auto& a, const auto& b) { return std::strcmp(a.code, b.code) == 0 && a.group == b.group; });
  expect_rows<OldVariable, nc_system_variable>([](unsigned index, nc_system_variable* row) { return nc_system_variable_row(NC_DIALECT_M700, index, row); },
                                               [](const auto& a, const auto& b) { return a.first == b.first && a.last == b.last; });
  expect_rows<OldParameter, nc_parameter>([](unsigned index, nc_parameter* row) { return nc_parameter_row(NC_DIALECT_M700, index, row); },
                                          [](const auto& a, const auto& b) { return a.key == b.key && a.first == b.first; });
}

constexpr char kProgram[] = "G1 X1. F6000\nG4 X.01\nX2.\nM30\n";

/// The set-points of a program in two part systems, for a caller with its own versions of the structs.
template <class In, class Out>
std::vector<double> set_points(std::vector<In> in, std::vector<Out> out) {
  Control c(small(2));
  c.program(kProgram, 0);
  c.program(kProgram, 1);
  std::vector<double> all;
  for (unsigned cycle = 0; cycle < 120; ++cycle) {
    nc_feed(c.control, 10);
    for (In& i : in) {
      as<nc_inputs>(&i)->cycle_start = cycle == 1;
      as<nc_inputs>(&i)->fin = cycle % 4 < 2;  // so that every M code is completed soon
    }
    EXPECT_EQ(nc_cycle(c.control, as<nc_inputs>(in.data()), as<nc_outputs>(out.data())), NC_OK);
    for (Out& o : out) all.push_back(as<nc_outputs>(&o)->command.v[0]);
  }
  for (Out& o : out) EXPECT_EQ(as<nc_outputs>(&o)->state, NC_STATE_IDLE);
  return all;
}

template <class T>
std::vector<T> two(uint32_t size) {
  std::vector<T> both(2);
  for (T& one : both) {
    std::memcpy(static_cast<void*>(&one), &size, sizeof size);
  }
  return both;
}

TEST(StructSize, CyclesOfAnyCallerAreTheSame) {
  std::vector<nc_inputs> in(2);
  for (nc_inputs& i : in) nc_inputs_init(&i);
  const std::vector<double> now = set_points(in, std::vector<nc_outputs>(2));
  EXPECT_EQ(now.back(), 2);
  // Members that an older caller does not have are as nc_inputs_init() sets them: overrides of 100 %.
  EXPECT_EQ(set_points(two<OldInputs>(sizeof(OldInputs)), two<OldOutputs>(sizeof(OldOutputs))), now);
  EXPECT_EQ(set_points(in, two<OldOutputs>(sizeof(OldOutputs))), now);
  EXPECT_EQ(set_points(two<OldInputs>(sizeof(OldInputs)), std::vector<nc_outputs>(2)), now);
  std::vector<Newer<nc_inputs>> newer(2);
  for (Newer<nc_inputs>& i : newer) i.known.feed_override = i.known.rapid_override = 1;
  EXPECT_EQ(set_points(newer, std::vector<Newer<nc_outputs>>(2)), now);
  // Cleared in C: the struct of the first version.
  std::vector<FirstInputs> cleared = two<FirstInputs>(0);
  for (FirstInputs& i : cleared) as<nc_inputs>(&i)->feed_override = as<nc_inputs>(&i)->rapid_override = 1;
  EXPECT_EQ(set_points(cleared, two<FirstOutputs>(0)), now);
}

TEST(StructSize, NothingMovesWhenOneOfThemIsRefused) {
  Control c(small(2));
  nc_inputs in[2];
  nc_outputs out[2];
  for (nc_inputs& i : in) nc_inputs_init(&i);
  for (nc_outputs& o : out) o.blocks = 77;
  in[1].struct_size = 0;
  EXPECT_EQ(nc_cycle(c.control, in, out), NC_E_ARGUMENT);
  EXPECT_EQ(out[0].blocks, 77u);
  Newer<nc_inputs> newer[2];
  newer[1].later = 1;
  EXPECT_EQ(nc_cycle(c.control, &newer[0].known, out), NC_E_ARGUMENT);
  EXPECT_EQ(out[0].blocks, 77u);
  newer[1].later = 0;
  EXPECT_EQ(nc_cycle(c.control, &newer[0].known, out), NC_OK);
  EXPECT_EQ(out[0].blocks, 0u);
  EXPECT_EQ(nc_cycle(c.control, nullptr, out), NC_E_ARGUMENT);
}

TEST(StructSize, OlderCallersReceiveWhatTheyKnow) {
  Control c(small());
  c.program("G1 X1. F100\n#100=#5021\nG1 X2. F0\nQQ\n");
  Guarded<OldItem> item;
  ASSERT_EQ(nc_pull(c.control, 0, 10, as<nc_item>(&item.old)), NC_OK);
  EXPECT_EQ(item.old.struct_size, sizeof(OldItem));
  EXPECT_EQ(item.old.kind, NC_ITEM_MOVE);
  EXPECT_EQ(item.old.source.line, 1u);
  EXPECT_NE(item.old.serial, 0u);
  while (item.old.kind != NC_ITEM_SYNC) ASSERT_EQ(nc_pull(c.control, 0, 10, as<nc_item>(&item.old)), NC_OK);
  Guarded<OldWorld> world;
  world.old.machine.v[0] = 1;
  EXPECT_EQ(nc_answer(c.control, 0, as<nc_world>(&world.old)), NC_OK);
  nc_status status = NC_OK;
  while ((status = nc_pull(c.control, 0, 10, as<nc_item>(&item.old))) == NC_OK) {
  }
  EXPECT_EQ(status, NC_ALARMED);
  double value = 0;
  bool vacant = true;
  EXPECT_EQ(nc_variable_get(c.control, 0, 100, &value, &vacant), NC_OK);
  EXPECT_EQ(value, 1);
  Guarded<OldAlarm> alarm;
  EXPECT_EQ(nc_alarm_get(c.control, 0, as<nc_alarm>(&alarm.old)), NC_OK);
  nc_alarm whole;
  EXPECT_EQ(nc_alarm_get(c.control, 0, &whole), NC_OK);
  EXPECT_STREQ(alarm.old.code, whole.code);
  EXPECT_STREQ(alarm.old.message, whole.message);
  for (const uint64_t behind : {item.behind, world.behind, alarm.behind}) EXPECT_EQ(behind, kGuard);
}

TEST(StructSize, NewerCallersKeepWhatIsNotKnownHere) {
  Control c(small());
  c.program("G1 X1. F100\nM30\n");
  Newer<nc_item> item;
  item.later = 5;
  ASSERT_EQ(nc_pull(c.control, 0, 10, &item.known), NC_OK);
  EXPECT_EQ(item.known.u.move.work.v[0], 1);
  EXPECT_EQ(item.later, 5);
  EXPECT_EQ(item.known.struct_size, sizeof item);
}

TEST(StructSize, EventsOfAnOlderCaller) {
  Control c(small());
  c.program(kProgram);
  nc_inputs in;
  nc_inputs_init(&in);
  nc_outputs out{};
  unsigned seen = 0;
  for (unsigned cycle = 0; cycle < 120; ++cycle) {
    nc_feed(c.control, 10);
    in.cycle_start = cycle == 1;
    ASSERT_EQ(nc_cycle(c.control, &in, &out), NC_OK);
    Guarded<OldEvent> event;
    while (nc_event_poll(c.control, 0, as<nc_event>(&event.old), nullptr) == NC_OK) {
      EXPECT_EQ(event.old.struct_size, sizeof(OldEvent));
      EXPECT_EQ(event.old.source.system, 0);
      EXPECT_EQ(event.behind, kGuard);
      ++seen;
    }
  }
  EXPECT_GE(seen, 4u);
}

TEST(StructSize, TheOrderOfTheCodesInFrontOfAPlaceIsForThoseWhoKnowOfIt) {
  for (const bool old : {true, false}) {
    Control c(small());
    c.program("T1 M6\nT2\nG0 X1.\nX2.\nM30\n");
    nc_restart_place place;
    nc_restart_place_init(&place);
    place.by = NC_RESTART_LINE;
    place.number = 4;
    ASSERT_EQ(nc_restart_begin(c.control, 0, &place, nullptr), NC_OK);
    nc_restart_found found;
    std::memset(static_cast<void*>(&found), 0x55, sizeof found);
    found.struct_size = old ? offsetof(nc_restart_found, change_t) : sizeof found;
    nc_status status = NC_BUDGET;
    while (status == NC_BUDGET) status = nc_restart_find(c.control, 0, 10, &found);
    ASSERT_EQ(status, NC_OK);
    EXPECT_EQ(found.t, 2u);
    EXPECT_EQ(found.change_t, old ? 0x5555555555555555u : 1u);
    EXPECT_EQ(found.t_order, old ? 0x55555555u : 3u);
  }
}

TEST(StructSize, ThePlaceToGoBackToIsForThoseWhoKnowOfIt) {
  for (const bool old : {true, false}) {
    Control c(small());
    nc_inputs in;
    nc_inputs_init(&in);
    nc_outputs out;
    nc_outputs_init(&out);
    out.return_place.v[0] = 77;
    if (old) out.struct_size = offsetof(nc_outputs, return_place);
    EXPECT_EQ(nc_cycle(c.control, &in, &out), NC_OK);
    EXPECT_EQ(out.return_place.v[0], old ? 77 : 0);
  }
}

TEST(StructSize, TheLengthAlongTheToolIsForThoseWhoKnowOfIt) {
  static_assert(offsetof(nc_inputs, tool_length_handle) == offsetof(nc_inputs, spindle_age_s) + sizeof(nc_inputs::spindle_age_s));
  static_assert(offsetof(nc_inputs, tool_angle) == offsetof(nc_inputs, tool_length_handle) + sizeof(double));
  static_assert(offsetof(nc_world, tool_angle) == offsetof(nc_world, run_ms) + sizeof(double));
  nc_config config = small();
  config.system[0].tool_axis = NC_TOOL_AXIS_MECHANICAL_A;
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const bool old : {true, false}) {
    Control c(config);
    nc_inputs in;
    nc_inputs_init(&in);
    in.tool_length_handle = in.tool_angle[1] = none;
    nc_outputs out;
    nc_outputs_init(&out);
    out.tool_length_added = 77;
    out.tool_length_dropped = true;
    if (old) in.struct_size = offsetof(nc_inputs, tool_length_handle), out.struct_size = offsetof(nc_outputs, tool_length_added);
    EXPECT_EQ(nc_cycle(c.control, &in, &out), NC_OK);
    EXPECT_EQ(out.inputs_refused, old ? 0u : uint32_t{NC_INPUT_TOOL_LENGTH} | NC_INPUT_TOOL_ANGLE);
    EXPECT_EQ(out.tool_length_added, old ? 77 : 0);
    EXPECT_EQ(out.tool_length_dropped, old);
  }
  for (const bool old : {true, false}) {
    Control c(config);
    ASSERT_EQ(nc_tool_offset_set(c.control, 1, NC_TOOL_LENGTH, 10), NC_OK);
    c.program("G43.1 H1 G0 X0\nM30\n");
    nc_item item;
    nc_item_init(&item);
    while (nc_pull(c.control, 0, 100, &item) == NC_OK && item.kind != NC_ITEM_SYNC) {
    }
    ASSERT_EQ(item.kind, NC_ITEM_SYNC);
    nc_world world;
    nc_world_init(&world);
    world.tool_angle[0] = 90;
    if (old) world.struct_size = offsetof(nc_world, tool_angle);
    EXPECT_EQ(nc_answer(c.control, 0, &world), NC_OK);
    while (nc_pull(c.control, 0, 100, &item) == NC_OK && item.kind != NC_ITEM_MOVE) {
    }
    ASSERT_EQ(item.kind, NC_ITEM_MOVE);
    EXPECT_NEAR(item.u.move.machine.v[2], old ? 10 : 0, 1e-9);
    EXPECT_NEAR(item.u.move.machine.v[1], old ? 0 : -10, 1e-9);
  }
}

}  // namespace
