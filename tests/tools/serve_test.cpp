// SPDX-License-Identifier: Apache-2.0
// ncrtd as a service: what it reports to the service manager, when it feeds the watchdog, and how it ends.
#include "tools/lib/serve.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "hal/sim/sim_machine.hpp"
#include "runtime/runtime.hpp"
#include "tools/lib/service_notify.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;

// The end of the socket that a service manager has.
class Manager {
 public:
  explicit Manager(bool abstract = false) {
    char folder[] = "/tmp/nc-serve-XXXXXX";
    folder_ = mkdtemp(folder);
    name_ = abstract ? "@" + folder_ + "/notify" : folder_ + "/notify";
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, name_.data(), name_.size());
    if (abstract) address.sun_path[0] = '\0';
    socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name_.size());
    bound_ = bind(socket_, reinterpret_cast<const sockaddr*>(&address), size) == 0;
    setenv("NOTIFY_SOCKET", name_.c_str(), 1);
  }
  ~Manager() {
    close(socket_);
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) unsetenv(name);
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Manager(const Manager&) = delete;
  Manager& operator=(const Manager&) = delete;

  // All messages that have come, in order.
  std::vector<std::string> heard() {
    char text[512];
    for (;;) {
      const ssize_t size = recv(socket_, text, sizeof text, 0);
      if (size < 0) return heard_;
      heard_.emplace_back(text, static_cast<std::size_t>(size));
    }
  }
  std::size_t count(const std::string& line) {
    const auto all = heard();
    return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [&](const std::string& datagram) {
      return ("\n" + datagram + "\n").find("\n" + line + "\n") != std::string::npos;
    }));
  }
  bool bound() const { return bound_; }

 private:
  std::string folder_, name_;
  int socket_ = -1;
  bool bound_ = false;
  std::vector<std::string> heard_;
};

TEST(ServiceNotify, WithoutAManagerNothingIsSent) {
  unsetenv("NOTIFY_SOCKET");
  nc::tools::ServiceNotify notify;
  EXPECT_FALSE(notify.send("READY=1"));
  EXPECT_EQ(notify.watchdog_ns(), 0);
}

TEST(ServiceNotify, BothKindsOfSocketAreReached) {
  for (const bool abstract : {false, true}) {
    Manager manager(abstract);
    ASSERT_TRUE(manager.bound());
    nc::tools::ServiceNotify notify;
    EXPECT_TRUE(notify.send("READY=1\nSTATUS=ready"));
    EXPECT_EQ(manager.heard(), std::vector<std::string>{"READY=1\nSTATUS=ready"});
  }
}

TEST(ServiceNotify, AManagerThatIsGoneOrMisnamedIsNoError) {
  for (const std::string& name : {std::string("/nowhere/at/all"), std::string("relative"), std::string(""),
                                  "/" + std::string(200, 'x')}) {
    setenv("NOTIFY_SOCKET", name.c_str(), 1);
    nc::tools::ServiceNotify notify;
    EXPECT_FALSE(notify.send("READY=1")) << name;
  }
  unsetenv("NOTIFY_SOCKET");
}

TEST(ServiceNotify, TheWatchdogIsThisProcessOwn) {
  Manager manager;
  setenv("WATCHDOG_USEC", "3000000", 1);
  EXPECT_EQ(nc::tools::ServiceNotify().watchdog_ns(), 3'000'000'000);
  setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
  EXPECT_EQ(nc::tools::ServiceNotify().watchdog_ns(), 3'000'000'000);
  setenv("WATCHDOG_PID", std::to_string(getppid()).c_str(), 1);
  EXPECT_EQ(nc::tools::ServiceNotify().watchdog_ns(), 0);
  unsetenv("WATCHDOG_PID");
  for (const char* nonsense : {"", "-1", "3s", "99999999999999999999"}) {
    setenv("WATCHDOG_USEC", nonsense, 1);
    EXPECT_EQ(nc::tools::ServiceNotify().watchdog_ns(), 0) << nonsense;
  }
}

constexpr const char* kMachine = R"([machine]
name = "served"
[scheduling]
policy = "other"
lock_memory = false
overrun = "count"
[[axis]]
name = "X"
max_velocity = 200.0
max_acceleration = 2000.0
soft_limits = [-500.0, 500.0]
[[point]]
name = "lamp"
direction = "output"
[macro_interface]
"#1100" = "lamp"
)";

// A served machine. The test does what an operator does in options.look, as ncrtd does.
class ServeTest : public testing::Test {
 protected:
  ServeTest() {
    errors = nc::rt::parse_config(kMachine, "test.toml", &config);
    machine = std::make_unique<nc::hal::SimMachine>(config.sim, config.points);
    parts.clock = &clock;
    parts.hal = machine.get();
    runtime = nc::rt::Runtime::create(config, parts, &errors);
    options.signal = &signal;
    options.out = out = std::tmpfile();
  }
  ~ServeTest() override { std::fclose(out); }
  std::string printed() {
    std::rewind(out);
    std::string text;
    for (int c = std::fgetc(out); c != EOF; c = std::fgetc(out)) text += static_cast<char>(c);
    return text;
  }
  Answer start(const std::string& blocks) {
    Answer answer =
        runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(nc::rt::Mode::kMdi));
    if (answer == Answer::kDone) answer = runtime->load_mdi(blocks);
    return answer == Answer::kDone ? runtime->execute(CommandKind::kCycleStart) : answer;
  }

  Manager manager;
  nc::rt::Config config;
  std::vector<nc::rt::ConfigError> errors;
  std::unique_ptr<nc::hal::SimMachine> machine;
  nc::rt::RealClock clock;
  nc::rt::RuntimeParts parts;
  std::unique_ptr<nc::rt::Runtime> runtime;
  nc::rt::EndSignal signal = 0;
  nc::tools::ServeOptions options;
  std::FILE* out = nullptr;
  std::string error;
};

TEST_F(ServeTest, ReadyIsSaidOnceAndTheEndIsAnnounced) {
  ASSERT_NE(runtime, nullptr);
  ASSERT_TRUE(runtime->start(&error)) << error;
  unsigned looks = 0;
  options.look = [&] {
    if (++looks == 3) signal = SIGTERM;
  };
  EXPECT_TRUE(nc::tools::serve(runtime.get(), options));
  runtime->stop();
  EXPECT_EQ(looks, 3u);
  EXPECT_EQ(manager.count("READY=1"), 1u);
  EXPECT_EQ(manager.count("STOPPING=1"), 1u);
  EXPECT_EQ(manager.count("WATCHDOG=1"), 0u);  // the service manager did not ask for it
  EXPECT_NE(printed().find("end: at rest"), std::string::npos);
}

TEST_F(ServeTest, TheSignalStopsAMotionOnItsPathAndTheOutputsAreSafe) {
  ASSERT_NE(runtime, nullptr);
  ASSERT_TRUE(runtime->start(&error)) << error;
  double at_signal = 0;
  bool left = false;
  options.look = [&] {
    const nc::rt::Snapshot now = runtime->snapshot();
    if (now.system[0].nc.state == NC_STATE_IDLE) {
      ASSERT_EQ(start("#1100=1\nG90 G01 X400. F6000.\n"), Answer::kDone);
    } else if (now.system[0].nc.command.v[0] > 5) {
      at_signal = now.system[0].nc.command.v[0];
      signal = SIGTERM;
    }
  };
  bool stops = false;
  options.leave = [&] {  // as where a client's command waits for a disk
    left = true;
    for (unsigned n = 0; n < 3000 && !stops; ++n) {
      stops = runtime->snapshot().system[0].nc.state == NC_STATE_HOLD;
      usleep(1000);
    }
  };
  EXPECT_TRUE(nc::tools::serve(runtime.get(), options));
  const nc::rt::Snapshot end = runtime->snapshot();
  EXPECT_TRUE(end.system[0].nc.distance_zero);
  EXPECT_GE(end.system[0].nc.command.v[0], at_signal);
  EXPECT_LT(end.system[0].nc.command.v[0], 400);
  EXPECT_EQ(end.system[0].nc.state, NC_STATE_IDLE);
  EXPECT_EQ(machine->outputs().value[0], 1u);
  runtime->stop();
  EXPECT_TRUE(machine->stopped());
  EXPECT_TRUE(left);
  EXPECT_TRUE(stops) << "the axes do not go on until the clients have left";
  EXPECT_NE(printed().find("end: feed hold\nend: at rest"), std::string::npos) << printed();
}

// In manual mode there is no feed hold, but a reference move, or a jog that the ladder holds, must end, too.
TEST_F(ServeTest, TheSignalStopsAMotionByHand) {
  ASSERT_NE(runtime, nullptr);
  ASSERT_TRUE(runtime->start(&error)) << error;
  const auto x = [&] { return runtime->snapshot().system[0].nc.command.v[0]; };
  double at_signal = 0;
  bool jogged = false;
  options.look = [&] {
    if (at_signal != 0) return;
    if (!jogged) {
      (void)runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(nc::rt::Mode::kManual));
      nc::rt::Command step;
      step.kind = CommandKind::kStep;
      step.value = 400;
      jogged = runtime->execute(step) == Answer::kDone;
    } else if (x() > 20) {
      at_signal = x();
      signal = SIGTERM;
    }
  };
  EXPECT_TRUE(nc::tools::serve(runtime.get(), options));
  EXPECT_GT(at_signal, 0);
  EXPECT_TRUE(runtime->snapshot().system[0].nc.distance_zero);
  EXPECT_LT(x(), 399);
  runtime->stop();
}

// A handwheel turns by thousands of detents in a shift, which must not fill the journal.
TEST_F(ServeTest, DetentsOfAHandwheelAreNoEvents) {
  ASSERT_NE(runtime, nullptr);
  ASSERT_TRUE(runtime->start(&error)) << error;
  unsigned detents = 0, seen = 0;
  bool moving = false;
  options.look = [&] {
    const bool moves = runtime->snapshot().system[0].nc.state == NC_STATE_MANUAL;
    seen += moves && !moving;
    moving = moves;
    if (moves) return;
    (void)runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(nc::rt::Mode::kManual));
    nc::rt::Command step;
    step.kind = CommandKind::kStep;
    step.value = 0.5;
    if (detents < 20 && runtime->execute(step) == Answer::kDone) ++detents;
    if (detents == 20 && seen >= 5) signal = SIGTERM;
  };
  EXPECT_TRUE(nc::tools::serve(runtime.get(), options));
  runtime->stop();
  EXPECT_EQ(printed(), "up: served, cycle 1000 us\nend: feed hold\nend: at rest\n");
}

TEST_F(ServeTest, AnAlarmIsToldOnceAndDoesNotEndTheService) {
  ASSERT_NE(runtime, nullptr);
  ASSERT_TRUE(runtime->start(&error)) << error;
  unsigned looks = 0;
  options.look = [&] {
    if (++looks == 1) {
      EXPECT_EQ(start("G90 G01 X1.\n"), Answer::kDone);  // no feed: P62
    }
    if (looks >= 40 && runtime->snapshot().alarmed()) signal = SIGINT;
  };
  EXPECT_TRUE(nc::tools::serve(runtime.get(), options));
  runtime->stop();
  const std::string text = printed();
  EXPECT_NE(text.find("alarm: P62"), std::string::npos) << text;
  EXPECT_EQ(text.find("alarm: ", text.find("alarm: P62") + 1), std::string::npos) << text;
}

// The watchdog is fed by the scan, not by the loop around it: if the scan of a runtime stops, the watchdog is not fed
// although the loop runs on.
TEST_F(ServeTest, TheWatchdogIsFedByTheScan) {
  ASSERT_NE(runtime, nullptr);
  setenv("WATCHDOG_USEC", "30000", 1);
  ASSERT_TRUE(runtime->start(&error)) << error;
  options.look = [&] {
    if (manager.count("WATCHDOG=1") >= 3) signal = SIGTERM;
  };
  EXPECT_TRUE(nc::tools::serve(runtime.get(), options));
  runtime->stop();

  const std::size_t fed = manager.count("WATCHDOG=1");
  signal = 0;
  unsigned looks = 0;
  options.look = [&] {
    if (++looks == 40) signal = SIGTERM;
  };
  std::string ignored;
  nc::hal::SimMachine still(config.sim, config.points);
  nc::rt::VirtualClock stands;
  const auto stepped = nc::rt::Runtime::create(config, {&stands, &still, nullptr, nullptr}, &errors);
  ASSERT_NE(stepped, nullptr);
  ASSERT_TRUE(stepped->start_stepping(&ignored));
  std::size_t while_standing = 0;
  options.leave = [&] { while_standing = manager.count("WATCHDOG=1"); };
  // options.look does not step the runtime, so it does not come to rest at the end either.
  options.rest_ns = 20'000'000;
  EXPECT_FALSE(nc::tools::serve(stepped.get(), options));
  EXPECT_NE(printed().find("not at rest in time"), std::string::npos);
  EXPECT_LE(while_standing, fed + 1);  // at most once more, for a scan that was done before
}

}  // namespace
