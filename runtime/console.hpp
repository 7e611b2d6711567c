// SPDX-License-Identifier: Apache-2.0
// What ncrtd shows on a terminal: one line that is rewritten in place (or single lines where there is no terminal), and the summary
// at the end.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

#include "runtime/runtime.hpp"

namespace nc::rt {

// The sentence that on virtual time the files of retained data, which it names, are neither read nor written, so that a damaged file goes unnoticed.
// "" when there are no such files.
std::string not_read_text(const Config& config);

// Lines of a program up to its end code (M02, M30 of the m700), for the percentage: counted in small files, estimated
// from the first megabyte in large ones. 0 = cannot be read.
std::uint64_t estimate_lines(ProgramText* program, nc_dialect dialect);

// Share of the program that is done, 0..100, by the line of the main program.
unsigned percent_done(std::uint32_t main_line, std::uint64_t lines);

// How far a part system has come with the program of `lines` that is selected there.
struct RunProgress {
  std::uint32_t main_line = 0;  // line of the main program that is in execution or was finished last
  unsigned percent = 0;         // 100 from the end of the program until it starts again, is reset, or another one is selected
};
RunProgress run_progress(const FeederInfo::System& info, const nc_outputs& now, std::uint64_t lines);

// A line such as "  43 % line 27  X -12.345 Y 3.000 Z -5.000  F4800 S8000 T2  running".
std::string progress_line(const Runtime& runtime, std::uint64_t lines);

// The state in words, with the reason when nothing moves.
std::string state_text(const nc_outputs& outputs);

// Cycle time, path length, blocks and scan statistics as text. `since_ns`: time on CLOCK_MONOTONIC at which the process began.
std::string summary_text(const Runtime& runtime, const nc_outputs& last_run, std::int64_t since_ns);

// Progress while a program runs. On a terminal one line is rewritten in place; elsewhere a line is printed at each tenth of the program and at
// each change of state.
class Progress {
 public:
  Progress(std::FILE* out, bool terminal, std::uint64_t lines)
      : out_(out), terminal_(terminal), lines_(lines) {}
  void show(const Runtime& runtime);
  void finish();  // ends the line that is rewritten, so that what follows begins on a new line
  void note(const std::string& text);

 private:
  std::FILE* out_;
  bool terminal_;
  std::uint64_t lines_;
  bool live_ = false;
  int last_tenth_ = -1;
  std::string last_state_;
};

}  // namespace nc::rt
