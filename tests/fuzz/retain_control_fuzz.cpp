// SPDX-License-Identifier: Apache-2.0
// Any bytes as the payload of retained variables, of retained tables and of the names and pockets of tools. If they are refused they change nothing. If they are accepted the control
// has only finite values, and no two tools are in one pocket; all are the same after they are written and read again.
#include "fuzz/small_control.hpp"
#include "runtime/retain/tables.hpp"
#include "runtime/retain/tool_label_data.hpp"
#include "runtime/retain/variables.hpp"

namespace {

using namespace nc::fuzz;

void variables(const std::string& bytes) {
  SmallControl control;
  const std::string before = nc::rt::encode_variables(control.get());
  const bool taken = nc::rt::restore_variables(control.get(), bytes);
  const std::string after = nc::rt::encode_variables(control.get());
  require(taken || after == before);
  std::uint32_t number = 0;
  for (double value = 0; nc_variable_next(control.get(), 0, number, &number, &value) == NC_OK; ++number) require(std::isfinite(value));
  SmallControl next;
  require(nc::rt::restore_variables(next.get(), after) && nc::rt::encode_variables(next.get()) == after);
}

void tables(const std::string& bytes) {
  SmallControl control;
  const nc::rt::TableRows configured = nc::rt::read_tables(control.get(), control.config());
  const bool taken = nc::rt::restore_changes(control.get(), control.config(), configured, bytes);
  const nc::rt::TableRows after = nc::rt::read_tables(control.get(), control.config());
  require(taken || after == configured);
  for (const auto& [key, value] : after)
    require(key.find('\n') == std::string::npos && value.find('\n') == std::string::npos && value.find("nan") == std::string::npos);
  SmallControl next;
  const std::string kept = nc::rt::encode_changes(after, configured);
  require(nc::rt::restore_changes(next.get(), next.config(), configured, kept));
  require(nc::rt::encode_changes(nc::rt::read_tables(next.get(), next.config()), configured) == kept);
}

void labels(const std::string& bytes) {
  const nc::rt::ToolLabels configured = {{1, {"drill", 1}}, {2, {"", 2}}};
  nc::rt::ToolLabels read = configured, again = configured;
  std::vector<std::string> remarks;
  require(nc::rt::restore_tool_labels(bytes, 200, &read, &remarks) || read == configured);
  for (const auto& [tool, label] : read) require(nc::rt::tool_name_trouble(label.name).empty() && nc::rt::other_in_pocket(read, tool) == 0);
  const std::string kept = nc::rt::encode_tool_labels(read, configured);
  require(nc::rt::restore_tool_labels(kept, 200, &again, &remarks));
  require(nc::rt::encode_tool_labels(again, configured) == kept);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes in(data, size);
  const unsigned what = in.byte();
  ((what & 2) != 0 ? labels : (what & 1) != 0 ? tables : variables)(in.rest());
  return 0;
}
