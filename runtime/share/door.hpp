// SPDX-License-Identifier: Apache-2.0
// How the segment gets from ncrtd to a reader: ncrtd hands out the descriptor of memory that nobody can make
// shorter, over a socket in the abstract name space, to processes of its own user (or group) alone.
//
// A file in /dev/shm would do but for one thing: whoever may open it may also truncate it, and the next access
// of everyone who has mapped it is a bus error. Memory with F_SEAL_SHRINK cannot be truncated by anyone. The
// name in the abstract name space is free again when its owner is gone, however it went.
#pragma once

#include <cstddef>
#include <string>

#include "runtime/rt_thread.hpp"

namespace nc::rt::share {

// Anonymous memory of this size, all zeros, that can neither shrink nor grow. A descriptor, or -1 with a
// sentence in *error.
int make_sealed_memory(const std::string& name, std::size_t size, std::string* error);

// Owner: answers every reader with the descriptor, in a thread of its own.
class Door {
 public:
  Door() = default;
  ~Door() { close(); }
  Door(const Door&) = delete;
  Door& operator=(const Door&) = delete;

  // False with a sentence in *error; *in_use says that another process has the name. `memory` stays the
  // caller's. `group`: processes of this one's group too, else of its user only (root may, as everywhere).
  bool open(const std::string& name, int memory, bool group, bool* in_use, std::string* error);
  void close();

 private:
  void serve();
  bool may_enter(int client) const;

  int socket_ = -1, stop_ = -1, memory_ = -1;
  bool group_ = false;
  RtThread thread_;
};

enum class Knock { kGiven, kNobody, kRefused };
// Reader: the descriptor of the segment, sealed and of an owner that may be believed. A sentence in *error
// otherwise; kNobody: there is no such control.
Knock fetch_memory(const std::string& name, int* memory, std::string* error);

}  // namespace nc::rt::share
