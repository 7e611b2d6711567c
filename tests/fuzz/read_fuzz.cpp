// SPDX-License-Identifier: Apache-2.0
// A program behind a read callback that gives short reads, fails, reports that the text has changed, or gives other bytes the next time. Short
// reads change nothing. After a failure there are no items that the whole text would not have given, and the run ends in an alarm.
#include "fuzz/small_control.hpp"

namespace {

using namespace nc::fuzz;

constexpr unsigned kMaxItems = 500, kMaxIdle = 50;
enum class Trouble : std::uint8_t { kNone, kShort, kFailed, kChanged, kOtherBytes, kCount };

struct Source {
  std::string text;
  Trouble trouble = Trouble::kNone;
  unsigned step = 1;     // bytes of a short read
  unsigned good = 0;     // reads before the trouble begins
  unsigned calls = 0;
  bool failed = false;   // the callback has reported a failure
};

long read_at(void* user, std::uint64_t offset, char* buffer, std::size_t size) {
  Source& source = *static_cast<Source*>(user);
  const bool troubled = source.calls++ >= source.good;
  if (offset >= source.text.size()) return 0;
  std::size_t count = std::min<std::size_t>(size, source.text.size() - offset);
  if (source.trouble == Trouble::kShort) count = std::min<std::size_t>(count, source.step);
  std::memcpy(buffer, source.text.data() + offset, count);
  if (!troubled) return static_cast<long>(count);
  if (source.trouble == Trouble::kFailed || source.trouble == Trouble::kChanged) {
    std::memset(buffer, 'X', count);  // nothing of this may act
    source.failed = true;
    return source.trouble == Trouble::kFailed ? NC_READ_FAILED - static_cast<long>(source.step & 1) * 5 : NC_READ_CHANGED;
  }
  if (source.trouble == Trouble::kOtherBytes) {
    for (std::size_t i = 0; i < count; i += 1 + source.step) buffer[i] = static_cast<char>(source.calls * 31 + i);
  }
  return static_cast<long>(count);
}

struct Run {
  std::vector<Seen> seen;
  nc_status added = NC_OK, selected = NC_OK, status = NC_OK;
};

Run run(Source* source) {
  SmallControl control;
  Run result;
  unsigned file = 0;
  result.added = nc_program_add(control.get(), "O1.nc", read_at, source, source->text.size(), &file);
  if (result.added != NC_OK) return result;
  result.selected = nc_program_select(control.get(), 0, file);
  if (result.selected != NC_OK) return result;
  Puller puller(control.get(), 0);
  puller.pull_all(kMaxItems, kMaxIdle);
  result.seen = std::move(puller.seen);
  result.status = puller.status();
  return result;
}

/// The number of items at the beginning that are the same in both runs. The alarm and the end after a failed read are not in the other run.
std::size_t same_from_start(const Run& a, const Run& b) {
  const std::size_t count = std::min(a.seen.size(), b.seen.size());
  const auto differs = std::mismatch(a.seen.begin(), a.seen.begin() + static_cast<long>(count), b.seen.begin());
  return static_cast<std::size_t>(differs.first - a.seen.begin());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes in(data, size);
  Source whole, troubled;
  troubled.trouble = static_cast<Trouble>(in.byte() % static_cast<unsigned>(Trouble::kCount));
  troubled.step = 1 + in.byte() % 64;
  troubled.good = in.byte() % 32;
  whole.text = troubled.text = in.rest();
  const Run expected = run(&whole), got = run(&troubled);
  require(expected.added == NC_OK);
  if (troubled.trouble == Trouble::kNone || troubled.trouble == Trouble::kShort) {
    require(got.added == expected.added && got.selected == expected.selected && got.status == expected.status);
    require(got.seen == expected.seen);
  } else if (troubled.failed) {
    // A block that is in the window already may end the program before the text is read again.
    const bool refused = got.added != NC_OK || got.selected != NC_OK;
    require(refused || got.status == NC_ALARMED || got.seen == expected.seen);
    std::size_t moves = 0;
    for (std::size_t i = same_from_start(got, expected); i < got.seen.size(); ++i) moves += got.seen[i].kind == NC_ITEM_MOVE;
    require(moves == 0);
  }
  return 0;
}
