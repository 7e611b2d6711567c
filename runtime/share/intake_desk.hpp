// SPDX-License-Identifier: Apache-2.0
// The intake for several ways: the ring of the segment and the socket of the services. Each way has its own thread, so the intake is behind a lock; no thread
// of the machine takes it. Control is one token for all ways.
#pragma once

#include <functional>
#include <mutex>
#include <utility>
#include <vector>

#include "runtime/share/intake.hpp"

namespace nc::rt::share {

class IntakeDesk {
 public:
  explicit IntakeDesk(Machine* machine) : intake_(machine) {}

  // Called in the thread of tick() with an answer for a local client that came later than its command. To be set before the threads start.
  void set_local(std::function<void(const Ack&)> local) { local_ = std::move(local); }

  void take(const Request& request, const Now& now, Way way, std::vector<Ack>* acks) {
    const std::lock_guard lock(mutex_);
    intake_.take(request, now, acks, way);
  }
  // As Intake::tick(). *acks gets the answers for the gateway.
  void tick(const Now& now, std::vector<Ack>* acks) {
    late_.clear();
    {
      const std::lock_guard lock(mutex_);
      intake_.tick(now, &late_);
    }
    for (const Ack& ack : late_) {
      if (static_cast<Way>(ack.way) == Way::kGateway) acks->push_back(ack);
      else if (local_) local_(ack);
    }
  }
  std::string controlling() const {
    const std::lock_guard lock(mutex_);
    return intake_.controlling();
  }

 private:
  mutable std::mutex mutex_;
  Intake intake_;
  std::vector<Ack> late_;  // of the thread of tick()
  std::function<void(const Ack&)> local_;
};

}  // namespace nc::rt::share
