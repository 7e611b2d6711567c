// SPDX-License-Identifier: Apache-2.0
// The options of the programs that draw a tool path: the view, the coordinates and the meaning of the colours.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "tools/lib/option_values.hpp"

namespace nc::tools {

/** Adds --view, --coordinates and --color; `each` is called with each of them to say which other options they need. */
inline void add_plot_options(CLI::App* command, std::string* view, std::string* coordinates, std::string* color,
                             const std::function<void(CLI::Option*)>& each) {
  each(command->add_option("--view", *view, "iso, xy, xz or yz")->capture_default_str()->transform(one_of({"iso", "xy", "xz", "yz"})));
  each(command->add_option("--coordinates", *coordinates, "work: of the tool's tip on the workpiece; machine: where the axes go")
           ->capture_default_str()
           ->transform(one_of({"work", "machine"})));
  each(command->add_option("--color", *color, "what the colour of a feed says: kind (none but that it is one), tool, feed or z")
           ->capture_default_str()
           ->transform(one_of({"kind", "tool", "feed", "z"})));
}

}  // namespace nc::tools
