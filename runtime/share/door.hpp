// SPDX-License-Identifier: Apache-2.0
// How the segment gets from ncrtd to a reader. ncrtd sends the descriptor of memory that nobody can make
// shorter over a socket in the abstract name space, only to processes of its own user (or group).
//
// A file in /dev/shm has one disadvantage: a process that may open it for writing may also truncate it, and then the next access
// of every process that has mapped it is a bus error. Memory with F_SEAL_SHRINK cannot be truncated by anyone. The
// name in the abstract name space is free again when its owner has ended, in whatever way.
#pragma once

#include <cstddef>
#include <string>

#include "runtime/rt_thread.hpp"

namespace nc::rt::share {

// Makes anonymous memory of this size, all zeros, that can neither shrink nor grow. Returns its descriptor, or -1 with a
// sentence in *error.
int make_sealed_memory(const std::string& name, std::size_t size, std::string* error);

// The owner's side: gives every permitted reader the descriptor, in a thread of its own.
class Door {
 public:
  Door() = default;
  ~Door() { close(); }
  Door(const Door&) = delete;
  Door& operator=(const Door&) = delete;

  // False with a sentence in *error; *in_use says that another process has the name. `memory` still belongs to the
  // caller. `group`: also processes of the same group are admitted, otherwise only those of the same user and of root.
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
// The reader's side: fetches the descriptor of the segment, if it is sealed and comes from a trusted owner. Otherwise there is a sentence in
// *error; kNobody: there is no such control.
Knock fetch_memory(const std::string& name, int* memory, std::string* error);

}  // namespace nc::rt::share
