// SPDX-License-Identifier: Apache-2.0
// The setup of an offline run: what the control and its machine are before the first block (docs/trace.md,
// "Setup").
//
// Reading and applying are two steps: parse_setup() checks the text against the format without a control, the
// two apply functions carry it into libnc, which alone knows which parameters and variables a dialect has.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nc/nc.h"
#include "tools/lib/probe_solid.hpp"

namespace nc::tools {

/** Something in the setup with the place it came from, for errors found later. */
struct SetupPlace {
  std::string path;  // "params.1078"
  uint32_t line = 0;
};

struct SetupAxis {
  char name = 0;
  bool rotary = false;
};

/** One control parameter; `axis` 0 = all axes. */
struct SetupParameter {
  SetupPlace place;
  std::string key;
  char axis = 0;
  std::string text;
};

/** One value for one axis. */
struct SetupAxisValue {
  SetupPlace place;
  unsigned axis = 0;  // index
  double value = 0.0;
};

struct SetupWorkOffset {
  SetupPlace place;
  unsigned index = 0;  // of nc_work_offset_set
  std::vector<SetupAxisValue> values;
};

struct SetupToolOffset {
  SetupPlace place;
  unsigned number = 0;
  bool plain = false;  // one number: a length or a radius, whichever the program asks for
  double column[4] = {0, 0, 0, 0};
};

struct SetupVariable {
  SetupPlace place;
  uint32_t number = 0;
  bool vacant = false;
  double value = 0.0;
};

/** A solid; its signal is on while the controlled point, or the ball there, is inside. A plain box holds for every axis, by machine
 * coordinates; all others have a `probe` and hold for X, Y and Z. */
struct SkipSolid {
  unsigned signal = 1;
  std::optional<ProbeSolid> probe;
  double low[NC_MAX_AXES], high[NC_MAX_AXES];  // +-infinity where the box says nothing
  bool bounded[NC_MAX_AXES] = {};
};

/** Inputs of one moment: macro interface words and which of their bits are given. */
struct InputChange {
  uint32_t mask[NC_WORDS] = {0, 0, 0, 0};
  uint32_t bits[NC_WORDS] = {0, 0, 0, 0};
};

/** Where the signal comes in one skip move: where its path passes the place, workpiece coordinates. */
struct SkipHit {
  SetupPlace place;
  std::optional<uint32_t> line;   // of the move; without it the entries are taken by the skip moves in their order
  std::optional<uint32_t> program;
  unsigned signal = 1;
  bool none = false;              // this move meets nothing
  double at[NC_MAX_AXES] = {};
  bool named[NC_MAX_AXES] = {};
};

/** A change from outside. */
struct SetupEvent {
  SetupPlace place;
  std::optional<uint32_t> line;   // when it begins to execute: of the main program, or of `program`
  std::optional<uint32_t> program;
  std::optional<uint32_t> m;      // when this M code is given out
  std::optional<double> seconds;  // of the trace's clock since the start
  InputChange inputs;
  std::map<std::string, int> signals;
};

struct SetupKinematics {
  std::string type;
  std::string tool, table;  // rotary axes from the machine base outwards
  double center[NC_MAX_AXES] = {};
  std::string sense = "iso", program_frame, interpolation = "joint";
};

/** A whole setup file; the defaults are those of an empty object. */
struct Setup {
  std::string name = "setup";  // of the file, for messages
  std::vector<SetupAxis> axes = {{'X', false}, {'Y', false}, {'Z', false}};
  std::vector<SetupParameter> parameters;
  std::optional<SetupKinematics> kinematics;
  nc_axes start = {};
  std::vector<SetupWorkOffset> work_offsets;
  std::vector<SetupToolOffset> tool_offsets;
  std::vector<SetupVariable> variables;
  nc_dialect dialect{};  // whose numbers `inputs` has
  InputChange inputs;
  std::vector<SkipSolid> skip;
  std::vector<SkipHit> hits;
  uint32_t optional_skip = 0;  // bit n = switch n
  bool optional_stop = false, single_block = false, dry_run = false;
  uint32_t mirror_axes = 0;                                      // bit = axis index
  std::vector<std::pair<std::string, std::string>> subprograms;  // name as the store takes it, text
  std::vector<SetupEvent> events;
  int64_t clock_ms = 0;  // local time, ms since 1970-01-01
  uint32_t option_variable_sets = 600, option_tool_offsets = 200, option_work_offsets = 96;
  bool option_extended_variables = false, option_macro_extensions = false, option_negative_count = false;
  SetupPlace extended_variables_place, macro_extensions_place, negative_count_place;
  nc_variable_range option_variable_ranges[NC_VARIABLE_RANGES] = {};

  Setup();
  int axis_index(char axis_name) const;
  /** X, Y and Z of a position; one that there is not is 0. */
  Point3 linear(const nc_axes& position) const;
};

/** Parse the text of a setup file; what it does not say is as in `defaults`. @return false with "NAME:LINE: key.path: why" in
 * *error. */
bool parse_setup(const std::string& text, const std::string& name, Setup* setup, std::string* error,
                 const Setup& defaults = Setup());

/** Read and parse a setup file. */
bool load_setup(const std::string& path, Setup* setup, std::string* error, const Setup& defaults = Setup());

/** ms since 1970-01-01 of "2026-01-01T00:00:00" (local time as it stands, no zone); a "Z" or fraction is an
 * error. */
std::optional<int64_t> parse_clock(const std::string& text);

/** What nc_create() must know: axes and sizes. Call nc_config_init() before. */
void apply_setup(const Setup& setup, nc_config* config);

/** Parameters, tables, variables, switches, position and sub programs; the setup must outlive the control. */
bool apply_setup(const Setup& setup, nc_control* control, std::string* error);

}  // namespace nc::tools
