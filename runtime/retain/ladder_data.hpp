// SPDX-License-Identifier: Apache-2.0
// The retained devices of the ladder program, for the keeper.
#pragma once

#include "runtime/ladder_task.hpp"
#include "runtime/retain/retained_data.hpp"

namespace nc::rt {

class LadderData final : public RetainedData {
 public:
  explicit LadderData(LadderTask* task) : task_(*task) {}
  const char* name() const override { return "devices of the ladder"; }
  const char* start() const override { return "begin with 0"; }
  bool restore(const std::string& bytes) override {
    std::vector<RetainedRow> rows;
    if (!decode_rows(bytes, &rows)) return false;
    task_.restore(rows);
    return true;
  }
  std::string now() override { return encode_rows(task_.retained()); }
  void want() override { task_.want_retained(); }
  bool take(std::string* bytes) override {
    std::vector<RetainedRow> rows;
    if (!task_.take_retained(&rows)) return false;
    *bytes = encode_rows(rows);
    return true;
  }

 private:
  LadderTask& task_;
};

}  // namespace nc::rt
