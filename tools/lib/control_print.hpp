// SPDX-License-Identifier: Apache-2.0
// Replies of services as text for a person.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "runtime/services/service_table.hpp"

namespace nc::tools {

/** The reply of a service: a list as a table with a column for each member of its row in the table of services, a status in a few lines, everything else as
 * names and values. It ends with a line end unless it is empty. Control characters in texts are replaced. */
std::string reply_text(const rt::services::ServiceRow& row, const nlohmann::json& reply);

/** The text with its control characters replaced: a terminal must not obey what stands in a program, in the name of a file or in a sentence about one. */
std::string terminal_text(const std::string& text);

/** Behind the value of a device that is forced. */
inline constexpr char kForcedMark[] = " forced";

/** The reply as JSON in one line, in which what a terminal would obey is written as \u009b. */
std::string json_text(const nlohmann::json& json);

/** A status in one line, for ncctl watch. */
std::string status_line(const nlohmann::json& status);

}  // namespace nc::tools
