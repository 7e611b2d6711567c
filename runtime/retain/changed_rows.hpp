// SPDX-License-Identifier: Apache-2.0
// Values that differ from the configuration, as lines of text: the form of the file of offsets and of that of the names and pockets of tools.
//
// The first line is a head with the number of its version, "nc tables 1", and the last one is "end". Each value has three lines: its key, the value in the configuration ("" = none), the
// value. No value holds the end of a line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nc::rt {

struct ChangedRow {
  std::string key, configured, value;
};

std::string encode_rows_of(std::string_view head, const std::vector<ChangedRow>& rows);
// False when the bytes are not such lines with this head.
bool decode_rows_of(std::string_view head, const std::string& bytes, std::vector<ChangedRow>* rows);
// Whether it is a file of the same kind with another number behind the last space of its head: one that another version of the control has written.
bool is_of_other_version(std::string_view head, const std::string& bytes);

}  // namespace nc::rt
