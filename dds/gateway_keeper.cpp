// SPDX-License-Identifier: Apache-2.0
// See gateway_keeper.hpp.
#include "dds/gateway_keeper.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "dds/service_state.hpp"
#include "runtime/clock.hpp"
#include "runtime/share/text.hpp"

namespace nc::dds {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kSettleNs = 500 * kMs;       // the partners of a gateway have not changed for so long: they have found it
constexpr std::int64_t kPatienceNs = 10'000 * kMs;  // a partner that has not found the new gateway by then is not waited for
constexpr std::int64_t kEarlyS = 2;                 // a gateway ends so long before its certificate, and takes none that ends sooner
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

GatewayKeeper::Running::~Running() {
  gateway->stop();
  if (thread.joinable()) thread.join();
}

GatewayKeeper::~GatewayKeeper() {
  next_.reset();
  current_.reset();
}

void GatewayKeeper::say(const std::string& text) {
  tell_state(text);
  if (text == said_) return;
  said_ = text;
  std::fprintf(stderr, "ncdds: %s\n", text.c_str());
}

void GatewayKeeper::fault(const std::string& text) {
  say(text + (current_ ? "; goes on with the identity that it has, until " + utc_text(current_->identity.ends_s)
                       : "; publishes nothing until " + options_.access.security + " has a valid one (nc-keys renew)"));
}

bool GatewayKeeper::open(std::string* error) {
  Identity identity;
  SecurityPlugins plugins;
  if (!find_plugins(&plugins, error)) return false;
  stamp_ = stamp_of(options_.access.security);
  if (!read_identity(options_.access.security, &identity, error)) return false;
  const std::int64_t now_s = wall_s();
  if (validity_of(identity, now_s) != Validity::kValid) {
    use(identity);
    return true;
  }
  current_ = begin(identity, false, error);
  return current_ != nullptr;
}

std::unique_ptr<GatewayKeeper::Running> GatewayKeeper::begin(const Identity& identity, bool stands_by, std::string* error) {
  auto running = std::make_unique<Running>();
  running->identity = identity;
  running->gateway = std::make_unique<Gateway>(options_);
  if (stands_by) running->gateway->stand_by();
  if (!running->gateway->open(error)) return nullptr;
  running->thread = std::thread([gateway = running->gateway.get()] { gateway->run(); });
  const std::string text = "the identity of " + identity.subject + " is valid until " + utc_text(identity.ends_s);
  tell_state(text);
  std::fprintf(stderr, "ncdds: %s\n", text.c_str());
  said_.clear();
  return running;
}

// Takes an identity whose files are in order, if this is its time.
void GatewayKeeper::use(const Identity& identity) {
  const std::int64_t now_s = wall_s();
  const std::string whose = "the identity of " + identity.subject + " (" + identity.folder + ") ";
  switch (validity_of(identity, now_s + kEarlyS)) {
    case Validity::kNotYet:
      retry_s_ = std::min(identity.begins_s, now_s + kRetryS);
      return fault(whose + "begins at " + utc_text(identity.begins_s));
    case Validity::kEnded: return fault(whose + "has expired at " + utc_text(identity.ends_s));
    case Validity::kValid: break;
  }
  std::string error;
  std::unique_ptr<Running> begun = begin(identity, current_ != nullptr, &error);
  if (!begun) {
    retry_s_ = now_s + kRetryS;
    return fault(error);
  }
  if (!current_) {
    warn_s_ = 0;
    current_ = std::move(begun);
    return;
  }
  next_ = std::move(begun);
  next_since_ns_ = settled_since_ns_ = steady_ns();
}

void GatewayKeeper::look_at_files(std::int64_t now_s) {
  const std::string stamp = stamp_of(options_.access.security);
  const bool again = retry_s_ != 0 && now_s >= retry_s_;
  if (stamp == stamp_ && !again) return;
  stamp_ = stamp;
  retry_s_ = 0;
  next_.reset();  // it has files that are old already
  Identity identity;
  std::string error;
  if (read_identity(options_.access.security, &identity, &error)) use(identity);
  else fault(error);
}

// Lets the next gateway take over as soon as everybody who talks with the current one talks with it, or the time is over.
void GatewayKeeper::change_over(std::int64_t now_s) {
  if (!next_ || !current_) return;  // end_in_time() comes after this, so there is a current one as long as there is a next one
  const std::int64_t now_ns = steady_ns();
  const bool all = next_->gateway->partners() >= current_->gateway->partners();
  if (!all) settled_since_ns_ = now_ns;
  const bool late = now_ns - next_since_ns_ >= kPatienceNs || now_s + kEarlyS >= current_->identity.ends_s;
  if (now_ns - settled_since_ns_ < kSettleNs && !late) return;
  next_->gateway->take_over(current_->gateway.get());
  current_ = std::move(next_);
  warn_s_ = 0;
  std::fprintf(stderr, "ncdds: the new identity is in use\n");
}

void GatewayKeeper::end_in_time(std::int64_t now_s) {
  if (!current_ || validity_of(current_->identity, now_s + kEarlyS) == Validity::kValid) return;
  const Identity identity = current_->identity;
  current_.reset();
  use(identity);
}

// A line each day, from 14 days before the end on, or from the last tenth of the time where that is shorter.
void GatewayKeeper::warn_in_time(std::int64_t now_s) {
  if (!current_ || now_s < warn_s_) return;
  const Identity& identity = current_->identity;
  const std::int64_t from = identity.ends_s - std::min(kWarnS, (identity.ends_s - identity.begins_s) / 10);
  if (now_s < from) {
    warn_s_ = from;
    return;
  }
  warn_s_ = now_s + kDayS;
  say("warning: the identity of " + identity.subject + " ends at " + utc_text(identity.ends_s) + ": nc-keys renew");
}

void GatewayKeeper::run() {
  std::int64_t next_look_ns = 0;
  while (!stop_) {
    const std::int64_t now_s = wall_s();
    if (look_now_.exchange(false) || steady_ns() >= next_look_ns) {
      next_look_ns = steady_ns() + 500 * kMs;
      look_at_files(now_s);
    }
    change_over(now_s);
    end_in_time(now_s);
    warn_in_time(now_s);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

}  // namespace nc::dds
