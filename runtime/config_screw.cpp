// SPDX-License-Identifier: Apache-2.0
// Key of [[axis]]: screw, the backlash of an axis and the error of its pitch. docs/homing.md.
#include <algorithm>
#include <cmath>
#include <string>

#include "runtime/config_equipment.hpp"

namespace nc::rt {
namespace {

constexpr double kMostError = 1;       // mm or deg: more is no error of a screw but one of the table
constexpr double kSteepest = 0.01;     // of the step: as much faster the drive goes than the axis
constexpr std::size_t kMostPlaces = 4096;
constexpr double kSameTurn = 1e-6;     // deg
constexpr double kSpeedShare = 0.25;   // of max_velocity: so much faster the drive turns where the axis reverses; its motor can do that (docs/connecting-a-machine.md)

// Between two neighbours, and between the last and the first one of a turn.
bool is_smooth(const ScrewConfig& screw, const std::vector<double>& error) {
  for (std::size_t n = 0; n + (screw.turns ? 0 : 1) < error.size(); ++n)
    if (std::abs(error[(n + 1) % error.size()] - error[n]) > kSteepest * screw.step) return false;
  return true;
}

// The largest change of its slope; outside of the table it has none. There the drive changes its speed within a cycle.
double sharpest_bend(const ScrewConfig& screw, const std::vector<double>& error) {
  double bend = 0;
  for (std::size_t n = 0; n < error.size(); ++n) {
    const double before = n > 0 ? error[n - 1] : screw.turns ? error.back() : error[n];
    const double after = n + 1 < error.size() ? error[n + 1] : screw.turns ? error.front() : error[n];
    bend = std::max(bend, std::abs(after - 2 * error[n] + before) / screw.step);
  }
  return bend;
}

// A table may not ask more of the drive where it bends than a reversal does.
void check_bends(TableReader* reader, const ScrewConfig& screw, double max_velocity, double cycle_s) {
  for (const unsigned side : {1u, 0u}) {
    const double needs = sharpest_bend(screw, screw.error[side]) * max_velocity / cycle_s;
    if (needs <= screw.acceleration) continue;
    reader->error(side == 1 ? "error" : "error_minus", "bends so sharply that the drive would need " + number_text(std::round(needs)) + " there at max_velocity, and acceleration is " + number_text(screw.acceleration) + ": places further apart, or smaller errors");
  }
}

bool read_errors(TableReader* reader, const char* key, const ScrewConfig& screw, std::vector<double>* error) {
  if (!reader->numbers(key, error, 2, kMostPlaces)) return false;
  for (const double value : *error) {
    if (!(std::abs(value) <= kMostError)) {
      reader->error(key, number_text(value) + " is more than an error of a screw can be (" + number_text(kMostError) + ")");
      return false;
    }
  }
  if (is_smooth(screw, *error)) return true;
  reader->error(key, "must not change by more than a hundredth of step from place to place");
  return false;
}

void read_table(TableReader* reader, ScrewConfig* screw) {
  for (const char* key : {"from", "step"}) reader->require(key);
  reader->number("from", &screw->from, -kMaxLength, kMaxLength);
  if (!reader->number("step", &screw->step, 1e-3, kMaxLength)) return;
  std::vector<double> plus, minus;
  if (!read_errors(reader, "error", *screw, &plus)) return;
  if (screw->turns && std::abs(static_cast<double>(plus.size()) * screw->step - 360) > kSameTurn)
    return reader->error("error", "the table of a rotary axis is one turn: as many numbers as steps in 360");
  if (reader->find("error_minus") != nullptr) {
    if (!read_errors(reader, "error_minus", *screw, &minus)) return;
    if (minus.size() != plus.size()) return reader->error("error_minus", "must have as many numbers as error (" + std::to_string(plus.size()) + ")");
    if (reader->find("backlash") != nullptr) return reader->error("backlash", "is in the difference of error and error_minus already");
  }
  screw->error[0] = std::move(minus);
  screw->error[1] = std::move(plus);
}

}  // namespace

void read_screw(TableReader* reader, const nc_axis_config& axis, double cycle_s, ScrewConfig* screw) {
  screw->turns = axis.rotary;
  screw->acceleration = axis.max_acceleration;
  screw->velocity = kSpeedShare * axis.max_velocity;
  reader->number("backlash", &screw->backlash, quantity::kBacklash);
  if (reader->find("error") != nullptr) {
    read_table(reader, screw);
  } else {
    for (const char* key : {"from", "step", "error_minus"})
      if (reader->find(key) != nullptr) reader->error(key, "is for a table: error");
    if (reader->find("backlash") == nullptr) reader->errors()->add(reader->line(), reader->path(), "needs backlash, error or both");
  }
  reader->number("acceleration", &screw->acceleration, 1, 1e6);
  if (!(screw->acceleration > 0)) reader->error("acceleration", "is missing, and the axis has no max_acceleration");
  if (screw->acceleration > 0) check_bends(reader, *screw, axis.max_velocity, cycle_s);
  if (axis.spindle != 0) reader->error("backlash", "the axis is a spindle, whose encoder has no screw");
}

}  // namespace nc::rt
