// SPDX-License-Identifier: Apache-2.0
// How often `ncsim check` says rightly of which other family a program is: a measure over a fixed set. Each program, and its first 3, 5 and 10 lines with words,
// ended by M30, is read as each other family; where this alarms the note is right (it names the program's own family, alone or among others), wrong, or there is
// none. Slips, one character changed by a fixed rule, are read as the own family: a note is false there. NC_SHOW=1 prints the table and what is not right.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "places/places.hpp"
#include "tools/lib/dialect_names.hpp"
#include "tools/lib/item_source.hpp"
#include "tools/lib/other_dialects.hpp"
#include "tools/lib/virtual_world.hpp"

namespace nc::tools {
namespace {

struct Sample {
  std::string family, name, text;
};

enum Said : unsigned { kAlone, kAmong, kAnother, kNothing, kKinds };
using Row = std::array<unsigned, kKinds>;

struct Measure {
  std::map<std::string, Row> clean, faulty;  // by the own family, which reads the text without an alarm, or not
  unsigned slips = 0, false_slips = 0, noted_own = 0;
};

Row sum_of(const std::map<std::string, Row>& rows) {
  Row sum{};
  for (const auto& [family, row] : rows)
    for (unsigned i = 0; i < kKinds; ++i) sum[i] += row[i];
  return sum;
}

SessionOptions options_of(const std::string& family, const std::string& text) {
  SessionOptions options;
  options.program = "p.nc";
  options.dialect = family;
  options.dialect_given = true;
  options.text = text;
  return options;
}

bool alarms(const std::string& family, const std::string& text) {
  const SessionOptions options = options_of(family, text);
  Session session;
  std::string error;
  if (!session.configure(options, &error) || !session.start(options, &error)) return true;
  ControlSource items(session.control(), session.dialect());
  VirtualWorld world(session.setup(), session.config().system[0]);
  RunSink nothing;
  return run_offline(&items, &world, &nothing, session.decides(), RunLimits().silent_blocks, true, {}, RunLimits().loops).how == RunResult::How::kAlarmed;
}

std::string note_of(const std::string& family, const std::string& text) { return other_dialect_note(options_of(family, text), RunLimits(), family, false); }

/// The first lines that have words, up to `count` of them, and a block that ends the program; "" when the text has no more.
std::string first_lines(const std::string& text, unsigned count) {
  size_t at = 0;
  for (unsigned i = 0; i < count && at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size() - 1), word = text.find_first_not_of(" \t\r", at);
    if (word < end && std::string("(;%").find(text[word]) == std::string::npos) ++i;
    at = end + 1;
  }
  return text.find_first_not_of(" \t\r\n", at) == std::string::npos ? "" : text.substr(0, at) + "M30\n";
}

Said said(const std::string& note, const std::string& own) {
  const std::string names = note.substr(0, note.find(", as which")) + ",";
  if (note.empty()) return kNothing;
  if (names.find(" " + own + ",") == std::string::npos && names.find(" " + own + " ") == std::string::npos) return kAnother;
  return names.find(" or ") == std::string::npos ? kAlone : kAmong;
}

bool shows() { return std::getenv("NC_SHOW") != nullptr; }  // NOLINT(concurrency-mt-unsafe): nothing sets it

void measure_text(const Sample& sample, const std::string& text, Measure* all) {
  const bool faulty = alarms(sample.family, text);
  Row& row = (faulty ? all->faulty : all->clean)[sample.family];
  if (faulty) {
    const std::string note = note_of(sample.family, text);
    all->noted_own += !note.empty();
    if (shows() && !note.empty()) std::printf("fault of %s: %s: %s\n", sample.family.c_str(), sample.name.c_str(), note.c_str());
  }
  for (const std::string& other : dialect_names()) {
    if (other == sample.family || !alarms(other, text)) continue;
    const std::string note = note_of(other, text);
    const Said what = said(note, sample.family);
    ++row[what];
    if (shows() && !faulty && what >= kAnother) std::printf("%s as %s: %s: %s\n%s", sample.family.c_str(), other.c_str(), sample.name.c_str(), note.c_str(), text.size() < 300 ? text.c_str() : "");
  }
}

/// One character is left out, changed or put in, at places and in ways that depend on the name of the sample alone.
void measure_slips(const Sample& sample, Measure* all) {
  constexpr unsigned kSlips = 6;
  const std::string near = "0123456789.-XYZIJKFGMRNHDP ";
  uint32_t random = 2166136261U;
  for (const char c : sample.name) random = (random ^ static_cast<unsigned char>(c)) * 16777619U;
  const auto next = [&random](size_t below) { return (random = random * 1664525U + 1013904223U, (random >> 8) % below); };
  for (unsigned i = 0; i < kSlips; ++i) {
    std::string text = sample.text;
    const size_t at = next(text.size()), how = next(3);
    const char c = near[next(near.size())];
    if (text[at] == '\n') continue;
    if (how == 0) text.erase(at, 1);
    else if (how == 1) text[at] = c;
    else text.insert(at, 1, c);
    if (!alarms(sample.family, text)) continue;
    const std::string note = note_of(sample.family, text);
    ++all->slips;
    all->false_slips += !note.empty();
    if (shows() && !note.empty()) std::printf("slip in %s: %s: %s\n", sample.family.c_str(), sample.name.c_str(), note.c_str());
  }
}

Measure measure(const std::vector<Sample>& samples) {
  Measure all;
  for (const Sample& sample : samples) {
    for (const unsigned lines : {3U, 5U, 10U})
      if (const std::string text = first_lines(sample.text, lines); !text.empty()) measure_text(sample, text, &all);
    measure_text(sample, sample.text, &all);
    if (!alarms(sample.family, sample.text)) measure_slips(sample, &all);
  }
  for (const auto* rows : {&all.clean, &all.faulty})
    for (const auto& [family, row] : *rows)
      if (shows()) std::printf("%s%s: right alone %u, among others %u, wrong %u, no note %u\n", family.c_str(), rows == &all.clean ? "" : " with an alarm of its own", row[kAlone], row[kAmong], row[kAnother], row[kNothing]);
  if (shows()) std::printf("slips %u, false notes %u\n", all.slips, all.false_slips);
  return all;
}

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The parts that are shipped, and the seeds of the fuzzer, whose first two bytes are no text and whose names begin with their family.
std::vector<Sample> samples_of_the_tree() {
  const std::string top = nc::test::kSourceDir;
  std::vector<Sample> samples;
  const std::pair<const char*, const char*> parts[] = {{"m700", "flange.nc"},  {"m700", "bolt-circle.nc"}, {"m700", "every-cycle.nc"}, {"m700", "tool-length.nc"},
                                                       {"dgshape", "keytag.nc"}, {"iso", "plate.ngc"},       {"hx", "bracket.nc"},       {"series8", "jig-plate.s8"}};
  for (const auto& [family, name] : parts) samples.push_back({family, name, content_of(top + "/examples/parts/" + name)});
  std::map<std::string, std::string> seeds;  // sorted
  for (const auto& entry : std::filesystem::directory_iterator(top + "/tests/fuzz/corpus/program")) seeds[entry.path().filename()] = content_of(entry.path());
  for (const auto& [name, bytes] : seeds) {
    std::string own = "m700";
    for (const std::string& family : dialect_names())
      if (name.rfind(family, 0) == 0) own = family;
    if (bytes.size() > 2) samples.push_back({own, name, bytes.substr(2)});
  }
  return samples;
}

std::vector<Sample> samples_of_the_manuals() {
  std::vector<Sample> samples;
  std::map<std::string, nlohmann::json> files;  // sorted
  const std::string folder = nc::test::kSharedDir + "/conformance";
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".json") files[entry.path()] = nlohmann::json::parse(content_of(entry.path()));
  for (const auto& [path, all] : files) {
    unsigned count = 0;
    for (const nlohmann::json& one : all["cases"]) {
      const std::string own = one.value("dialect", "m700");
      if (own == "m700" && count++ % 4 != 0) continue;  // there are many of them
      if (one.contains("program") && one["program"].is_string()) samples.push_back({own, one["id"], one["program"]});
    }
  }
  for (const char* name : {"3D_Chips.ngc", "arcspiral.ngc", "compass.ngc", "tort.ngc", "botomata_bottom.nc", "flower_mold.nc"})
    samples.push_back({"iso", name, content_of(nc::test::kSharedDir + "/programs/" + name)});
  return samples;
}

/// The floor: so many of a hundred are right, none is wrong, and so few slips of its own are called another family.
void expect_at_least(const Measure& measured, unsigned right_of_100, unsigned false_of_100, unsigned faults_noted) {
  const Row clean = sum_of(measured.clean), faulty = sum_of(measured.faulty);
  const unsigned right = clean[kAlone] + clean[kAmong], all = right + clean[kAnother] + clean[kNothing];
  for (const auto& [name, count] : {std::pair{"right_alone", clean[kAlone]}, {"right_among", clean[kAmong]}, {"wrong", clean[kAnother]}, {"none", clean[kNothing]},
                                    {"faulty_wrong", faulty[kAnother]}, {"slips", measured.slips}, {"false_slips", measured.false_slips}})
    ::testing::Test::RecordProperty(name, static_cast<int>(count));
  EXPECT_GE(right * 100, all * right_of_100) << right << " of " << all;
  EXPECT_EQ(clean[kAnother], 0u) << "another family is named although the own one reads the program without an alarm";
  EXPECT_LE(measured.noted_own, faults_noted) << "a fault in a program of its own is taken for another family";
  EXPECT_LE(measured.false_slips * 100, measured.slips * false_of_100) << measured.false_slips << " of " << measured.slips;
}

// Of the faults one seed is taken for m700, whole and its first lines: it consists of O words, which iso refuses. The first lines of another, which call what stands
// behind them, are a program of hx.
TEST(Recognition, OfTheProgramsInTheTree) { expect_at_least(measure(samples_of_the_tree()), 70, 2, 3); }

TEST(Recognition, OfTheProgramsOfTheManuals) {
  if (!std::filesystem::is_directory(nc::test::kSharedDir + "/conformance")) GTEST_SKIP() << "the shared cases are not here";
  expect_at_least(measure(samples_of_the_manuals()), 60, 3, 0);
}

}  // namespace
}  // namespace nc::tools
