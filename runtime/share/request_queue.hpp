// SPDX-License-Identifier: Apache-2.0
// Commands between the thread that takes them from the segment and the one that executes them, and their answers on the way back.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <vector>

#include "runtime/share/intake.hpp"
#include "runtime/share/layout.hpp"
#include "runtime/share/request_table.hpp"

namespace nc::rt::share {

// In the order in which they came. Bounded: whatever others have sent, there is room for what stops the machine, and for the end of a client.
class RequestQueue {
 public:
  static constexpr std::size_t kMost = 64, kMostWithStops = 2 * kMost;
  struct Waiting {
    Request request{};
    Arrival arrival{};
  };

  // False when there is no room.
  bool push(const Request& request, const Arrival& arrival) {
    const bool kept = request_row(request).stops() || is_from_gateway(request);
    {
      const std::lock_guard lock(mutex_);
      if (waiting_.size() >= (kept ? kMostWithStops : kMost)) return false;
      waiting_.push_back({request, arrival});
    }
    wake_.notify_one();
    return true;
  }
  bool pop(Waiting* next) {
    const std::lock_guard lock(mutex_);
    if (waiting_.empty()) return false;
    *next = waiting_.front();
    waiting_.pop_front();
    return true;
  }
  // Returns when there is one, or after this time.
  void wait(std::chrono::nanoseconds at_most) {
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, at_most, [this] { return !waiting_.empty(); });
  }
  void wake() { wake_.notify_all(); }

 private:
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Waiting> waiting_;
};

// Both threads answer, and the ring of the segment has one producer: whoever has the lock.
class AnswerQueue {
 public:
  static constexpr std::size_t kMostRefusals = 256;

  // Takes all of them out of *acks.
  void add(std::vector<Ack>* acks) {
    const std::lock_guard lock(mutex_);
    waiting_.insert(waiting_.end(), acks->begin(), acks->end());
    acks->clear();
  }
  // For a command that was not executed: when nobody reads the answers, it has none.
  void add_if_room(const Ack& ack) {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() < kMostRefusals) waiting_.push_back(ack);
  }
  std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return waiting_.size();
  }
  // Gives the ring as many as have room there. True when it has got one.
  template <class Ring>
  bool give(Ring* ring) {
    const std::lock_guard lock(mutex_);
    const std::size_t before = waiting_.size();
    while (!waiting_.empty() && ring->push(waiting_.front())) waiting_.pop_front();
    return waiting_.size() != before;
  }

 private:
  mutable std::mutex mutex_;
  std::deque<Ack> waiting_;
};

}  // namespace nc::rt::share
