// SPDX-License-Identifier: Apache-2.0
// The subcommands of ncsim. Each returns the exit code: 0 the program ended, 2 it stopped on an alarm, 3 it was given up because it does not
// come to an end, 1 any other error, with one line on `err` that says what and where.
#pragma once

#include <cstdio>
#include <string>

#include "tools/lib/loop_watch.hpp"
#include "tools/lib/machine_choice.hpp"
#include "tools/lib/motion_writer.hpp"
#include "tools/lib/session.hpp"
#include "tools/lib/toolpath_plot.hpp"

namespace nc::tools {

inline constexpr int kExitEnded = 0, kExitError = 1, kExitAlarm = 2, kExitEndless = 3;

/** When a run that does not come to an end is given up. What it has done until then is still written. */
struct RunLimits {
  uint64_t silent_blocks = 1'000'000;  // for trace, check, plot: blocks in a row that only calculate or jump; 0 = no limit
  double seconds = 30 * 86400.0;       // for time, motion, --profile: time of the machine
  LoopLimits loops;
};

/** `ncsim trace`: writes JSON Lines to the descriptor `out`. */
int trace_command(const SessionOptions& options, const RunLimits& limits, int out, std::FILE* err);

/** `ncsim check`: writes the alarm as FILE:LINE: CODE MESSAGE - DETAIL, or one line about what the program does, to
 * `out`. */
int check_command(const SessionOptions& options, const RunLimits& limits, std::FILE* out, std::FILE* err);

/** `ncsim time`: prints cycle time, path length and blocks of the program on this machine. */
int time_command(const SessionOptions& options, const MachineOptions& machine, const RunLimits& limits, std::FILE* out, std::FILE* err);

/** `ncsim motion`: writes the position of every axis in every cycle to `path` ("" = the descriptor `out`). After an alarm the rows before it
 * are written, too, and the alarm is printed on `err`. */
int motion_command(const SessionOptions& options, const MachineOptions& machine, MotionFormat format, const std::string& path,
                   const RunLimits& limits, int out, std::FILE* err);

/** `ncsim plot --profile`: draws path speed, acceleration and jerk over time into BASE.svg and BASE.png. */
int profile_command(const SessionOptions& options, const MachineOptions& machine, const RunLimits& limits, const std::string& base,
                    std::FILE* out, std::FILE* err);

/** How `ncsim plot` draws. */
struct PlotOptions {
  PlotView view = PlotView::kIsometric;
  PlotCoordinates coordinates = PlotCoordinates::kWork;
  PlotColor color = PlotColor::kKind;
};

/** `ncsim plot`: draws the path into BASE.svg and BASE.png, also the path until an alarm. */
int plot_command(const SessionOptions& options, const RunLimits& limits, const PlotOptions& how,
                 const std::string& base, std::FILE* out, std::FILE* err);

/** `ncsim dialects`: a line for each dialect that the library knows, and what it has. */
int dialects_command(bool markdown, std::FILE* out, std::FILE* err);
/** `ncsim functions`: prints the dialect's table of functions, tab-separated or as Markdown; the same for the tables below. */
int functions_command(const std::string& dialect, bool markdown, std::FILE* out, std::FILE* err);

/** `ncsim variables`: the dialect's table of system variables. */
int variables_command(const std::string& dialect, bool markdown, std::FILE* out, std::FILE* err);

/** `ncsim parameters`: the parameters of the dialect that the control reads. */
int parameters_command(const std::string& dialect, bool markdown, std::FILE* out, std::FILE* err);

/** `ncsim alarms`: the dialect's alarm table. */
int alarms_command(const std::string& dialect, bool markdown, std::FILE* out, std::FILE* err);

}  // namespace nc::tools
