// SPDX-License-Identifier: Apache-2.0
// The sections of the machine configuration, in the order in which they are read (later ones refer to earlier
// ones).
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "runtime/toml_reader.hpp"

namespace nc::rt {

inline constexpr double kMaxLength = 1e6;  // mm or deg; a greater number is a typing error
inline constexpr double kMostRpm = 6e5;     // largest speed that nc_spindle_inputs accepts

void read_machine(TableReader* root, Config* config);
void read_scheduling(TableReader* root, Config* config);
void read_motion(TableReader* root, Config* config);  // after the axes
void read_axes(TableReader* root, Config* config);
void read_parameters(TableReader* root, Config* config);
// A parameter's value as the text that nc_parameter_set() takes: of a number or a word. A switch is 0 or 1, as in the manual.
std::optional<std::string> parameter_text(const toml::node& node);
std::string parameter_text(double number);
void read_work_offsets(TableReader* root, Config* config);
void read_tool_offsets(TableReader* root, Config* config);
void read_points(TableReader* root, Config* config);  // after read_point_buses(), which reads the buses that carry points
void read_macro_interface(TableReader* root, Config* config);
void read_ladder(TableReader* root, Config* config);
void read_signals(TableReader* root, Config* config);  // after points, macro interface and ladder
// Connects the point that `key` names with a signal, which the family of the machine calls by this key. After the points.
void connect_signal(TableReader* reader, const std::string& key, const std::string& signal, Config* config);
void read_handwheels(TableReader* root, Config* config);  // after axes and points
void read_joysticks(TableReader* root, Config* config);   // the same
// The input of this type that `key` names, which is used for `role` of this number then. -1 when the key is not there or names none.
int read_input(TableReader* reader, const std::string& key, hal::PointType type, PointRole role, std::uint8_t number, Config* config);
void read_power(TableReader* root, Config* config);  // after the signals
void read_sim(TableReader* root, Config* config);
void read_spindle_feedback(TableReader* root, Config* config);  // after [sim] and the points; in runtime/config_spindles.cpp
void limit_taps(Config* config);  // after parameters and spindles; in the same file
void read_share(TableReader* root, Config* config);  // runtime/share/config_share.cpp
void read_services(TableReader* root, Config* config);  // runtime/services/config_services.cpp
// [sim.spindle], [sim.spindle2] ... and [sim.tool_changer]; called by read_sim() with the reader of [sim].
void read_sim_plant(TableReader* sim, Config* config);

// "X" = axis X of part system 1, "X2" = axis X of part system 2. False when there is none.
bool find_axis(const Config& config, std::string_view name, unsigned* system, unsigned* axis);

// Whether two paths of the configuration name the same file: "a", "./a" and "b/../a" do. An empty path names no file.
inline bool same_file(const std::string& one, const std::string& other) {
  return !one.empty() && std::filesystem::path(one).lexically_normal() == std::filesystem::path(other).lexically_normal();
}

}  // namespace nc::rt
