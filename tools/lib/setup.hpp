// SPDX-License-Identifier: Apache-2.0
// The setup of an offline run: the state of the control and its machine before the first block (docs/trace.md,
// "Setup").
//
// Reading and applying are two steps: parse_setup() checks the text against the format without a control. The
// two apply functions write it into libnc, because only libnc knows which parameters and variables a dialect has.
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

/** The place of something in the setup, for errors that are found later. */
struct SetupPlace {
  std::string path;  // "params.1078"
  uint32_t line = 0;
};

struct SetupAxis {
  char name = 0;
  bool rotary = false;
};

/** One parameter of the control; `axis` 0 = all axes. */
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
  unsigned index = 0;  // as nc_work_offset_set() counts
  std::vector<SetupAxisValue> values;
};

struct SetupToolOffset {
  SetupPlace place;
  unsigned number = 0;
  bool plain = false;  // a single number, which is a length or a radius, depending on what the program asks for
  double column[4] = {0, 0, 0, 0};
};

struct SetupVariable {
  SetupPlace place;
  uint32_t number = 0;
  bool vacant = false;
  double value = 0.0;
};

/** A solid; its skip signal is on while the controlled point, or the ball there, is inside. A plain box is given in machine coordinates and may limit any
 * axis. All other solids have a `probe` and are given in X, Y and Z. */
struct SkipSolid {
  unsigned signal = 1;
  std::optional<ProbeSolid> probe;
  double low[NC_MAX_AXES], high[NC_MAX_AXES];  // +-infinity for an axis that the box does not limit
  bool bounded[NC_MAX_AXES] = {};
};

/** A change of inputs: words of the macro interface, and which of their bits are given. */
struct InputChange {
  uint32_t mask[NC_WORDS] = {0, 0, 0, 0};
  uint32_t bits[NC_WORDS] = {0, 0, 0, 0};
};

/** A touch in one skip move: the signal comes when the path passes the given place in workpiece coordinates. */
struct SkipHit {
  SetupPlace place;
  std::optional<uint32_t> line;   // line of the move; entries without a line are used for the skip moves in their order
  std::optional<uint32_t> program;
  unsigned signal = 1;
  bool none = false;              // this move touches nothing
  double at[NC_MAX_AXES] = {};
  bool named[NC_MAX_AXES] = {};
};

/** A change from outside, and when it happens. */
struct SetupEvent {
  SetupPlace place;
  std::optional<uint32_t> line;   // when this line of the main program, or of `program`, begins to execute
  std::optional<uint32_t> program;
  std::optional<uint32_t> m;      // when this M code is given out
  std::optional<double> seconds;  // at this time since the start, on the clock of the trace
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
  std::string name = "setup";  // name of the file, for messages
  std::vector<SetupAxis> axes = {{'X', false}, {'Y', false}, {'Z', false}};
  std::vector<SetupParameter> parameters;
  std::optional<SetupKinematics> kinematics;
  nc_axes start = {};
  std::vector<SetupWorkOffset> work_offsets;
  std::vector<SetupToolOffset> tool_offsets;
  std::vector<SetupVariable> variables;
  nc_dialect dialect{};  // dialect to which the numbers in `inputs` belong
  InputChange inputs;
  std::vector<SkipSolid> skip;
  std::vector<SkipHit> hits;
  uint32_t optional_skip = 0;  // bit n = switch n is on
  bool optional_stop = false, single_block = false, dry_run = false;
  uint32_t mirror_axes = 0;                                      // bit n = the axis with index n
  std::vector<std::pair<std::string, std::string>> subprograms;  // name in the form that the program store takes, and text
  std::vector<SetupEvent> events;
  int64_t clock_ms = 0;  // local time, ms since 1970-01-01
  uint32_t option_variable_sets = 600, option_tool_offsets = 200, option_work_offsets = 96;
  bool option_extended_variables = false, option_macro_extensions = false, option_negative_count = false;
  SetupPlace extended_variables_place, macro_extensions_place, negative_count_place;
  nc_variable_range option_variable_ranges[NC_VARIABLE_RANGES] = {};

  Setup();
  int axis_index(char axis_name) const;
  /** X, Y and Z of a position; 0 for an axis that does not exist. */
  Point3 linear(const nc_axes& position) const;
};

/** Parses the text of a setup file; what it does not name is taken from `defaults`. @return false with "NAME:LINE: key.path: why" in
 * *error. */
bool parse_setup(const std::string& text, const std::string& name, Setup* setup, std::string* error,
                 const Setup& defaults = Setup());

/** Reads and parses a setup file. */
bool load_setup(const std::string& path, Setup* setup, std::string* error, const Setup& defaults = Setup());

/** The ms since 1970-01-01 of a time such as "2026-01-01T00:00:00" (local time without a zone); a "Z" or a fraction is an
 * error. */
std::optional<int64_t> parse_clock(const std::string& text);

/** Writes the values that nc_create() needs: axes and sizes. nc_config_init() must have been called before. */
void apply_setup(const Setup& setup, nc_config* config);

/** Writes parameters, tables, variables, switches, position and sub programs; the setup must outlive the control. */
bool apply_setup(const Setup& setup, nc_control* control, std::string* error);

}  // namespace nc::tools
