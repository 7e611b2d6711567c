// SPDX-License-Identifier: Apache-2.0
// See control_memory.hpp.
#include "tools/lib/control_memory.hpp"

#include <utility>

#include "runtime/programs/large_pages.hpp"

namespace nc::tools {

thread_local ControlMemory::Block ControlMemory::spare_;

void* ControlMemory::allocate(std::size_t size) {
  release();
  if (spare_.size >= size && spare_.bytes) {
    block_ = std::exchange(spare_, {});
    return block_.bytes.get();
  }
  spare_ = {};
  const std::size_t pages = (size + rt::kLargePage - 1) / rt::kLargePage * rt::kLargePage;
  block_.bytes.reset(std::aligned_alloc(rt::kLargePage, pages));
  block_.size = block_.bytes ? pages : 0;
  if (block_.bytes) rt::ask_for_large_pages(block_.bytes.get(), pages);  // nearly all of it is written when the control is created
  return block_.bytes.get();
}

void ControlMemory::release() {
  if (block_.size > spare_.size) spare_ = std::move(block_);
  block_ = {};
}

}  // namespace nc::tools
