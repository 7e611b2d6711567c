// SPDX-License-Identifier: Apache-2.0
// See identity_keeper.hpp.
#include "dds/identity_keeper.hpp"

#include <algorithm>

#include "runtime/clock.hpp"
#include "runtime/share/text.hpp"

namespace nc::dds {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kLookEveryNs = 500 * kMs;
constexpr std::int64_t kSettleNs = 500 * kMs;       // the partners of the new part have not changed for so long: they have found it
constexpr std::int64_t kPatienceNs = 10'000 * kMs;  // a partner that has not found the new part by then is not waited for
constexpr std::int64_t kEarlyS = 2;                 // a part ends so long before its certificate, and takes none that ends sooner
constexpr std::int64_t kRetryS = 10;
constexpr std::int64_t kDayS = 86'400;
constexpr std::int64_t kWarnS = 14 * kDayS;

std::int64_t wall_s() {
  return rt::share::wall_ns() / 1'000'000'000;
}

std::int64_t steady_ns() {
  return rt::RealClock().now_ns();
}

}  // namespace

void IdentityKeeper::say(const std::string& text) {
  if (text == said_) return;
  said_ = text;
  use_.tell(text, true);
}

void IdentityKeeper::fault(const std::string& text) {
  say(text + (current_.part ? "; goes on with the identity that it has, until " + utc_text(current_.identity.ends_s)
                            : "; " + use_.without + " until " + use_.folder + " has a valid one (nc-keys renew)"));
}

bool IdentityKeeper::open(bool waits, std::string* error) {
  Identity identity;
  SecurityPlugins plugins;
  if (!find_plugins(&plugins, error)) return false;
  stamp_ = stamp_of(use_.folder);
  if (!read_identity(use_.folder, &identity, error)) return false;
  if (waits && validity_of(identity, wall_s()) != Validity::kValid) {
    use(identity);
    return true;
  }
  if (!begin(identity, false, &current_, error)) return false;
  use_.change(nullptr, current_.part.get());
  return true;
}

void IdentityKeeper::end() {
  next_.part.reset();
  current_.part.reset();
}

bool IdentityKeeper::begin(const Identity& identity, bool stands_by, Running* running, std::string* error) {
  running->part = use_.make(stands_by, error);
  if (!running->part) return false;
  running->identity = identity;
  said_.clear();
  use_.tell("the identity of " + identity.subject + " is valid until " + utc_text(identity.ends_s), true);
  return true;
}

// Takes an identity whose files are in order, if this is its time.
void IdentityKeeper::use(const Identity& identity) {
  const std::int64_t now_s = wall_s();
  if (const std::string why = invalid_text(identity, now_s + kEarlyS); !why.empty()) {
    if (validity_of(identity, now_s + kEarlyS) == Validity::kNotYet) retry_s_ = std::min(identity.begins_s, now_s + kRetryS);
    return fault(why);
  }
  // The plug-in has one set of rules for all participants of a process: with the next part beside the current one it would go on with those of the current one,
  // and end both when they end.
  if (current_.part && identity.rules != current_.identity.rules) end_current();
  std::string error;
  Running* place = current_.part ? &next_ : &current_;
  if (!begin(identity, place == &next_, place, &error)) {
    retry_s_ = now_s + kRetryS;
    return fault(error);
  }
  if (place == &current_) {
    warn_s_ = 0;
    use_.change(nullptr, current_.part.get());
    return;
  }
  next_since_ns_ = settled_since_ns_ = steady_ns();
}

void IdentityKeeper::look_at_files(std::int64_t now_s) {
  const std::string stamp = stamp_of(use_.folder);
  const bool again = retry_s_ != 0 && now_s >= retry_s_;
  if (stamp == stamp_ && !again) return;
  stamp_ = stamp;
  retry_s_ = 0;
  next_.part.reset();  // it has files that are old already
  Identity identity;
  std::string error;
  if (read_identity(use_.folder, &identity, &error)) use(identity);
  else fault(error);
}

// Lets the next part take over as soon as everybody who talks with the current one talks with it, or the time is over.
void IdentityKeeper::change_over(std::int64_t now_s) {
  if (!next_.part || !current_.part) return;  // end_in_time() comes after this, so there is a current one as long as there is a next one
  const std::int64_t now_ns = steady_ns();
  const bool all = next_.part->partners() >= current_.part->partners();
  if (!all) settled_since_ns_ = now_ns;
  const bool late = now_ns - next_since_ns_ >= kPatienceNs || now_s + kEarlyS >= current_.identity.ends_s;
  if (now_ns - settled_since_ns_ < kSettleNs && !late) return;
  use_.change(current_.part.get(), next_.part.get());
  current_ = std::move(next_);
  warn_s_ = 0;
  use_.tell("the new identity is in use", false);
}

void IdentityKeeper::end_in_time(std::int64_t now_s) {
  if (!current_.part || validity_of(current_.identity, now_s + kEarlyS) == Validity::kValid) return;
  const Identity identity = current_.identity;
  end_current();
  use(identity);
}

void IdentityKeeper::end_current() {
  use_.change(current_.part.get(), nullptr);
  current_.part.reset();
}

// A line each day, from 14 days before the end on, or from the last tenth of the time where that is shorter.
void IdentityKeeper::warn_in_time(std::int64_t now_s) {
  if (!current_.part || now_s < warn_s_) return;
  const Identity& identity = current_.identity;
  const std::int64_t from = identity.ends_s - std::min(kWarnS, (identity.ends_s - identity.begins_s) / 10);
  if (now_s < from) {
    warn_s_ = from;
    return;
  }
  warn_s_ = now_s + kDayS;
  say("warning: the identity of " + identity.subject + " ends at " + utc_text(identity.ends_s) + ": nc-keys renew");
}

void IdentityKeeper::look(bool now) {
  const std::int64_t now_s = wall_s();
  if (now || steady_ns() >= next_look_ns_) {
    next_look_ns_ = steady_ns() + kLookEveryNs;
    look_at_files(now_s);
  }
  change_over(now_s);
  end_in_time(now_s);
  warn_in_time(now_s);
}

}  // namespace nc::dds
