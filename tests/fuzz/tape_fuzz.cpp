// SPDX-License-Identifier: Apache-2.0
// Any bytes as the rows of a punched tape, in each code and in each unit: the program comes to its end or to an alarm, and to the same one when it
// is read again. A code or unit that does not exist is refused.
#include "fuzz/small_control.hpp"

namespace {

using namespace nc::fuzz;

constexpr unsigned kMaxItems = 500, kMaxIdle = 50, kUnits = 5;

struct Result {
  nc_status taken = NC_OK, selected = NC_OK, status = NC_OK;
  std::vector<Seen> seen;
};

Result run(const std::string& rows, std::uint8_t tape, unsigned unit) {
  SmallControl control;
  Result result;
  unsigned file = 0;
  require(nc_program_add_text(control.get(), "O1.nc", rows.data(), rows.size(), &file) == NC_OK);
  result.taken = nc_program_tape(control.get(), file, tape, unit);
  result.selected = nc_program_select(control.get(), 0, file);
  if (result.selected != NC_OK) return result;
  Puller puller(control.get(), 0);
  puller.pull_all(kMaxItems, kMaxIdle);
  result.status = puller.status();
  result.seen = std::move(puller.seen);
  return result;
}

/// The eighth hole makes the number of holes even (ISO).
std::string iso_rows(const std::string& text) {
  std::string rows;
  for (const char c : text) {
    const unsigned code = static_cast<unsigned char>(c) & 0x7f;
    rows += static_cast<char>(code | static_cast<unsigned>(__builtin_parity(code)) << 7);
  }
  return rows;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes in(data, size);
  const std::uint8_t shape = in.byte();
  const std::uint8_t tape = shape & 7;
  const unsigned unit = shape >> 3 & 7u;
  std::string rows = in.rest();
  if ((shape & 0x40) != 0) rows = iso_rows(rows);
  const Result result = run(rows, tape, unit);
  if (tape > NC_TAPE_EIA || (tape != NC_TAPE_NONE && (unit < 1 || unit > kUnits))) require(result.taken != NC_OK);
  const Result again = run(rows, tape, unit);
  require(again.taken == result.taken && again.selected == result.selected && again.status == result.status);
  require(again.seen == result.seen);
  return 0;
}
