// SPDX-License-Identifier: Apache-2.0
// Every conformance program of every family is read with a way back in between: now and then, and once more at its end, the control goes back to one of
// the marks before and reads again what it had read. The items are the same, and so is all that can influence the program (nc_program_state_hash), whatever
// stages held items back at the mark.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "own_folder.hpp"
#include "places/places.hpp"
#include "support/pull.hpp"
#include "support/seeds.hpp"
#include "tools/lib/commands.hpp"
#include "tools/lib/offline_run.hpp"
#include "tools/lib/session.hpp"

namespace nc::tools {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The items of a control, which goes back and reads again before some of them are given out.
class Rewinding final : public ItemSource {
 public:
  Rewinding(nc_control* control, nc_dialect dialect, uint32_t seed) : control_(control), inner_(control, dialect), random_(seed) {}

  unsigned done = 0, refused = 0;
  std::string difference;  ///< the first one; "" = none

  nc_status pull(uint32_t budget, nc_item* item) override {
    const nc_status status = inner_.pull(budget, item);
    if (status != NC_OK) return status;
    keep(*item);
    const bool end = item->kind == NC_ITEM_END;
    const bool mark = item->kind == NC_ITEM_MARK && item->u.mark.report;
    for (unsigned times = end ? 3 : mark && random_() % 4 == 0 ? 1 : 0;
         times > 0 && difference.empty(); --times) go_back(item);
    if (mark) marks_.push_back(item->serial);
    return NC_OK;
  }
  nc_status answer(const nc_world& world) override {
    worlds_[newest_] = world;
    return inner_.answer(world);
  }
  bool interrupt(bool on) override {
    marks_.clear();  // what stands before the interrupt is not read in the same way again
    may_go_to_head_ = false;
    return inner_.interrupt(on);
  }
  nc_status reset() override {
    texts_.clear();
    worlds_.clear();
    marks_.clear();
    may_go_to_head_ = true;
    return inner_.reset();
  }
  nc_status rewind(uint64_t serial) override { return inner_.rewind(serial); }
  bool move_point(double share, nc_axes* machine) override { return inner_.move_point(share, machine); }
  bool move_zero(nc_axes* zero) override { return inner_.move_zero(zero); }
  void shown(nc_axes* machine, nc_axes* work) override { inner_.shown(machine, work); }
  uint32_t main_line(const nc_source& source) override { return inner_.main_line(source); }
  uint64_t program_state() override { return inner_.program_state(); }
  bool alarm(nc_alarm* alarm) override { return inner_.alarm(alarm); }
  bool text(uint32_t id, nc_text* text) override { return inner_.text(id, text); }
  unsigned modal_codes(uint32_t id, char (*codes)[8], unsigned capacity) override { return inner_.modal_codes(id, codes, capacity); }
  uint32_t optional_stop_code() override { return inner_.optional_stop_code(); }
  bool next_common(uint32_t from, uint32_t* number, double* value) override { return inner_.next_common(from, number, value); }

 private:
  std::string described(const nc_item& item) {
    test::Step step;
    step.item = item;
    if (item.kind == NC_ITEM_MARK || item.kind == NC_ITEM_END) {
      nc_modal_init(&step.modal);
      nc_modal_get(control_, kPartSystem, item.kind == NC_ITEM_MARK ? item.u.mark.modal : item.u.end.modal, &step.modal);
    }
    nc_text text{};
    if (item.kind == NC_ITEM_ACTION && item.u.action.kind == NC_ACTION_MESSAGE && nc_text_get(control_, kPartSystem, item.u.action.text, &text) == NC_OK) step.text = text.s;
    return test::exactly(step);
  }
  void keep(const nc_item& item) {
    newest_ = item.serial;
    texts_[item.serial] = described(item);
  }
  /// Goes back from `item`, which has been pulled, to a mark before it, and comes to it again.
  void go_back(nc_item* item) {
    const uint64_t until = item->serial;
    const size_t reach = std::min<size_t>(marks_.size(), 40), pick = random_() % (reach + 1);
    if (pick == 0 && (!may_go_to_head_ || marks_.size() > reach)) return;
    const uint64_t to = pick == 0 ? 0 : marks_[marks_.size() - pick];
    const uint64_t state = program_state();
    const nc_status went = nc_rewind(control_, kPartSystem, to);
    if (went == NC_E_NOT_FOUND) {
      ++refused;
      return;
    }
    if (went != NC_OK) return fail("a rewind to " + std::to_string(to) + " is refused with " + std::to_string(went));
    ++done;
    for (uint64_t serial = to; serial != until;) {
      const nc_status status = inner_.pull(4096, item);
      if (status == NC_BUDGET) continue;
      if (status != NC_OK) return fail("from " + std::to_string(to) + ": no item behind " + std::to_string(serial) + ", but " + std::to_string(status));
      serial = item->serial;
      const std::string again = described(*item);
      if (again != texts_[serial]) return fail("from " + std::to_string(to) + ", item " + std::to_string(serial) + ":\n  " + texts_[serial] + "\n  " + again);
      if (item->kind == NC_ITEM_SYNC && inner_.answer(worlds_[serial]) != NC_OK) return fail("no answer at " + std::to_string(serial));
    }
    if (item->kind == NC_ITEM_END && program_state() != state) fail("from " + std::to_string(to) + " to " + std::to_string(until) + ": something that can influence the program is another");
  }
  void fail(const std::string& what) {
    if (difference.empty()) difference = what;
  }

  nc_control* control_;
  ControlSource inner_;
  std::mt19937 random_;
  std::map<uint64_t, std::string> texts_;
  std::map<uint64_t, nc_world> worlds_;
  std::vector<uint64_t> marks_;
  uint64_t newest_ = 0;
  bool may_go_to_head_ = true;
};

struct Case {
  std::string id, program, setup, dialect;
};

class RewindEverywhere : public OwnFolder {
 protected:
  std::vector<Case> cases() const {
    std::vector<Case> all;
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(nc::test::kSharedDir + "/conformance"))
      if (entry.path().extension() == ".json") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& path : files) {
      const Json json = Json::parse(content(path));
      for (const Json& one : json["cases"]) {
        const std::string id = one["id"], text = one["program"];
        all.push_back({id, file(id + ".nc", text), file(id + ".json", one.value("setup", Json::object()).dump()), one["dialect"]});
      }
    }
    return all;
  }
};

TEST_F(RewindEverywhere, EveryConformanceProgramIsReadAgainInTheSameWay) {
  if (!fs::is_directory(nc::test::kSharedDir + "/conformance")) GTEST_SKIP() << nc::test::kSharedDir << " is not here";
  unsigned done = 0, refused = 0, programs = 0;
  const std::vector<Case> all = cases();
  const uint64_t rounds = nc::test::seeds(3, 1);
  for (const Case& one : all) {
    for (uint32_t round = 0; round < rounds; ++round) {
      SessionOptions options;
      options.program = one.program;
      options.setup = one.setup;
      options.dialect = one.dialect;
      options.dialect_given = true;
      Session session;
      std::string error;
      if (!session.configure(options, &error) || !session.start(options, &error)) break;
      programs += round == 0;
      Rewinding items(session.control(), session.dialect(), round * 1000 + programs);
      VirtualWorld world(session.setup(), session.config().system[0]);
      RunSink nothing;
      run_offline(&items, &world, &nothing, session.decides(), 20'000, true);
      EXPECT_EQ(items.difference, "") << one.id << " round " << round;
      done += items.done;
      refused += items.refused;
    }
  }
  std::printf("%u programs, %u times back and on again, %u times refused\n", programs, done, refused);
  EXPECT_GT(programs, all.size() * 9 / 10);
  EXPECT_GT(done, programs);
  EXPECT_LT(refused * 20, done);
}

}  // namespace
}  // namespace nc::tools
