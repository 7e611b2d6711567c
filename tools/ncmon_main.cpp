// SPDX-License-Identifier: Apache-2.0
// ncmon: a monitor on the terminal. Nothing but a DDS subscriber: it shows what ncdds publishes.
//
//   ncmon [--control NAME] [--domain N]      full screen; q ends it, s shows the signals, space their next page
//   ncmon --view signals                     begins with them; also for --once and --json
//   ncmon --once [--json] [--wait SECONDS]   one status
//   ncmon --json                             a line of JSON for each status
//   ncmon --progress                         one live line, until the control ends
//   ncmon --latency N                        times of N samples from the scan to here
//
// Exit status: 0, 1 usage or DDS that does not come up, 2 nobody publishes (within --wait).
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "dds/monitor.hpp"
#include "nc/control.h"
#include "runtime/clock.hpp"
#include "tools/lib/option_values.hpp"

namespace {

constexpr int kExitUsage = 1, kExitNobody = 2, kExitSignal = 128;
constexpr std::int64_t kMs = 1'000'000;

volatile std::sig_atomic_t g_signal = 0;
extern "C" void on_signal(int number) {
  g_signal = number;
}

struct Options {
  std::string machine;
  unsigned domain = nc::dds::kDefaultDomain;
  bool once = false, json = false, progress = false;
  std::string view = "status";
  bool signals() const { return view == "signals"; }
  double wait_s = 5;
  unsigned latency = 0;
};

std::int64_t now() {
  return nc::rt::RealClock().now_ns();
}

// The alternate screen without echo; the terminal is as before whatever ends the program in order.
class Screen {
 public:
  Screen() {
    raw_ = tcgetattr(STDIN_FILENO, &before_) == 0;
    if (raw_) {
      termios now = before_;
      now.c_lflag &= static_cast<tcflag_t>(~(ICANON | ECHO));
      tcsetattr(STDIN_FILENO, TCSANOW, &now);
    }
    std::fputs("\033[?1049h\033[?25l", stdout);
  }
  ~Screen() {
    std::fputs("\033[?25h\033[?1049l", stdout);
    std::fflush(stdout);
    if (raw_) tcsetattr(STDIN_FILENO, TCSANOW, &before_);
  }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  static winsize dimensions() {
    winsize size{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_row == 0) size = {24, 80, 0, 0};
    return size;
  }
  void show(const std::string& page) {
    const winsize size = dimensions();
    std::string text = "\033[H";
    unsigned row = 0;
    for (std::size_t begin = 0; begin < page.size() && row + 1 < size.ws_row; ++row) {
      const std::size_t end = page.find('\n', begin);
      std::string line = page.substr(begin, end - begin);
      if (line.size() > size.ws_col) line.resize(size.ws_col);
      text += line + "\033[K\r\n";
      begin = end == std::string::npos ? page.size() : end + 1;
    }
    std::fputs((text + "\033[J").c_str(), stdout);
    std::fflush(stdout);
  }
  // The key that was pressed, 0 = none.
  char key() const {
    pollfd in{STDIN_FILENO, POLLIN, 0};
    char key = 0;
    return raw_ && poll(&in, 1, 0) > 0 && read(STDIN_FILENO, &key, 1) == 1 ? key : '\0';
  }

 private:
  termios before_{};
  bool raw_ = false;
};

int nobody(const nc::dds::Monitor& monitor, const Options& options) {
  if (monitor.gateway_there()) {
    std::fprintf(stderr, "ncmon: ncdds is running, but its control is not (waited %g s): it has ended, or has not begun\n",
                 options.wait_s);
    return kExitNobody;
  }
  std::fprintf(stderr,
               "ncmon: nobody publishes the status of %s in DDS domain %u (waited %g s): is ncdds running, with the same "
               "--domain?\n",
               options.machine.empty() ? "a control" : ("\"" + options.machine + "\"").c_str(), options.domain,
               options.wait_s);
  return kExitNobody;
}

// Until a status is there, a signal, or the time is over.
bool wait_for_status(nc::dds::Monitor* monitor, double seconds) {
  const std::int64_t end = now() + static_cast<std::int64_t>(seconds * 1e9);
  while (!monitor->heard() && g_signal == 0 && now() < end)
    monitor->wait(std::min<std::int64_t>(100 * kMs, std::max<std::int64_t>(1, end - now())));
  return monitor->heard();
}

int once(nc::dds::Monitor* monitor, const Options& options) {
  // The alarms come on a topic of their own, perhaps a moment later; so do further part systems.
  const std::int64_t end = now() + 500 * kMs;
  const std::uint64_t first = monitor->samples();
  const auto complete = [&] {
    const nc::dds::StatusView& status = monitor->view().systems.begin()->second;
    return monitor->samples() >= first + 2 && (!status.alarm || !monitor->view().alarms.empty());
  };
  while (!complete() && now() < end) monitor->wait(50 * kMs);
  if (options.signals()) {
    const std::int64_t patience = now() + static_cast<std::int64_t>(options.wait_s * 1e9);
    while (monitor->view().signals.empty() && g_signal == 0 && now() < patience) monitor->wait(50 * kMs);
    if (monitor->view().signals.empty()) {
      std::fprintf(stderr, "ncmon: no signals came (waited %g s)\n", options.wait_s);
      return kExitNobody;
    }
    monitor->wait(200 * kMs);  // the table, which says what they mean
  }
  if (options.signals() && !options.json) {
    std::printf("%s", nc::dds::signal_page(monitor->view(), 0).c_str());
    return 0;
  }
  std::printf("%s", options.json ? (nc::dds::json_line(monitor->view()) + "\n").c_str()
                                 : nc::dds::page(monitor->view()).c_str());
  return 0;
}

int json_stream(nc::dds::Monitor* monitor) {
  std::uint64_t shown = 0;
  while (g_signal == 0 && !std::ferror(stdout)) {
    if (monitor->changes() != shown) {  // the last line says "alive": false
      shown = monitor->changes();
      std::printf("%s\n", nc::dds::json_line(monitor->view()).c_str());
      std::fflush(stdout);
    }
    if (monitor->ended()) break;
    monitor->wait(100 * kMs);
  }
  return 0;
}

int latency(nc::dds::Monitor* monitor, unsigned wanted, double limit_s) {
  std::vector<std::int64_t> times;
  std::uint64_t seen = monitor->samples();
  const std::int64_t end = now() + static_cast<std::int64_t>(limit_s * 1e9) + wanted * 200 * kMs;
  while (times.size() < wanted && g_signal == 0 && now() < end && !monitor->ended()) {
    monitor->wait(100 * kMs);
    if (monitor->samples() == seen) continue;
    seen = monitor->samples();
    times.push_back(monitor->last_latency_ns());
  }
  if (times.empty()) {
    std::fprintf(stderr, "ncmon: no samples came\n");
    return kExitNobody;
  }
  std::sort(times.begin(), times.end());
  const auto at = [&](double fraction) {
    return static_cast<double>(times[static_cast<std::size_t>(fraction * static_cast<double>(times.size() - 1))]) / 1e6;
  };
  std::printf("scan to subscriber, %zu samples: p50 %.3f ms   p90 %.3f ms   p99 %.3f ms   max %.3f ms\n", times.size(),
              at(0.5), at(0.9), at(0.99), at(1.0));
  return 0;
}

// One line that is rewritten on a terminal; elsewhere one at each tenth and each change of state.
int progress(nc::dds::Monitor* monitor) {
  const bool terminal = isatty(STDOUT_FILENO) != 0;
  std::string last_state;
  unsigned last_tenth = ~0u;
  std::uint64_t messages = 0;
  bool live = false, alive = true;
  const auto leave_line = [&] {
    if (live) std::fputc('\n', stdout);
    live = false;
  };
  while (g_signal == 0 && !std::ferror(stdout)) {
    const nc::dds::StatusView& status = monitor->view().systems.begin()->second;
    if (status.message_count > messages) {
      messages = status.message_count;
      leave_line();
      std::printf("message: %s\n", nc::dds::printable(status.message).c_str());
    }
    if (monitor->view().alive != alive) {
      alive = monitor->view().alive;
      leave_line();
      if (!alive && !monitor->ended()) std::printf("no status any more: ncdds is gone, or the scan stands still\n");
    }
    const std::string line = nc::dds::progress_line(status, monitor->view().alarms);
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

// A page from this line on; behind its end it begins again.
std::string from_line(const std::string& page, std::size_t* line) {
  std::size_t at = 0;
  for (std::size_t i = 0; i < *line && at < page.size(); ++i) at = std::min(page.find('\n', at), page.size() - 1) + 1;
  if (at >= page.size()) at = *line = 0;
  return page.substr(at);
}

int full_screen(nc::dds::Monitor* monitor, const Options& options) {
  if (isatty(STDOUT_FILENO) == 0) {
    std::fprintf(stderr, "ncmon: this is not a terminal: --once, --json or --progress\n");
    return kExitUsage;
  }
  Screen screen;
  std::int64_t next = 0;
  bool signals = options.signals();
  std::size_t first_line = 0;
  while (g_signal == 0) {
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
    std::string text = "ncmon   domain " + std::to_string(options.domain) +
                       (signals ? "   q ends, s status, space next page\n\n" : "   q ends, s signals\n\n");
    if (!monitor->heard()) text += "nobody publishes yet ...\n";
    else text += signals ? from_line(nc::dds::signal_page(monitor->view(), size.ws_col), &first_line)
                         : nc::dds::page(monitor->view());
    screen.show(text);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"ncmon: shows a control that ncdds publishes"};
  Options options;
  app.set_version_flag("--version", std::string("ncmon ") + nc_version());
  app.add_option("--control", options.machine, "name of the control (ncdds --share); default: the first that is heard")->check(nc::tools::given());
  std::string file;  // neither stands in --help
  app.add_option("--machine,--config", file)->group("")->check([](const std::string&) {
    return std::string("is the file of a machine, which ncmon does not read: the name of a control is --control NAME");
  });
  app.add_option("--domain", options.domain, "DDS domain")->transform(nc::tools::whole(0, 230));
  CLI::Option* once_flag = app.add_flag("--once", options.once, "one status, then end");
  app.add_flag("--json", options.json, "as JSON, one object in a line");
  app.add_option("--view", options.view, "status, or the signals between NC, ladder and machine")
      ->check(CLI::IsMember({"status", "signals"}));
  CLI::Option* progress_flag = app.add_flag("--progress", options.progress, "one live line, until the control ends");
  app.add_option("--wait", options.wait_s, "seconds for the first status")->check(nc::tools::seconds(true, "86400"));
  CLI::Option* latency_option = app.add_option("--latency", options.latency, "times of so many samples")
                                    ->transform(nc::tools::whole(1, 1000000));
  once_flag->excludes(progress_flag);
  latency_option->excludes(once_flag)->excludes(progress_flag);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kExitUsage;
  }
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGHUP, on_signal);
  std::signal(SIGPIPE, SIG_IGN);
  nc::dds::Monitor monitor(options.domain, options.machine);
  std::string error;
  if (!monitor.open(&error) || (options.signals() && !monitor.watch_signals(true, &error))) return failed(error);
  const bool shows_screen = !options.once && !options.json && !options.progress && options.latency == 0;
  int result = 0;
  if (shows_screen) result = full_screen(&monitor, options);
  else if (!wait_for_status(&monitor, options.wait_s)) result = g_signal != 0 ? 0 : nobody(monitor, options);
  else if (options.latency != 0) result = latency(&monitor, options.latency, options.wait_s);
  else if (options.progress) result = progress(&monitor);
  else if (options.once) result = once(&monitor, options);
  else result = json_stream(&monitor);
  if (std::fflush(stdout) != 0) return kExitUsage;
  return g_signal != 0 ? kExitSignal + g_signal : result;
}
