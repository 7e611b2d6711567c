// SPDX-License-Identifier: Apache-2.0
// The common variables of the programs and their names as bytes, and back. They are
// kept while the power is off (M700 13.4, 13.5.4), with the values that the executed blocks have left.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "nc/nc.h"
#include "runtime/config.hpp"
#include "runtime/feeder.hpp"
#include "runtime/retain/retained_data.hpp"

namespace nc::rt {

// All variables that are not vacant. To be called in the thread that the control belongs to.
std::string encode_variables(const nc_control* control);
// The variables as they are after the blocks that the machine has executed, without what was only read ahead.
std::string executed_variables(nc_control* control);
// False when the bytes are not such variables; nothing has changed then. Variables that the control does not have (any
// more) are skipped, and so are those of `not_kept`, and NC_VARIABLES_CLEARED when a
// parameter says so (M700 #1129 PwrVC1). *left_out gets a sentence for each name that the control does not take, as one of an older release.
bool restore_variables(nc_control* control, const std::string& bytes, const std::vector<VariableRangeSetting>& not_kept = {}, std::vector<std::string>* left_out = nullptr);
// Sets all of them but the local ones, also those that would not be kept over power off.
void set_variables(nc_control* control, const std::string& bytes);
// What has changed from `before` to `after`, local variables left out, becomes what it was where it is still that of `after`.
void put_back_variables(nc_control* control, const std::string& before, const std::string& after);
// The bytes `now` with those changes taken back.
std::string variables_without(const std::string& before, const std::string& after, const std::string& now);

// A variable of one part system that has changed from `before` to `after`, without the names. One that was vacant is left out.
struct VariableChange {
  std::uint32_t number = 0;
  double was = 0, is = 0;
  bool vacant = false;  // now
};
std::vector<VariableChange> changed_variables(const std::string& before, const std::string& after, unsigned system);

// What has changed from `before` to `after`, names too, local variables left out: "variable 0 501" (part system, number) with the new value, "" = vacant; "name 501" with the new name.
struct VariableWrite {
  std::string key, value;
};
std::vector<VariableWrite> written_variables(const std::string& before, const std::string& after, nc_variable_range local);

// M700 13.5.5: local variables belong to the program that is being read, and are kept nowhere.
bool is_local_variable(const nc_control* control, std::uint32_t number);

class VariableData final : public RetainedData {
 public:
  VariableData(nc_control* control, Feeder* feeder, std::vector<VariableRangeSetting> not_kept)
      : control_(control), feeder_(*feeder), not_kept_(std::move(not_kept)) {}
  const char* name() const override { return "common variables"; }
  const char* start() const override { return "are vacant"; }
  bool restore(const std::string& bytes) override { return restore_variables(control_, bytes, not_kept_, &remarks_); }
  std::vector<std::string> remarks() const override { return remarks_; }
  std::string now() override { return executed_variables(control_); }
  void want() override { feeder_.want(Feeder::kVariables); }
  bool take(std::string* bytes) override { return feeder_.take(Feeder::kVariables, bytes); }

 private:
  nc_control* control_;
  Feeder& feeder_;
  std::vector<VariableRangeSetting> not_kept_;
  std::vector<std::string> remarks_;
};

}  // namespace nc::rt
