// SPDX-License-Identifier: Apache-2.0
#include "motion/optimal/known_law.hpp"

#include <algorithm>
#include <cmath>

namespace nc::optimal {
namespace {

constexpr double kSameEnd = 1e-6;  ///< mm: a law in phases that ends so near to the end of the path rests there

}  // namespace

Task<bool> KnownLaw::from(Work& work, unsigned place) {
  const Followed::At& at = followed_->at[place];
  const bool found = co_await phases_->from(work, at.s, at.v, at.a);
  co_return found;
}

/// From rest there always is one: this is why there is a known law from every start.
Task<bool> KnownLaw::from_its_rest(Work& work) {
  const Followed::At& end = followed_->end;
  ends_there_ = std::fabs(end.s - phases_->distance()) <= kSameEnd;
  if (!ends_there_) {
    const bool found = co_await phases_->from(work, end.s, 0, 0);
    if (!found) co_return false;
  }
  rests_ = true;
  leaves_at_ = followed_->count;
  before_s_ = end.seconds;
  begins_ = end.s;
  co_return true;
}

/// What is followed brakes to its rest, and the slower it is, the less the bends take: farther on there is a law where there is one here, with
/// few exceptions. So the places are tried ever farther apart, and then those between the last two.
Task<bool> KnownLaw::find(Work& work, const MeshRequest& request, const Limits& limits, PhaseLaw* phases) {
  phases_ = phases;
  followed_ = request.followed;
  leaves_at_ = hint_ = 0;
  before_s_ = begins_ = 0;
  rests_ = ends_there_ = false;
  const bool measured = co_await phases->measure(work, request, limits);
  if (!measured) co_return false;
  const double v = request.from_rest ? 0 : std::sqrt(request.b0), a = request.from_rest ? 0 : 0.5 * request.slope0;
  bool found = co_await phases->from(work, 0, v, a);
  if (found) co_return true;
  if (followed_ == nullptr) co_return false;
  unsigned none = 0, some = 1;
  while (some < followed_->count) {
    found = co_await from(work, some);
    if (found) break;
    none = some;
    some = std::min(2 * some + 1, std::max(some + 1, followed_->count - 1));
  }
  if (some >= followed_->count) {
    found = co_await from_its_rest(work);
    co_return found;
  }
  while (none + 1 < some) {
    const unsigned middle = (none + some) / 2;
    found = co_await from(work, middle);
    (found ? some : none) = middle;
  }
  found = co_await from(work, some);
  if (!found) co_return false;
  leaves_at_ = some;
  before_s_ = followed_->at[some].seconds;
  begins_ = followed_->at[some].s;
  co_return true;
}

double KnownLaw::squared_speed(double s) {
  if (s >= begins_) return ends_there_ ? 0 : phases_->squared_speed(s);
  while (hint_ + 1 < leaves_at_ && followed_->at[hint_ + 1].s <= s) ++hint_;
  const Followed::At &a = followed_->at[hint_], &b = hint_ + 1 < followed_->count ? followed_->at[hint_ + 1] : followed_->end;
  const double share = std::clamp((s - a.s) / (b.s - a.s), 0.0, 1.0);
  return a.v * a.v + share * (b.v * b.v - a.v * a.v);
}

}  // namespace nc::optimal
