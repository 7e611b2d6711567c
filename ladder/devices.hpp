// SPDX-License-Identifier: Apache-2.0
// Devices, which a ladder program can name, and their memory.
//
// A device is a bit, a 16-bit word or a 32-bit word with a name: a signal between NC and ladder, a point of
// the machine, or an internal device of the program (M, D, T, C ... with a number). The table is made before
// the program is compiled and does not change after that. Compiled code holds only indices, so that a scan never
// searches. A 32-bit word takes two neighbouring words, low half first, as the D forms of the instructions
// (DMOV, D+, D>) expect.
#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace nc::ladder {

enum class DeviceType : std::uint8_t { kBit, kWord16, kWord32 };
constexpr const char* type_name(DeviceType type) { return type == DeviceType::kBit ? "bit" : type == DeviceType::kWord16 ? "16 bit" : "32 bit"; }

struct Device {
  std::string name;
  DeviceType type = DeviceType::kBit;
  bool writable = false;    // the program may write it; inputs and signals from the NC are read-only
  std::uint32_t index = 0;  // index in DeviceImage::bit or DeviceImage::word
  std::string comment;      // for listings and monitors
};

class DeviceTable {
 public:
  // Adds a device. Returns its index in its array, or -1 when the name is taken. Names consist of letters, digits, '_', '-' and
  // '.', and are case-sensitive (the internal devices of the instruction list are upper case).
  std::int64_t add(std::string_view name, DeviceType type, bool writable, std::string_view comment = {}) {
    if (by_name_.count(std::string(name)) != 0) return -1;
    Device device{std::string(name), type, writable, 0, std::string(comment)};
    if (type == DeviceType::kBit) {
      device.index = bits_++;
    } else {
      device.index = words_;
      words_ += type == DeviceType::kWord32 ? 2 : 1;
    }
    by_name_.emplace(device.name, devices_.size());
    devices_.push_back(device);
    return device.index;
  }
  // Null when there is none.
  const Device* find(std::string_view name) const {
    const auto it = by_name_.find(std::string(name));
    return it == by_name_.end() ? nullptr : &devices_[it->second];
  }
  const std::vector<Device>& all() const { return devices_; }
  std::uint32_t bits() const { return bits_; }
  std::uint32_t words() const { return words_; }

 private:
  std::vector<Device> devices_;
  std::map<std::string, std::size_t> by_name_;
  std::uint32_t bits_ = 0, words_ = 0;
};

// The memory of the devices. Its size is fixed by the compiler, which appends internal devices to those of the table. It belongs to
// the scan thread.
struct DeviceImage {
  std::vector<std::uint8_t> bit;  // 0 or 1
  std::vector<std::int16_t> word;

  std::int32_t word32(std::uint32_t index) const noexcept {
    std::int32_t value;
    std::memcpy(&value, &word[index], sizeof value);
    return value;
  }
  void set_word32(std::uint32_t index, std::int32_t value) noexcept {
    std::memcpy(&word[index], &value, sizeof value);
  }
  // A device by its type and its index.
  std::int32_t value(DeviceType type, std::uint32_t index) const noexcept {
    return type == DeviceType::kBit ? bit[index] : type == DeviceType::kWord16 ? word[index] : word32(index);
  }
  void set_value(DeviceType type, std::uint32_t index, std::int32_t value) noexcept {
    if (type == DeviceType::kBit) bit[index] = value != 0;
    else if (type == DeviceType::kWord16) word[index] = static_cast<std::int16_t>(value);
    else set_word32(index, value);
  }
};

}  // namespace nc::ladder
