// SPDX-License-Identifier: Apache-2.0
// The folder of programs as a service: list, read, write, rename, delete, protect.
//
// A program is written beside the others under a hidden name, compared with its size and hash, brought to the disk and then renamed, so nobody ever sees a half
// of one. What runs is a copy, or, when it is larger than ProgramText::Options::copy_bytes, is read from its file; so while a program is in execution, the
// selected ones and those that are that large are not changed. Names are checked (is_program_name()), links are not followed.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "runtime/services/call.hpp"
#include "runtime/services/sha256.hpp"

namespace nc::rt::services {

struct StoreLimits {
  std::uint64_t program_bytes = 0, total_bytes = 0;  // of one program, of all together
  std::uint64_t copy_bytes = 0;                      // a larger program runs from its file
  std::chrono::milliseconds silence{60'000};         // an upload that nobody has gone on with for so long makes room for another one
};

// To be used by one thread.
class ProgramStore {
 public:
  // What the machine does with programs.
  struct Use {
    std::vector<std::string> selected;  // names
    std::vector<std::string> called;    // names of what those call, as their check has found
    bool active = false;                // a program is in execution or interrupted
    bool known = true;                  // false: the control has not said what its parameters protect
    std::vector<std::string> locked;    // those of the names asked about that parameters of the control protect
  };
  using Names = std::vector<std::string>;

  // `use`: says so of these names, whether or not there are such programs.
  ProgramStore(std::string folder, const StoreLimits& limits, std::function<Use(const Names&)> use) : folder_(std::move(folder)), limits_(limits), use_(std::move(use)) {}
  ~ProgramStore();
  ProgramStore(const ProgramStore&) = delete;
  ProgramStore& operator=(const ProgramStore&) = delete;

  // Removes what an earlier process has begun to write and not finished.
  void clean();

  Outcome list(const Call& call) const;
  Outcome read(const Call& call) const;
  // `session`: number of the connection; an upload belongs to it.
  Outcome begin(std::uint64_t session, const Call& call);
  Outcome data(std::uint64_t session, const Call& call);
  Outcome finish(std::uint64_t session, const Call& call, std::string* name);
  Outcome abandon(std::uint64_t session, const Call& call);
  void abandon_all(std::uint64_t session);
  Outcome rename(const Call& call);
  Outcome remove(const Call& call);
  Outcome protect(const Call& call);

  static constexpr unsigned kUploads = 4;  // at the same time

 private:
  struct Upload {
    std::uint64_t session = 0;
    int file = -1;
    std::string name, hidden, hash;
    std::uint64_t size = 0, written = 0;
    bool replace = false;
    std::chrono::steady_clock::time_point last;  // it was begun, or its newest piece came
    Sha256 sum;
  };
  int open_folder() const;
  bool may_change(int folder, const std::string& name, Outcome* outcome) const;
  bool may_name(const std::string& name, Outcome* outcome) const;
  bool may_appear(const std::string& name, Outcome* outcome) const;
  Upload* find(std::uint64_t session, const Call& call);
  void drop(std::uint32_t number);
  void drop_silent();
  std::uint64_t used_bytes(int folder) const;

  const std::string folder_;
  const StoreLimits limits_;
  const std::function<Use(const Names&)> use_;
  std::map<std::uint32_t, Upload> uploads_;
  std::uint32_t next_ = 1;
};

}  // namespace nc::rt::services
