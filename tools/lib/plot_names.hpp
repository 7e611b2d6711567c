// SPDX-License-Identifier: Apache-2.0
// What the words of the options of a plot stand for (plot_options.hpp). They are here because the parser of the command line takes long to compile.
#pragma once

#include <map>
#include <string>

#include "tools/lib/toolpath_plot.hpp"

namespace nc::tools {

inline const std::map<std::string, PlotView>& plot_views() {
  static const std::map<std::string, PlotView> names = {
      {"iso", PlotView::kIsometric}, {"xy", PlotView::kXY}, {"xz", PlotView::kXZ}, {"yz", PlotView::kYZ}};
  return names;
}
inline const std::map<std::string, PlotCoordinates>& plot_coordinates() {
  static const std::map<std::string, PlotCoordinates> names = {{"work", PlotCoordinates::kWork}, {"machine", PlotCoordinates::kMachine}};
  return names;
}
inline const std::map<std::string, PlotColor>& plot_colors() {
  static const std::map<std::string, PlotColor> names = {
      {"kind", PlotColor::kKind}, {"tool", PlotColor::kTool}, {"feed", PlotColor::kFeed}, {"z", PlotColor::kZ}};
  return names;
}

}  // namespace nc::tools
