// SPDX-License-Identifier: Apache-2.0
// Execution time of a scan with three axes, 64 points on a Modbus link and a ladder program: inputs, ladder, NC, outputs,
// snapshot; the axes are simulated. The link has its thread and its buffered images, and a server in this process that
// answers every request, so that the images change hands as they do on a machine. The scan runs with the priority that
// ncrtd gives it, so that a helper thread that wakes up on its processor does not stand in front of it. The distribution
// comes from the runtime's own histogram (p50, p99, p99.9, max); wake-up jitter is another figure, see runtime_process.py.
// Goal: at most 50 us at p99.9.
//
// The disturbances of the computer are measured in the same run: half a period after each scan runs a loop of sums that
// takes about as long and touches no memory (loop_...). Interrupts, and time that the computer gives to other programs, are
// in both figures. What the scan needs beyond that is its own, with caches that other programs have used meanwhile.
#include <benchmark/benchmark.h>

#include <modbus/modbus.h>
#include <netinet/in.h>
#include <poll.h>
#include <pthread.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include "hal/modbus/link.hpp"
#include "runtime/hal_factory.hpp"
#include "runtime/runtime.hpp"

namespace {

// A Modbus server that answers the link's requests with bits and registers that count up. One connection, one thread.
class Server {
 public:
  Server() {
    context_ = modbus_new_tcp("127.0.0.1", 0);
    mapping_ = modbus_mapping_new(256, 256, 256, 256);
    if (context_ == nullptr || mapping_ == nullptr) return;
    listener_ = modbus_tcp_listen(context_, 1);
    sockaddr_in address{};
    socklen_t size = sizeof address;
    if (listener_ < 0 || getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0) return;
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  ~Server() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
    if (listener_ >= 0) close(listener_);
    modbus_mapping_free(mapping_);
    modbus_free(context_);
  }
  unsigned port() const { return port_; }

 private:
  void serve() {
    pollfd wait{listener_, POLLIN, 0};
    while (!stop_ && poll(&wait, 1, 100) <= 0) continue;
    if (stop_ || modbus_tcp_accept(context_, &listener_) < 0) return;
    std::uint8_t query[MODBUS_TCP_MAX_ADU_LENGTH];
    modbus_set_indication_timeout(context_, 0, 100000);
    for (unsigned n = 0; !stop_; ++n) {
      const int length = modbus_receive(context_, query);
      if (length < 0 && errno != ETIMEDOUT) break;
      if (length <= 0) continue;
      mapping_->tab_input_bits[n % 32] ^= 1;
      if (modbus_reply(context_, query, length, mapping_) < 0) break;
    }
    modbus_close(context_);
  }
  modbus_t* context_ = nullptr;
  modbus_mapping_t* mapping_ = nullptr;
  int listener_ = -1;
  unsigned port_ = 0;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

// Half of the points are inputs. Of each half 16 are bits of a table of bits, 12 are bits of one register, 4 are scaled words.
constexpr unsigned kHalf = 32, kBits = 16, kWords = 4;

constexpr long kPeriodNs = 1'000'000, kSecondNs = 1'000'000'000;
constexpr unsigned kWarmUp = 500;  // scans whose median is the duration that the loop of sums gets

std::int64_t now_ns() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return t.tv_sec * kSecondNs + t.tv_nsec;
}

// A loop of sums that takes the same time on every pass if the computer does not disturb it.
class EmptyLoop {
 public:
  // A pass is to take `ns`; the fastest of 50 trial passes tells how long one turn takes.
  explicit EmptyLoop(std::uint64_t ns) {
    std::int64_t fastest = kSecondNs;
    for (int i = 0; i < 50; ++i) fastest = std::min(fastest, pass(kProbe));
    turns_ = std::max<std::uint64_t>(1, ns * kProbe / static_cast<std::uint64_t>(std::max<std::int64_t>(1, fastest)));
  }
  void measure() { times_.record(pass(turns_)); }
  const nc::rt::Histogram& times() const { return times_; }

 private:
  static constexpr std::uint64_t kProbe = 10000;
  static std::int64_t pass(std::uint64_t turns) {
    const std::int64_t began = now_ns();
    std::uint64_t sum = 1;
    for (std::uint64_t i = 0; i < turns; ++i) {
      sum = sum * 5 + i;
      benchmark::DoNotOptimize(sum);
    }
    return now_ns() - began;
  }
  std::uint64_t turns_ = 1;
  nc::rt::Histogram times_;
};

// Sleeps to the next half period; does nothing when it is not paced.
class Pacer {
 public:
  explicit Pacer(bool paced) : paced_(paced) { clock_gettime(CLOCK_MONOTONIC, &next_); }
  void wait() {
    if (!paced_) return;
    next_.tv_nsec += kPeriodNs / 2;
    if (next_.tv_nsec >= kSecondNs) {
      next_.tv_nsec -= kSecondNs;
      ++next_.tv_sec;
    }
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next_, nullptr);
  }

 private:
  const bool paced_;
  timespec next_{};
};

// Figures of a histogram as counters, for example scan_p50_us.
void show(benchmark::State& state, const std::string& name, const nc::rt::Histogram& times) {
  const auto us = [](std::uint64_t ns) { return static_cast<double>(ns) / 1e3; };
  state.counters[name + "_p50_us"] = us(times.percentile_ns(0.5));
  state.counters[name + "_p99_us"] = us(times.percentile_ns(0.99));
  state.counters[name + "_p99.9_us"] = us(times.percentile_ns(0.999));
  state.counters[name + "_max_us"] = us(times.max_ns());
}

std::string modbus_place(unsigned point, bool input) {
  const unsigned n = point % kHalf;
  const std::string link = "modbus = { link = \"io\", table = \"";
  if (n < kBits) return link + (input ? "discrete" : "coil") + "\", address = " + std::to_string(n) + " }\n";
  const std::string registers = link + (input ? "input" : "holding");
  if (n < kHalf - kWords)
    return registers + "\", address = 0, bit = " + std::to_string(n - kBits) + " }\n";
  return registers + "\", address = " + std::to_string(10 + 2 * n) + ", words = \"CDAB\", scale = 0.5 }\n";
}

std::string configuration(unsigned points, unsigned port) {
  std::string text = "[machine]\n";
  for (const char* name : {"X", "Y", "Z"})
    text += std::string("[[axis]]\nname = \"") + name +
            "\"\nmax_velocity = 500.0\nmax_acceleration = 5000.0\nmax_jerk = 100000.0\nsoft_limits = "
            "[-1000.0, 1000.0]\n";
  text += "[[modbus]]\nname = \"io\"\nhost = \"127.0.0.1\"\nport = " + std::to_string(port) + "\npoll_ms = 5\n";
  std::string map = "[macro_interface]\n";
  for (unsigned p = 0; p < points; ++p) {
    const bool input = p < points / 2;
    const std::string name = (input ? "in" : "out") + std::to_string(p);
    const bool word = p % kHalf >= kHalf - kWords;
    text += "[[point]]\nname = \"" + name + "\"\ndirection = \"" + (input ? "input" : "output") + "\"\n" +
            (word ? "type = \"word\"\n" : "") + modbus_place(p, input);
    if (!word) map += "\"#" + std::to_string((input ? 1000 : 1100) + p % (points / 2)) + "\" = \"" + name + "\"\n";
  }
  return text + map;
}

// An endless loop with lines, arcs, an output and the reading of an input.
constexpr char kProgram[] =
    "G90 G17 G64 F6000.\n"
    "N1 G1 X50. Y10. Z-5.\n"
    "G3 X50. Y50. J20.\n"
    "#1132=#1132+1\n"
    "G2 X0. Y0. R60. Z0.\n"
    "G0 X-20. Y-20.\n"
    "#100=#1032\n"
    "X0. Y0.\n"
    "GOTO 1\n";

// A ladder program of about so many instructions over the points and the NC's signals: contacts, coils, timers, compares
// and moves as in the program of a machine, and the completion of M, S and T.
std::string ladder(unsigned instructions) {
  std::string text = "LD nc.m_strobe\nOR nc.s_strobe\nOR nc.t_strobe\nOUT plc.fin2\n";
  unsigned count = 5;  // with END
  for (unsigned n = 0; count + 10 <= instructions; ++n, count += 10) {
    const std::string in = "in" + std::to_string(n % 28), other = "in" + std::to_string((n + 7) % 28);
    const std::string out = "out" + std::to_string(32 + n % 28), m = "M" + std::to_string(n), k = std::to_string(n);
    text += "LD " + in + "\nAND " + other + "\nOR " + m + "\nANI nc.alarm\nOUT " + m + "\nLD " + m + "\nOUT T" + k +
            " K5\nAND> D" + k + " K100\nMOV K" + k + " D" + k + "\nSET " + out + "\n";
  }
  return text + "END\n";
}

// Scans with 3 axes and 64 points on the link, the bits among them mapped to the macro interface. range(0): instructions of
// the ladder, 0 = none. range(1): 1 = one scan per millisecond, as on a machine, with caches that others have used
// meanwhile; 0 = scans without a pause between them, which show the cost of a scan but meet every interrupt of the computer.
void scan(benchmark::State& state) {
  nc::rt::Config config;
  const auto instructions = static_cast<unsigned>(state.range(0));
  const std::string path = std::string(std::getenv("TMPDIR") != nullptr ? std::getenv("TMPDIR") : "/tmp") +
                           "/nc_scan_bench_" + std::to_string(getpid()) + ".il";
  Server server;
  std::string text = configuration(2 * kHalf, server.port());
  if (instructions != 0) {
    std::ofstream(path) << ladder(instructions);
    text += "[ladder]\nprogram = \"" + path + "\"\n";
  }
  for (const nc::rt::ConfigError& error : nc::rt::parse_config(text, "bench.toml", &config)) {
    state.SkipWithError(error.text().c_str());
    return;
  }
  const nc::rt::MadeMachine machine = nc::rt::make_machine(config, {});
  const auto& link = static_cast<const nc::hal::modbus::ModbusLink&>(*machine.buses[0]);  // the only one of the configuration above
  nc::rt::VirtualClock clock;
  std::vector<nc::rt::ConfigError> errors;
  const auto runtime = nc::rt::Runtime::create(config, {&clock, machine.hal.get(), nullptr, nullptr}, &errors);
  if (instructions != 0) std::remove(path.c_str());
  for (const nc::rt::ConfigError& e : errors) state.SkipWithError(e.text().c_str());
  unsigned file = 0;
  std::string error;
  if (runtime == nullptr ||
      nc_program_add_text(runtime->control(), "bench.nc", kProgram, sizeof kProgram - 1, &file) != NC_OK ||
      !runtime->start_stepping(&error) || runtime->select_program(file) != nc::rt::Answer::kDone ||
      runtime->execute(nc::rt::CommandKind::kCycleStart) != nc::rt::Answer::kDone) {
    state.SkipWithError(("the runtime does not start: " + error).c_str());
    return;
  }
  for (unsigned n = 0; n < 200 && link.statistics().state == nc::hal::modbus::LinkState::kLost; ++n) usleep(10000);
  const std::uint64_t requests = link.statistics().requests;
  // The priority of ncrtd's scan. Where it is not allowed a warning says so, and the figures are those of an ordinary thread.
  std::vector<std::string> warnings;
  nc::rt::promote_scan_thread(config.scheduling, &warnings);
  for (const std::string& warning : warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
  Pacer pacer(state.range(1) != 0);
  for (unsigned n = 0; n < kWarmUp; ++n) {
    pacer.wait();
    runtime->step();
    pacer.wait();
  }
  EmptyLoop loop(runtime->statistics().execution.percentile_ns(0.5));
  for (auto _ : state) {
    pacer.wait();
    runtime->step();
    pacer.wait();
    loop.measure();
  }
  const sched_param ordinary{};
  pthread_setschedparam(pthread_self(), SCHED_OTHER, &ordinary);
  if (link.statistics().state != nc::hal::modbus::LinkState::kOk) state.SkipWithError("the link is not ok");
  state.counters["modbus_requests"] = static_cast<double>(link.statistics().requests - requests);
  if (runtime->snapshot().alarmed()) state.SkipWithError("the program stopped on an alarm");
  show(state, "scan", runtime->statistics().execution);
  show(state, "loop", loop.times());
}
// One iteration is a feeder step, a scan and the loop; the counters scan_ are of the scan alone, loop_ of the loop.
BENCHMARK(scan)->Args({0, 0})->Args({1000, 0})->Iterations(200000)->Unit(benchmark::kMicrosecond);
BENCHMARK(scan)->Args({1000, 1})->Iterations(10000)->Unit(benchmark::kMicrosecond);

}  // namespace
