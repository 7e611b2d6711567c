// SPDX-License-Identifier: Apache-2.0
// Which program has written a value of the tables last, and when. A program leaves nothing but the values, and the scan writes nothing down: so the feeder compares the values that the executed
// blocks have left with those of the look before. It looks every second, and whenever who writes becomes another one: before another program is selected, before MDI blocks are loaded, and
// around a change through the services. So what is found between two looks has one writer, but where several part systems run.
//
// The rows are bounded, the oldest go. They are kept over power off as other retained data, each with the value that it belongs to: a row whose value is not that of its table any more says nothing.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "nc/nc.h"
#include "runtime/retain/retained_data.hpp"

namespace nc::rt {

// A value that was written: "program part.nc", "MDI blocks", "machine". Names of users have no blank, and none is called "machine" but by who means to.
struct Written {
  std::string by;
  std::int64_t time_ns = 0;  // time of day
  std::string value;         // as retained data have it; "" = vacant, not set
  bool operator==(const Written&) const = default;
};

class WriterTable {
 public:
  // `local`: local variables, which belong to the program that runs.
  explicit WriterTable(nc_variable_range local) : local_(local) {}
  // What has executed something in each part system since the look before, "" = nothing.
  struct Ran {
    std::string by[NC_MAX_SYSTEMS];
    bool any() const;
    // Who has written what belongs to one part system, or to all of them (NC_MAX_SYSTEMS).
    std::string of(unsigned system) const;
  };

  // ---- feeder thread ----
  // `variables` and `tables`: NcPort::variables() and tables(). The first look only notes the values.
  void look(const std::string& variables, const std::string& tables, const Ran& ran, std::int64_t time_ns);
  // What has changed since the look before was written by the services, which note that themselves.
  void look_behind_change(const std::string& variables, const std::string& tables);
  // The values of variables, or those of the other tables, as they were at the last look, are what is kept over power off: so are those who have written them.
  void keep(bool variables);
  // Whether somebody wants to read what is written up to now.
  bool take_asked() { return asked_.exchange(false, std::memory_order_acq_rel); }

  // ---- any thread ----
  void ask() { asked_.store(true, std::memory_order_release); }
  // The key is that of TableRows ("tool 3 0", "work 0 1 X"), or "variable 0 501", "name 501". False when no writer is known.
  bool find(const std::string& key, Written* written) const;
  std::string encode() const;
  // As of keep().
  std::string encode_kept() const;
  // False when the bytes are not such rows; nothing has changed then.
  bool restore(const std::string& bytes);

  static constexpr std::size_t kMostRows = 8000;
  static constexpr std::size_t kMostBytes = 500'000;  // of encode(); encode_kept() is of two moments, and below RetainStore::kMaxPayload

 private:
  using Rows = std::map<std::string, Written>;
  struct Value {
    std::string key, value;
    unsigned system = NC_MAX_SYSTEMS;  // to which it belongs
  };
  std::vector<Value> changed(const std::string& variables, const std::string& tables);
  void forget_oldest();
  static std::string encode(const Rows& rows);
  const nc_variable_range local_;
  std::atomic<bool> asked_{false};
  bool looked_ = false;            // feeder thread, as the next two
  std::string variables_, tables_;
  mutable std::mutex mutex_;  // guards rows_ and kept_
  Rows rows_, kept_;
};

class WriterData final : public RetainedData {
 public:
  explicit WriterData(WriterTable* table) : table_(*table) {}
  const char* name() const override { return "which program has written what"; }
  const char* start() const override { return "is not known"; }
  bool is_vital() const override { return false; }
  bool restore(const std::string& bytes) override { return table_.restore(bytes); }
  std::string why_refused(const std::string& bytes) const override;
  std::string now() override { return table_.encode(); }
  void want() override {}
  bool take(std::string* bytes) override {
    *bytes = table_.encode_kept();
    return true;
  }

 private:
  WriterTable& table_;
};

}  // namespace nc::rt
