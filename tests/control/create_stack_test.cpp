// SPDX-License-Identifier: Apache-2.0
// What nc_memory_required and nc_create use of the caller's stack: a task of a small controller has no more than docs/embedding.md says.
#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/mman.h>

#include <cstring>

#include "support/pull.hpp"

namespace nc::test {
namespace {

constexpr size_t kStack = size_t{1} << 20;
constexpr unsigned char kUnused = 0xA7;

/// Bytes of a thread's stack that `work` has used, counted by what it has left untouched.
size_t stack_used(const std::function<void()>& work) {
  void* const stack = mmap(nullptr, kStack, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (stack == MAP_FAILED) return 0;
  std::memset(stack, kUnused, kStack);
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstack(&attributes, stack, kStack);
  pthread_t thread;
  const auto run = [](void* of) -> void* {
    (*static_cast<const std::function<void()>*>(of))();
    return nullptr;
  };
  if (pthread_create(&thread, &attributes, run, const_cast<std::function<void()>*>(&work)) != 0) return 0;
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  size_t untouched = 0;
  while (untouched < kStack && static_cast<unsigned char*>(stack)[untouched] == kUnused) ++untouched;
  munmap(stack, kStack);
  return kStack - untouched;
}

TEST(CreateStack, IsNoMoreThanTheDocumentsSay) {
#if defined(NC_UNDER_SANITIZER) || !defined(NDEBUG)
  GTEST_SKIP() << "the frames of this build are larger than those of a product";
#endif
  for (const uint8_t dialect : {NC_DIALECT_M700, NC_DIALECT_HX, NC_DIALECT_DGSHAPE, NC_DIALECT_SERIES8})
    for (const uint8_t mode : {NC_MOTION_TRAPEZOID, NC_MOTION_OPTIMAL}) {
      SCOPED_TRACE(testing::Message() << "dialect " << int{dialect} << " mode " << int{mode});
      nc_config config;
      nc_config_init(&config);
      config.dialect = dialect;
      config.motion_mode = mode;
      for (nc_axis_config& axis : config.system[0].axis) {
        axis.max_velocity = 250;
        axis.max_acceleration = 2000;
        axis.max_jerk = 50000;
      }
      nc_config_fault fault{};
      ASSERT_EQ(nc_config_check(&config, &fault), NC_OK) << fault.field << " " << fault.reason;
      bool made = false;
      const size_t used = stack_used([&] {
        const size_t size = nc_memory_required(&config);
        void* memory = nullptr;
        if (posix_memalign(&memory, 64, size) != 0) return;
        made = nc_create(&config, memory, size, nullptr) != nullptr;
        std::free(memory);
      });
      EXPECT_TRUE(made);
      EXPECT_GT(used, 0u);
      EXPECT_LE(used, 64u * 1024);
      std::printf("%zu bytes\n", used);
    }
}

}  // namespace
}  // namespace nc::test
