// SPDX-License-Identifier: Apache-2.0
// Rows of a signal trace as CSV (RFC 4180, with plain line ends): number of the scan, time from the trigger in seconds, one column for each signal.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace nc::tools {

/** The head, from the reply of trace.status. */
std::string trace_csv_head(const nlohmann::json& status);
/** The lines of a reply of trace.read. */
std::string trace_csv_rows(const nlohmann::json& page);

}  // namespace nc::tools
