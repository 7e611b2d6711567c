// SPDX-License-Identifier: Apache-2.0
// Arguments with which a request for a service is well formed.
#pragma once

#include <algorithm>
#include <string>

#include "runtime/services/call.hpp"

namespace nc::test {

// A value for each member that a request must have, so that only the right decides.
inline rt::services::Json arguments_of(const rt::services::ServiceRow& row) {
  using namespace rt::services;
  Json args = Json::object();
  for (const Wanted& wanted : row.request) {
    if (!wanted.required) continue;
    const FieldInfo& field = row_of(wanted.field);
    switch (field.kind) {
      case Kind::kNumber:
      case Kind::kWhole: args[field.name] = std::max(field.least, std::min(1.0, field.most)); break;
      case Kind::kFlag: args[field.name] = true; break;
      case Kind::kText: args[field.name] = field.field == Field::kMode ? "auto" : std::string(static_cast<std::size_t>(field.least), 'X'); break;
      case Kind::kName: args[field.name] = "none.nc"; break;
      case Kind::kData: args[field.name] = "AAAA"; break;
      case Kind::kList: args[field.name] = field.field == Field::kKeptRights ? Json({"view", "operate", "set up", "maintain"}) : Json({"XX"}); break;
    }
  }
  if (row.service == Service::kProgramBegin) args["sha256"] = std::string(64, '0');
  if (row.service == Service::kSetTool) args["length"] = 1;
  if (row.service == Service::kParameterImport) args["toml"] = "[parameters]\n1078 = 1\n";
  if (row.service == Service::kSetLife) args["used"] = 1;
  if (row.service == Service::kRestartFind) args["line"] = 1;
  if (row.service == Service::kSetVariable) args["value"] = 1;
  if (row.service == Service::kImport) args["toml"] = "[tool_offsets]\n1 = 1\n";
  return args;
}

}  // namespace nc::test
