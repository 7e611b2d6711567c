// SPDX-License-Identifier: Apache-2.0
#include "tools/lib/other_dialects.hpp"

#include <algorithm>
#include <iterator>
#include <map>
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
constexpr uint64_t kWholePart = 12;          // a program of so many blocks is a part: that a family reads it without an alarm is no accident

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
    reading.ends = result.how == RunResult::How::kEnded || result.how == RunResult::How::kStopped;
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

/** What a text shows of two families without being run. */
struct TextSigns {
  std::map<uint32_t, CodeSet> codes;  // of the lines that have codes which the own family's table does not have, and the other's has
  bool lengths = false;               // lengths without a point, which the own family reads in thousandths and the other in mm, are probably meant in mm
};

/**
 * Mistakes that lines show: an alarm in the line behind another one may be its consequence. A code that the family does not have is none, whatever stands in
 * front of it.
 */
size_t mistakes(const std::vector<uint32_t>& lines, const std::map<uint32_t, CodeSet>& foreign) {
  size_t count = 0;
  CodeSet seen;
  for (size_t i = 0; i < lines.size(); ++i) {
    const auto codes = foreign.find(lines[i]);
    bool another = i == 0 || lines[i] != lines[i - 1] + 1;
    if (codes != foreign.end())
      for (const int code : codes->second) another = seen.insert(code).second || another;
    if (another) ++count;
  }
  return count;
}

/** The family reads the program clearly better than the own one. A program without moves does not show that it is of a family. */
bool clearly_better(const Reading& other, const Reading& own, const TextSigns& text) {
  if (!other.ends || other.moves == 0) return false;
  std::vector<uint32_t> gained = only_in(own.refused, other.refused);
  bool foreign = false;  // the own family refuses a line because of a code that it does not have
  for (const auto& [line, codes] : text.codes) {
    if (own.refused.count(line) == 0) continue;
    foreign = true;  // and where the other one refuses this line, it does so for another reason: it has the code
    if (other.refused.count(line) != 0) gained.push_back(line);
  }
  std::sort(gained.begin(), gained.end());
  std::vector<uint32_t> lost = only_in(other.refused, own.refused);
  size_t signs = mistakes(gained, text.codes);
  if (!own.ends) {  // of what lies behind, the own family says nothing; and what it refuses line by line is no consequence of one mistake
    std::erase_if(lost, [&](uint32_t line) { return line > *own.refused.rbegin(); });
    signs = gained.size();
  }
  if (foreign && text.lengths && other.refused.empty()) ++signs;
  constexpr size_t kEnough = 2, kFactor = 3;
  if (lost.empty()) return signs >= kEnough || (signs > 0 && other.blocks >= kWholePart);
  return signs >= std::max(kEnough, kFactor * lost.size());
}

struct Found {
  std::string family;
  size_t refused;
};

std::string note(const std::vector<Found>& found) {
  if (found.empty()) return "";
  std::string names;
  for (size_t i = 0; i < found.size(); ++i) names += (i == 0 ? "" : i + 1 == found.size() ? " or " : ", ") + found[i].family;
  const size_t refused = found.front().refused;
  const std::string how = refused == 0 ? "it ends without an alarm" : std::to_string(refused) + (refused == 1 ? " line has an alarm" : " lines have an alarm");
  return "note: this looks like a program of " + names + ", as which " + how + "; try --dialect " + found.front().family;
}

/** Of lines of the text the codes that the other family reads there and has, and the own one does not have. */
std::map<uint32_t, CodeSet> foreign_codes(std::string_view text, const std::set<uint32_t>& lines, const std::string& own, const std::string& other) {
  std::map<uint32_t, CodeSet> foreign;
  nc_dialect of_own{}, of_other{};
  if (nc_dialect_get(own.c_str(), &of_own) != NC_OK || nc_dialect_get(other.c_str(), &of_other) != NC_OK) return foreign;
  const CodeSet has = codes_of_family(of_own), wanted = codes_of_family(of_other);
  uint32_t line = 1;
  for (size_t begin = 0; begin < text.size() && line <= *lines.rbegin(); ++line) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    if (lines.count(line) != 0)
      for (const int code : codes_of_line(of_other, text.substr(begin, end - begin)))
        if (has.count(code) == 0 && wanted.count(code) != 0) foreign[line].insert(code);
    begin = end + 1;
  }
  return foreign;
}

}  // namespace

std::string other_dialect_note(const SessionOptions& options, const RunLimits& limits, const std::string& own, bool whole_numbers, uint64_t* work) {
  if (options.program == "-" || !options.tape.empty()) return "";
  std::string text, axes;
  {
    Session session;
    std::string error;
    if (!session.configure(options, &error) || !session.start(options, &error)) return "";
    text = session.main_text();
    const nc_system_config& system = session.config().system[kPartSystem];
    for (unsigned i = 0; i < system.axis_count; ++i) axes += system.axis[i].name;
  }
  const Reading as_own = read_as(own, options, text, limits, false);
  if (work != nullptr) *work = as_own.work;
  if (as_own.refused.empty() != whole_numbers) return "";  // no alarm with a default setup: it comes from the setup or the machine
  bool mm_lengths = false;
  const bool looked_at = !whole_numbers && text.size() <= kLongestText;
  if (looked_at) {
    nc_dialect dialect{};
    mm_lengths = !as_own.whole_numbers && nc_dialect_get(own.c_str(), &dialect) == NC_OK && number_hints(text, dialect, axes, true).doubtful();
  }
  std::vector<Found> found;
  for (const std::string& family : dialect_names()) {
    if (family == own) continue;
    const Reading other = read_as(family, options, text, limits, whole_numbers);
    if (work != nullptr) *work += other.work;
    TextSigns signs;
    if (looked_at) signs = {foreign_codes(text, as_own.refused, own, family), mm_lengths && other.whole_numbers};
    const bool looks_so = whole_numbers ? other.ends && other.refused.empty() && other.moves > 0 : clearly_better(other, as_own, signs);
    if (looks_so) found.push_back({family, other.refused.size()});
  }
  size_t least = ~size_t{0};
  for (const Found& one : found) least = std::min(least, one.refused);
  std::erase_if(found, [least](const Found& one) { return one.refused != least; });
  return note(found);
}

}  // namespace nc::tools
