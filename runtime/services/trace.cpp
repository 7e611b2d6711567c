// SPDX-License-Identifier: Apache-2.0
// See trace.hpp.
#include "runtime/services/trace.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <thread>

#include "runtime/share/text.hpp"

namespace nc::rt::services {
namespace {

constexpr double kStandardRows = 1000;
constexpr auto kPatience = std::chrono::milliseconds(500);  // within which the scan gives a recording back
// In the order of trace::When.
constexpr const char* kWhens[] = {"", "rise", "fall", "change", "high", "low"};
// In the order of trace::State.
constexpr const char* kStates[] = {"waiting", "recording", "complete", "stopped"};

}  // namespace

// Signals and points. The devices of the ladder are a hundred thousand, and everybody knows their names.
Outcome TraceDesk::list_signals(const Call& call) const {
  const std::vector<Signal>& signals = runtime_.signals()->signals();
  const hal::PointTable& points = runtime_.config().points;
  const auto from = static_cast<std::size_t>(call.value_or(Field::kFrom, 0)), count = static_cast<std::size_t>(call.value_or(Field::kCount, kWholePage));
  const std::size_t all = signals.size() + points.size();
  Json list = Json::array();
  std::size_t i = from;
  for (; i < all && list.size() < count; ++i) {
    if (i < signals.size()) {
      list.push_back({{"name", signals[i].name}, {"type", ladder::type_name(signals[i].row->type)}, {"meaning", signals[i].row->meaning}});
      continue;
    }
    const hal::Point& point = points.at(static_cast<unsigned>(i - signals.size()));
    list.push_back({{"name", point.name}, {"type", ladder::type_name(point.type == hal::PointType::kBit ? ladder::DeviceType::kBit : ladder::DeviceType::kWord32)}, {"meaning", point.meaning}});
  }
  return Outcome::with({{"signals", std::move(list)}, {"next", i < all ? i : 0}});
}

bool TraceDesk::read_plan(const Call& call, trace::Plan* plan, Outcome* outcome) const {
  const auto bad = [outcome](Refused why, std::string text) {
    *outcome = Outcome::refused(why, std::move(text));
    return false;
  };
  const std::vector<std::string>& names = call.list(Field::kSignals);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) != names.begin() + static_cast<std::ptrdiff_t>(i))
      return bad(Refused::kMalformed, "\"" + names[i] + "\" stands twice among the signals");
    trace::Source source;
    if (!runtime_.trace()->find(names[i], &source)) return bad(Refused::kNotFound, "there is no signal, point or device \"" + names[i] + "\"");
    plan->sources.push_back(source);
  }
  plan->rows = static_cast<std::uint32_t>(call.value_or(Field::kSamples, kStandardRows));
  plan->before = static_cast<std::uint32_t>(call.value_or(Field::kBefore, 0));
  plan->level = static_cast<std::int32_t>(call.value_or(Field::kLevel, 1));
  if (!call.has(Field::kTrigger)) {
    for (const Field field : {Field::kWhen, Field::kLevel, Field::kBefore})
      if (call.has(field)) return bad(Refused::kMalformed, std::string(row_of(field).name) + " needs a trigger");
  } else {
    const auto trigger = std::find(names.begin(), names.end(), call.words(Field::kTrigger));
    if (trigger == names.end()) return bad(Refused::kMalformed, "the trigger must be one of the signals");
    plan->trigger = static_cast<std::uint32_t>(trigger - names.begin());
    const std::string when = call.has(Field::kWhen) ? call.words(Field::kWhen) : "rise";
    const auto* const known = std::find(std::begin(kWhens) + 1, std::end(kWhens), when);
    if (known == std::end(kWhens)) return bad(Refused::kMalformed, "when must be rise, fall, change, high or low");
    plan->when = static_cast<trace::When>(known - std::begin(kWhens));
    if (plan->when == trace::When::kChange && call.has(Field::kLevel)) return bad(Refused::kMalformed, "a change has no level");
  }
  const std::uint32_t most = trace::most_rows(names.size());
  if (plan->rows > most) return bad(Refused::kMalformed, "samples must be at most " + std::to_string(most) + " with so many signals");
  if (plan->before >= plan->rows) return bad(Refused::kMalformed, "before must be less than samples");
  if (const std::string fault = trace::plan_fault(*plan); !fault.empty()) return bad(Refused::kMalformed, fault);
  return true;
}

Outcome TraceDesk::arm(const Call& call, const std::string& user, const std::string& client) {
  trace::Plan plan;
  Outcome outcome;
  if (!read_plan(call, &plan, &outcome)) return outcome;
  if (!runtime_.trace()->arm(std::move(plan))) return Outcome::refused(Refused::kBusy, "recording " + std::to_string(number_) + " of " + user_ + " is going on: trace.stop ends it");
  ++number_;
  names_ = call.list(Field::kSignals);
  trigger_ = call.words(Field::kTrigger);
  user_ = user;
  client_ = client;
  return Outcome::with({{"recording", number_}});
}

Outcome TraceDesk::stop() {
  trace::TraceTap& tap = *runtime_.trace();
  if (!tap.is_recording()) return Outcome::refused(Refused::kState, "nothing is being recorded");
  tap.stop();
  const auto give_up = std::chrono::steady_clock::now() + kPatience;
  while (tap.is_recording()) {
    if (std::chrono::steady_clock::now() > give_up) return Outcome::refused(Refused::kNotReached, "the scan does not run: the recording ends with its next run");
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return Outcome::done();
}

// The time of day of something that the scan has stamped; 0 on virtual time, which has none.
std::int64_t TraceDesk::time_of_day(std::int64_t scan_time_ns) const { return runtime_.running() ? share::wall_ns() - RealClock().now_ns() + scan_time_ns : 0; }

Outcome TraceDesk::status() const {
  const trace::TraceTap& tap = *runtime_.trace();
  // Asked first: when it is false everything below stands still.
  const bool going_on = tap.is_recording();
  const trace::Recording* recording = tap.recording();
  if (recording == nullptr) return Outcome::with({{"recording", 0}, {"state", "none"}});
  const trace::Plan& plan = recording->plan();
  Json reply = {{"recording", number_},
                {"state", kStates[static_cast<unsigned>(recording->state())]},
                {"user", user_},
                {"client", client_},
                {"signals", names_},
                {"trigger", trigger_},
                {"when", kWhens[static_cast<unsigned>(plan.when)]},
                {"level", plan.level},
                {"samples", plan.rows},
                {"before", plan.before},
                {"recorded", recording->progress()},
                {"cycle_us", runtime_.config().cycle_us}};
  if (going_on) {
    // It may have ended since it was asked for; its rows are the scan's until they are asked for again.
    if (recording->state() > trace::State::kRecording) reply["state"] = kStates[static_cast<unsigned>(trace::State::kRecording)];
    return Outcome::with(std::move(reply));
  }
  reply["recorded"] = recording->row_count();
  reply["triggered"] = recording->triggered();
  reply["trigger_row"] = recording->trigger_row();
  reply["trigger_ns"] = recording->row_count() == 0 ? 0 : time_of_day(recording->at(recording->trigger_row()).time_ns);
  return Outcome::with(std::move(reply));
}

Outcome TraceDesk::read(const Call& call) const {
  const trace::TraceTap& tap = *runtime_.trace();
  if (number_ == 0 || call.value(Field::kRecording) != number_) return Outcome::refused(Refused::kNotFound, "there is no such recording any more");
  if (tap.is_recording()) return Outcome::refused(Refused::kState, "the recording has not ended");
  const trace::Recording& recording = *tap.recording();
  const auto from = static_cast<std::uint32_t>(call.value_or(Field::kFrom, 0)), count = static_cast<std::uint32_t>(call.value_or(Field::kCount, kWholePage));
  const std::int64_t begin_ns = recording.row_count() == 0 ? 0 : recording.at(recording.trigger_row()).time_ns;
  Json rows = Json::array();
  std::uint32_t row = from;
  for (; row < recording.row_count() && rows.size() < count; ++row) {
    const trace::Recording::Row at = recording.at(row);
    rows.push_back({{"scan", at.scan},
                    {"time_s", static_cast<double>(at.time_ns - begin_ns) * 1e-9},
                    {"values", std::vector<std::int32_t>(at.values, at.values + recording.plan().sources.size())}});
  }
  return Outcome::with({{"rows", std::move(rows)}, {"next", row < recording.row_count() ? row : 0}});
}

}  // namespace nc::rt::services
