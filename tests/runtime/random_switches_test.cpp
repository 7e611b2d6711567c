// SPDX-License-Identifier: Apache-2.0
// An operator who turns the switches of a machine at any scan of a program that runs, in cycles, threads and taps, too: dry run, machine lock of all axes and of one, auxiliary lock, manual absolute,
// interlocks of the machine, of an axis and of a direction, codes of the overrides, FIN by group, feed hold, single block; and who jogs, steps, turns a wheel, changes
// the mode, starts and resets. In every scan: no drive is given more than its axis may do, a locked one stands, and what is held or interlocked comes to rest and
// stays there. When everything is let go the program ends where it is written.
#include <map>
#include <random>

#include "support/seeds.hpp"
#include "switch_machine.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::rt::Mode;

// Signals that let the machine go while they are 1.
const char* const kLetsGo[] = {"feed_hold_n", "interlock_n", "interlock_p_n.X", "interlock_m_n.X", "interlock_p_n.Y", "interlock_m_n.Y", "interlock_p_n.Z", "interlock_m_n.Z", "manual_absolute_n"};
const char* const kWords[] = {"feed_override", "rapid_override"};
const char* const kSwitches[] = {"machine_lock", "axis_lock.X", "axis_lock.Z", "auxiliary_lock", "dry_run", "jog_rapid", "single_block", "mfin", "sfin", "tfin"};
constexpr int kStopScans = 500;  // within these every path comes to rest, of 200 mm/s, 1000 mm/s2, with jerk ...
constexpr int kThreadScans = 3000;  // ... and a thread or a tap, which is not stopped, comes to its end

class RandomSwitches : public nc::test::SwitchMachine {
 protected:
  void SetUp() override { fin_timeout_s = 0; }

  void begin(std::uint64_t seed) {
    random.seed(seed);
    std::string points;
    more_signals.clear();
    const auto wire = [&](const char* signal, const char* rest) {
      points += "[[point]]\nname = \"" + point_of(signal) + "\"\ndirection = \"input\"\n" + rest;
      more_signals += std::string("\"plc.") + signal + "\" = \"" + point_of(signal) + "\"\n";
    };
    for (const char* signal : kLetsGo) wire(signal, "initial = 1\n");
    for (const char* signal : kWords) wire(signal, "type = \"word\"\ninitial = 10000\n");
    build(std::string(below(2) == 0 ? "[motion]\nmode = \"trapezoid\"\n" : "") + points);
    for (const char* signal : kLetsGo) on_[signal] = 1;
    for (const char* signal : kSwitches) on_[signal] = 0;
    for (auto& scans : off_for_) scans.second = 0;
    shifts_ = below(3) == 0;
    threads_ = below(2) == 0;
    stop_scans_ = threads_ ? kThreadScans : kStopScans;
    jogged_ = false;
    known_ = 0;
    put("jog_feed", 1200);
    select(program());
  }

  unsigned below(unsigned n) { return static_cast<unsigned>(random() % n); }
  void put(const std::string& signal, std::uint32_t value) {
    turn(signal, value);
    on_[signal] = value;
    if (log_) std::printf("  %s = %u\n", signal.c_str(), value);
  }

  // It ends with all axes in absolute words.
  std::string program() {
    std::string text = "G90 G54 G17 G21 G94 F" + std::to_string(500 + below(8000)) + "\n";
    const auto place = [this] { return std::to_string(static_cast<int>(below(80)) - 40) + "."; };
    for (unsigned n = 6 + below(10); n > 0; --n) switch (below(threads_ ? 15 : 12)) {
        case 0: text += "G90 G0 X" + place() + " Y" + place() + "\n"; break;
        case 1: text += "G90 G0 Z" + place() + "\n"; break;
        case 2:
        case 3: text += "G90 G1 X" + place() + " Y" + place() + " Z" + place() + "\n"; break;
        case 4: text += "G91 G1 X" + std::to_string(static_cast<int>(below(20)) - 10) + ". Y3.\n"; break;
        case 5: text += "G91 G2 X5. Y5. I5. J0\nG90\n"; break;
        case 6: text += "M8 S" + std::to_string(100 + below(900)) + "\n"; break;
        case 7: text += "T" + std::to_string(1 + below(9)) + " M6\n"; break;
        case 8: text += "G4 P" + std::to_string(below(200)) + "\n"; break;
        case 9: text += "G90 G" + std::string(below(2) == 0 ? "98" : "99") + " G81 X" + place() + " Y" + place() + " Z-15. R-5. F" + std::to_string(1000 + below(5000)) + "\nX" + place() + "\nG80\n"; break;
        case 10: text += "G91 G83 X4. Y-2. Z-9. R-3. Q2.5 F3000 L2\nG80 G90\n"; break;
        case 11: text += "G91 G1 X5. ,R1.\nY4.\nX-3.\nG90\n"; break;
        case 12:
        case 13: text += "S2000 M3\nG4 X0.1\nG91 G33 Z-" + std::to_string(4 + below(8)) + ". F1.5\nG90 G0 Z2.\nM5\n"; break;
        case 14: text += "G90 G84 X" + place() + " Y" + place() + " Z-8. R-2. S1500 F1. ,R1\nG80\n"; break;
      }
    text += "G90 G1 X7. Y-3. Z2.\nM30\n";
    lines_ = static_cast<std::uint32_t>(std::count(text.begin(), text.end(), '\n'));
    return text;
  }

  void do_anything() {
    const unsigned what = below(14);
    if (log_) std::printf("  does %u\n", what);
    switch (what) {
      case 0:
      case 1:
      case 2: flip(kLetsGo[below(std::size(kLetsGo))]); break;
      case 3:
      case 4: flip(kSwitches[below(std::size(kSwitches))]); break;
      case 5: put("feed_override", below(3) == 0 ? 65535 : 100 * below(200)); break;  // 65535: the code
      case 6: put("rapid_override", 100 * below(101)); break;
      case 7: put("feed_code." + std::to_string(1 + below(5)), below(2)); break;
      case 8: put("jog_feed", below(5) == 0 ? 0 : 60 * below(200)); break;
      case 9: begin_jog(); break;
      case 10: put("handle.Z", on_["handle.Z"] + below(30)); break;
      case 11: (void)mode(below(2) == 0 ? Mode::kManual : Mode::kAuto); break;
      case 12: press_start(); break;
      case 13:
        if (below(3) == 0) (void)runtime->execute(CommandKind::kReset);
        else hal->machine.hold_fin(below(3) == 0);
        break;
    }
  }
  void flip(const std::string& signal) {
    if (signal.find("lock") != std::string::npos && signal[0] != 'i' && on_[signal] == 0 && below(3) != 0) return;  // a lock that has moved an axis needs a reset
    if (signal == "manual_absolute_n" && !shifts_) return;
    put(signal, on_[signal] ^ 1u);
  }
  void begin_jog() {
    const unsigned axis = below(3);
    const double by = static_cast<double>(below(200)) - 100;
    (void)mode(Mode::kManual);
    if (below(2) == 0) {
      jogged_ |= ask(CommandKind::kStep, axis, by / 20) == Answer::kDone;
      return;
    }
    jog_axis_ = axis;
    jog_velocity_ = by;
    jog_left_ = 1 + below(400);
  }
  void press_start() {
    lead_back();
    if (HasFatalFailure()) return;
    if (mode(Mode::kAuto) == Answer::kDone) (void)runtime->execute(CommandKind::kCycleStart);
  }

  // Axes that were moved in a feed hold come back to the path, as far as the switches let them.
  void lead_back() {
    if (out().restart_axes == 0 || mode(Mode::kManual) != Answer::kDone) return;
    put("handle.Z", 0);  // the hand leaves the wheel
    for (unsigned axis = 0; axis < 3; ++axis) {
      (void)ask(CommandKind::kJog, axis, 0);
      for (int n = 0; n < 100 && !HasFatalFailure(); ++n) judged_scan();
      for (int n = 0; n < 10000 && (out().restart_axes >> axis & 1u) != 0; ++n) {
        if (n % 50 == 0 && ask(CommandKind::kApproach, axis, 40) != Answer::kDone) break;
        judged_scan();
        if (HasFatalFailure()) return;
      }
      (void)ask(CommandKind::kJog, axis, 0);
      if (HasFatalFailure()) return;
    }
    for (int n = 0; n < 100 && !HasFatalFailure(); ++n) judged_scan();
  }

  void scan() {
    if (jog_left_ > 0 && --jog_left_ % 50 == 0) jogged_ |= ask(CommandKind::kJog, jog_axis_, jog_left_ == 0 ? 0 : jog_velocity_) == Answer::kDone;
    runtime->step();
    if (log_) std::printf("scan state %d cause %d line %u v %.3f %.3f %.3f at %.4f %.4f %.4f %s\n", int{out().state}, int{out().cause}, out().source.line, out().velocity.v[0], out().velocity.v[1], out().velocity.v[2], drive(0), drive(1), drive(2), alarm().c_str());
  }

  // Every command that the drives were given since the last look; requests of the operator take scans, too.
  void judge() {
    for (const nc::hal::SystemCommand& given : hal->all) judge(given);
    hal->all.clear();
    if (HasFatalFailure()) return;
    const std::uint32_t locked = flags().locked;
    if (flags().beside == 0 && locked == 0) {
      for (unsigned a = 0; a < 3; ++a) ASSERT_NEAR(drive(a), counted(a), 1e-9) << "axis " << a << " is not where it is shown";
    }
  }
  void judge(const nc::hal::SystemCommand& given) {
    for (const auto& [signal, value] : on_) off_for_[signal] = value == 0 ? off_for_[signal] + 1 : 0;
    const double cycle = config.nc.cycle_s;
    const std::uint32_t locked = flags().locked & locked_;
    locked_ = flags().locked;
    for (unsigned a = 0; a < 3; ++a) {
      const nc_axis_config& axis = config.nc.system[0].axis[a];
      const std::string name(1, axis.name);
      const double velocity = known_ >= 1 ? (given.position.v[a] - at_[a]) / cycle : 0, change = known_ >= 2 ? (velocity - velocity_[a]) / cycle : 0;
      const double least = 1e-9 / cycle;
      ASSERT_LE(std::abs(velocity), axis.max_velocity * 1.001) << name;
      ASSERT_LE(std::abs(change), axis.max_acceleration * 1.01) << name;
      ASSERT_NEAR((locked >> a & 1u) != 0 ? velocity : 0, 0, least) << name << " is locked";
      follow_interlock(a, 0, off_long("interlock_p_n." + name) && velocity > least);
      follow_interlock(a, 1, off_long("interlock_m_n." + name) && velocity < -least);
      if (HasFatalFailure()) return;
      for (const char* all : {"feed_hold_n", "interlock_n"}) ASSERT_NEAR(off_long(all) ? velocity : 0, 0, least) << name << " moves at " << all;
      at_[a] = given.position.v[a];
      velocity_[a] = velocity;
      moved_ += velocity != 0;
    }
    known_ = std::min(known_ + 1, 2);
  }

  // By hand nothing goes there. A path whose axis turns into the direction comes to rest.
  void follow_interlock(unsigned a, unsigned side, bool goes) {
    int& scans = goes_[a][side];
    scans = goes ? scans + 1 : 0;
    ASSERT_LE(scans, out().state == NC_STATE_MANUAL ? 0 : stop_scans_) << "axis " << a << " is interlocked in " << (side == 0 ? "+" : "-");
  }
  bool off_long(const std::string& signal) { return off_for_[signal] > stop_scans_; }

  // An alarm of a block that begins where a hand has put the axes is the program's: an arc whose ends do not fit, an increment that leads beyond a limit.
  bool alarm_is_of_the_hand() const { return jogged_ && (alarm().rfind("P7", 0) == 0 || alarm().find("M01") != std::string::npos); }

  void let_everything_go() {
    jog_left_ = 0;
    (void)ask(CommandKind::kJog, jog_axis_, 0);
    for (const char* signal : kLetsGo) put(signal, 1);
    for (const char* signal : kSwitches) put(signal, 0);
    for (unsigned n = 1; n <= 5; ++n) put("feed_code." + std::to_string(n), 0);
    for (const char* signal : kWords) put(signal, 10000);
    hal->machine.hold_fin(false);
  }

  void judged_scan() {
    scan();
    judge();
  }

  // Where the last move is still to come it ends where it is written, whatever has been moved by hand before.
  void comes_to_its_end() {
    let_everything_go();
    for (int n = 0; n < 1000 && !HasFatalFailure(); ++n) judged_scan();
    if (HasFatalFailure()) return;
    give_up_what_cannot_go_on();
    const bool ahead = out().state == NC_STATE_IDLE || out().source.line + 2 < lines_;
    run_to_end(ahead);
    if (HasFatalFailure()) return;
    give_up_what_cannot_go_on();
    run_to_end(true);
  }
  void give_up_what_cannot_go_on() {
    EXPECT_TRUE(alarm().empty() || alarm_is_of_the_hand()) << alarm();
    if (alarm().empty() && flags().beside == 0) return;
    reset();
    hal->all.clear();
    known_ = 0;
    jogged_ = false;
  }
  void run_to_end(bool to_the_place) {
    const std::uint64_t runs = runtime->info().system[0].runs;
    for (int n = 0; n < 60000 && runtime->info().system[0].runs == runs && alarm().empty(); ++n) {
      if (n % 3000 == 0) press_start();
      judged_scan();
      if (HasFatalFailure()) return;
    }
    EXPECT_TRUE(alarm().empty() || alarm_is_of_the_hand()) << alarm();
    if (!alarm().empty()) return;
    ASSERT_EQ(runtime->info().system[0].runs, runs + 1) << "state " << int{out().state} << " cause " << int{out().cause} << " "
                                                        << nc::rt::refusal_text(config, 0, runtime->snapshot().system[0].refusal);
    ++ended_;
    constexpr double kEnd[] = {7, -3, 2};
    // A lock stays in force until the machine is at rest between two blocks, which may be at the end.
    for (unsigned a = 0; a < 3 && to_the_place && flags().beside == 0 && !shifts_; ++a) EXPECT_NEAR(drive(a), kEnd[a], 1e-6) << "axis " << a;
  }

  std::mt19937_64 random;
  std::uint64_t moved_ = 0, ended_ = 0, ran_ = 0, were_locked_ = 0, by_hand_ = 0;

 private:
  std::map<std::string, std::uint32_t> on_;
  std::map<std::string, int> off_for_;  // scans for which it has been 0
  bool shifts_ = false, jogged_ = false, threads_ = false;
  int stop_scans_ = kStopScans;
  std::uint32_t locked_ = 0, lines_ = 0;
  int known_ = 0, goes_[3][2] = {};  // goes_: scans in a row in which an axis has gone where it may not
  double at_[3] = {}, velocity_[3] = {};
  unsigned jog_axis_ = 0, jog_left_ = 0;
  double jog_velocity_ = 0;
  const bool log_ = nc::test::wish("NC_LOG", 0) != 0;
};

TEST_F(RandomSwitches, KeepWhatTheyPromiseInEveryScan) {
  constexpr unsigned kScans = 10000;
  const std::uint64_t first = nc::test::wish("NC_FIRST_SEED", 1), seeds = nc::test::seeds(6, 2);
  for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    begin(seed);
    if (seed % 2 == 0) put("machine_lock", 1);  // at rest it is in force at once, so that some scans are locked in each pair of seeds
    press_start();
    const unsigned seldom = 20 + below(200);
    for (unsigned n = 0; n < kScans; ++n) {
      SCOPED_TRACE("scan " + std::to_string(n));
      if (below(seldom) == 0) do_anything();
      if (below(1000) == 0) press_start();
      scan();
      judge();
      if (HasFatalFailure()) return;
      ran_ += out().state == NC_STATE_RUNNING;
      by_hand_ += out().state == NC_STATE_MANUAL;
      were_locked_ += flags().locked != 0;
      if (alarm().empty()) continue;
      ASSERT_TRUE(alarm_is_of_the_hand()) << alarm();
      reset();
    }
    comes_to_its_end();
    if (HasFatalFailure()) return;
  }
  // A sanitizer's build runs fewer seeds, so that what must have been met is counted by the seed.
  EXPECT_GE(moved_, 200 * seeds);
  EXPECT_GE(ran_, 200 * seeds);
  EXPECT_GE(were_locked_, 100 * seeds);
  EXPECT_GE(ended_, 1u);
  std::printf("%llu ended, %llu scans running, %llu by hand, %llu locked\n", static_cast<unsigned long long>(ended_), static_cast<unsigned long long>(ran_),
              static_cast<unsigned long long>(by_hand_), static_cast<unsigned long long>(were_locked_));
}

}  // namespace
