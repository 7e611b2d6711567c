// SPDX-License-Identifier: Apache-2.0
// See command_text.hpp.
#include "tools/lib/command_text.hpp"

#include <algorithm>
#include <cstring>

#include "runtime/programs/encoding.hpp"
#include "tools/lib/commands.hpp"
#include "tools/lib/item_source.hpp"

namespace nc::tools {
namespace {

// A text of a program or of the alarm table in a form that is safe on one line of a terminal: without control characters.
std::string printable(const char* text) {
  std::string out = text;
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  return out;
}

}  // namespace

int complain(std::FILE* err, const std::string& what) {
  std::fprintf(err, "ncsim: %s\n", rt::valid_utf8(what).c_str());
  return kExitError;
}

std::string decimals(double value, int count) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", count, value);
  return text;
}

std::string alarm_line(const Session& session, const nc_alarm& alarm) {
  std::string line =
      session.file_name(alarm.source) + ":" + std::to_string(alarm.source.line) + ": " + alarm.code;
  if (alarm.message[0] && std::strcmp(alarm.message, alarm.code) != 0) line += " " + printable(alarm.message);
  if (alarm.detail.s[0]) line += " - " + printable(alarm.detail.s);
  nc_source calls[NC_MAX_CALLS];
  const unsigned count = std::min(nc_alarm_calls_get(session.control(), kPartSystem, calls, NC_MAX_CALLS), unsigned{NC_MAX_CALLS});
  for (unsigned i = 0; i + 1 < count; ++i) {
    const nc_source& called = calls[i + 1];
    line += "\n  " + session.file_name(calls[i]) + ":" + std::to_string(calls[i].line) + ": calls ";
    line += called.program ? "O" + std::to_string(called.program) : session.file_name(called);
  }
  return rt::valid_utf8(line);  // the name of a file may have any bytes
}

void note_unused(const std::vector<std::string>& sentences, std::FILE* err) {
  for (const std::string& sentence : sentences) std::fprintf(err, "note: %s\n", sentence.c_str());
}

int close_output(std::FILE* out, std::FILE* err, int code) {
  if (std::fflush(out) != 0 || std::ferror(out)) return complain(err, "the output cannot be written");
  return code;
}

}  // namespace nc::tools
