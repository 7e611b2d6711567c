// SPDX-License-Identifier: Apache-2.0
// SHA-256 (FIPS 180-4) over bytes that come piece by piece.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace nc::rt::services {

class Sha256 {
 public:
  void add(std::string_view bytes);
  // The hash of all bytes as 64 hexadecimal digits. Nothing may be added afterwards.
  std::string finish();

 private:
  void block(const unsigned char* bytes);
  std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<unsigned char, 64> rest_{};  // bytes that do not fill a block yet
  std::size_t filled_ = 0;
  std::uint64_t total_ = 0;
};

}  // namespace nc::rt::services
