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
std::string terminal_text(std::string text);

/** A status in one line, for ncctl watch. */
std::string status_line(const nlohmann::json& status);

}  // namespace nc::tools
