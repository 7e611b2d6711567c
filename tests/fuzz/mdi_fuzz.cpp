// SPDX-License-Identifier: Apache-2.0
// Any bytes as MDI blocks, several times in succession on one control: a text that is too long is refused and changes nothing, the text is copied,
// each program comes to its end or to an alarm, and after a reset the next one is accepted.
#include <memory>

#include "fuzz/small_control.hpp"

namespace {

using namespace nc::fuzz;

constexpr std::size_t kLongest = 1024;
constexpr unsigned kMaxItems = 300, kMaxIdle = 50;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes in(data, size);
  SmallControl control;
  for (unsigned round = 0; round < 4 && !in.empty(); ++round) {
    const std::uint8_t shape = in.byte();
    std::string text = in.text(1 + 4u * in.byte());
    // Texts of about the greatest length, which inputs rarely have.
    if ((shape & 3) == 3) text.append(kLongest - 2 + (shape >> 2 & 7u) - std::min(text.size(), kLongest - 2), ' ');
    // The memory has exactly the size of the text, so that the sanitizer finds a read behind it; it is freed before the blocks run, which shows
    // that they were copied.
    auto given = std::make_unique<char[]>(text.size());
    std::copy(text.begin(), text.end(), given.get());
    const nc_status loaded = nc_mdi_load(control.get(), 0, given.get(), text.size());
    given.reset();
    require(loaded == NC_OK || text.size() > kLongest);
    if (text.size() > kLongest) require(loaded != NC_OK);
    require(nc_mdi_load(control.get(), 1, "", 0) != NC_OK);  // there is no such part system
    if (loaded != NC_OK) continue;
    Puller puller(control.get(), 0);
    puller.pull_all(kMaxItems, kMaxIdle);
    require(nc_reset(control.get(), 0) == NC_OK);
  }
  return 0;
}
