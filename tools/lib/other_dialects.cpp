// SPDX-License-Identifier: Apache-2.0
#include "tools/lib/other_dialects.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <string_view>
#include <vector>

#include "tools/lib/codes_of_line.hpp"
#include "tools/lib/dialect_names.hpp"
#include "tools/lib/item_source.hpp"
#include "tools/lib/number_hints.hpp"
#include "tools/lib/virtual_world.hpp"

namespace nc::tools {
namespace {

constexpr size_t kMostRefused = 12;          // so many lines show well enough that a family does not read a text
constexpr size_t kLongestText = 1024 * 1024;  // a longer one is run once by each family: it is not run again without lines
constexpr uint64_t kLongestRun = 400'000;    // blocks and moves of one run, which shows enough of a program; the same for each family, so that they are compared fairly
constexpr uint64_t kWholePart = 12;          // a program of so many blocks is a part: that a family reads it better in each line is no accident

/** What a family makes of a text. */
struct Reading {
  std::set<uint32_t> refused;  // lines of the main program that have an alarm
  bool whole_numbers = false;  // lengths without a point are mm or inch
  bool ends = false;           // without them the program comes to its end, or goes on for longer than a run is
  uint64_t moves = 0, blocks = 0;
  uint64_t work = 0;  // blocks and moves of all its runs
};

/** Ends a run that is long enough. Cycles are counted by their moves, too: one block may make very many. */
class ShortRun : public RunSink {
 public:
  void move(const nc_source&, const nc_move&) override { ++work_; }
  void block(const nc_source&, const nc_axes&, const nc_axes&) override { ++work_; }
  bool stop() const override { return work_ >= kLongestRun; }
  uint64_t work() const { return work_; }

 private:
  uint64_t work_ = 0;
};

/** Takes a line out of a text, in which the numbers of the others stay. @return false when there is nothing in it. */
bool take_out(std::string* text, uint32_t line) {
  size_t begin = 0;
  if (line == 0) return false;
  for (uint32_t i = 1; i < line; ++i) {
    begin = text->find('\n', begin);
    if (begin == std::string::npos) return false;
    ++begin;
  }
  const size_t end = std::min(text->find('\n', begin), text->size());
  if (text->find_first_not_of(" \r", begin) >= end) return false;
  text->replace(begin, end - begin, end - begin, ' ');
  return true;
}

/** Runs the program once. @return false when it cannot be run at all. */
bool run_once(const SessionOptions& options, const RunLimits& limits, bool whole_numbers, RunResult* result, bool* in_main, Reading* reading) {
  Session session;
  std::string error;
  if (!session.configure(options, &error) || !session.start(options, &error)) return false;
  if (nc_undotted_get(session.control(), kPartSystem, &reading->whole_numbers) != NC_OK || (whole_numbers && !reading->whole_numbers)) return false;
  ControlSource items(session.control(), session.dialect());
  VirtualWorld world(session.setup(), session.config().system[0]);
  world.spindle_may_turn();
  ShortRun sink;
  *result = run_offline(&items, &world, &sink, session.decides(), limits.silent_blocks, true, {}, limits.loops);
  *in_main = result->alarm.source.file == session.main_file();
  reading->work += sink.work();
  return true;
}

Reading read_as(const std::string& family, const SessionOptions& given, const std::string& text, const RunLimits& limits, bool whole_numbers) {
  SessionOptions options = given;
  options.dialect = family;
  options.dialect_given = true;
  options.print.clear();
  options.setup.clear();  // they belong to the family of the program as it was given
  options.machine.clear();
  const bool again = !text.empty() && text.size() <= kLongestText;
  if (again) options.text = text;
  Reading reading;
  while (reading.refused.size() < kMostRefused && reading.work < kMostReadByFamily - kLongestRun) {
    RunResult result;
    bool in_main = false;
    if (!run_once(options, limits, whole_numbers, &result, &in_main, &reading)) break;
    reading.ends = result.how == RunResult::How::kEnded || result.how == RunResult::How::kStopped || result.how == RunResult::How::kEndless;
    reading.moves = result.moves;
    reading.blocks = result.blocks;
    if (result.how != RunResult::How::kAlarmed || !in_main) break;
    if (again && !take_out(&*options.text, result.alarm.source.line)) break;
    reading.refused.insert(result.alarm.source.line);
    if (!again) break;
  }
  return reading;
}

std::vector<uint32_t> only_in(const std::set<uint32_t>& these, const std::set<uint32_t>& those) {
  std::vector<uint32_t> lines;
  std::set_difference(these.begin(), these.end(), those.begin(), those.end(), std::back_inserter(lines));
  return lines;
}

/** What a text shows to the reader of a family before it is run, line by line: what is here is never a consequence of another line. */
struct LineText {
  bool readable = true;  // every block of the line is one of the family's language
  CodeSet codes;         // numbers of its codes, up to where it is readable
};

std::vector<LineText> lines_as(nc_dialect dialect, std::string_view text) {
  std::vector<LineText> lines(1);
  nc_block_text block = NC_INIT(nc_block_text);
  nc_plain_word words[NC_MAX_WORDS];
  for (size_t begin = 0; begin < text.size(); begin += block.used) {
    if (nc_block_words(dialect, "", text.data() + begin, text.size() - begin, &block, words) != NC_OK) break;
    LineText& line = lines.back();
    line.readable = line.readable && !block.fault;
    for (uint32_t i = 0; i < block.count; ++i)
      if (const int code = code_of(words[i]); code >= 0) line.codes.insert(code);
    if (text[begin + block.used - 1] == '\n') lines.emplace_back();
  }
  return lines;
}

/** A family, what it makes of the program, and what the text shows to it. */
struct Family {
  std::string name;
  Reading reading;
  std::vector<LineText> lines;
  CodeSet codes;  // those that it executes
};

/** What speaks for one family and against another one, in signs. */
struct Signs {
  size_t count = 0;
  size_t shown = 0;  // of them those that the text alone shows
};

/**
 * The signs that a program is of family `these` and not of family `those`: a line that is written in the language of the first one alone, each code that only
 * the first one has, and lines that the second one refuses and the first one does not. Of the latter those in a row count as one mistake, because an alarm in
 * the line behind another one may be its consequence.
 */
Signs signs_for(const Family& these, const Family& those) {
  Signs signs;
  std::set<uint32_t> shown;  // lines whose text shows it
  CodeSet seen;
  for (uint32_t i = 0; i < these.lines.size() && i < those.lines.size(); ++i) {
    const LineText &here = these.lines[i], &there = those.lines[i];
    if (!here.readable) continue;
    if (!there.readable) ++signs.count, shown.insert(i + 1);
    for (const int code : here.codes) {
      if (these.codes.count(code) == 0 || those.codes.count(code) != 0) continue;
      shown.insert(i + 1);
      signs.count += seen.insert(code).second;
    }
  }
  signs.shown = signs.count;
  uint32_t before = 0;
  for (const uint32_t line : those.reading.refused) {
    if (these.reading.refused.count(line) != 0) continue;
    if (shown.count(line) == 0 && (before == 0 || line != before + 1)) ++signs.count;
    before = line;
  }
  return signs;
}

constexpr size_t kEnough = 2;  // signs: one alone is a slip
constexpr size_t kFactor = 3;  // so many times more speaks for a family than against it

/** Lengths without a point are probably meant as one family reads them, and not as another one does. */
bool fits_better(const NumberHints& numbers, bool whole, bool others_whole) {
  return whole != others_whole && (whole ? numbers.probably_whole() : numbers.probably_least());
}

/** The family reads the program clearly better than the own one. A program without moves does not show that it is of a family. */
bool clearly_better(const Family& other, const Family& own, const NumberHints& numbers) {
  const Signs gained = signs_for(other, own);
  if (!other.reading.ends || (other.reading.moves == 0 && gained.shown < kEnough)) return false;
  const size_t lost = signs_for(own, other).count;
  size_t signs = gained.count;
  // What the own family refuses line by line until it gives up is no consequence of one mistake; of what lies behind it says nothing.
  if (!own.reading.ends) signs = std::max(signs, only_in(own.reading.refused, other.reading.refused).size());
  if (gained.shown != 0 && other.reading.refused.empty() && fits_better(numbers, other.reading.whole_numbers, own.reading.whole_numbers)) ++signs;
  if (lost == 0) return signs >= kEnough || (signs > 0 && other.reading.blocks >= kWholePart);
  return signs >= std::max(kEnough, kFactor * lost);
}

struct Found {
  std::string family;
  size_t refused;
};

/** Another family reads all that this one reads, and lines that it refuses. */
bool is_worse_than_any(const Family& one, const std::vector<Family>& others) {
  return std::any_of(others.begin(), others.end(), [&one](const Family& other) {
    return other.reading.ends && other.reading.refused.size() < one.reading.refused.size() && only_in(other.reading.refused, one.reading.refused).empty();
  });
}

std::string note(const std::vector<Found>& found) {
  if (found.empty()) return "";
  std::string names;
  for (size_t i = 0; i < found.size(); ++i) names += (i == 0 ? "" : i + 1 == found.size() ? " or " : ", ") + found[i].family;
  const size_t refused = found.front().refused;
  const std::string how = refused == 0 ? "it ends without an alarm" : std::to_string(refused) + (refused == 1 ? " line has an alarm" : " lines have an alarm");
  return "note: this looks like a program of " + names + ", as which " + how + "; try --dialect " + found.front().family;
}

}  // namespace

std::string other_dialect_note(const SessionOptions& options, const RunLimits& limits, const std::string& own, bool whole_numbers, uint64_t* work) {
  if ((options.program == "-" && !options.text) || !options.tape.empty()) return "";
  std::string text, axes;
  {
    Session session;
    std::string error;
    if (!session.configure(options, &error) || !session.start(options, &error)) return "";
    text = session.main_text();
    const nc_system_config& system = session.config().system[kPartSystem];
    for (unsigned i = 0; i < system.axis_count; ++i) axes += system.axis[i].name;
  }
  const bool looked_at = !whole_numbers && text.size() <= kLongestText;
  const auto family = [&](const std::string& name) {
    Family read{name, read_as(name, options, text, limits, whole_numbers && name != own), {}, {}};
    nc_dialect dialect{};
    if (looked_at && nc_dialect_get(name.c_str(), &dialect) == NC_OK) {
      read.lines = lines_as(dialect, text);
      read.codes = codes_of_family(dialect, true);
    }
    if (work != nullptr) *work += read.reading.work;
    return read;
  };
  if (work != nullptr) *work = 0;
  const Family of_own = family(own);
  if (of_own.reading.refused.empty() != whole_numbers) return "";  // no alarm with a default setup: it comes from the setup or the machine
  nc_dialect dialect{};
  NumberHints numbers;
  if (looked_at && nc_dialect_get(own.c_str(), &dialect) == NC_OK) numbers = number_hints(text, dialect, axes, true);
  std::vector<Family> others;
  for (const std::string& name : dialect_names())
    if (name != own) others.push_back(family(name));
  std::vector<Found> found;
  for (const Family& other : others) {
    const Reading& reading = other.reading;
    const bool looks_so = whole_numbers ? reading.ends && reading.refused.empty() && reading.moves > 0 : clearly_better(other, of_own, numbers);
    if (looks_so && !is_worse_than_any(other, others)) found.push_back({other.name, reading.refused.size()});
  }
  size_t least = ~size_t{0};
  for (const Found& one : found) least = std::min(least, one.refused);
  std::erase_if(found, [least](const Found& one) { return one.refused != least; });
  return note(found);
}

}  // namespace nc::tools
