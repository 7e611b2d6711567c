// SPDX-License-Identifier: Apache-2.0
// NC_RT promises that the body of a scan does not allocate, lock or call the system. This test program replaces malloc,
// its relatives and pthread_mutex_lock, and lets the kernel refuse system calls (syscall user dispatch) while the flag
// is set that the scan sets in its body; then it runs whole programs.
#include <gtest/gtest.h>

#include "runtime/rt_scope.hpp"
#include "runtime/sanitizer.hpp"

#if defined(NC_UNDER_SANITIZER)

TEST(RtTrap, NeedsTheOrdinaryAllocator) {
  GTEST_SKIP() << "a sanitizer has replaced the allocator";
}

#else

#include <dlfcn.h>
#include <malloc.h>
#include <pthread.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <memory>
#include <mutex>
#include <sstream>

#include "hal/sim/sim_machine.hpp"
#include "places/places.hpp"
#include "program_generator.hpp"
#include "runtime/runtime.hpp"
#include "stepping.hpp"
#include "test_config.hpp"

#ifndef PR_SET_SYSCALL_USER_DISPATCH
#define PR_SET_SYSCALL_USER_DISPATCH 59
#define PR_SYS_DISPATCH_OFF 0
#define PR_SYS_DISPATCH_ON 1
#endif

namespace {

std::atomic<unsigned> g_allocations{0}, g_locks{0}, g_system_calls{0};
std::atomic<long> g_last_call{-1};

void count_allocation() {
  if (nc::rt::t_in_scan != 0) g_allocations.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace

extern "C" {
void* __libc_malloc(size_t);
void __libc_free(void*);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);

void* malloc(size_t size) {
  count_allocation();
  return __libc_malloc(size);
}
void free(void* memory) {
  count_allocation();
  __libc_free(memory);
}
void* calloc(size_t count, size_t size) {
  count_allocation();
  return __libc_calloc(count, size);
}
void* realloc(void* memory, size_t size) {
  count_allocation();
  return __libc_realloc(memory, size);
}
void* aligned_alloc(size_t alignment, size_t size) {
  count_allocation();
  return __libc_memalign(alignment, size);
}

int pthread_mutex_lock(pthread_mutex_t* mutex) {
  using Lock = int (*)(pthread_mutex_t*);
  static const Lock real = reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
  if (nc::rt::t_in_scan != 0) g_locks.fetch_add(1, std::memory_order_relaxed);
  return real(mutex);
}
}

namespace {

// The kernel sends SIGSYS instead of making the call, which is counted and refused. The flag is cleared, because the
// return from this handler is a system call, too.
void on_refused_call(int, siginfo_t* info, void* context) {
  nc::rt::t_in_scan = 0;
  g_last_call = info->si_syscall;
  g_system_calls.fetch_add(1, std::memory_order_relaxed);
#if defined(__x86_64__)
  static_cast<ucontext_t*>(context)->uc_mcontext.gregs[REG_RAX] = -ENOSYS;
#else
  (void)context;
#endif
}

// Lets the kernel refuse the system calls of the calling thread; false if the kernel cannot.
bool refuse_system_calls() {
  struct sigaction action {};
  action.sa_sigaction = on_refused_call;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGSYS, &action, nullptr);
  return prctl(PR_SET_SYSCALL_USER_DISPATCH, PR_SYS_DISPATCH_ON, 0, 0, &nc::rt::t_in_scan) == 0;
}
void allow_system_calls() {
  prctl(PR_SET_SYSCALL_USER_DISPATCH, PR_SYS_DISPATCH_OFF, 0, 0, 0);
}

void clear_counts() {
  g_allocations = g_locks = g_system_calls = 0;
}

TEST(RtTrap, TheTrapsWork) {
  clear_counts();
  std::mutex mutex;
  {
    const nc::rt::RtScope scope;
    void* volatile memory = std::malloc(10);
    std::free(memory);
    delete new int(3);
    const std::lock_guard lock(mutex);
  }
  EXPECT_GE(g_allocations.load(), 2u);  // the compiler may remove new and delete, but not the volatile pair
  EXPECT_EQ(g_locks.load(), 1u);
  if (!refuse_system_calls()) GTEST_SKIP() << "no syscall user dispatch in this kernel";
  {
    const nc::rt::RtScope scope;
    syscall(SYS_getppid);
  }
  allow_system_calls();
  EXPECT_EQ(g_system_calls.load(), 1u);
  EXPECT_EQ(g_last_call.load(), SYS_getppid);
}

std::string flange() {
  std::ifstream stream(nc::test::kSourceDir + "/examples/parts/flange.nc", std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

void run_to_end(const nc::rt::Config& config, const std::string& text) {
  nc::hal::SimMachine machine(config.sim, config.points);
  nc::rt::VirtualClock clock;
  std::vector<nc::rt::ConfigError> errors;
  const auto runtime = nc::rt::Runtime::create(config, {&clock, &machine, nullptr, nullptr}, &errors);
  ASSERT_NE(runtime, nullptr);
  unsigned file = 0;
  ASSERT_EQ(nc_program_add_text(runtime->control(), "main.nc", text.data(), text.size(), &file), NC_OK);
  std::string error;
  ASSERT_TRUE(runtime->start_stepping(&error));
  ASSERT_EQ(runtime->select_program(file), nc::rt::Answer::kDone);
  ASSERT_EQ(runtime->execute(nc::rt::CommandKind::kCycleStart), nc::rt::Answer::kDone);
  for (unsigned i = 0; i < 400000 && runtime->info().system[0].runs == 0; ++i) {
    if (i % 1000 == 300) runtime->execute(nc::rt::CommandKind::kFeedHold);
    if (i % 1000 == 500) runtime->execute(nc::rt::CommandKind::kFeedOverride, (i / 1000 % 20) * 0.1);
    const auto state = runtime->snapshot().system[0].nc.state;
    if (i % 100 == 0 && (state == NC_STATE_HOLD || state == NC_STATE_STOPPED))
      runtime->execute(nc::rt::CommandKind::kCycleStart);
    runtime->step();
  }
  EXPECT_EQ(runtime->info().system[0].runs, 1u);
  EXPECT_TRUE(runtime->info().system[0].ended_ok);
}

void expect_nothing_trapped() {
  EXPECT_EQ(g_allocations.load(), 0u);
  EXPECT_EQ(g_locks.load(), 0u);
  EXPECT_EQ(g_system_calls.load(), 0u) << "system call " << g_last_call.load();
}

TEST(RtTrap, AWholePartRunsWithoutAllocationLockOrSystemCall) {
  nc::rt::Config config;
  ASSERT_TRUE(nc::rt::load_config(nc::test::kSourceDir + "/etc/machine.toml", &config).empty());
  clear_counts();
  const bool refusing = refuse_system_calls();
  run_to_end(config, flange());
  if (refusing) allow_system_calls();
  expect_nothing_trapped();
}

TEST(RtTrap, SoDoRandomProgramsWithMacrosInputsAndSkips) {
  clear_counts();
  const bool refusing = refuse_system_calls();
  for (std::uint32_t seed = 500; seed < 510; ++seed) {
    nc::test::ProgramGenerator generator(seed);
    const nc::test::GeneratedProgram program = generator.make(12);
    std::string text = nc::test::base_toml() + "script = [";
    for (const std::string& statement : program.script) text += "\"" + statement + "\",";
    const nc::rt::Config config = nc::test::parse_or_fail(text + "]\n" + nc::test::probe_solid_toml() +
                                                          "[tool_offsets]\n1 = 2.5\n2 = 12.0\n");
    run_to_end(config, program.text);
  }
  if (refusing) allow_system_calls();
  expect_nothing_trapped();
}

// An alarm, a fault of the machine and a reset are scans like any other.
TEST(RtTrap, SoDoAlarmsAndReset) {
  nc::rt::Config config = nc::test::parse_or_fail(nc::test::base_toml());
  nc::hal::SimMachine machine(config.sim, config.points);
  nc::rt::VirtualClock clock;
  std::vector<nc::rt::ConfigError> errors;
  const auto runtime = nc::rt::Runtime::create(config, {&clock, &machine, nullptr, nullptr}, &errors);
  ASSERT_NE(runtime, nullptr);
  const std::string text = "G91\nG1 X50. F1000.\nG1 X50.\nG2 X1. I20.\nM30\n";
  unsigned file = 0;
  ASSERT_EQ(nc_program_add_text(runtime->control(), "a.nc", text.data(), text.size(), &file), NC_OK);
  std::string error;
  ASSERT_TRUE(runtime->start_stepping(&error));
  clear_counts();
  const bool refusing = refuse_system_calls();
  for (int round = 0; round < 3; ++round) {
    runtime->select_program(file);
    runtime->execute(nc::rt::CommandKind::kCycleStart);
    for (int i = 0; i < 3000; ++i) runtime->step();
    if (round == 1) machine.fail_drive(0, 0, true);
    if (round == 2) machine.fail_bus(true);
    for (int i = 0; i < 5000; ++i) runtime->step();
    machine.fail_drive(0, 0, false);
    machine.fail_bus(false);
    runtime->execute(nc::rt::CommandKind::kReset);
    for (int i = 0; i < 500; ++i) runtime->step();
  }
  if (refusing) allow_system_calls();
  expect_nothing_trapped();
}

// Homing, a limit switch with its way out, a brake.
TEST(RtTrap, SoDoHomingAndLimitSwitches) {
  nc::rt::Config config;
  ASSERT_TRUE(nc::rt::load_config(nc::test::kSourceDir + "/etc/homed_mill.toml", &config).empty());
  nc::test::SteppedMachine stepped(config);
  const auto& runtime = stepped.runtime;
  ASSERT_NE(runtime, nullptr);
  const auto steps = [&](int n) {
    while (n-- > 0) runtime->step();
  };
  const auto jog = [&](double velocity, int times) {
    nc::rt::Command command;
    command.kind = nc::rt::CommandKind::kJog;
    command.value = velocity;
    for (; times > 0; --times) {
      (void)runtime->execute(command);
      steps(100);
    }
    command.value = 0;
    (void)runtime->execute(command);
    steps(300);
  };
  clear_counts();
  const bool refusing = refuse_system_calls();
  steps(300);
  (void)runtime->execute(nc::rt::CommandKind::kSetMode, 0, static_cast<std::uint32_t>(nc::rt::Mode::kManual));
  nc::rt::Command home;
  home.kind = nc::rt::CommandKind::kHome;
  home.system = nc::rt::kAllSystems;
  (void)runtime->execute(home);
  steps(40000);
  const std::uint32_t homed = runtime->snapshot().system[0].axes.homed;
  stepped.machine.set_input(static_cast<unsigned>(config.points.find("x_max")), 0);  // until the machine sets it again
  steps(5);
  const bool stopped = runtime->snapshot().stopped_by_alarm();
  (void)runtime->execute(nc::rt::CommandKind::kReset);
  steps(300);
  jog(-20, 10);
  stepped.machine.fail_drive(0, 2, true);
  steps(500);
  if (refusing) allow_system_calls();
  EXPECT_EQ(homed, 7u);
  EXPECT_TRUE(stopped);
  EXPECT_LT(stepped.machine.place(0, 0), -5);
  expect_nothing_trapped();
}

// Another ladder program in each scan.
TEST(RtTrap, SoDoesTheSwapOfTheLadder) {
  nc::rt::Config config;
  ASSERT_TRUE(nc::rt::load_config(nc::test::kSourceDir + "/etc/machine.toml", &config).empty());
  nc::test::SteppedMachine stepped(config);
  const auto& runtime = stepped.runtime;
  ASSERT_NE(runtime, nullptr);
  const std::string texts[] = {"LDP nc.m_strobe\nINC D0\nLD M0\nOUT C1 K5\nEND\n", "LD SM400\nOUT spindle_forward\nLD M0\nOUT C1 K5\nLDP nc.m_strobe\nINC D0\nEND\n"};
  clear_counts();
  const bool refusing = refuse_system_calls();
  bool good = true;
  for (int i = 0; i < 200; ++i) {
    std::vector<nc::ladder::Error> wrong;
    auto next = runtime->ladder()->prepare_swap(texts[i % 2], "next.il", &wrong);
    good = good && next != nullptr && runtime->ladder()->swap(std::move(next), std::chrono::milliseconds(60000), [&] { runtime->step(); });
  }
  if (refusing) allow_system_calls();
  EXPECT_TRUE(good);
  expect_nothing_trapped();
}

// A recording of 64 signals in the scan, its ring that runs round, its trigger, its end.
TEST(RtTrap, SoDoesTheSignalTrace) {
  nc::rt::Config config;
  ASSERT_TRUE(nc::rt::load_config(nc::test::kSourceDir + "/etc/machine.toml", &config).empty());
  nc::test::SteppedMachine stepped(config);
  const auto& runtime = stepped.runtime;
  ASSERT_NE(runtime, nullptr);
  nc::rt::trace::Plan plan;
  std::vector<std::string> names = {"D0", "M0", "TN0", "T0", "C0", "CN0", "D10"};
  for (unsigned p = 0; p < config.points.size() && names.size() < 16; ++p) names.push_back(config.points.at(p).name);
  for (const nc::rt::Signal& signal : runtime->signals()->signals())
    if (names.size() < nc::rt::trace::kMostSignals) names.push_back(signal.name);
  for (const std::string& name : names) ASSERT_TRUE(runtime->trace()->find(name, &plan.sources.emplace_back())) << name;
  plan.when = nc::rt::trace::When::kRise;
  plan.level = 123;
  plan.rows = 200;
  plan.before = 50;
  clear_counts();
  const bool refusing = refuse_system_calls();
  ASSERT_TRUE(runtime->trace()->arm(plan));
  for (int i = 0; i < 1000; ++i) runtime->step();
  const bool waits = runtime->trace()->is_recording();
  (void)runtime->force("D0", 123);
  for (int i = 0; i < 1000; ++i) runtime->step();
  const bool ended = !runtime->trace()->is_recording();
  ASSERT_TRUE(runtime->trace()->arm(plan));
  for (int i = 0; i < 500; ++i) runtime->step();
  runtime->trace()->stop();
  for (int i = 0; i < 500; ++i) runtime->step();
  if (refusing) allow_system_calls();
  EXPECT_TRUE(waits);
  EXPECT_TRUE(ended);
  EXPECT_FALSE(runtime->trace()->is_recording());
  expect_nothing_trapped();
}

}  // namespace
#endif
