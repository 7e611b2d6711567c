// SPDX-License-Identifier: Apache-2.0
// Every word in the block of every fixed cycle of every family: left out, 0, negative, with a fraction, too large, and without a number. The cycles are those of
// the families' tables, so that none is forgotten. A cell is an alarm, which has to lie in the line of the block, or one of these readings:
//
//   own     what is made is not what the block makes without the word: the word means what it says
//   idle    it is: the word is ignored, or says what holds without it
//   whole   a fraction is cut off
//   made    of a word that is left out: the block is made, as the family's section says for it
//
// The table of these cells is cycle_words.txt. A cell that has changed is a change of what a control does with a program: it is to be looked up in the manual of
// its family. NC_WRITE_CYCLE_WORDS=1 writes the table anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>

#include "dialect/dialect.hpp"
#include "modal/modes.hpp"
#include "places/places.hpp"
#include "support/pull.hpp"

namespace nc::test {
namespace {

struct Word {
  std::string name;  ///< "Q", ",R"
  std::string value;
};
using Words = std::vector<Word>;

/// What a cycle wants beside X Y Z R F.
struct Needs {
  Function function;
  Words words;
};

struct Family {
  nc_dialect id;
  const char* head;  ///< two blocks
  const char* end;
  std::vector<Needs> needs;
};

const Family kFamilies[] = {
    {NC_DIALECT_M700,
     "G0\nS500 M3\n",
     "M30",
     {{Function::cycle_step, {{"Q", "2."}}},
      {Function::cycle_peck, {{"Q", "2."}}},
      {Function::cycle_spot, {{"P", "100"}}},
      {Function::cycle_circle, {{"Q", "5."}, {"P", "7"}}},
      {Function::cycle_fine_bore, {{"I", "1."}}},
      {Function::cycle_back_bore, {{"I", "1."}}}}},
    {NC_DIALECT_DGSHAPE, "%\nM03\n", "M02", {{Function::cycle_peck, {{"Q", "2."}}}, {Function::cycle_spot, {{"P", "100"}}}, {Function::cycle_bore_dwell, {{"P", "100"}}}}},
    {NC_DIALECT_HX,
     "G0\nS500 M3\n",
     "M30",
     {{Function::cycle_step, {{"Q", "2."}}},
      {Function::cycle_peck, {{"Q", "2."}}},
      {Function::cycle_spot, {{"P", "100"}}},
      {Function::cycle_fine_bore, {{"I", "1."}}},
      {Function::cycle_back_bore, {{"I", "1."}}}}},
    {NC_DIALECT_SERIES8,
     "G0\nS500 M3\n",
     "M30",
     {{Function::cycle_spot, {{"P", "1"}}},
      {Function::cycle_peck, {{"I", "-2."}, {"J", "2."}}},
      {Function::cycle_tap, {{"K", "1."}}},
      {Function::cycle_bore_oriented, {{"I", "1."}}},
      {Function::cycle_face_upwards, {{"I", "1."}}}}},
    {NC_DIALECT_ISO,
     "G0\nS500 M3\n",
     "M30",
     {{Function::cycle_step, {{"Q", "2."}}},
      {Function::cycle_peck, {{"Q", "2."}}},
      {Function::cycle_spot, {{"P", "1"}}},
      {Function::cycle_reverse_tap, {{"M", "4"}}},
      {Function::cycle_back_bore, {{"I", "1."}, {"K", "-4."}}}}},
};

std::string code_of(const FunctionRow& row) { return "G" + std::to_string(row.code / 10) + (row.code % 10 != 0 ? "." + std::to_string(row.code % 10) : ""); }

/// The words of a whole block of the cycle.
Words whole(const Family& family, const FunctionRow& row) {
  const bool from_below = row.function == Function::cycle_back_bore || row.function == Function::cycle_face_upwards;
  Words words{{"X", "5."}, {"Y", "6."}, {"Z", "-8."}, {"R", "2."}, {"F", "100"}};
  if (from_below && family.id != NC_DIALECT_ISO) words[2].value = "-4.", words[3].value = "-8.";
  for (const Needs& needs : family.needs)
    if (needs.function == row.function) words.insert(words.end(), needs.words.begin(), needs.words.end());
  return words;
}

Words without(Words words, const std::string& name) {
  words.erase(std::remove_if(words.begin(), words.end(), [&](const Word& word) { return word.name == name; }), words.end());
  return words;
}
Words with(Words words, const std::string& name, const std::string& value) {
  for (Word& word : words)
    if (word.name == name) {
      word.value = value;
      return words;
    }
  words.push_back({name, value});
  return words;
}

struct Made {
  std::string alarm;
  unsigned line = 0;
  Path steps;
};

const Made& make(const Family& family, const std::string& code, const Words& words) {
  static std::map<std::string, Made> known;  // of one family
  static nc_dialect of_family = family.id;
  if (of_family != family.id) known.clear();
  of_family = family.id;
  std::string block = code;
  for (const Word& word : words) block += " " + word.name + word.value;
  const auto [place, fresh] = known.try_emplace(block);
  Made& made = place->second;
  if (!fresh) return made;
  Bench bench(family.id);
  bench.at(0, 0, 10).tool(7, 1).tool(1, 1);
  const Outcome run = bench.run(std::string(family.head) + block + "\nG80\n" + family.end);
  made = {run.alarm, run.alarm_line, {}};
  size_t move = 0;
  const Path moves = run.path();
  for (const Step& step : run.steps) {
    const nc_item& item = step.item;
    if (item.kind == NC_ITEM_MOVE) made.steps.push_back(moves[move++] + " " + brief(item.u.move.feed_mm_rev));
    if (item.kind == NC_ITEM_GATE) made.steps.push_back("gate " + std::to_string(item.u.gate.kind) + " " + brief(item.u.gate.value));
    if (item.kind == NC_ITEM_ACTION && item.u.action.kind <= NC_ACTION_B) made.steps.push_back(item.u.action.letter + brief(item.u.action.value));
  }
  return made;
}

const char* const kDefects[] = {"absent", "bare", "0", "-1", "1.5", "1e9"};
std::string value_of(const std::string& defect) { return defect == "bare" ? "" : defect == "1e9" ? "999999999" : defect; }

std::string cell(const Family& family, const std::string& code, const Words& all, const std::string& name, const std::string& defect) {
  const bool needed = without(all, name).size() != all.size();
  const bool absent = defect == "absent";
  if (absent && !needed) return "";
  const Made& made = make(family, code, absent ? without(all, name) : with(all, name, value_of(defect)));
  if (!made.alarm.empty()) return made.line == 3 ? made.alarm : made.alarm + " in line " + std::to_string(made.line);
  if (absent) return "made";
  const Made& bare = make(family, code, without(all, name));
  if (defect == "1.5") {
    const Made& one = make(family, code, with(all, name, "1"));
    if (one.alarm.empty() && one.steps == made.steps && one.steps != bare.steps) return "whole";
  }
  return bare.alarm.empty() && bare.steps == made.steps ? "idle" : "own";
}

/// "Q absent: P33 G73 G83; made G76": of one word and one defect.
std::string row_of(const Family& family, const std::string& name, const std::string& defect) {
  std::map<std::string, std::vector<std::string>> codes;
  size_t count = 0;
  const Dialect& tables = dialect(family.id);
  for (const FunctionRow& row : tables.functions) {
    if (mode_of(row.function) != Mode::cycle || row.function == Function::cycle_off || row.missing != nullptr) continue;
    const std::string code = code_of(row), label = cell(family, code, whole(family, row), name, defect);
    if (label.empty()) continue;
    codes[label].push_back(code);
    ++count;
  }
  if (codes.empty()) return "";
  const auto most = std::max_element(codes.begin(), codes.end(), [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
  std::string text = name + " " + defect + ": ";
  for (const auto& [label, list] : codes) {
    if (label == most->first) continue;
    text += label;
    for (const std::string& code : list) text += " " + code;
    text += "; ";
  }
  return text + most->first + (codes.size() > 1 ? " the others" : "");
}

std::vector<std::string> table() {
  std::vector<std::string> lines;
  for (const Family& family : kFamilies) {
    lines.push_back(std::string("== ") + dialect(family.id).name);
    for (const char* name : {"X", "Y", "Z", "R", "F", "S", "Q", "P", "I", "J", "K", "L", "D", "H", "E", ",R", ",S", ",I", ",J"})
      for (const char* defect : kDefects) {
        const std::string row = row_of(family, name, defect);
        if (!row.empty()) lines.push_back(row);
      }
  }
  return lines;
}

TEST(CycleWords, EveryCellIsAnAlarmOfItsBlockOrANamedReading) {
  const std::string path = kSourceDir + "/tests/cycle/cycle_words.txt";
  const std::vector<std::string> now = table();
  if (std::getenv("NC_WRITE_CYCLE_WORDS") != nullptr) {
    std::ofstream file(path);
    for (const std::string& line : now) file << line << "\n";
    ASSERT_TRUE(file.good());
  }
  std::ifstream file(path);
  std::vector<std::string> kept;
  for (std::string line; std::getline(file, line);) kept.push_back(line);
  std::string family;
  for (size_t i = 0; i < std::max(now.size(), kept.size()); ++i) {
    const std::string is = i < now.size() ? now[i] : "(no row)", was = i < kept.size() ? kept[i] : "(no row)";
    if (is.rfind("==", 0) == 0) family = is;
    EXPECT_EQ(is, was) << family;
    EXPECT_EQ(is.find(" in line "), std::string::npos) << family << ", an alarm that lies in another block: " << is;
  }
}

}  // namespace
}  // namespace nc::test
