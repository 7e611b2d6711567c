// SPDX-License-Identifier: Apache-2.0
// Any text as the data sheet of a drive. It is refused with errors that name lines of it, or it is read, and can be compared with what an axis
// needs.
#include "fuzz/input.hpp"
#include "hal/canopen/eds.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nc::hal::canopen;
  using nc::fuzz::require;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto lines = static_cast<unsigned>(std::count(text.begin(), text.end(), '\n')) + 1;
  Eds eds;
  const auto errors = read_eds(text, &eds);
  for (const EdsError& error : errors) require(error.line <= lines && !error.text.empty());
  for (const auto& [key, object] : eds.objects) require(key >> 8 <= 0xFFFF && object.line <= lines && object.bits <= 64);
  NodeMap node;
  node.axes.emplace_back();
  node.axes[0].slot = size % 3;
  node.axes[0].skip_signal = size % 2;
  node.axes[0].homing_method = static_cast<std::int8_t>(size % 5);
  node.objects.push_back({0x6065, 0, 4, 1});
  for (const EdsError& error : check_eds(eds, node)) require(error.line <= lines && !error.text.empty());
  return 0;
}
