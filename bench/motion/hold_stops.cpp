// SPDX-License-Identifier: Apache-2.0
// How long after a feed hold the axes stand, compared with an ideal stop: from the cycle of the hold on the machine is thought to go straight on
// along the tangent of the path, and to stop there as fast as the limits of the axes allow, from the speed and the acceleration that it has.
// No stop along a bent path is shorter than that. The difference is what the path and the control add to a hold.
//
//   hold_stops [--every CYCLES] [--at CYCLE] [--at CYCLE] [--look-ahead RECORDS] [--limits V,A,J] [--tolerance MM] [--worst N] [--list] [--write DIR] PROGRAM.nc ...
//
// Each program runs once, with a call of nc_feed in each cycle. In every tenth cycle (--every) in which it moves the process forks, and the
// copy presses feed hold and counts the cycles until the axes stand (--at: in that cycle alone). So each hold begins from the motion of an undisturbed program.
// Standard output: for each program the number of holds, then of the difference in ms the median, the value that 95 % do not exceed, the worst
// and the share above 20 ms; then median, 95 % and worst once more, of the time beyond what the slowest axis alone needs; then the worst hold.
// The last row is for all programs. Exit status: 0; 1 after a message.
// --write: for best_stop.py, of each hold that is later than 20 ms a file of that directory, PROGRAM_CYCLE.hold: a line with the limits and the time of
// a cycle, one with the time in ms that the stop took and that of the ideal one, and then the positions of each cycle without a hold, from the two
// in front of the hold on; behind a line "held" those of the stop, from the cycle of the hold on.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "nc/nc.h"

namespace {

constexpr unsigned kAxes = 3;
constexpr uint32_t kBudget = 1000;      // blocks per call of nc_feed
constexpr long kMostCycles = 5000;      // after a hold the axes must stand within so many
constexpr long kMostProgram = 2000000;  // a program must end within so many cycles
constexpr double kLate = 20;            // ms: the table gives the share of the holds that are later than this
constexpr long kWritten = 600;          // cycles of the motion without the hold
constexpr double kMoves = 1e-3;         // mm/s: below that the axes as good as stand, and a hold says nothing

struct Options {
  long every = 10, at = 0;  // at: the only cycle of a hold
  uint32_t look_ahead = 4096;
  double velocity = 250, acceleration = 2000, jerk = 50000, tolerance = 0.01;
  size_t worst = 0;
  bool list = false;
  std::string write;  // where the holds go that are late; empty: nowhere
  std::vector<std::string> programs;
};

struct Hold {
  long cycle = 0;
  double ideal_s = 0, axes_s = 0, took_s = 0, speed = 0;
  bool stood = false;
  std::string program;
  double late_ms() const { return 1e3 * (took_s - ideal_s); }
  double late_of_axes_ms() const { return 1e3 * (took_s - std::max(axes_s, ideal_s)); }
};

struct FreeAligned {
  void operator()(void* p) const { std::free(p); }
};

// The shortest time in which speed v and acceleration a come to 0, wherever that is: the acceleration goes with the full jerk to a peak,
// stays there for a while if the peak is its limit, `most`, and goes back to 0 with the full jerk.
double to_rest(double v, double a, double most, double jerk) {
  const double sign = v + a * std::fabs(a) / (2 * jerk) > 0 ? -1 : 1, from = sign * a, change = -sign * v;  // the speed that is to be gained
  double peak = std::sqrt(std::max(0.0, jerk * change + 0.5 * from * from)), stays = 0;
  if (peak > most) {
    peak = std::max(most, from);
    stays = std::max(0.0, change / peak - (2 * peak * peak - from * from) / (2 * jerk * peak));
  }
  return (2 * peak - from) / jerk + stays;
}

// A control in memory of its own, in the time-optimal mode, with drives that follow at once.
class Machine {
 public:
  explicit Machine(const Options& options) {
    nc_config_init(&config_);
    for (unsigned i = 0; i < kAxes; ++i) {
      nc_axis_config& axis = config_.system[0].axis[i];
      axis.max_velocity = options.velocity;
      axis.max_acceleration = options.acceleration;
      axis.max_jerk = options.jerk;
      axis.in_position = 0.01;
    }
    config_.motion_mode = NC_MOTION_OPTIMAL;
    config_.path_tolerance = options.tolerance;
    config_.look_ahead = options.look_ahead;
    const size_t size = (nc_memory_required(&config_) + 63) / 64 * 64;
    memory_.reset(std::aligned_alloc(64, size));
    nc_status status = NC_E_MEMORY;
    control_ = memory_ ? nc_create(&config_, memory_.get(), size, &status) : nullptr;
    nc_inputs_init(&in_);
    nc_outputs_init(&out_);
    in_.actual_valid = true;
    in_.cycle_start = true;
  }
  bool select(const std::string& text) {
    unsigned file = 0;
    return control_ != nullptr && nc_program_add_text(control_, "PART", text.data(), text.size(), &file) == NC_OK &&
           nc_program_select(control_, 0, file) == NC_OK;
  }
  bool cycle() {
    nc_feed(control_, kBudget);
    if (nc_cycle(control_, &in_, &out_) != NC_OK) return false;
    in_.fin = out_.strobe != 0;
    in_.actual = out_.command;
    in_.spindle[0].rev_per_s = out_.s / 60;  // it has the speed of its S command at once
    for (unsigned n = 3; n > 0; --n) std::copy_n(place_[n - 1], kAxes, place_[n]);
    std::copy_n(out_.command.v, kAxes, place_[0]);
    return true;
  }
  void hold() { in_.feed_hold = true; }
  const double* place(unsigned cycles_ago) const { return place_[cycles_ago]; }
  bool stands() const { return std::equal(place_[0], place_[0] + kAxes, place_[1]); }
  bool ended() const { return out_.state == NC_STATE_IDLE && out_.blocks > 0; }
  bool alarmed() const { return out_.state == NC_STATE_ALARM; }
  bool cuts() const { return out_.state == NC_STATE_RUNNING; }
  double cycle_s() const { return config_.cycle_s; }

  // Duration of the ideal stop along the tangent, in s. Beside it the present speed in mm/s, and in *axes_s the time in s that the slowest axis
  // needs to come to rest, whatever the path.
  double ideal(const Options& options, double* speed, double* axes_s) const {
    const double dt = cycle_s();
    double v[kAxes], size = 0, along = 0;
    for (unsigned i = 0; i < kAxes; ++i) {
      v[i] = (place_[0][i] - place_[1][i]) / dt;
      size += v[i] * v[i];
    }
    *speed = size = std::sqrt(size);
    if (!(size > kMoves)) return 0;
    struct {
      double acceleration = HUGE_VAL, jerk = HUGE_VAL;
    } limits;
    for (unsigned i = 0; i < kAxes; ++i) {
      const double d = v[i] / size, a = (place_[0][i] - 2 * place_[1][i] + place_[2][i]) / (dt * dt);
      along += a * d;
      if (limits.acceleration * std::fabs(d) > options.acceleration) limits.acceleration = options.acceleration / std::fabs(d);
      if (limits.jerk * std::fabs(d) > options.jerk) limits.jerk = options.jerk / std::fabs(d);
    }
    double least = 0;
    for (unsigned i = 0; i < kAxes; ++i)
      least = std::max(least, to_rest(v[i], (place_[0][i] - 2 * place_[1][i] + place_[2][i]) / (dt * dt), options.acceleration, options.jerk));
    *axes_s = least;
    return to_rest(size, along, limits.acceleration, limits.jerk);
  }

 private:
  nc_config config_{};
  std::unique_ptr<void, FreeAligned> memory_;
  nc_control* control_ = nullptr;
  nc_inputs in_{};
  nc_outputs out_{};
  double place_[4][kAxes] = {};  // positions of the last four cycles, the newest first
};

int complain(const std::string& what) {
  std::fprintf(stderr, "hold_stops: %s\n", what.c_str());
  return 1;
}

bool read_file(const std::string& name, std::string* text) {
  std::FILE* in = std::fopen(name.c_str(), "rb");
  if (in == nullptr) return false;
  char part[65536];
  for (size_t n = 0; (n = std::fread(part, 1, sizeof part, in)) > 0;) text->append(part, n);
  const bool read = std::ferror(in) == 0;
  std::fclose(in);
  return read;
}

// Presses feed hold; returns the cycles until the axes stand, -1 if they do not.
long cycles_to_rest(Machine& m) {
  m.hold();
  for (long n = 1; n <= kMostCycles; ++n) {
    if (!m.cycle() || m.alarmed()) return -1;
    if (m.stands()) return n - 1;
  }
  return -1;
}

// Forks: the copy of the process presses feed hold and reports its cycles; the machine of this process stays as it was.
bool hold_in_a_copy(Machine& m, long* cycles) {
  int pipe_of[2];
  if (pipe(pipe_of) != 0) return false;
  const pid_t copy = fork();
  if (copy < 0) return false;
  if (copy == 0) {
    const long n = cycles_to_rest(m);
    _exit(write(pipe_of[1], &n, sizeof n) == static_cast<ssize_t>(sizeof n) ? 0 : 1);
  }
  close(pipe_of[1]);
  const bool got = read(pipe_of[0], cycles, sizeof *cycles) == static_cast<ssize_t>(sizeof *cycles);
  close(pipe_of[0]);
  int status = 0;
  return waitpid(copy, &status, 0) == copy && got;
}

void write_place(std::FILE* out, const double* place) { std::fprintf(out, "%.12f %.12f %.12f\n", place[0], place[1], place[2]); }

// Goes on with a copy of the machine for up to `cycles` and writes where it is in each of them.
bool write_motion(Machine& m, std::FILE* out, bool held, long cycles) {
  std::fflush(out);
  const pid_t copy = fork();
  if (copy < 0) return false;
  if (copy == 0) {
    if (held) m.hold();
    bool goes_on = true;
    for (long n = 0; n < cycles && goes_on; ++n) {
      write_place(out, m.place(0));
      goes_on = !m.ended() && m.cycle() && !m.alarmed();
    }
    _exit(std::fflush(out) == 0 ? 0 : 1);
  }
  int status = 0;
  return waitpid(copy, &status, 0) == copy && status == 0;
}

// What the machine does without the hold, up to the end of the program, and with it, up to rest.
bool write_hold(Machine& m, const Options& options, const Hold& h) {
  std::FILE* out = std::fopen((options.write + "/" + h.program + "_" + std::to_string(h.cycle) + ".hold").c_str(), "w");
  if (out == nullptr) return false;
  std::fprintf(out, "%.9g %.9g %.9g %.9g\n%.9g %.9g\n", options.velocity, options.acceleration, options.jerk, m.cycle_s(), 1e3 * h.took_s, 1e3 * h.ideal_s);
  for (unsigned ago = 2; ago > 0; --ago) write_place(out, m.place(ago));
  bool written = write_motion(m, out, false, kWritten);
  std::fprintf(out, "held\n");
  written = written && write_motion(m, out, true, std::lround(h.took_s / m.cycle_s()) + 1);
  return std::fclose(out) == 0 && written;
}

std::string short_name(const std::string& path) {
  const size_t slash = path.find_last_of('/'), from = slash == std::string::npos ? 0 : slash + 1;
  return path.substr(from, path.find_last_of('.') > from ? path.find_last_of('.') - from : std::string::npos);
}

bool measure(const Options& options, const std::string& program, std::vector<Hold>* holds) {
  std::string text;
  if (!read_file(program, &text)) return complain("cannot read " + program) == 0;
  Machine m(options);
  if (!m.select(text)) return complain(program + ": the control does not take it") == 0;
  for (long n = 1; !m.ended(); ++n) {
    if (!m.cycle() || m.alarmed() || n > kMostProgram) return complain(program + ": does not come to its end, cycle " + std::to_string(n)) == 0;
    if (options.at != 0 ? n != options.at : n % options.every != 0) continue;
    if (!m.cuts()) continue;
    Hold h;
    h.program = short_name(program);
    h.cycle = n;
    h.ideal_s = m.ideal(options, &h.speed, &h.axes_s);
    if (!(h.speed > kMoves)) continue;
    long cycles = 0;
    if (!hold_in_a_copy(m, &cycles)) return complain("a copy of the process could not be made") == 0;
    h.stood = cycles >= 0;
    h.took_s = static_cast<double>(cycles) * m.cycle_s();
    if (!options.write.empty() && h.late_ms() > kLate && !write_hold(m, options, h)) return complain("cannot write to " + options.write) == 0;
    holds->push_back(h);
  }
  return true;
}

// The value in ms that this share of the holds does not exceed.
template <class Late>
double quantile(const std::vector<Hold>& holds, double share, Late&& late) {
  std::vector<double> ms;
  for (const Hold& h : holds) ms.push_back(late(h));
  std::sort(ms.begin(), ms.end());
  return ms[std::min(ms.size() - 1, static_cast<size_t>(share * static_cast<double>(ms.size())))];
}

void print_row(const std::string& name, const std::vector<Hold>& holds) {
  if (holds.empty()) return;
  const auto of_line = [](const Hold& h) { return h.late_ms(); };
  const auto of_axes = [](const Hold& h) { return h.late_of_axes_ms(); };
  const auto never = std::count_if(holds.begin(), holds.end(), [](const Hold& h) { return !h.stood; });
  const auto many = std::count_if(holds.begin(), holds.end(), [](const Hold& h) { return h.late_ms() > kLate; });
  const Hold& worst = *std::max_element(holds.begin(), holds.end(), [](const Hold& a, const Hold& b) { return a.late_ms() < b.late_ms(); });
  std::printf("%-18s %6zu %7.1f %6.1f %6.1f %6.1f %% %8.1f %6.1f %6.1f  %s cycle %ld, %.1f mm/s, %.0f ms of %.1f", name.c_str(), holds.size(), quantile(holds, 0.5, of_line),
              quantile(holds, 0.95, of_line), worst.late_ms(), 100.0 * static_cast<double>(many) / static_cast<double>(holds.size()), quantile(holds, 0.5, of_axes),
              quantile(holds, 0.95, of_axes), quantile(holds, 1, of_axes), worst.program.c_str(), worst.cycle, worst.speed, 1e3 * worst.took_s, 1e3 * worst.ideal_s);
  if (never > 0) std::printf("  %ld DO NOT STAND", static_cast<long>(never));
  std::printf("\n");
}

bool number(const char* text, double* out) {
  char* end = nullptr;
  *out = std::strtod(text, &end);
  return end != text && *end == 0 && *out > 0;
}

bool read_options(int argc, char** argv, Options* o) {
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    const char* value = k + 1 < argc ? argv[k + 1] : "";
    double x = 0;
    if (word == "--list") {
      o->list = true;
    } else if (word == "--limits") {
      if (std::sscanf(value, "%lf,%lf,%lf", &o->velocity, &o->acceleration, &o->jerk) != 3) return false;
      ++k;
    } else if (word == "--write") {
      o->write = value;
      ++k;
    } else if (word.rfind("--", 0) == 0) {
      if (!number(value, &x)) return false;
      if (word == "--at") o->at = static_cast<long>(x);
      else if (word == "--every") o->every = std::max(1L, static_cast<long>(x));
      else if (word == "--look-ahead") o->look_ahead = static_cast<uint32_t>(x);
      else if (word == "--tolerance") o->tolerance = x;
      else if (word == "--worst") o->worst = static_cast<size_t>(x);
      else return false;
      ++k;
    } else {
      o->programs.push_back(word);
    }
  }
  return !o->programs.empty();
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  if (!read_options(argc, argv, &options))
    return complain("[--every CYCLES] [--at CYCLE] [--look-ahead RECORDS] [--limits V,A,J] [--tolerance MM] [--worst N] [--list] [--write DIR] PROGRAM.nc ...");
  std::vector<Hold> all;
  std::printf("%-18s %6s %7s %6s %6s %8s %8s %6s %6s  the worst\n", "program", "holds", "median", "95 %", "worst", "> 20 ms", "median", "95 %", "worst");
  for (const std::string& program : options.programs) {
    std::vector<Hold> holds;
    if (!measure(options, program, &holds)) return 1;
    print_row(short_name(program), holds);
    std::fflush(stdout);
    all.insert(all.end(), holds.begin(), holds.end());
  }
  print_row("all", all);
  std::sort(all.begin(), all.end(), [](const Hold& a, const Hold& b) { return a.late_ms() > b.late_ms(); });
  const size_t shown = options.list ? all.size() : std::min(options.worst, all.size());
  for (size_t k = 0; k < shown; ++k)
    std::printf("%s cycle %ld: %.1f mm/s, %.0f ms, on a line %.1f, late by %.1f\n", all[k].program.c_str(), all[k].cycle, all[k].speed, 1e3 * all[k].took_s,
                1e3 * all[k].ideal_s, all[k].late_ms());
  return 0;
}
