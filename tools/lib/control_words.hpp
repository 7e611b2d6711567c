// SPDX-License-Identifier: Apache-2.0
// How the rows of the table of services become commands of ncctl, and the documents that are made from the table.
#pragma once

#include <string>

#include "runtime/services/service_table.hpp"

namespace nc::tools {

/** True for a service that is a command of ncctl as it is. The others are used by commands of ncctl's own: a control that is taken would end with the command,
 * and pieces of programs are for programs. */
bool is_command(const rt::services::ServiceRow& row);
/** "NEW-NAME" */
std::string argument_name(const rt::services::FieldInfo& row);
/** "--lease-ms" */
std::string option_name(const rt::services::FieldInfo& row);
/** A time on the command line as seconds since 1970: "90s", "15m", "8h", "7d" before `now`, or a local date with or without a time. "" = it is good, else what is
 * wrong. */
std::string time_of(const std::string& text, double now, double* seconds);
/** What the commands have in common whose first word this is. */
std::string group_meaning(const std::string& word);

/** docs/services.md, from "Services" on: a section for each right with its services, then the fields. */
std::string services_markdown();
/** The section COMMANDS of the manual page of ncctl. */
std::string services_man();
/** The completion of ncctl for bash. */
std::string services_bash();
// Types and topics of the services over DDS: the part of dds/nc_dds.idl and of dds/nc_dds.py between their markers.
std::string services_idl();
std::string services_python();

}  // namespace nc::tools
