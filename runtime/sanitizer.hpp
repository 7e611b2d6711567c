// SPDX-License-Identifier: Apache-2.0
// NC_UNDER_SANITIZER is defined when the address or the thread sanitizer is built in: they replace the allocator and need more stack. GCC tells it
// by macros, clang by __has_feature.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define NC_UNDER_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define NC_UNDER_SANITIZER 1
#endif
#endif
