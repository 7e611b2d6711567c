// SPDX-License-Identifier: Apache-2.0
// Work offsets, tool offsets and parameters that were changed since the configuration was read (G10, system variables ...), as text
// and back. They are kept while the power is off, as on a control with a battery.
//
// The configuration gives the values of the first start. The file keeps each value that differs from the configuration, together with the value that the
// configuration had when the file was written. When that value is changed in the configuration later, the configuration wins and the kept value is dropped.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "nc/nc.h"
#include "runtime/feeder.hpp"
#include "runtime/retain/retained_data.hpp"

namespace nc::rt {

// Maps keys to values. Keys are "work 0 1 X" (part system, index of nc_work_offset_set(), axis), "tool 3 0" (number, column) and "parameter 0 - 8012"
// (part system, axis, key). An offset without an entry is 0.
using TableRows = std::map<std::string, std::string>;
TableRows read_tables(const nc_control* control, const nc_config& config);

// The tables as they are after the blocks that the machine has executed, without what was only read ahead.
TableRows executed_tables(nc_control* control, const nc_config& config);

// The rows as text, one in each line, and back.
std::string table_text(const TableRows& rows);
bool parse_tables(const std::string& text, TableRows* rows);

// The values of `now` that differ from `configured`, as the contents of the file.
std::string encode_changes(const TableRows& now, const TableRows& configured);
// Writes the changes into a control that has the tables `configured`. False when the bytes are not such changes; nothing has changed then. Values that the
// control does not have (any more) are skipped, and so are those for which the configuration has another value than when the file was written.
bool restore_changes(nc_control* control, const nc_config& config, const TableRows& configured, const std::string& bytes);

// `now` with the values of `before` where they have changed from `before` to `after` and are still those of `after`; each is a table_text().
std::string tables_without(const std::string& before, const std::string& after, const std::string& now);

// A row that has changed from `before` to `after`, each a table_text(): its key and the two values.
struct TableChange {
  std::string key, was, is;
};
std::vector<TableChange> changed_tables(const std::string& before, const std::string& after);

class TableData final : public RetainedData {
 public:
  // To be made while the control still has the values of the configuration.
  TableData(nc_control* control, const nc_config& config, Feeder* feeder)
      : control_(control), config_(config), feeder_(*feeder), configured_(read_tables(control, config)) {}
  const char* name() const override { return "offsets and parameters"; }
  const char* start() const override { return "are those of the configuration"; }
  bool restore(const std::string& bytes) override { return restore_changes(control_, config_, configured_, bytes); }
  std::string why_refused(const std::string& bytes) const override;
  std::string now() override { return encode_changes(executed_tables(control_, config_), configured_); }
  void want() override { feeder_.want(Feeder::kTables); }
  bool take(std::string* bytes) override;

 private:
  nc_control* control_;
  const nc_config& config_;
  Feeder& feeder_;
  const TableRows configured_;
};

}  // namespace nc::rt
