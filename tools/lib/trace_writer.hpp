// SPDX-License-Identifier: Apache-2.0
// The lines of a trace (docs/trace.md): one JSON object per line, keys always in the same order, numbers as
// number_text.hpp.
#pragma once

#include <string>
#include <string_view>

#include "nc/nc.h"
#include "tools/lib/item_source.hpp"
#include "tools/lib/output_file.hpp"

namespace nc::tools {

/** Writes the lines of a trace, without any knowledge of the run. */
class TraceWriter {
 public:
  TraceWriter(OutputFile* out, const nc_system_config& system);

  void move(const nc_source& source, const nc_move& move, const bool* skipped = nullptr);  // skipped: given only for a skip move
  void block(const nc_source& source, const nc_axes& work, const nc_axes& machine);
  void aux(const nc_source& source, char code, double value);
  void dwell(const nc_source& source, bool turns, double value);
  void sync(const nc_source& source, uint32_t what);
  void message(const nc_source& source, uint32_t port, const nc_text& text);
  void alarm(const nc_alarm& alarm);
  /** Writes the last line; common variables and modal codes come from `items`. */
  void end(const nc_source& source, bool ok, const nc_axes& work, const nc_axes& machine, uint32_t modal,
           ItemSource* items);

 private:
  void begin(std::string_view type, const nc_source& source);
  void finish();
  void put(std::string_view text);
  void put_number(double value);
  void put_integer(uint64_t value);
  void put_axes(std::string_view key, const nc_axes& axes);
  void put_pair(std::string_view key, const nc_move& move, const double (&center)[3]);
  void put_circular(const nc_move& move);
  void put_string(std::string_view text);

  OutputFile* out_;
  unsigned axis_count_;
  char axis_key_[NC_MAX_AXES][6];  // ,"X":
  char* at_ = nullptr;             // next byte of the line being built
};

/** `text` as the contents of a JSON string: control characters are escaped, and bytes that are not valid UTF-8 become
 * U+0080...U+00FF. */
std::string json_escaped(std::string_view text);

}  // namespace nc::tools
