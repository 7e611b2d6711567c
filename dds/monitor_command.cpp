// SPDX-License-Identifier: Apache-2.0
// See monitor_command.hpp.
#include "dds/monitor_command.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <utility>

#include "dds/monitor.hpp"
#include "dds/monitor_screen.hpp"
#include "runtime/clock.hpp"
#include "runtime/end_signal.hpp"

namespace nc::dds {
namespace {

constexpr int kExitUsage = 1, kExitNobody = 2;
constexpr std::int64_t kMs = 1'000'000;

std::int64_t now() {
  return rt::RealClock().now_ns();
}

int nobody(const Monitor& monitor, const MonitorOptions& options) {
  if (monitor.gateway_there()) {
    std::fprintf(stderr, "ncmon: ncdds is running, but its control is not (waited %g s): it has ended, or has not begun\n",
                 options.wait_s);
    return kExitNobody;
  }
  std::fprintf(stderr,
               "ncmon: nobody publishes the status of %s in DDS domain %u (waited %g s): is ncdds running, with the same "
               "--domain?\n",
               options.machine.empty() ? "a control" : ("\"" + options.machine + "\"").c_str(), options.access.domain,
               options.wait_s);
  return kExitNobody;
}

// Waits until a status has come, a signal ends the program, or the time is over. True when a status has come.
bool wait_for_status(Monitor* monitor, double seconds) {
  const std::int64_t end = now() + static_cast<std::int64_t>(seconds * 1e9);
  while (!monitor->heard() && rt::end_signal() == 0 && now() < end)
    monitor->wait(std::min<std::int64_t>(100 * kMs, std::max<std::int64_t>(1, end - now())));
  return monitor->heard();
}

int once(Monitor* monitor, const MonitorOptions& options) {
  // Alarms have a topic of their own and may come a moment later, and so may further part systems.
  const std::int64_t end = now() + 500 * kMs;
  const std::uint64_t first = monitor->samples();
  const auto complete = [&] {
    const StatusView& status = monitor->view().systems.begin()->second;
    return monitor->samples() >= first + 2 && (!status.alarm || !monitor->view().alarms.empty());
  };
  while (!complete() && now() < end) monitor->wait(50 * kMs);
  if (options.signals) {
    const std::int64_t patience = now() + static_cast<std::int64_t>(options.wait_s * 1e9);
    while (monitor->view().signals.empty() && rt::end_signal() == 0 && now() < patience) monitor->wait(50 * kMs);
    if (monitor->view().signals.empty()) {
      std::fprintf(stderr, "ncmon: no signals came (waited %g s)\n", options.wait_s);
      return kExitNobody;
    }
    monitor->wait(200 * kMs);  // for the table with the meanings of the signals
  }
  if (options.signals && !options.json) {
    std::printf("%s", signal_page(monitor->view(), 0).c_str());
    return 0;
  }
  std::printf("%s", options.json ? (json_line(monitor->view()) + "\n").c_str()
                                 : page(monitor->view()).c_str());
  return 0;
}

int json_stream(Monitor* monitor) {
  std::uint64_t shown = 0;
  while (rt::end_signal() == 0 && !std::ferror(stdout)) {
    if (monitor->changes() != shown) {  // when the control has ended, a last line with "alive": false is printed
      shown = monitor->changes();
      std::printf("%s\n", json_line(monitor->view()).c_str());
      std::fflush(stdout);
    }
    if (monitor->ended()) break;
    monitor->wait(100 * kMs);
  }
  return 0;
}

int latency(Monitor* monitor, unsigned wanted, double limit_s) {
  std::vector<std::int64_t> times;
  std::uint64_t seen = monitor->samples();
  const std::int64_t end = now() + static_cast<std::int64_t>(limit_s * 1e9) + wanted * 200 * kMs;
  while (times.size() < wanted && rt::end_signal() == 0 && now() < end && !monitor->ended()) {
    monitor->wait(100 * kMs);
    if (monitor->samples() == seen) continue;
    seen = monitor->samples();
    times.push_back(monitor->last_latency_ns());
  }
  if (times.empty()) {
    std::fprintf(stderr, "ncmon: no samples came\n");
    return kExitNobody;
  }
  std::printf("%s\n", latency_text(std::move(times)).c_str());
  return 0;
}

// On a terminal one line that is rewritten; elsewhere a line at each tenth of the program and at each change of state.
int progress(Monitor* monitor) {
  const bool terminal = isatty(STDOUT_FILENO) != 0;
  std::string last_state;
  unsigned last_tenth = ~0u;
  std::map<std::uint32_t, std::uint64_t> messages;  // number of messages of each part system that have been shown
  bool live = false, alive = true;
  const auto leave_line = [&] {
    if (live) std::fputc('\n', stdout);
    live = false;
  };
  while (rt::end_signal() == 0 && !std::ferror(stdout)) {
    const StatusView& status = monitor->view().systems.begin()->second;
    for (const auto& [number, system] : monitor->view().systems) {
      if (system.message_count <= messages[number]) continue;
      messages[number] = system.message_count;
      leave_line();
      std::printf("message: %s\n", printable(system.message).c_str());
    }
    if (monitor->view().alive != alive) {
      alive = monitor->view().alive;
      leave_line();
      if (!alive && !monitor->ended()) std::printf("no status any more: ncdds is gone, or the scan stands still\n");
    }
    const std::string line = progress_line(status, monitor->view().alarms);
    const std::string state = status.run_state == "running" ? "" : status.state_text;
    if (terminal) {
      std::printf("\r\033[K%.200s", line.c_str());
      live = true;
    } else if (status.percent / 10 != last_tenth || state != last_state) {
      std::printf("%s\n", line.c_str());
      last_tenth = status.percent / 10;
      last_state = state;
    }
    std::fflush(stdout);
    if (monitor->ended()) break;
    monitor->wait(200 * kMs);
  }
  leave_line();
  if (monitor->ended()) std::printf("the control has ended\n");
  return 0;
}

int failed(const std::string& text) {
  std::fprintf(stderr, "ncmon: %s\n", text.c_str());
  return kExitUsage;
}

int full_screen(Monitor* monitor, const MonitorOptions& options, const std::string& notice) {
  if (isatty(STDOUT_FILENO) == 0) return failed("this is not a terminal: --once, --json or --progress");
  Screen screen;
  std::int64_t next = 0;
  bool signals = options.signals;
  std::size_t first_line = 0;
  while (rt::end_signal() == 0) {
    const char key = screen.key();
    if (key == 'q' || key == 'Q') break;
    if (key == 's' || key == 'S') {
      std::string error;
      signals = !signals;
      first_line = 0;
      if (!monitor->watch_signals(signals, &error)) return failed(error);
    }
    const winsize size = Screen::dimensions();
    if (key == ' ') first_line += size.ws_row > 4 ? size.ws_row - 4u : 1u;
    monitor->wait(100 * kMs);
    if (now() < next && key == '\0') continue;
    next = now() + 100 * kMs;
    std::string text = "ncmon   domain " + std::to_string(options.access.domain) +
                       (signals ? "   q ends, s status, space next page\n\n" : "   q ends, s signals\n\n");
    if (!notice.empty()) text += printable(notice) + "\n\n";
    if (!monitor->heard()) text += "nobody publishes yet ...\n";
    else text += signals ? from_line(signal_page(monitor->view(), size.ws_col), &first_line)
                         : page(monitor->view());
    screen.show(text);
  }
  return 0;
}

bool on_full_screen(const MonitorOptions& options) {
  return !options.once && !options.json && !options.progress && options.latency == 0;
}

// Does what the options ask for, once DDS is running. `notice`: the last sentence about the identity.
int show(Monitor* monitor, const MonitorOptions& options, const std::string& notice) {
  if (on_full_screen(options)) return full_screen(monitor, options, notice);
  if (!wait_for_status(monitor, options.wait_s)) return rt::end_signal() != 0 ? 0 : nobody(*monitor, options);
  if (options.latency != 0) return latency(monitor, options.latency, options.wait_s);
  if (options.progress) return progress(monitor);
  return options.once ? once(monitor, options) : json_stream(monitor);
}

}  // namespace

std::string latency_text(std::vector<std::int64_t> times_ns) {
  std::sort(times_ns.begin(), times_ns.end());
  const auto at = [&](double fraction) {
    return static_cast<double>(times_ns[static_cast<std::size_t>(fraction * static_cast<double>(times_ns.size() - 1))]) / 1e6;
  };
  char text[160];
  std::snprintf(text, sizeof text, "scan to subscriber, %zu samples: p50 %.3f ms   p90 %.3f ms   p99 %.3f ms   max %.3f ms", times_ns.size(), at(0.5),
                at(0.9), at(0.99), at(1.0));
  return text;
}

int monitor_command(const MonitorOptions& options) {
  rt::catch_end_signals({SIGINT, SIGTERM, SIGHUP});
  std::string error, notice;
  Monitor monitor(options.access, options.machine, [&](const std::string& text) {
    notice = text;
    if (!on_full_screen(options)) std::fprintf(stderr, "ncmon: %s\n", text.c_str());
  });
  if (!may_access(options.access, false, &error)) return failed(error);
  if (!monitor.open(&error) || (options.signals && !monitor.watch_signals(true, &error))) return failed(error);
  const int status = show(&monitor, options, notice);
  if (std::fflush(stdout) != 0) return kExitUsage;
  return rt::end_signal() != 0 ? rt::exit_status_of_signal(rt::end_signal()) : status;
}

}  // namespace nc::dds
