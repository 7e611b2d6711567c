// SPDX-License-Identifier: Apache-2.0
// Fuzz target: any bytes as a ladder program. The result is errors that name the file, or a program whose scans end,
// with the same result on both interpreters, and write no device that they must not write.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>

#include "ladder/code.hpp"
#include "ladder/exchange.hpp"

namespace {

using namespace nc::ladder;

const DeviceTable& machine() {
  static const DeviceTable table = [] {
    DeviceTable t;
    for (const char* name : {"X0", "X1", "X2", "nc.strobe"}) t.add(name, DeviceType::kBit, false);
    for (const char* name : {"Y0", "Y1", "nc.fin1"}) t.add(name, DeviceType::kBit, true);
    t.add("in16", DeviceType::kWord16, false);
    t.add("in32", DeviceType::kWord32, false);
    t.add("out16", DeviceType::kWord16, true);
    t.add("out32", DeviceType::kWord32, true);
    return t;
  }();
  return table;
}

void put_inputs(DeviceImage* image, unsigned scan, std::size_t size) {
  for (const Device& device : machine().all()) {
    if (device.writable) continue;
    const std::size_t value = (size * 2654435761u + device.index * 40503u) >> scan;
    if (device.type == DeviceType::kBit) image->bit[device.index] = value & 1u;
    if (device.type == DeviceType::kWord16) image->word[device.index] = static_cast<std::int16_t>(value);
    if (device.type == DeviceType::kWord32) image->set_word32(device.index, static_cast<std::int32_t>(value));
  }
}

void require(bool holds) {
  if (!holds) std::abort();
}

void run(const Program& program, std::size_t size) {
  Engine engine(program);
  DeviceImage image = engine.make_image(), portable = image;
  for (unsigned scan = 0; scan < 3 && engine.fault() == kNoFault; ++scan) {
    put_inputs(&image, scan, size);
    put_inputs(&portable, scan, size);
    const DeviceImage before = image;
    engine.scan(&image);
    const Outcome outcome = execute_portable(*program.code(), &portable);
    require(outcome.fault == engine.fault() && outcome.step == engine.fault_step());
    require(image.bit == portable.bit && image.word == portable.word);
    require(engine.fault() == kNoFault || !engine.fault_text().empty());
    for (const std::uint8_t bit : image.bit) require(bit <= kEdgeUnknown);
    for (const Device& device : machine().all()) {
      if (device.writable) continue;
      if (device.type == DeviceType::kBit)
        require(image.bit[device.index] == before.bit[device.index]);
      else
        require(image.word[device.index] == before.word[device.index]);
      if (device.type == DeviceType::kWord32)
        require(image.word[device.index + 1] == before.word[device.index + 1]);
    }
  }
}

// The program takes its own place between two scans, and another one comes and goes: nobody may see that.
void exchange(const Program& program, std::size_t size) {
  static const Program other = [] {
    Program made;
    require(compile("LDP X0\nINC D8000\nLD X1\nOUT C511 K3\nEND\n", "other.il", machine(), {}, &made, nullptr));
    return made;
  }();
  Engine plain(program), exchanged(program);
  DeviceImage image = plain.make_image(), moved = image;
  Exchange self, there;
  std::string reason;
  // A timer with two units in one program is none that can go on.
  if (!self.prepare(program, program, &reason)) return require(!reason.empty());
  for (unsigned scan = 0; scan < 4 && plain.fault() == kNoFault; ++scan) {
    put_inputs(&image, scan, size);
    put_inputs(&moved, scan, size);
    DeviceImage next = exchanged.make_image();
    self.carry(moved, &next);
    plain.scan(&image);
    exchanged.scan(&next);
    moved = std::move(next);
    require(plain.fault() == exchanged.fault());
    const auto common = static_cast<std::ptrdiff_t>(program.code()->layout.edges);
    require(std::equal(image.bit.begin(), image.bit.begin() + common, moved.bit.begin()));
    require(std::equal(image.word.begin(), image.word.begin() + program.code()->layout.loops, moved.word.begin()));
  }
  if (!there.prepare(program, other, &reason)) return require(!reason.empty());
  Engine last(other);
  DeviceImage end = last.make_image();
  there.carry(moved, &end);
  last.scan(&end);
  require(last.fault() == kNoFault);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  CompileOptions options;
  options.step_budget = 20000;
  Program program;
  std::vector<Error> errors;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (compile(text, "fuzz.il", machine(), options, &program, &errors)) {
    require(errors.empty());
    run(program, size);
    exchange(program, size);
  } else {
    require(!errors.empty() && program.instruction_count() == 0);
    for (const Error& error : errors)
      require(!error.message.empty() && error.text().rfind("fuzz.il:", 0) == 0);
  }
  return 0;
}
