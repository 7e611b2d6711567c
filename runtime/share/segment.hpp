// SPDX-License-Identifier: Apache-2.0
// The segment as sealed memory under a name, nc-<name>: made by ncrtd, which hands it to readers (door.hpp).
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <memory>
#include <string>

#include "runtime/share/door.hpp"
#include "runtime/share/layout.hpp"

namespace nc::rt::share {

// Name of a segment: "nc-sim-mill".
std::string segment_path(const std::string& name);

// Check sum of the parts that do not change: FNV-1a over identity and machine, 64 bits.
std::uint64_t check_sum(const Segment& segment);

// Start time of a process in clock ticks since boot, 0 = there is no such process. When a pid has another start time, it is that of
// another process.
std::uint64_t process_start(pid_t pid);

// ncrtd's side.
class SegmentOwner {
 public:
  SegmentOwner() = default;
  ~SegmentOwner() { remove(); }
  SegmentOwner(const SegmentOwner&) = delete;
  SegmentOwner& operator=(const SegmentOwner&) = delete;

  // Makes the segment and opens its door. A name that a living process has is refused. False with a sentence in
  // *error. `group`: readers of this process's group are admitted, too, otherwise only those of its user.
  bool create(const std::string& name, bool group, bool commands, const MachineBlock& machine, std::string* error);
  // Tells readers that this is the end and frees the name; readers that have the segment open keep the last values.
  void remove();

  Segment* get() { return segment_; }

 private:
  Segment* segment_ = nullptr;
  int memory_ = -1;
  Door door_;
};

// A reader's side.
class SegmentReader {
 public:
  SegmentReader() = default;
  ~SegmentReader() { close(); }
  SegmentReader(const SegmentReader&) = delete;
  SegmentReader& operator=(const SegmentReader&) = delete;

  // False with a sentence in *error when there is no such segment, or when it has the layout of another build.
  bool open(const std::string& name, std::string* error);
  void close();
  bool is_open() const { return segment_ != nullptr; }
  Segment* get() { return segment_; }
  const Segment* get() const { return segment_; }

  // Consistent copies whose counts and texts have been checked. False with a sentence in *error: the
  // writer died in the middle of writing, or another process has written here.
  bool status(StatusBlock* block, std::string* error) const;
  bool history(HistoryBlock* block, std::uint64_t* sequence, std::string* error) const;
  bool points(PointsBlock* block, std::string* error) const;
  bool signals(SignalsBlock* block, std::string* error) const;

  // True when the owner has told that this is the end, or its process is gone.
  bool owner_gone() const;
  // Takes the right to write commands. Only one process has it at a time, and it loses it when it ends.
  bool claim_commands(std::string* error);
  void release_commands();
  // The right of another reader of this process goes over to this one, without a moment in which nobody has it.
  void take_claim_of(SegmentReader* other);

 private:
  Segment* segment_ = nullptr;
  bool claimed_ = false;
};

// Detects a writer that has stopped: it is alive as long as its heartbeat changes.
class HeartbeatWatch {
 public:
  explicit HeartbeatWatch(std::int64_t limit_ns = 1'000'000'000) : limit_ns_(limit_ns) {}
  // `now_ns`: monotonic time. True while the last change of `beat` is younger than the limit.
  bool alive(std::uint64_t beat, std::int64_t now_ns) {
    if (!started_ || beat != beat_) {
      started_ = true;
      beat_ = beat;
      since_ns_ = now_ns;
    }
    return now_ns - since_ns_ < limit_ns_;
  }
  void restart() { started_ = false; }

 private:
  std::int64_t limit_ns_, since_ns_ = 0;
  std::uint64_t beat_ = 0;
  bool started_ = false;
};

// Counts up a futex word that processes share, and wakes those that wait for it.
void wake(std::atomic<std::uint32_t>* word);
// Returns when the word is no longer `seen`, after the timeout, or on a signal.
void wait_for_change(std::atomic<std::uint32_t>* word, std::uint32_t seen, std::int64_t timeout_ns);

}  // namespace nc::rt::share
