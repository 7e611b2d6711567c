// SPDX-License-Identifier: Apache-2.0
// The intake for several ways: the ring of the segment and the socket of the services. Each way has its own thread, so the intake is behind a lock; no thread
// of the machine takes it. Control is one token for all ways.
#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "runtime/share/intake.hpp"

namespace nc::rt::share {

class IntakeDesk {
 public:
  explicit IntakeDesk(Machine* machine) : intake_(machine) {}

  // Called in the thread of tick() with an answer for a local client that came later than its command. To be set before the threads start.
  void set_local(std::function<void(const Ack&)> local) { local_ = std::move(local); }

  // Called with each answer: with the request in the thread of take(), or with null in that of tick(). To be set before the threads start.
  void set_witness(std::function<void(const Request*, const Ack&)> witness) { witness_ = std::move(witness); }

  // As Intake::arrived(), whatever another thread waits for here. Any thread.
  Arrival arrived(const Request& request, const Now& now) { return intake_.arrived(request, now); }

  // `arrival`: what arrived() has said of this request, when that was asked; a command of another way may take its time before it, as a selection does.
  void take(const Request& request, const Now& now, Way way, std::vector<Ack>* acks, const Arrival& arrival) {
    const std::size_t before = acks->size();
    {
      const std::lock_guard lock(mutex_);
      intake_.take(request, now, acks, way, arrival);
      show();
    }
    if (witness_)
      for (std::size_t i = before; i < acks->size(); ++i) witness_(&request, (*acks)[i]);
  }
  void take(const Request& request, const Now& now, Way way, std::vector<Ack>* acks) { take(request, now, way, acks, arrived(request, now)); }
  // As Intake::tick(). *acks gets the answers for the gateway.
  void tick(const Now& now, std::vector<Ack>* acks) {
    late_.clear();
    {
      const std::lock_guard lock(mutex_);
      intake_.tick(now, &late_);
      show();
    }
    for (const Ack& ack : late_) {
      if (witness_) witness_(nullptr, ack);
      if (static_cast<Way>(ack.way) == Way::kGateway) acks->push_back(ack);
      else if (local_) local_(ack);
    }
  }
  // The client that has control, "" = nobody. It does not wait for a command that takes long.
  std::string controlling() const {
    const std::lock_guard lock(shown_mutex_);
    return shown_;
  }

 private:
  void show() {
    std::string now = intake_.controlling();
    const std::lock_guard lock(shown_mutex_);
    shown_ = std::move(now);
  }

  std::mutex mutex_;
  mutable std::mutex shown_mutex_;
  std::string shown_;  // guarded by shown_mutex_
  Intake intake_;
  std::vector<Ack> late_;  // of the thread of tick()
  std::function<void(const Ack&)> local_;
  std::function<void(const Request*, const Ack&)> witness_;
};

}  // namespace nc::rt::share
