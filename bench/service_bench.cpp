// SPDX-License-Identifier: Apache-2.0
// What ten clients of the services cost the scan: the machine of etc/machine.toml executes an endless program on the real clock, and windows in which ten clients of
// another process get a watch list of 16 devices every 20 ms each take turns with windows in which the same connections are silent. So all that the computer does
// besides is in both kinds, and the scans of each are counted together: the 99 % of one window would be its fifth slowest scan.
//
// `added_p50_us` and `added_p99_us` are the differences of the two distributions; `_low` and `_high` hold them in 95 of 100 cases, from 1000 sets of as many pairs of
// windows, drawn with replacement. The scan has its real-time priority where that is permitted (`fifo`); its time is that of the processor, as in ncrtd's summary.
// NC_PAIRS: pairs of windows, each of which takes 1 s. Without it there are 5, which show that the bench runs; a figure takes 150.
#include <benchmark/benchmark.h>

#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "hal/sim/sim_machine.hpp"
#include "runtime/runtime.hpp"
#include "runtime/services/local_server.hpp"
#include "runtime/share/service.hpp"

namespace {

using nc::rt::Histogram;
using nc::rt::services::Json;

constexpr unsigned kClients = 10, kDevices = 16, kIntervalMs = 20, kSets = 1000;
constexpr std::chrono::milliseconds kWindow{450}, kSettles{50};
constexpr char kProgram[] = "G90 G17 G64 F6000.\nN1 G1 X5. Y1. Z-2.\nG3 X5. Y5. J2.\n#100=#100+1\nG2 X0. Y0. R6. Z0.\nGOTO 1\n";

// ---- the clients, in a process of their own ----

class Client {
 public:
  explicit Client(const std::string& path) : socket_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    if (connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) _exit(2);
    (void)next();
  }
  ~Client() { close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  int socket() const { return socket_; }

  // Asks and waits for the answer; updates that come before it are dropped.
  Json call(const std::string& service, const Json& args) {
    const std::string frame = nc::rt::services::frame_of(Json{{"id", 1}, {"service", service}, {"args", args}}.dump());
    if (send(socket_, frame.data(), frame.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(frame.size())) _exit(3);
    for (;;)
      if (const Json message = next(); message.contains("id")) {
        if (message["ok"] != true) _exit(4);
        return message["reply"];
      }
  }
  Json next() {
    std::string text;
    while (in_.next(&text) != nc::rt::services::FrameReader::Next::kFrame) {
      char bytes[4096];
      const ssize_t count = recv(socket_, bytes, sizeof bytes, 0);
      if (count <= 0) _exit(5);
      in_.add({bytes, static_cast<std::size_t>(count)});
    }
    return Json::parse(text);
  }

 private:
  int socket_;
  nc::rt::services::FrameReader in_;
};

// What the bench and its clients tell each other. Each `wish` is answered by `is`.
struct Shared {
  std::atomic<int> wish{0}, is{0};  // 0 = silent, 1 = they watch, 2 = the end
  std::atomic<std::uint64_t> updates{0};
};

[[noreturn]] void be_clients(const std::string& path, Shared* shared) {
  std::vector<std::unique_ptr<Client>> clients;
  for (unsigned i = 0; i < kClients; ++i) clients.push_back(std::make_unique<Client>(path));
  Json devices = Json::array();
  for (unsigned d = 0; d < kDevices; ++d) devices.push_back("D" + std::to_string(d));
  for (;;) {
    while (shared->wish == shared->is) usleep(1000);
    if (shared->wish == 2) _exit(0);
    std::vector<Json> lists;
    for (const auto& client : clients) lists.push_back(client->call("watch.begin", {{"devices", devices}, {"interval_ms", kIntervalMs}})["watch"]);
    shared->is = 1;
    while (shared->wish == 1)
      for (const auto& client : clients) {
        (void)client->next();
        ++shared->updates;
      }
    for (unsigned i = 0; i < kClients; ++i) (void)clients[i]->call("watch.end", {{"watch", lists[i]}});
    shared->is = 0;
    if (shared->wish == 2) _exit(0);
  }
}

// ---- distributions ----

// Of each bucket of the histogram, by its largest value in ns, how many scans were in it.
using Counts = std::map<std::uint64_t, std::uint64_t>;

// What the histogram has at this moment: the smallest value that so many of all scans do not exceed, for each number of scans.
Counts counts_of(const Histogram& histogram) {
  Counts counts;
  const std::uint64_t all = histogram.count();
  for (std::uint64_t n = 1; n <= all; ++n) ++counts[histogram.percentile_ns((static_cast<double>(n) - 0.5) / static_cast<double>(all))];
  return counts;
}

void add(Counts* sum, const Counts& more) {
  for (const auto& [high, count] : more) (*sum)[high] += count;
}

// In us, evenly between the edges of a bucket, of which there are 32 for each power of two.
double part_us(const Counts& counts, double part) {
  std::uint64_t all = 0;
  for (const auto& [high, count] : counts) all += count;
  const double wanted = part * static_cast<double>(all);
  double seen = 0;
  for (const auto& [high, count] : counts) {
    const auto here = static_cast<double>(count);
    if (seen + here >= wanted) {
      const double width = static_cast<double>(std::max<std::uint64_t>(1, std::bit_floor(high) / 32));
      return (static_cast<double>(high) - width * (1 - (wanted - seen) / here)) / 1e3;
    }
    seen += here;
  }
  return NAN;
}

struct Pair {
  Counts silent, watched;
};

double added_us(const std::vector<const Pair*>& pairs, double part) {
  Counts silent{}, watched{};
  for (const Pair* pair : pairs) {
    add(&silent, pair->silent);
    add(&watched, pair->watched);
  }
  return part_us(watched, part) - part_us(silent, part);
}

void report(benchmark::State* state, const std::vector<Pair>& pairs) {
  Counts silent{};
  std::vector<const Pair*> all;
  for (const Pair& pair : pairs) {
    add(&silent, pair.silent);
    all.push_back(&pair);
  }
  struct Row {
    const char* name;
    double part;
  };
  std::mt19937 random(1);
  std::uniform_int_distribution<std::size_t> any(0, pairs.size() - 1);
  for (const Row row : {Row{"p50", 0.5}, Row{"p90", 0.9}, Row{"p99", 0.99}}) {
    std::vector<double> drawn;
    for (unsigned set = 0; set < kSets; ++set) {
      std::vector<const Pair*> some;
      for (std::size_t i = 0; i < pairs.size(); ++i) some.push_back(&pairs[any(random)]);
      drawn.push_back(added_us(some, row.part));
    }
    std::sort(drawn.begin(), drawn.end());
    const std::string added = std::string("added_") + row.name;
    state->counters[std::string("silent_") + row.name + "_us"] = part_us(silent, row.part);
    state->counters[added + "_us"] = added_us(all, row.part);
    state->counters[added + "_low"] = drawn[kSets / 40];
    state->counters[added + "_high"] = drawn[kSets - 1 - kSets / 40];
  }
}

// ---- the machine ----

void services(benchmark::State& state) {
  char pattern[] = "/tmp/nc-service-bench-XXXXXX";
  const std::string folder = mkdtemp(pattern) == nullptr ? "" : pattern, path = folder + "/control.sock";
  nc::rt::Config config;
  for (const nc::rt::ConfigError& error : nc::rt::load_config(NC_SOURCE_DIR "/etc/machine.toml", &config)) state.SkipWithError(error.text().c_str());
  config.scheduling.overrun = nc::rt::OverrunReaction::kCount;
  config.scheduling.fifo = geteuid() == 0;
  config.scheduling.lock_memory = config.scheduling.fifo;
  config.services.changes = folder + "/changes";
  nc::rt::RealClock clock;
  nc::hal::SimMachine machine(config.sim, config.points);
  std::vector<nc::rt::ConfigError> errors;
  const auto runtime = nc::rt::Runtime::create(config, {&clock, &machine, nullptr, nullptr}, &errors);
  nc::rt::share::ProgramTable programs(static_cast<nc_dialect>(config.nc.dialect));
  nc::rt::share::ServiceOptions options;
  options.name = "bench-" + std::to_string(getpid());
  options.local = true;
  nc::rt::share::Service share(runtime.get(), &programs, nullptr, options);
  std::string error;
  unsigned file = 0;
  if (runtime == nullptr || !share.create(&error) || nc_program_add_text(runtime->control(), "bench.nc", kProgram, sizeof kProgram - 1, &file) != NC_OK) {
    state.SkipWithError(("there is no machine: " + error).c_str());
    return;
  }
  nc::rt::services::Services services(runtime.get(), &programs, share.desk(), share.segment(), nullptr);
  nc::rt::services::LocalServer server(&services, options.name, [](const nc::rt::services::Credentials&) { return nc::rt::services::RightSet::all(); });
  void* memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  auto* shared = new (memory) Shared;
  if (!server.open(path, &error)) return state.SkipWithError(error.c_str());
  const pid_t child = fork();  // before any thread; connections wait until somebody takes them
  if (child == 0) be_clients(path, shared);
  if (!runtime->start(&error) || !share.start(&error) || !server.start(&error)) state.SkipWithError(error.c_str());
  if (runtime->select_program(file) != nc::rt::Answer::kDone || runtime->execute(nc::rt::CommandKind::kCycleStart) != nc::rt::Answer::kDone) state.SkipWithError("the program does not start");
  // Only the bench asks for it, and begins it anew with each window: a scan that is noted in that moment may be lost.
  auto& execution = const_cast<Histogram&>(runtime->statistics().execution);
  bool alive = true;
  const auto window = [&](int kind) {
    shared->wish = kind;
    while (alive && shared->is != kind) {
      alive = waitpid(child, nullptr, WNOHANG) == 0;
      usleep(500);
    }
    std::this_thread::sleep_for(kSettles);
    execution.clear();
    std::this_thread::sleep_for(kWindow);
    return counts_of(execution);
  };
  std::vector<Pair> pairs;
  for (auto _ : state) {
    Pair pair;
    const bool turned = pairs.size() % 2 != 0;  // silent first, then watched first: so what drifts is in both kinds
    (turned ? pair.watched : pair.silent) = window(turned ? 1 : 0);
    (turned ? pair.silent : pair.watched) = window(turned ? 0 : 1);
    pairs.push_back(pair);
  }
  shared->wish = 2;
  if (alive) (void)waitpid(child, nullptr, 0);
  if (!alive) state.SkipWithError("the clients have failed");
  if (runtime->snapshot().alarmed()) state.SkipWithError("the program stopped on an alarm");
  server.stop();
  share.stop();
  runtime->stop();
  std::filesystem::remove_all(folder);
  report(&state, pairs);
  state.counters["fifo"] = config.scheduling.fifo;
  state.counters["updates_per_s"] = static_cast<double>(shared->updates.load()) / (static_cast<double>(pairs.size()) * std::chrono::duration<double>(kWindow + kSettles).count());
}
const long of_environment = std::getenv("NC_PAIRS") != nullptr ? std::atol(std::getenv("NC_PAIRS")) : 0;
BENCHMARK(services)->Iterations(of_environment > 0 ? of_environment : 5)->Unit(benchmark::kMillisecond);

}  // namespace
