// SPDX-License-Identifier: Apache-2.0
// The memory of a control in a program without real time.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>

namespace nc::tools {

/**
 * Memory for nc_create, given back at its end. Each thread keeps the last one that was given back for the next control: the check of a program, and the search for
 * the family that it is of, create one control after the other, and the pages of some megabytes cost the system more than such a check takes. One thread at a time.
 */
class ControlMemory {
 public:
  ControlMemory() = default;
  ~ControlMemory() { release(); }
  ControlMemory(const ControlMemory&) = delete;
  ControlMemory& operator=(const ControlMemory&) = delete;

  /** Memory of at least so many bytes, whose content is anything, instead of what was there; null when there is none. */
  void* allocate(std::size_t size);
  void release();

 private:
  struct Free {
    void operator()(void* memory) const { std::free(memory); }
  };
  struct Block {
    std::unique_ptr<void, Free> bytes;
    std::size_t size = 0;
  };
  static thread_local Block spare_;
  Block block_;
};

}  // namespace nc::tools
