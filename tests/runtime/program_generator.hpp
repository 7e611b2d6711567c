// SPDX-License-Identifier: Apache-2.0
// Random m700 programs for walls_test.cpp: lines, arcs, helices, cycles, macros, subprograms, loops over inputs that
// change meanwhile, skips against a solid, M S T, dwells, offsets, tool radius compensation. Every program is valid,
// stays inside the soft limits of test_config.hpp and depends only on its seed.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace nc::test {

struct GeneratedProgram {
  std::string text;
  std::vector<std::string> script;  // input changes that belong to it
};

// The solid that probing moves meet: X from 150 mm on, signal 1 (for the [sim] section).
inline const char* probe_solid_toml() {
  return "[[sim.solid]]\nsignal = 1\nX = [150.0, 200.0]\n";
}

class ProgramGenerator {
 public:
  explicit ProgramGenerator(std::uint32_t seed) : random_(seed) {}
  GeneratedProgram make(unsigned groups);

 private:
  void line(const std::string& text);
  unsigned draw(unsigned n) { return static_cast<unsigned>(random_() % n); }
  double draw(double from, double to);  // on a grid of 1 um, so that the text is exact
  std::string feed();
  void go(double x, double y, double z);

  // One group of blocks each.
  void lines();
  void arcs();
  void helix();
  void radius_arc();
  void incremental();
  void drilling();
  void auxiliary();
  void dwell();
  void subprogram();
  void polygon_macro();
  void input_loop();
  void input_macro();
  void input_off();
  void input_at_line();
  void outputs();
  void probe();
  void contour();
  void work_system();
  void tool_length();
  void exact_stop();
  void stops();
  void optional_blocks();
  void goto_loop();
  void corners();

  std::mt19937 random_;
  GeneratedProgram program_;
  unsigned lines_ = 0;            // number of lines so far
  double x_ = 0, y_ = 0, z_ = 0;  // programmed position, G54, no length offset
  unsigned m50_ = 0;              // number of strobes of M50 so far, by which the script names them
  unsigned next_label_ = 1000;
};

}  // namespace nc::test
