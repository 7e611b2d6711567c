// SPDX-License-Identifier: Apache-2.0
// Large pages for memory of some megabytes that is written at once.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>

namespace nc::rt {

inline constexpr std::size_t kLargePage = std::size_t{2} << 20;

// Asks the system for large pages in memory that has not been written yet. Small ones come one by one when they are first written: for a short check of a program
// that is a fifth of its time. Where the system has no large pages, or the memory has room for none, all goes on as without this call.
inline void ask_for_large_pages(void* memory, std::size_t size) {
  const auto address = reinterpret_cast<std::uintptr_t>(memory);
  const std::size_t before = (kLargePage - address % kLargePage) % kLargePage;
  if (before >= size) return;
  const std::size_t whole = (size - before) / kLargePage * kLargePage;
  if (whole != 0) (void)madvise(static_cast<char*>(memory) + before, whole, MADV_HUGEPAGE);
}

}  // namespace nc::rt
