// SPDX-License-Identifier: Apache-2.0
#include "runtime/axes/screw.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "runtime/axes/equipment.hpp"

namespace nc::rt {
namespace {

constexpr double kReversal = 1e-5;  // mm or deg: less is the rounding of a command that stands
constexpr double kComesInS = 0.5;   // the compensation of an axis that has been homed comes in within that, where its limits allow it
constexpr double kFullTurn = 360;   // deg

// From 0 to 1 with neither velocity nor acceleration at both ends. Its largest second derivative is 10/sqrt(3), its largest first one 15/8.
double smooth(double t) { return t * t * t * (10 + t * (6 * t - 15)); }
constexpr double kSmoothPeak = 5.7735026918962573, kSmoothSpeed = 1.875;

}  // namespace

void ScrewCompensation::create(const ScrewConfig& config, double zero, int direction) noexcept {
  *this = ScrewCompensation();
  if (!config.present()) return;
  config_ = &config;
  side_ = side_of(direction);
  zero_error_ = error_at(side_, zero);
  double apart = config.backlash;
  for (std::size_t n = 0; n < config.error[0].size(); ++n) apart = std::max(apart, std::abs(config.error[0][n] - config.error[1][n]));
  turn_s_ = time_for(apart);
  comes_in_s_ = std::max(kComesInS, time_for(most_error() + std::abs(zero_error_)));
}

// So long the drive needs for this way beside the motion of its axis.
double ScrewCompensation::time_for(double way) const noexcept {
  const double by_speed = config_->velocity > 0 ? kSmoothSpeed * way / config_->velocity : 0;
  return std::max(std::sqrt(kSmoothPeak * way / config_->acceleration), by_speed);
}

double ScrewCompensation::most_error() const noexcept {
  double most = 0;
  for (const std::vector<double>& side : config_->error)
    for (const double error : side) most = std::max(most, std::abs(error));
  return most + config_->backlash;
}

// Linear between the places of the table; outside of it what stands at its end. Without a table of its own the way in - has the error of the way in + and the backlash.
double ScrewCompensation::error_at(unsigned side, double place) const noexcept {
  const ScrewConfig& screw = *config_;
  const bool own = side == 1 || !screw.error[0].empty();
  const std::vector<double>& error = own ? screw.error[side] : screw.error[1];
  const double lost = own ? 0 : screw.backlash;
  if (error.empty()) return lost;
  const std::size_t count = error.size();
  double n = (place - screw.from) / screw.step;
  if (screw.turns) n -= std::floor((place - screw.from) / kFullTurn) * static_cast<double>(count);
  n = std::clamp(n, 0.0, static_cast<double>(screw.turns ? count : count - 1));
  const std::size_t k = std::min(static_cast<std::size_t>(n), count - 1);
  const double next = k + 1 < count ? error[k + 1] : screw.turns ? error[0] : error[k];
  return lost + error[k] + (n - static_cast<double>(k)) * (next - error[k]);
}

// A reversal while the change of the last one is under way waits for its end: it takes some milliseconds, in which the axis has hardly gone back.
void ScrewCompensation::turn_round(double place, bool measured) noexcept {
  if (measured || !placed_) {
    furthest_ = place;
    placed_ = !measured;
    return;
  }
  const double on = side_ == 1 ? place - furthest_ : furthest_ - place;
  if (on >= 0) furthest_ = place;
  if (on > -kReversal || turned_ < 1) return;
  side_ = 1 - side_;
  turned_ = 0;
  furthest_ = place;
}

double ScrewCompensation::step(double place, bool known, bool measured, double cycle_s) noexcept {
  if (config_ == nullptr) return 0;
  turn_round(place, measured);
  turned_ = turn_s_ > cycle_s ? std::min(1.0, turned_ + cycle_s / turn_s_) : 1;
  weight_ = std::clamp(weight_ + (known ? 1 : -1) * cycle_s / comes_in_s_, 0.0, 1.0);
  const double here = error_at(side_, place);
  const double error = turned_ < 1 ? here + (1 - smooth(turned_)) * (error_at(1 - side_, place) - here) : here;
  return value_ = smooth(weight_) * (zero_error_ - error);
}

}  // namespace nc::rt
