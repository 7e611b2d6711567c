// SPDX-License-Identifier: Apache-2.0
// A small machine for the tests: some inputs and outputs, a program, scans. Every scan runs on all three interpreters,
// which have to agree in every bit and word. The one for forced devices and the power flow forces a device that never changes.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "ladder/code.hpp"

namespace nc::ladder {

inline DeviceTable test_table() {
  DeviceTable table;
  for (const char* name : {"X0", "X1", "X2", "X3", "X4", "X5", "nc.m_strobe", "door_closed"})
    table.add(name, DeviceType::kBit, false);
  for (const char* name : {"Y0", "Y1", "Y2", "Y3", "Y4", "Y5", "plc.fin1", "part_present"})
    table.add(name, DeviceType::kBit, true);
  table.add("in16", DeviceType::kWord16, false);
  table.add("in32", DeviceType::kWord32, false);
  table.add("out16", DeviceType::kWord16, true);
  table.add("out32", DeviceType::kWord32, true);
  return table;
}

inline std::string all_text(const std::vector<Error>& errors) {
  std::string out;
  for (const Error& error : errors) out += error.text() + "\n";
  return out;
}

class Rig {
 public:
  explicit Rig(std::string_view text, CompileOptions options = {}) : Rig(text, test_table(), options) {}
  Rig(std::string_view text, const DeviceTable& table, CompileOptions options = {})
      : program_(build(text, table, options)),
        engine_(program_),
        image(engine_.make_image()),
        portable_(engine_.make_image()),
        held_(engine_.make_image()) {}

  void scan(unsigned count = 1) {
    for (unsigned i = 0; i < count; ++i) {
      held_ = portable_ = image;
      const bool stopped = engine_.fault() != kNoFault;
      engine_.scan(&image);
      if (stopped) return;
      const Outcome outcome = execute_portable(*program_.code(), &portable_);
      ASSERT_EQ(outcome.fault, engine_.fault());
      ASSERT_EQ(outcome.step, engine_.fault_step());
      ASSERT_EQ(portable_.bit, image.bit);
      ASSERT_EQ(portable_.word, image.word);
      const Hold off{DeviceType::kBit, program_.code()->layout.sm + kSmOff, 0};
      std::vector<std::uint8_t> flow(program_.flow_bytes());
      const Outcome held = execute_watched(*program_.code(), &held_, &off, 1, flow.data());
      ASSERT_EQ(held.fault, engine_.fault());
      ASSERT_EQ(held.step, engine_.fault_step());
      ASSERT_EQ(held_.bit, image.bit);
      ASSERT_EQ(held_.word, image.word);
    }
  }

  const Device& device(std::string_view name) const {
    static const Device none{};
    const Device* found = engine_.find(name);
    EXPECT_NE(found, nullptr) << name;
    return found == nullptr ? none : *found;
  }
  void set(std::string_view name, std::int32_t value) {
    const Device& d = device(name);
    if (d.type == DeviceType::kBit) image.bit[d.index] = value != 0;
    if (d.type == DeviceType::kWord16) image.word[d.index] = static_cast<std::int16_t>(value);
    if (d.type == DeviceType::kWord32) image.set_word32(d.index, value);
  }
  std::int32_t get(std::string_view name) const {
    const Device& d = device(name);
    if (d.type == DeviceType::kBit) return image.bit[d.index];
    return d.type == DeviceType::kWord16 ? image.word[d.index] : image.word32(d.index);
  }
  // Two words as one of 32 bits, as D0 and D1.
  void set32(std::string_view name, std::int32_t value) { image.set_word32(device(name).index, value); }
  std::int32_t get32(std::string_view name) const { return image.word32(device(name).index); }

  const Program& program() const { return program_; }
  Engine& engine() { return engine_; }

 private:
  static Program build(std::string_view text, const DeviceTable& table, const CompileOptions& options) {
    Program program;
    std::vector<Error> errors;
    EXPECT_TRUE(compile(text, "test.il", table, options, &program, &errors)) << all_text(errors) << text;
    return program;
  }
  Program program_;
  Engine engine_;

 public:
  DeviceImage image;

 private:
  DeviceImage portable_, held_;
};

// The errors that compile() reports for a program.
inline std::vector<Error> errors_of(std::string_view text, const CompileOptions& options = {}) {
  Program program;
  std::vector<Error> errors;
  EXPECT_FALSE(compile(text, "test.il", test_table(), options, &program, &errors)) << text;
  EXPECT_EQ(program.instruction_count(), 0u) << "the program was replaced";
  return errors;
}

}  // namespace nc::ladder
