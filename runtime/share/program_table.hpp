// SPDX-License-Identifier: Apache-2.0
// For each entry of the program store the name of its file and the text that runs, for displays. Any thread.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "nc/types.h"
#include "runtime/programs/program_text.hpp"

namespace nc::rt::share {

class ProgramTable {
 public:
  // `dialect` says which code ends a program.
  explicit ProgramTable(nc_dialect dialect) : dialect_(dialect) {}
  using Text = std::shared_ptr<ProgramText>;
  struct Program {
    std::string path;
    std::uint64_t lines = 0;          // up to its end code, 0 = not known
    std::weak_ptr<ProgramText> text;  // empty once the store has dropped the program
    bool dropped = false;             // the store has given its place up: what has it now is no file of this name
  };

  // Also counts the lines, which takes time.
  void add(unsigned file, const std::string& path, const Text& text);
  // Adds the program without counting its lines.
  void add_name(unsigned file, const std::string& path, const Text& text) {
    const std::lock_guard lock(mutex_);
    Program& program = programs_[file];
    if (program.path != path || program.dropped || program.text.lock() != text) program = {path, 0, text};
  }
  // The store has dropped the program. Its name stays for those who show what has been.
  void drop(unsigned file) {
    const std::lock_guard lock(mutex_);
    const auto found = programs_.find(file);
    if (found != programs_.end()) found->second.dropped = true;
  }
  Program at(unsigned file) const {
    const std::lock_guard lock(mutex_);
    const auto found = programs_.find(file);
    return found == programs_.end() ? Program{} : found->second;
  }
  // The MDI blocks that were loaded last in a part system.
  void set_mdi(unsigned system, const std::string& blocks) {
    const std::lock_guard lock(mutex_);
    mdi_[system] = blocks;
  }
  std::string mdi(unsigned system) const {
    const std::lock_guard lock(mutex_);
    return mdi_[system];
  }

 private:
  const nc_dialect dialect_;
  mutable std::mutex mutex_;
  std::map<unsigned, Program> programs_;
  std::string mdi_[NC_MAX_SYSTEMS];
};

std::string file_name(const std::string& path);

}  // namespace nc::rt::share
