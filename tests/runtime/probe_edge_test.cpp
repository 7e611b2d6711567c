// SPDX-License-Identifier: Apache-2.0
// A contact on a bus that notes the times of edges ends skip moves: #5061 is where the axes were at the edge, amid two scans, by both laws of motion.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "hal/composite.hpp"
#include "switch_machine.hpp"

namespace {

using nc::hal::Feedback;
using nc::hal::PointImage;

constexpr std::int64_t kScanNs = 1'000'000;
constexpr double kRounding = 0.5e-3 + 1e-6;  // mm: #5061 is a multiple of the input unit

std::int64_t time_of_scan = 0;
std::int64_t scan_time() noexcept { return time_of_scan; }

// The simulated machine, and where its axes were in each scan.
class TracedHal final : public nc::test::WatchedHal {
 public:
  using WatchedHal::WatchedHal;
  void read(Feedback* feedback, PointImage* image) noexcept override {
    WatchedHal::read(feedback, image);
    feedback->system[0].actual_valid = measures;
    time_of_scan += kScanNs;
    const nc_axes& place = measures ? feedback->system[0].actual : given.system[0].position;
    x.push_back(place.v[0]);
    y.push_back(place.v[1]);
  }
  bool measures = true;
  std::vector<double> x, y;  // of scan n at n * kScanNs, counted from 1
};

// A contact as a bus of its own, which closes at a time that the test sets and is seen some scans later, as behind a poll.
class Contact final : public nc::hal::PointBus {
 public:
  bool start(const PointImage&, std::string*) override { return true; }
  void stop() noexcept override {}
  void write(const PointImage&) noexcept override {}
  void read(PointImage*) noexcept override {
    const bool closed = time_of_scan >= closes_ns + seen_after_ns;
    seen_[0] = {0, 0, closed, closed && !closed_, closes_ns};
    closed_ = closed;
  }
  std::span<const nc::hal::ProbeSeen> probes() const noexcept override { return seen_; }
  std::int64_t closes_ns = INT64_MAX / 2, seen_after_ns = 0;

 private:
  nc::hal::ProbeSeen seen_[1];
  bool closed_ = false;
};

// The place between scans, on the cubic through the four around it.
double between(const std::vector<double>& places, std::int64_t ns) {
  const auto n = static_cast<std::size_t>(ns / kScanNs);  // scan n has place n - 1
  const double t = static_cast<double>(ns % kScanNs) / kScanNs;
  const double p0 = places[n - 2], p1 = places[n - 1], p2 = places[n], p3 = places[n + 1];
  return p1 + t * ((p2 - p0) / 2 - (p3 - 3 * p2 + 3 * p1 - p0) / 6 + t * ((p2 - 2 * p1 + p0) / 2 + (t * (p3 - 3 * p2 + 3 * p1 - p0)) / 6));
}

class ProbeEdge : public testing::Test {
 protected:
  void build(bool optimal, bool measures) {
    runtime.reset();
    time_of_scan = 0;
    config = nc::test::parse_or_fail(nc::test::base_toml() + "[motion]\nmode = \"" + (optimal ? "optimal" : "trapezoid") + "\"\n");
    machine = std::make_unique<TracedHal>(config.sim, config.points);
    machine->measures = measures;
    contact = std::make_unique<Contact>();
    hal = std::make_unique<nc::hal::Composite>(machine.get(), std::vector<nc::hal::PointBus*>{contact.get()}, config.points, scan_time);
    std::vector<nc::rt::ConfigError> errors;
    runtime = nc::rt::Runtime::create(config, {&clock, hal.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr);
    std::string error;
    ASSERT_TRUE(runtime->start_stepping(&error)) << error;
    nc::test::steps_of(*runtime, 2);
  }
  void start(const std::string& source) {
    unsigned file = 0;
    text = source;
    ASSERT_EQ(nc_program_add_text(runtime->control(), "p", text.data(), text.size(), &file), NC_OK);
    ASSERT_EQ(runtime->select_program(file), nc::rt::Answer::kDone);
    ASSERT_EQ(runtime->execute(nc::rt::CommandKind::kCycleStart), nc::rt::Answer::kDone);
  }
  void until_end() {
    const std::uint64_t runs = runtime->info().system[0].runs;
    for (int n = 0; n < 30000; ++n) {
      runtime->step();
      if (runtime->info().system[0].runs > runs && runtime->snapshot().system[0].nc.state == NC_STATE_IDLE) return;
    }
    FAIL() << "no end";
  }
  double variable(std::uint32_t number) { return nc::test::variable_of(*runtime, number, NAN); }

  nc::rt::Config config;
  nc::rt::VirtualClock clock;
  std::string text;
  std::unique_ptr<TracedHal> machine;
  std::unique_ptr<Contact> contact;
  std::unique_ptr<nc::hal::Composite> hal;
  std::unique_ptr<nc::rt::Runtime> runtime;
};

TEST_F(ProbeEdge, TheSkipPositionIsThatOfTheEdge) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> share(0, 1);
  double worst = 0;
  for (const bool optimal : {false, true}) {
    for (const bool measures : {true, false}) {
      for (const double speed : {1.0, 7.0, 30.0, 90.0, 200.0}) {
        for (unsigned n = 0; n < 6; ++n) {
          SCOPED_TRACE(std::string(optimal ? "optimal" : "trapezoid") + (measures ? " measured " : " commanded ") + std::to_string(speed) + " mm/s, " + std::to_string(n));
          build(optimal, measures);
          start("G90 G31 X120. Y60. F" + std::to_string(speed * 60) + "\n#100=#5061\n#101=#5062\nM30\n");
          while (machine->x.back() < 1e-6) runtime->step();
          contact->closes_ns = time_of_scan + static_cast<std::int64_t>((5 + 300 * share(random)) * kScanNs);
          contact->seen_after_ns = static_cast<std::int64_t>(share(random) * 4 * kScanNs);
          until_end();
          const double x = between(machine->x, contact->closes_ns), y = between(machine->y, contact->closes_ns);
          ASSERT_LT(x, 119);
          worst = std::max({worst, std::abs(variable(100) - x), std::abs(variable(101) - y)});
          EXPECT_NEAR(variable(100), x, 2000 * 1e-6 / 8 + kRounding);
          EXPECT_NEAR(variable(101), y, 1500 * 1e-6 / 8 + kRounding);
        }
      }
    }
  }
  RecordProperty("worst_mm", std::to_string(worst));
}

TEST_F(ProbeEdge, AContactThatIsClosedBeforeTheMoveHasThePlaceWhereItBegins) {
  build(false, true);
  contact->closes_ns = 20 * kScanNs + 12345;
  start("G90 G1 X5. F6000\nG4 P200\nG31 X50. F3000\n#100=#5061\nM30\n");
  until_end();
  EXPECT_NEAR(variable(100), 5, 1e-3);
}

}  // namespace
