// SPDX-License-Identifier: Apache-2.0
// The executed path of a run for its drawing: makes vertices from one sample per scan.
#pragma once

#include <cstdint>
#include <functional>

#include "nc/nc.h"
#include "runtime/feeder.hpp"
#include "tools/lib/toolpath_plot.hpp"

namespace nc::tools {

/** Makes a vertex where the direction changes by more than two degrees, where the tool or the kind of move changes, and, when the colour shows the
 * feed, where the speed changes by more than a tenth. */
class RunPlot final : public rt::PathSink {
 public:
  RunPlot(const nc_config& config, PlotView view, PlotCoordinates coordinates, PlotColor color);

  /** Sets the function that gives the modal state, for the colour by tool. */
  void set_modal(std::function<bool(nc_modal*)> modal) { modal_ = std::move(modal); }

  void moved(const rt::PositionSample& sample) override;

  /** To be called when the run is over; then `plot` is complete. */
  void finish();

  ToolpathPlot plot;

 private:
  struct Point {
    double x[3] = {0, 0, 0};
    double speed_mm_min = 0, tool = 0;
    bool rapid = false;
  };
  Point point_of(const rt::PositionSample& sample) const;
  bool goes_on(const Point& next) const;
  double tool_now();
  void end_piece(bool before_rapid);
  void emit(const Point& point);

  int index_[3] = {-1, -1, -1};  // indices of the axes X, Y, Z
  double cycle_s_;
  PlotColor color_;
  std::function<bool(nc_modal*)> modal_;
  bool changer_ = false;
  double tool_ = 0;
  nc_axes start_{}, command_{};  // position of the first sample and of the previous one
  unsigned samples_ = 0;         // number of samples in the piece that ends in last_
  Point last_, vertex_;
  bool vertex_is_last_ = false;  // nothing has moved since the last vertex
  double piece_speed_ = 0;  // mm/min, speed of the first sample after the last vertex
  std::uint64_t count_ = 0;
};

}  // namespace nc::tools
