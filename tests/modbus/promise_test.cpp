// SPDX-License-Identifier: Apache-2.0
// The scan's side of a link promises NC_RT: no allocation, no lock, no system call, whatever the partner does. While the
// flag of the scan is set, malloc and pthread_mutex_lock are counted, and the kernel refuses system calls (syscall user
// dispatch).
#include "modbus/link_rig.hpp"
#include "runtime/rt_scope.hpp"
#include "runtime/sanitizer.hpp"

#if defined(NC_UNDER_SANITIZER)

TEST(ModbusPromise, NeedsTheOrdinaryAllocator) {
  GTEST_SKIP() << "a sanitizer has replaced the allocator";
}

#else

#include <dlfcn.h>
#include <pthread.h>
#include <signal.h>
#include <sys/prctl.h>
#include <ucontext.h>

#include <atomic>
#include <cerrno>

#ifndef PR_SET_SYSCALL_USER_DISPATCH
#define PR_SET_SYSCALL_USER_DISPATCH 59
#define PR_SYS_DISPATCH_OFF 0
#define PR_SYS_DISPATCH_ON 1
#endif

namespace {

std::atomic<unsigned> g_allocations{0}, g_locks{0}, g_system_calls{0};

void count_allocation() {
  if (nc::rt::t_in_scan != 0) g_allocations.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace

extern "C" {
void* __libc_malloc(size_t);
void __libc_free(void*);

void* malloc(size_t size) {
  count_allocation();
  return __libc_malloc(size);
}
void free(void* memory) {
  count_allocation();
  __libc_free(memory);
}
int pthread_mutex_lock(pthread_mutex_t* mutex) {
  using Lock = int (*)(pthread_mutex_t*);
  static const Lock real = reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
  if (nc::rt::t_in_scan != 0) g_locks.fetch_add(1, std::memory_order_relaxed);
  return real(mutex);
}
}

namespace {

using namespace nc::test;

// The call is counted and refused. The flag is cleared, because the return from this handler is a system call, too.
void on_refused_call(int, siginfo_t*, void* context) {
  nc::rt::t_in_scan = 0;
  g_system_calls.fetch_add(1, std::memory_order_relaxed);
#if defined(__x86_64__)
  static_cast<ucontext_t*>(context)->uc_mcontext.gregs[REG_RAX] = -ENOSYS;
#else
  (void)context;
#endif
}

TEST(ModbusPromise, ReadAndWriteNeitherAllocateNorLockNorCall) {
  LoopbackServer server;
  server.with([](auto& units) {
    for (unsigned i = 0; i < 64; ++i) units[1].holding[i] = 5;
  });
  LinkRig rig;
  rig.short_timeouts();
  unsigned in = 0, out = 0;
  for (unsigned i = 0; i < 32; ++i) in = rig.add(Table::kHolding, i, Format::kU16);
  for (unsigned i = 32; i < 64; ++i) out = rig.add(Table::kHolding, i, Format::kU16, true);
  rig.start(server.port());
  ASSERT_TRUE(rig.until([&] { return rig.good(in); }));

  struct sigaction action {};
  action.sa_sigaction = on_refused_call;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGSYS, &action, nullptr);
  const bool refused = prctl(PR_SET_SYSCALL_USER_DISPATCH, PR_SYS_DISPATCH_ON, 0, 0, &nc::rt::t_in_scan) == 0;
  g_allocations = g_locks = g_system_calls = 0;
  const auto scans = [&] {
    for (unsigned i = 0; i < 300; ++i) {
      {
        const nc::rt::RtScope scope;
        rig.image.value[out] = i;
        rig.scan();
      }
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
  };
  scans();
  const bool was_good = rig.good(in);
  server.set_fault([](const Bytes&, Answer right) {
    right.bytes.clear();
    return right;
  });
  const bool lost = rig.until([&] { return !rig.good(in); });
  scans();
  server.stop();
  scans();
  if (refused) prctl(PR_SET_SYSCALL_USER_DISPATCH, PR_SYS_DISPATCH_OFF, 0, 0, 0);
  EXPECT_TRUE(was_good && lost);
  EXPECT_EQ(g_allocations, 0u);
  EXPECT_EQ(g_locks, 0u);
  EXPECT_EQ(g_system_calls, 0u);
  if (!refused) GTEST_SKIP() << "no syscall user dispatch in this kernel: system calls were not counted";
}

}  // namespace

#endif
