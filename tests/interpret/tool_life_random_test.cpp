// SPDX-License-Identifier: Apache-2.0
// Random programs of tool life management, over several runs of one control: groups registered, added and removed by G10 L3, tools mounted and used until their lives
// have ended, spare tools, tools that the ladder has said to be broken. Beside them the test keeps a table of its own, by what docs/decisions.md says (10.15): which
// tool goes out, how often each was mounted or used, what state it is in, and what #60001 to #60007 of its group say.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "support/pull.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

struct KeptTool {
  unsigned group = 0, number = 0, life = 0, used = 0, status = 0, method = 1;  ///< Q: 1 mounts, 3 uses
};

class KeptTable {
 public:
  explicit KeptTable(uint64_t seed) : random_(seed), bench_(NC_DIALECT_M700) { bench_.param("1103", "1"); }

  /// One program; "" = the control does and keeps what this table does.
  std::string run() {
    text_ = "G0 X99.\n";
    out_.clear();
    selects_ = cuts_ = false;  // the tool in the spindle stays from program to program
    if (tools_.empty()) input(0);
    const unsigned blocks = 5 + pick(25);
    for (unsigned n = 0; n < blocks; ++n) block();
    const unsigned group = any_group();
    text_ += "#60000=" + std::to_string(group) + "\n#501=#60001\n#502=#60004\n#503=#60007\nM30\n";
    const Outcome run = bench_.run(text_);
    if (!run.alarm.empty()) return "alarm " + run.alarm + " (" + run.alarm_detail + ") in line " + std::to_string(run.alarm_line) + "\n" + text_;
    if (run.aux() != out_ + "M30") return "goes out: " + run.aux() + "\nand not:  " + out_ + "M30\n" + text_;
    if (read() != table()) return "is:      " + read() + "\nand not: " + table() + "\n" + text_;
    const double count = static_cast<double>(std::count_if(tools_.begin(), tools_.end(), [group](const KeptTool& tool) { return tool.group == group; }));
    unsigned number = 0, alive = 0;
    for (const KeptTool& tool : tools_)
      if (tool.group == group && (++number, alive == 0 && tool.status < 2)) alive = number;
    if (run.var(501) != count || run.var(502) != alive || run.var(503) != (alive == 0 ? 1 : 0)) return "#60001 #60004 #60007: " + brief(run.var(501)) + " " + brief(run.var(502)) + " " + brief(run.var(503)) + "\n" + text_;
    break_one();
    return "";
  }

 private:
  unsigned pick(unsigned n) { return static_cast<unsigned>(random_() % n); }

  void block() {
    switch (pick(10)) {
      case 0: return input(1);
      case 1: return pick(3) == 0 ? input(2) : cut();
      case 2:
      case 3:
      case 4: return select();
      case 5:
      case 6: return mount();
      default: return cut();
    }
  }
  unsigned any_group() { return tools_[pick(static_cast<unsigned>(tools_.size()))].group; }

  /// 0 anew, 1 adds, 2 removes.
  void input(unsigned how) {
    if (how == 2) {
      const unsigned group = any_group();
      if (std::all_of(tools_.begin(), tools_.end(), [group](const KeptTool& tool) { return tool.group == group; })) return;
      text_ += "G10 L3 P2\nP" + std::to_string(group) + "\nG11\n";
      return remove(group);
    }
    text_ += how == 0 ? "G10 L3\n" : "G10 L3 P1\n";
    std::vector<unsigned> groups(1 + pick(3));
    for (unsigned n = 0; n < groups.size(); ++n) groups[n] = 10 * (n + 1) + (how == 0 ? 0 : pick(2));
    for (const unsigned group : groups) {
      remove(group);
      KeptTool tool;
      tool.group = group;
      tool.life = pick(5);  // 0 = without end
      const unsigned written = pick(3);
      tool.method = written == 2 ? 3 : 1;
      text_ += "P" + std::to_string(group) + " L" + std::to_string(tool.life) + (written == 0 ? "" : " Q" + std::to_string(tool.method)) + "\n";
      for (unsigned n = 1 + pick(3); n > 0; --n) {
        tool.number = 100 * group + n;
        text_ += "T" + std::to_string(tool.number) + "\n";
        add(tool);
      }
    }
    text_ += "G11\n";
  }
  void remove(unsigned group) {
    for (KeptTool& tool : places_)
      if (tool.group == group) tool = {};
    gather();
  }
  void add(const KeptTool& tool) {
    const auto free = std::find_if(places_.begin(), places_.end(), [](const KeptTool& place) { return place.group == 0; });
    if (free != places_.end()) *free = tool;
    else places_.push_back(tool);
    gather();
  }
  void gather() {
    tools_.clear();
    for (const KeptTool& tool : places_)
      if (tool.group != 0) tools_.push_back(tool);
  }
  KeptTool* with_number(unsigned number) {
    for (KeptTool& tool : places_)
      if (tool.group != 0 && tool.number == number && number != 0) return &tool;
    return nullptr;
  }
  /// The first that is in use, else the first unused one, else the last.
  void select() {
    const unsigned group = any_group();
    const KeptTool* chosen = nullptr;
    for (const unsigned status : {1U, 0U})
      for (const KeptTool& tool : tools_)
        if (chosen == nullptr && tool.group == group && tool.status == status) chosen = &tool;
    for (const KeptTool& tool : tools_)
      if (tool.group == group && (chosen == nullptr || chosen->status > 1)) chosen = &tool;
    selected_ = chosen->number;
    selects_ = true;
    text_ += "T" + std::to_string(group) + "\n";
    out_ += "T" + std::to_string(selected_) + " ";
  }
  void mount() {
    if (!selects_) return;
    text_ += "M6\n";
    out_ += "M6 ";
    cuts_ = false;
    KeptTool* const tool = with_number(selected_);
    mounted_ = tool != nullptr ? selected_ : 0;
    if (tool == nullptr) return;
    if (tool->status == 0) tool->status = 1;
    if (tool->method == 1) count(*tool);
    gather();
  }
  /// "A use is a cut behind rapid traverse."
  void cut() {
    const bool rapid = pick(3) == 0;
    text_ += (rapid ? "G0 X" : "G1 F500 X") + std::to_string(++place_ % 50 + 1) + ".\n";
    KeptTool* const tool = with_number(mounted_);
    if (!rapid && !cuts_ && tool != nullptr && tool->method == 3) count(*tool), gather();
    cuts_ = !rapid;
  }
  static void count(KeptTool& tool) {
    ++tool.used;
    if (tool.life != 0 && tool.used >= tool.life && tool.status < 2) tool.status = 2;
  }
  /// As the ladder says of a tool, or an operator of the table.
  void break_one() {
    if (pick(4) != 0) return;
    const unsigned place = pick(static_cast<unsigned>(places_.size()));
    if (places_[place].group == 0) return;
    places_[place].status = 3;
    EXPECT_EQ(nc_tool_life_set(bench_.control(), place + 1, NC_LIFE_STATUS, 3), NC_OK);
    gather();
  }
  std::string table() const {
    std::string all;
    for (const KeptTool& tool : places_)
      all += tool.group == 0 ? "- " : std::to_string(tool.group) + ":" + std::to_string(tool.number) + ":" + std::to_string(tool.status) + ":" + std::to_string(tool.life) + ":" + std::to_string(tool.used) + " ";
    return all;
  }
  std::string read() {
    std::string all;
    for (unsigned n = 1; n <= places_.size(); ++n) {
      std::string tool;
      for (const nc_life_column column : {NC_LIFE_GROUP, NC_LIFE_TOOL, NC_LIFE_STATUS, NC_LIFE_LIFE, NC_LIFE_USED}) {
        double value = NAN;
        EXPECT_EQ(nc_tool_life_get(bench_.control(), n, column, &value), NC_OK);
        if (column == NC_LIFE_GROUP && value == 0) {
          tool = "-";
          break;
        }
        tool += (tool.empty() ? "" : ":") + brief(value);
      }
      all += tool + " ";
    }
    return all;
  }

  std::mt19937_64 random_;
  Bench bench_;
  std::vector<KeptTool> places_, tools_;  ///< as the table has them; those that are registered, in the order of their use
  std::string text_, out_;
  unsigned mounted_ = 0, selected_ = 0, place_ = 0;
  bool selects_ = false, cuts_ = false;
};

TEST(ToolLifeRandom, IsCountedAsTheTableBesideIt) {
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(150, 20);
  for (uint64_t seed = first; seed < first + count && !testing::Test::HasFailure(); ++seed) {
    KeptTable table(seed);
    for (unsigned n = 0; n < 8 && !testing::Test::HasFailure(); ++n) EXPECT_EQ(table.run(), "") << "seed " << seed << ", program " << n;
  }
}

}  // namespace
}  // namespace nc::test
