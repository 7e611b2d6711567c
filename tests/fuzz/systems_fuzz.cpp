// SPDX-License-Identifier: Apache-2.0
// Two programs (separated by a byte 0) in two part systems, pulled in an order that the input chooses: each has serials without gaps, finite
// numbers, and its own end or alarm.
#include <array>

#include "fuzz/small_control.hpp"

namespace {

using namespace nc::fuzz;

constexpr unsigned kMaxItems = 300, kMaxIdle = 60;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes in(data, size);
  std::uint32_t order = in.value<std::uint32_t>();
  const std::string both = in.rest();
  const std::size_t parted = std::min(both.find('\0'), both.size());
  const std::array<std::string, 2> text{both.substr(0, parted), both.substr(std::min(parted + 1, both.size()))};

  SmallControl control(2);
  std::array<Puller, 2> puller{Puller(control.get(), 0), Puller(control.get(), 1)};
  for (unsigned s = 0; s < 2; ++s) {
    unsigned file = 0;
    require(nc_program_add_text(control.get(), s == 0 ? "O1.nc" : "O2.nc", text[s].data(), text[s].size(), &file) == NC_OK);
    require(nc_program_select(control.get(), s, file) == NC_OK);
  }
  std::array<unsigned, 2> idle{};
  const auto open = [&](unsigned s) { return !puller[s].done() && idle[s] < kMaxIdle && puller[s].seen.size() < kMaxItems; };
  while (open(0) || open(1)) {
    order = order * 1664525u + 1013904223u;
    const unsigned s = open(order >> 31) ? order >> 31 : 1 - (order >> 31);
    if (!puller[s].pull() && !puller[s].done()) ++idle[s];
  }
  for (unsigned s = 0; s < 2; ++s) {
    require(nc_reset(control.get(), s) == NC_OK);
    nc_alarm alarm;
    require(nc_alarm_get(control.get(), s, &alarm) != NC_OK);
  }
  return 0;
}
