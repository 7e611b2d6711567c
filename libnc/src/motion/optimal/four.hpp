// SPDX-License-Identifier: Apache-2.0
// Four numbers at once, by whatever the processor has for that.
#pragma once

#include <algorithm>
#include <cmath>

// Where the processor is known only at run time there are two of one function, with the same results: no product is added in one
// rounding (-ffp-contract=off). Not in builds whose instruments do not know such functions. What such a function calls is either inlined or says that it is
// beside it: an older instruction behind a wide one waits some 70 cycles, unless the upper halves of the registers are cleared in front of the call, and the
// compiler leaves that out where it knows all that the called function does.
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__) && !defined(__clang__) && !defined(__AVX2__)
#define NC_FOR_WIDE_VECTORS [[gnu::target_clones("avx2", "default")]]
#define NC_BESIDE_WIDE_VECTORS [[gnu::noipa]]
#else
#define NC_FOR_WIDE_VECTORS
#define NC_BESIDE_WIDE_VECTORS [[gnu::noinline]]
#endif

// Vectors are passed between functions that are inlined, so nobody asks how.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace nc::optimal {

using Four __attribute__((vector_size(32), aligned(16))) = double;

[[gnu::always_inline]] inline Four all(double x) {
  return Four{x, x, x, x};
}
/// The next four from there.
[[gnu::always_inline]] inline Four four_of(const double* from) {
  return Four{from[0], from[1], from[2], from[3]};
}
[[gnu::always_inline]] inline Four larger(const Four& a, const Four& b) {
  return a > b ? a : b;
}
[[gnu::always_inline]] inline Four size_of(const Four& a) {
  return larger(a, -a);
}
[[gnu::always_inline]] inline Four root_of(const Four& a) {
  return Four{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
}
[[gnu::always_inline]] inline double sum(const Four& a) {
  return (a[0] + a[1]) + (a[2] + a[3]);
}
/// Of the first two.
[[gnu::always_inline]] inline double sum2(const Four& a) {
  return a[0] + a[1];
}
[[gnu::always_inline]] inline double largest(const Four& a) {
  return std::max(std::max(a[0], a[1]), std::max(a[2], a[3]));
}

}  // namespace nc::optimal
