// SPDX-License-Identifier: Apache-2.0
// Building a control, and what its functions return for arguments that make no sense.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "support/pull.hpp"

namespace nc::test {
namespace {

struct Release {
  void operator()(void* memory) const { std::free(memory); }
};
using Memory = std::unique_ptr<void, Release>;

/// Exactly `size` aligned bytes, so that the address sanitizer finds a use of more.
Memory exact_memory(size_t size) {
  void* memory = nullptr;
  if (posix_memalign(&memory, 64, size) != 0) memory = nullptr;
  return Memory(memory);
}

nc_config config_of(const std::function<void(nc_config&)>& change) {
  nc_config config;
  nc_config_init(&config);
  config.look_ahead = 64;
  config.window_bytes = 1024;
  if (change) change(config);
  return config;
}

TEST(Create, ExactlyTheMemoryItAsksFor) {
  for (uint8_t dialect : {NC_DIALECT_M700, NC_DIALECT_DGSHAPE}) {
    for (uint8_t systems : {1, 2, 4}) {
      const nc_config config = config_of([&](nc_config& c) {
        c.dialect = dialect;
        c.system_count = systems;
        for (unsigned i = 1; i < systems; ++i) c.system[i] = c.system[0];
      });
      const size_t size = nc_memory_required(&config);
      ASSERT_GT(size, 0u);
      const Memory memory = exact_memory(size);
      nc_status status = NC_E_STATE;
      nc_control* control = nc_create(&config, memory.get(), size, &status);
      ASSERT_NE(control, nullptr);
      EXPECT_EQ(status, NC_OK);
      const std::string text = "%\nG0 X1.\nM30\n";
      for (unsigned i = 0; i < systems; ++i) {
        unsigned file = 0;
        ASSERT_EQ(nc_program_add_text(control, "p", text.data(), text.size(), &file), NC_OK);
        ASSERT_EQ(nc_program_select(control, i, file), NC_OK);
        nc_item item;
        ASSERT_EQ(nc_pull(control, i, 100, &item), NC_OK);
        EXPECT_EQ(item.u.move.machine.v[0], 1);
      }
    }
  }
}

TEST(Create, NothingIsWrittenBehindTheMemory) {
  const nc_config config = config_of({});
  const size_t size = nc_memory_required(&config);
  constexpr size_t kCanary = 4096;
  const Memory memory = exact_memory(size + kCanary);
  std::memset(memory.get(), 0xa5, size + kCanary);
  nc_control* control = nc_create(&config, memory.get(), size, nullptr);
  ASSERT_NE(control, nullptr);
  const std::string text = "G41 D1 G1 X1. F1\nX2.\n#1100=1\nG81 Z1. R1.\nM30\n";
  unsigned file = 0;
  nc_program_add_text(control, "p", text.data(), text.size(), &file);
  nc_program_select(control, 0, file);
  nc_item item;
  while (nc_pull(control, 0, 100, &item) == NC_OK) {
  }
  nc_inputs in{};
  nc_outputs out{};
  nc_feed(control, 100);
  nc_cycle(control, &in, &out);
  const auto* bytes = static_cast<const unsigned char*>(memory.get());
  for (size_t i = 0; i < kCanary; ++i) ASSERT_EQ(bytes[size + i], 0xa5) << i;
}

TEST(Create, OneByteLessIsRefused) {
  const nc_config config = config_of({});
  const size_t size = nc_memory_required(&config);
  for (size_t less : {size_t{1}, size_t{64}, size / 2, size - 1, size}) {
    const Memory memory = exact_memory(size);
    std::memset(memory.get(), 0x5a, size);
    nc_status status = NC_OK;
    EXPECT_EQ(nc_create(&config, memory.get(), size - less, &status), nullptr);
    EXPECT_EQ(status, NC_E_MEMORY);
    EXPECT_EQ(static_cast<unsigned char*>(memory.get())[0], 0x5a);  // nothing was touched
  }
}

TEST(Create, MemoryThatIsNotAligned) {
  const nc_config config = config_of({});
  const size_t size = nc_memory_required(&config);
  const Memory memory = exact_memory(size + 64);
  nc_status status = NC_OK;
  EXPECT_EQ(nc_create(&config, static_cast<char*>(memory.get()) + 8, size, &status), nullptr);
  EXPECT_EQ(status, NC_E_ARGUMENT);
  EXPECT_EQ(nc_create(&config, nullptr, size, &status), nullptr);
  EXPECT_EQ(nc_create(nullptr, memory.get(), size, nullptr), nullptr);
}

TEST(Create, MemoryIsUsedAgain) {
  const nc_config config = config_of({});
  const size_t size = nc_memory_required(&config);
  const Memory memory = exact_memory(size);
  for (unsigned i = 0; i < 3; ++i) {
    nc_control* control = nc_create(&config, memory.get(), size, nullptr);
    ASSERT_NE(control, nullptr);
    double value = 1;
    bool vacant = false;
    ASSERT_EQ(nc_variable_get(control, 0, 500, &value, &vacant), NC_OK);
    EXPECT_TRUE(vacant);  // nothing is left of the control that was there before
    nc_variable_set(control, 0, 500, 5, false);
  }
}

TEST(Create, ConfigurationsThatAreNone) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::function<void(nc_config&)> wrong[] = {
      [](nc_config& c) { c.struct_size = 1; },
      [](nc_config& c) { c.dialect = NC_DIALECT_COUNT; },
      [](nc_config& c) { c.system_count = 0; },
      [](nc_config& c) { c.system_count = NC_MAX_SYSTEMS + 1; },
      [](nc_config& c) { c.system_count = 2; },  // the second one has no axis
      [](nc_config& c) { c.system[0].axis_count = 0; },
      [](nc_config& c) { c.system[0].axis_count = NC_MAX_AXES + 1; },
      [](nc_config& c) { c.system[0].axis[0].name = 0; },
      [](nc_config& c) { c.system[0].axis[0].name = 'x'; },
      [](nc_config& c) { c.system[0].axis[0].name = 'F'; },
      [](nc_config& c) { c.system[0].axis[1].name = 'X'; },
      [](nc_config& c) { c.system[0].axis[0].rapid = -1; },
      [=](nc_config& c) { c.system[0].axis[0].max_velocity = kNan; },
      [](nc_config& c) { c.system[0].axis[0].max_acceleration = std::numeric_limits<double>::infinity(); },
      [](nc_config& c) { c.system[0].axis[0].in_position = -1; },
      [=](nc_config& c) { c.system[0].axis[0].reference[0] = kNan; },
      [](nc_config& c) { c.system[0].axis[0].soft_limited = true; },  // an empty stroke
      [](nc_config& c) { c.cycle_s = 0; },
      [=](nc_config& c) { c.cycle_s = kNan; },
      [](nc_config& c) { c.look_ahead = 63; },
      [](nc_config& c) { c.look_ahead = 100; },
      [](nc_config& c) { c.look_ahead = 1u << 17; },
      [](nc_config& c) { c.programs = 0; },
      [](nc_config& c) { c.tool_offsets = 0; },
      [](nc_config& c) { c.tool_offsets = 1000; },
      [](nc_config& c) { c.work_offsets = 301; },
      [](nc_config& c) { c.window_bytes = 100; },
      [](nc_config& c) { c.window_bytes = 0xffffffff; },
      [](nc_config& c) { c.variable_sets = 7; },
      [](nc_config& c) { c.max_feed_override = 0.5; },
      [=](nc_config& c) { c.max_feed_override = kNan; },
      [=](nc_config& c) { c.path_tolerance = kNan; },  // whether the mode uses it or not
      [](nc_config& c) { c.path_tolerance = 11; },
  };
  const Memory memory = exact_memory(1 << 20);
  for (size_t i = 0; i < std::size(wrong); ++i) {
    const nc_config config = config_of(wrong[i]);
    EXPECT_EQ(nc_memory_required(&config), 0u) << i;
    nc_status status = NC_OK;
    EXPECT_EQ(nc_create(&config, memory.get(), 1 << 20, &status), nullptr) << i;
    EXPECT_EQ(status, NC_E_ARGUMENT) << i;
  }
  EXPECT_EQ(nc_memory_required(nullptr), 0u);
  nc_config_init(nullptr);
}

TEST(Create, SmallestAndLargest) {
  const nc_config small = config_of([](nc_config& c) {
    c.system[0].axis_count = 1;
    c.programs = c.tool_offsets = 1;
    c.work_offsets = 0;
    c.variable_sets = 100;
    c.window_bytes = 512;
    c.contour_blocks = 16;
  });
  const nc_config large = config_of([](nc_config& c) {
    axes("XYZABCUV")(c);
    c.tool_offsets = 999;
    c.work_offsets = 300;
    c.extended_variables = true;
    c.look_ahead = 4096;
    c.contour_blocks = 100000;
  });
  for (const nc_config& config : {small, large}) {
    const size_t size = nc_memory_required(&config);
    const Memory memory = exact_memory(size);
    EXPECT_NE(nc_create(&config, memory.get(), size, nullptr), nullptr);
  }
  EXPECT_LT(nc_memory_required(&small), size_t{1900000});
}

// ---- misuse --------------------------------------------------------------------------------------------------------------------

TEST(Misuse, NoControl) {
  double value = 0;
  bool vacant = false;
  uint32_t number = 0;
  unsigned file = 0;
  nc_item item;
  nc_world world{};
  nc_axes axes{};
  nc_alarm alarm;
  nc_modal modal{};
  nc_text text;
  nc_event event;
  char codes[4][8];
  EXPECT_EQ(nc_parameter_set(nullptr, 0, "1078", 0, "1"), NC_E_ARGUMENT);
  EXPECT_EQ(nc_parameter_get(nullptr, 0, "1078", 0, &value), NC_E_ARGUMENT);
  EXPECT_EQ(nc_work_offset_set(nullptr, 0, 1, 0, 1), NC_E_ARGUMENT);
  EXPECT_EQ(nc_work_offset_get(nullptr, 0, 1, 0, &value), NC_E_ARGUMENT);
  EXPECT_EQ(nc_tool_offset_set(nullptr, 1, NC_TOOL_LENGTH, 1), NC_E_ARGUMENT);
  EXPECT_EQ(nc_tool_offset_get(nullptr, 1, NC_TOOL_LENGTH, &value), NC_E_ARGUMENT);
  EXPECT_EQ(nc_variable_set(nullptr, 0, 100, 1, false), NC_E_ARGUMENT);
  EXPECT_EQ(nc_variable_get(nullptr, 0, 100, &value, &vacant), NC_E_ARGUMENT);
  EXPECT_EQ(nc_variable_next(nullptr, 0, 0, &number, &value), NC_E_ARGUMENT);
  EXPECT_EQ(nc_program_add_text(nullptr, "p", "", 0, &file), NC_E_ARGUMENT);
  EXPECT_EQ(nc_program_select(nullptr, 0, 0), NC_E_ARGUMENT);
  EXPECT_EQ(nc_mdi_load(nullptr, 0, "", 0), NC_E_ARGUMENT);
  EXPECT_EQ(nc_position_set(nullptr, 0, &axes), NC_E_ARGUMENT);
  EXPECT_EQ(nc_alarm_get(nullptr, 0, &alarm), NC_E_ARGUMENT);
  EXPECT_EQ(nc_modal_get(nullptr, 0, 0, &modal), NC_E_ARGUMENT);
  EXPECT_EQ(nc_text_get(nullptr, 0, 0, &text), NC_E_ARGUMENT);
  EXPECT_EQ(nc_pull(nullptr, 0, 1, &item), NC_E_ARGUMENT);
  EXPECT_EQ(nc_answer(nullptr, 0, &world), NC_E_ARGUMENT);
  EXPECT_EQ(nc_rewind(nullptr, 0, 0), NC_E_ARGUMENT);
  EXPECT_EQ(nc_recalculate(nullptr, 0), NC_E_ARGUMENT);
  EXPECT_EQ(nc_reset(nullptr, 0), NC_E_ARGUMENT);
  EXPECT_EQ(nc_feed(nullptr, 1), NC_E_ARGUMENT);
  EXPECT_EQ(nc_event_poll(nullptr, 0, &event, nullptr), NC_E_ARGUMENT);
  uint32_t bits = 7;
  EXPECT_EQ(nc_interface_output_get(nullptr, 0, 0, &bits), NC_E_ARGUMENT);
  EXPECT_EQ(bits, 7u);
  EXPECT_EQ(nc_interface_output_set(nullptr, 0, 0, 1, 1), NC_E_ARGUMENT);
  EXPECT_EQ(nc_modal_codes_get(nullptr, &modal, codes, 4), 0u);
  nc_switches_set(nullptr, 0, 0, 0);
  nc_program_on_missing(nullptr, nullptr, nullptr);
}

TEST(Misuse, NoSuchPartSystem) {
  Bench bench;
  nc_control* c = bench.control();
  double value = 0;
  bool vacant = false;
  nc_item item;
  nc_axes axes{};
  nc_world world{};
  EXPECT_EQ(nc_parameter_set(c, 1, "1078", 0, "1"), NC_E_ARGUMENT);
  EXPECT_EQ(nc_work_offset_set(c, 1, 1, 0, 1), NC_E_ARGUMENT);
  EXPECT_EQ(nc_variable_get(c, 99, 100, &value, &vacant), NC_E_ARGUMENT);
  EXPECT_EQ(nc_pull(c, 1, 1, &item), NC_E_ARGUMENT);
  EXPECT_EQ(nc_answer(c, 1, &world), NC_E_ARGUMENT);
  EXPECT_EQ(nc_position_set(c, 1, &axes), NC_E_ARGUMENT);
  EXPECT_EQ(nc_mdi_load(c, 1, "G0", 2), NC_E_ARGUMENT);
  EXPECT_EQ(nc_program_select(c, 1, 0), NC_E_ARGUMENT);
  nc_switches_set(c, 77, 0, 0);
  uint32_t bits = 7;
  EXPECT_EQ(nc_interface_output_get(c, 1, 0, &bits), NC_E_ARGUMENT);
  EXPECT_EQ(nc_interface_output_get(c, 0, NC_WORDS, &bits), NC_E_ARGUMENT);
  EXPECT_EQ(nc_interface_output_get(c, 0, 0, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(bits, 7u);
  EXPECT_EQ(nc_interface_output_set(c, 1, 0, 1, 1), NC_E_ARGUMENT);
  EXPECT_EQ(nc_interface_output_set(c, 0, NC_WORDS, 1, 1), NC_E_ARGUMENT);
}

TEST(Misuse, NullPointers) {
  Bench bench;
  nc_control* c = bench.control();
  EXPECT_EQ(nc_pull(c, 0, 1, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_answer(c, 0, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_variable_get(c, 0, 100, nullptr, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_variable_next(c, 0, 0, nullptr, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_work_offset_get(c, 0, 1, 0, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_tool_offset_get(c, 1, NC_TOOL_LENGTH, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_program_add(c, "p", nullptr, nullptr, 0, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_program_add_text(c, nullptr, "M30", 3, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_program_add_text(c, "p", nullptr, 3, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_program_add_text(c, "", "M30", 3, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_program_add_text(c, "empty", nullptr, 0, nullptr), NC_OK);
  EXPECT_EQ(nc_mdi_load(c, 0, nullptr, 0), NC_E_ARGUMENT);
  EXPECT_EQ(nc_position_set(c, 0, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_alarm_get(c, 0, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_modal_get(c, 0, 0, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_text_get(c, 0, 0, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_event_poll(c, 0, nullptr, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_parameter_get(c, 0, nullptr, 0, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_parameter_set(c, 0, nullptr, 0, "1"), NC_E_ARGUMENT);
  EXPECT_EQ(nc_parameter_set(c, 0, "1078", 0, nullptr), NC_E_ARGUMENT);
  const nc_inputs in{};
  nc_outputs out{};
  out.state = 77;  // nothing is written
  nc_cycle(nullptr, &in, &out);
  nc_cycle(c, nullptr, &out);
  nc_cycle(c, &in, nullptr);
  EXPECT_EQ(out.state, 77);
}

TEST(Misuse, NumbersOutOfTheirTables) {
  Bench bench;
  nc_control* c = bench.control();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  for (unsigned index : {7u, 100u, 197u, 1000u}) EXPECT_EQ(nc_work_offset_set(c, 0, index, 0, 1), NC_E_ARGUMENT) << index;
  EXPECT_EQ(nc_work_offset_set(c, 0, 1, 3, 1), NC_E_ARGUMENT);
  EXPECT_EQ(nc_work_offset_set(c, 0, 1, 0, kNan), NC_E_ARGUMENT);
  EXPECT_EQ(nc_work_offset_set(c, 0, 1, 0, kInf), NC_E_ARGUMENT);
  for (unsigned n : {0u, 201u}) EXPECT_EQ(nc_tool_offset_set(c, n, NC_TOOL_LENGTH, 1), NC_E_ARGUMENT) << n;
  double kept = 7;
  for (int column : {4, -1, -8, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()}) {  // an enum of C may hold any int
    EXPECT_EQ(nc_tool_offset_set(c, 1, static_cast<nc_tool_column>(column), 1), NC_E_ARGUMENT) << column;
    EXPECT_EQ(nc_tool_offset_get(c, 1, static_cast<nc_tool_column>(column), &kept), NC_E_ARGUMENT) << column;
    EXPECT_EQ(nc_function_row(static_cast<nc_dialect>(-1), 0, nullptr), NC_E_ARGUMENT);
  }
  EXPECT_EQ(kept, 7);
  EXPECT_EQ(nc_tool_offset_set(c, 1, NC_TOOL_LENGTH, kNan), NC_E_ARGUMENT);
  EXPECT_EQ(nc_variable_set(c, 0, 99, 1, false), NC_E_NOT_FOUND);
  EXPECT_EQ(nc_variable_set(c, 0, 500, kNan, false), NC_E_ARGUMENT);
  EXPECT_EQ(nc_variable_set(c, 0, 500, kNan, true), NC_OK);  // to make it vacant, where the value is ignored
  nc_axes axes{};
  axes.v[1] = kInf;
  EXPECT_EQ(nc_position_set(c, 0, &axes), NC_E_ARGUMENT);
  EXPECT_EQ(nc_program_select(c, 0, 5), NC_E_NOT_FOUND);
  EXPECT_EQ(nc_program_select(c, 0, 70000), NC_E_NOT_FOUND);
  nc_modal modal;
  EXPECT_EQ(nc_modal_get(c, 0, 12345678, &modal), NC_E_NOT_FOUND);
  nc_text text;
  EXPECT_EQ(nc_text_get(c, 0, 99, &text), NC_E_NOT_FOUND);
  const std::string long_text(1024, ' ');
  EXPECT_EQ(nc_mdi_load(c, 0, long_text.data(), 5000), NC_E_ARGUMENT);
  for (std::size_t less = 0; less < 10; ++less) EXPECT_EQ(nc_mdi_load(c, 0, "X1", SIZE_MAX - less), NC_E_ARGUMENT) << less;
  nc_function row;
  EXPECT_EQ(nc_function_row(static_cast<nc_dialect>(9), 0, &row), NC_E_ARGUMENT);
  EXPECT_EQ(nc_function_row(NC_DIALECT_M700, 100000, &row), NC_E_NOT_FOUND);
}

TEST(Misuse, TheStoreIsFull) {
  Bench bench(NC_DIALECT_M700, [](nc_config& c) { c.programs = 2; });
  EXPECT_EQ(nc_program_add_text(bench.control(), "a", "M30", 3, nullptr), NC_OK);
  EXPECT_EQ(nc_program_add_text(bench.control(), "b", "M30", 3, nullptr), NC_OK);
  EXPECT_EQ(nc_program_add_text(bench.control(), "c", "M30", 3, nullptr), NC_E_MEMORY);
  EXPECT_EQ(nc_program_add_text(bench.control(), "b", "M02", 3, nullptr), NC_OK);  // replaced
}

TEST(Misuse, AnswersThatNobodyAskedFor) {
  Bench bench;
  const nc_world world{};
  EXPECT_EQ(nc_answer(bench.control(), 0, &world), NC_E_STATE);
  nc_item item;
  EXPECT_EQ(nc_pull(bench.control(), 0, 10, &item), NC_ENDED);  // nothing is selected
  const std::string text = "#100=#1000\nM30";
  unsigned file = 0;
  nc_program_add_text(bench.control(), "p", text.data(), text.size(), &file);
  nc_program_select(bench.control(), 0, file);
  ASSERT_EQ(nc_pull(bench.control(), 0, 10, &item), NC_OK);
  ASSERT_EQ(item.kind, NC_ITEM_SYNC);
  EXPECT_EQ(nc_pull(bench.control(), 0, 10, &item), NC_WAITING);
  nc_world nowhere{};
  nowhere.machine.v[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(nc_answer(bench.control(), 0, &nowhere), NC_E_ARGUMENT);
  EXPECT_EQ(nc_answer(bench.control(), 0, &world), NC_OK);
  EXPECT_EQ(nc_answer(bench.control(), 0, &world), NC_E_STATE);
}

// ---- parameters ------------------------------------------------------------------------------------------------------------------

TEST(Parameters, KeysOfBothDialects) {
  Bench m;
  nc_control* c = m.control();
  EXPECT_EQ(nc_parameter_set(c, 0, "8999", 0, "5"), NC_OK);  // this parameter does nothing in the control, but is kept
  double value = 0;
  EXPECT_EQ(nc_parameter_get(c, 0, "8999", 0, &value), NC_OK);
  EXPECT_EQ(value, 5);
  EXPECT_EQ(nc_parameter_get(c, 0, "interpretation", 0, &value), NC_E_NOT_FOUND);
  EXPECT_EQ(nc_parameter_get(c, 0, "8999", 'Q', &value), NC_E_ARGUMENT);
  EXPECT_EQ(value, 5);
  EXPECT_EQ(nc_parameter_set(c, 0, "1078/bit9", 0, "1"), NC_E_ARGUMENT);  // #1078 is 0 or 1
  EXPECT_EQ(nc_parameter_set(c, 0, "1078/bit0", 0, "1"), NC_OK);
  EXPECT_EQ(nc_parameter_set(c, 0, "interpretation", 0, "calculator"), NC_E_NOT_FOUND);
  for (const char* key : {"", "x", "12a", "1267/", "1267/bit", "1267/bit32", "1267/bit1x", "1267/bit123", "1234567", "1267/bat1"})
    EXPECT_EQ(nc_parameter_set(c, 0, key, 0, "1"), NC_E_NOT_FOUND) << key;
  for (const char* text : {"", "1.2.3", "1e5", "--1", "-"}) EXPECT_EQ(nc_parameter_set(c, 0, "8999", 0, text), NC_E_ARGUMENT) << text;
  EXPECT_EQ(nc_parameter_set(c, 0, "8999", 0, "x1"), NC_OK);  // a text (M700 13.11)
  EXPECT_EQ(nc_parameter_set(c, 0, "1078", 0, "x1"), NC_E_ARGUMENT);
  EXPECT_EQ(nc_parameter_set(c, 0, "8999", 0, std::string(400, '9').c_str()), NC_E_ARGUMENT);
  EXPECT_EQ(nc_parameter_set(c, 0, "1003", 0, "F"), NC_E_ARGUMENT);
  EXPECT_EQ(nc_parameter_set(c, 0, "1003", 0, "3"), NC_E_ARGUMENT);
  Bench d(NC_DIALECT_DGSHAPE);
  EXPECT_EQ(nc_parameter_set(d.control(), 0, "interpretation", 0, "CALCULATOR"), NC_OK);
  EXPECT_EQ(nc_parameter_set(d.control(), 0, "interpretation", 0, "other"), NC_E_ARGUMENT);
  EXPECT_EQ(nc_parameter_set(d.control(), 0, "1078", 0, "1"), NC_E_NOT_FOUND);
}

TEST(Parameters, BitsAreBitsOfTheWhole) {
  Bench bench;
  nc_control* c = bench.control();
  auto get = [&](const char* key) {
    double value = -1;
    nc_parameter_get(c, 0, key, 0, &value);
    return value;
  };
  bench.param("1229", "6");
  EXPECT_EQ(get("1229/bit1"), 1);
  EXPECT_EQ(get("1229/bit0"), 0);
  bench.param("1229/bit0", "1");
  EXPECT_EQ(get("1229"), 7);
  bench.param("1229/bit2", "0");
  EXPECT_EQ(get("1229"), 3);
  bench.param("1229", "0");  // to write the whole parameter sets every bit
  EXPECT_EQ(get("1229/bit0"), 0);
  EXPECT_EQ(nc_parameter_set(c, 0, "1229/bit0", 0, "2"), NC_E_ARGUMENT);
  bench.param("1230/bit31", "1");
  EXPECT_EQ(get("1230"), 2147483648.0);
}

TEST(Parameters, PerAxis) {
  Bench bench(NC_DIALECT_M700, axes("XYZc"));
  bench.param("2106", "5");
  bench.param("2106", "2", 'C');
  double value = 0;
  EXPECT_EQ(nc_parameter_get(bench.control(), 0, "2106", 'C', &value), NC_OK);
  EXPECT_EQ(value, 2);
  EXPECT_EQ(nc_parameter_get(bench.control(), 0, "2106", 'X', &value), NC_OK);
  EXPECT_EQ(value, 5);
  EXPECT_EQ(nc_parameter_set(bench.control(), 0, "2106", 'W', "1"), NC_E_ARGUMENT);
  EXPECT_EQ(nc_parameter_set(bench.control(), 0, "2106", '#', "1"), NC_E_ARGUMENT);
}

// ---- MDI -------------------------------------------------------------------------------------------------------------------------

TEST(Mdi, EndsByItself) {
  Bench bench;
  ASSERT_EQ(nc_mdi_load(bench.control(), 0, "G0 X5.", 6), NC_OK);
  Outcome run = bench.finish();
  EXPECT_EQ(run.path(), (Path{"rapid 5 0 0"}));
  EXPECT_TRUE(run.ended_ok);
  ASSERT_EQ(nc_mdi_load(bench.control(), 0, "G0 X6. M30", 10), NC_OK);
  run = bench.finish();
  EXPECT_EQ(run.path(), (Path{"rapid 6 0 0"}));
  EXPECT_TRUE(run.ended_ok);
  EXPECT_EQ(run.aux(), "M30");
  ASSERT_EQ(nc_mdi_load(bench.control(), 0, "M3 S100", 7), NC_OK);
  run = bench.finish();
  EXPECT_EQ(run.aux(), "S100 M3") << "no end code that nobody wrote";
  EXPECT_EQ(run.lines(), (std::vector<unsigned>{1}));
  Bench dgshape_bench(NC_DIALECT_DGSHAPE);
  ASSERT_EQ(nc_mdi_load(dgshape_bench.control(), 0, "G0X5000", 7), NC_OK);
  EXPECT_EQ(dgshape_bench.finish().path(), (Path{"rapid 5 0 0"}));
}

TEST(Mdi, AMarkInTheBlocksIsNotDoubled) {  // DGSHAPE 2-6, M700 App.1 P36
  Bench bench(NC_DIALECT_DGSHAPE);
  const auto mdi = [](Bench& on, const std::string& blocks) {
    EXPECT_EQ(nc_mdi_load(on.control(), 0, blocks.data(), blocks.size()), NC_OK);
    return on.finish();
  };
  EXPECT_EQ(mdi(bench, " \n%\nG0X5000").path(), (Path{"rapid 5 0 0"}));
  EXPECT_EQ(mdi(bench, "G0X6000\n%\nG0X7000").alarm, "NC-END");  // the block behind the mark must not be lost without an alarm
  Bench m700_bench;
  EXPECT_EQ(mdi(m700_bench, "G0X6.\n%\nG0X7.").alarm, "P36");
}

TEST(Mdi, ModalCodesStayFromOneToTheNextUntilResetOrAProgram) {  // M700 5.1
  Bench bench;
  const auto mdi = [&](const std::string& blocks) {
    EXPECT_EQ(nc_mdi_load(bench.control(), 0, blocks.data(), blocks.size()), NC_OK);
    return bench.finish();
  };
  EXPECT_EQ(mdi("G91 G1 X2. F500").path(), (Path{"line 2 0 0 F500"}));
  EXPECT_EQ(mdi("X3.").path(), (Path{"line 5 0 0 F500"}));
  EXPECT_EQ(mdi("G55").alarm, "");
  EXPECT_EQ(mdi("G81 X1. Z-1. R0").alarm, "");
  EXPECT_EQ(mdi("Y1.").path(), (Path{"line 6 1 0 F500"})) << "a cycle does not stay";
  EXPECT_EQ(nc_reset(bench.control(), 0), NC_OK);
  EXPECT_EQ(mdi("X1. F100").path(), (Path{"line 1 1 0 F100"})) << "absolute again";
  EXPECT_EQ(mdi("G91").alarm, "");
  EXPECT_EQ(bench.run("G0 X7.\nM30").path(), (Path{"rapid 7 1 0"})) << "a program begins with the initial codes";
}

// A host can ask for a parameter by its role, whatever number the dialect gives it.
TEST(Create, TellsTheKeysOfParametersByTheirRole) {
  Bench m700(NC_DIALECT_M700), dgshape(NC_DIALECT_DGSHAPE);
  const auto key = [](Bench& bench, nc_parameter_role role) {
    char text[24] = "";
    const nc_status status = nc_parameter_key_get(bench.control(), role, text);
    return status == NC_OK ? std::string(text) : status == NC_E_NOT_FOUND ? "none" : "refused";
  };
  EXPECT_EQ(key(m700, NC_PARAMETER_DECIMAL_TYPE_2), "1078");
  EXPECT_EQ(key(m700, NC_PARAMETER_DWELL_POINT), "8112");
  EXPECT_EQ(key(m700, NC_PARAMETER_TOOL_MEMORY), "1037");
  EXPECT_EQ(key(m700, NC_PARAMETER_POWER_OFF_CLEARS), "1129");
  EXPECT_EQ(key(m700, NC_PARAMETER_DIGIT_FEED), "1185");
  EXPECT_EQ(key(m700, static_cast<nc_parameter_role>(5)), "refused");
  EXPECT_EQ(key(dgshape, NC_PARAMETER_TOOL_MEMORY), "none");
  EXPECT_EQ(nc_parameter_key_get(nullptr, NC_PARAMETER_TOOL_MEMORY, nullptr), NC_E_ARGUMENT);
}

// And how it reads lengths without a decimal point.
TEST(Create, TellsWhatLengthsWithoutAPointAre) {
  const auto whole = [](auto&& bench) {
    bool found = false;
    EXPECT_EQ(nc_undotted_get(bench.control(), 0, &found), NC_OK);
    return found;
  };
  Bench m700(NC_DIALECT_M700), dgshape(NC_DIALECT_DGSHAPE);
  EXPECT_FALSE(whole(m700) || whole(dgshape) || whole(Bench(NC_DIALECT_HX)));
  EXPECT_TRUE(whole(Bench(NC_DIALECT_ISO)) && whole(Bench(NC_DIALECT_SERIES8)));
  EXPECT_TRUE(whole(m700.param("1078", "1")) && whole(dgshape.param("interpretation", "calculator")));
  EXPECT_EQ(nc_undotted_get(m700.control(), 0, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_undotted_get(m700.control(), 7, nullptr), NC_E_ARGUMENT);
}

}  // namespace
}  // namespace nc::test
