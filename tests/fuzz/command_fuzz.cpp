// SPDX-License-Identifier: Apache-2.0
// Fuzz target: any bytes as commands from the network, with times between them, given to the intake. Whatever they are,
// the machine gets only commands that are in range, from the client that has control, and each of them but a hold once.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <set>
#include <string>

#include "nc/run.h"
#include "runtime/share/intake.hpp"
#include "runtime/share/text.hpp"

namespace {

using namespace nc::rt;
using namespace nc::rt::share;

void must(bool condition) {
  if (!condition) std::abort();
}

// The bytes of the input; 0 after its end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  bool empty() const { return at_ >= size_; }
  std::uint8_t byte() { return at_ < size_ ? data_[at_++] : 0; }
  template <class T>
  T value() {
    T result{};
    const std::size_t count = std::min(sizeof(T), size_ - std::min(at_, size_));
    std::memcpy(&result, data_ + at_, count);
    at_ += count;
    return result;
  }
  // Mostly small numbers, so that many commands are accepted; sometimes any number.
  std::uint32_t number() {
    const std::uint8_t b = byte();
    return b < 0xf0 ? b & 0x0fu : value<std::uint32_t>();
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

struct FuzzMachine final : Machine {
  State now;
  std::string client;     // client whose command is being handled
  std::string control;    // who had control before
  bool only_stop = false; // nothing but the end of a jog may come
  std::uint64_t executed = 0;
  Answer answer = Answer::kDone;
  State state() override { return now; }
  Answer execute(const Command& c) override {
    must(std::isfinite(c.value) && (c.system < now.system_count || (c.system == kAllSystems && takes_all_systems(c.kind))));
    if (c.kind == CommandKind::kJog) must(c.axis < now.axis_count[c.system] && std::abs(c.value) <= 1e6);
    if (c.kind == CommandKind::kApproach) must(c.axis < now.axis_count[c.system] && c.value >= 0 && c.value <= 1e6);
    if (c.kind == CommandKind::kFeedOverride) must(c.value >= 0 && c.value <= now.max_feed_override);
    if (c.kind == CommandKind::kRapidOverride) must(c.value >= 0 && c.value <= 1);
    if (c.kind == CommandKind::kSetMode) must(c.number <= 2);
    const bool stops = c.kind == CommandKind::kFeedHold || (c.kind == CommandKind::kJog && c.value == 0);
    must(stops || (!only_stop && !control.empty() && control == client));
    if (!(c.kind == CommandKind::kJog && c.value == 0)) ++executed;
    return answer;
  }
  Answer force(const std::string& device, std::int64_t value) override {
    must(!only_stop && control == client && !device.empty() && device.size() <= 64);
    must(value >= -2147483648LL && value <= 4294967295LL);
    ++executed;
    return answer;
  }
  Answer write_device(const std::string& device, std::int64_t value) override { return force(device, value); }
  Answer find_restart(unsigned system, const RestartWish& wish) override {
    must(!only_stop && control == client && system < now.system_count && wish.by < RestartBy::kCount && wish.number <= 9007199254740992ull);
    must(wish.file.find('/') == std::string::npos);
    ++executed;
    return answer;
  }
  Answer release(const std::string& device) override {
    must(!only_stop && control == client && device.size() <= 64);
    ++executed;
    return answer;
  }
  Answer load_mdi(unsigned system, const std::string& blocks) override {
    must(!only_stop && control == client && system < now.system_count && blocks.size() > 1 && blocks.size() <= kMdiText);
    for (const char c : blocks) must(static_cast<unsigned char>(c) >= ' ' || c == '\n' || c == '\r' || c == '\t');
    ++executed;
    return answer;
  }
  Answer select_program(unsigned system, const std::string& file) override {
    must(!only_stop && control == client && system < now.system_count && !file.empty() && file[0] != '.');
    must(file.find('/') == std::string::npos);
    ++executed;
    return answer;
  }
};

Request read_request(Bytes* in, std::int64_t now_ns) {
  Request r{};
  const std::uint8_t shape = in->byte();
  r.kind = in->number();
  if (shape & 1) r.client = in->value<Text<32>>();
  else set_text(&r.client, std::string(1, static_cast<char>('a' + in->byte() % 20)));
  r.sequence = shape & 2 ? in->value<std::uint64_t>() : in->byte();
  r.writer = in->byte() % 4;
  r.issued_ns = shape & 4 ? in->value<std::int64_t>() : now_ns;
  r.lifespan_ms = shape & 8 ? in->value<std::uint32_t>() : 1000;
  r.lease_ms = shape & 16 ? in->value<std::uint32_t>() : 0;
  r.expected_mode = shape & 32 ? static_cast<std::int32_t>(in->number() - 2u) : kAny;
  r.expected_run_state = shape & 64 ? static_cast<std::int32_t>(in->number() - 2u) : kAny;
  r.system = in->number() & (shape & 128 ? ~0u : 1u);
  r.axis = in->number();
  r.number = in->number();
  r.value = shape & 128 ? in->value<double>() : in->byte() / 100.0 - 0.5;
  if (shape & 32) set_text(&r.expected_program, in->byte() & 1 ? "part.nc" : "other.nc");
  const std::uint32_t length = in->number();
  for (std::uint32_t i = 0; i < length && i < r.text.size() && !in->empty(); ++i)
    r.text[i] = static_cast<char>(in->byte());
  return r;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes in(data, size);
  FuzzMachine machine;
  machine.now.system_count = 1 + in.byte() % 2;
  machine.now.axis_count = {3, 2, 0, 0};
  machine.now.program[0] = "part.nc";
  Intake intake(&machine);
  std::int64_t now_ns = 1'700'000'000'000'000'000;
  std::set<std::pair<std::string, std::uint64_t>> done;  // commands that were executed, of clients that are alive
  std::vector<Ack> acks;
  while (!in.empty()) {
    const std::uint8_t step = in.byte();
    now_ns += std::int64_t{step} * step * 100'000;  // up to 6.5 s
    machine.now.mode = static_cast<Mode>(in.byte() % 3);
    machine.now.run_state[0] = in.byte() % 6;
    machine.now.alarmed = step % 7 == 0;
    machine.answer = step % 5 == 0 ? Answer::kRefusedByControl : Answer::kDone;
    acks.clear();
    machine.only_stop = true;
    intake.tick(now_ns, &acks);
    for (const Ack& ack : acks) must(is_ended(ack.client) && is_ended(ack.text));
    machine.only_stop = false;
    const Request request = read_request(&in, now_ns);
    machine.client = text_of(request.client);
    machine.control = intake.controlling();
    const std::uint64_t before = machine.executed;
    acks.clear();
    intake.take(request, now_ns, &acks);
    must(acks.size() <= 1 && machine.executed <= before + 1);
    for (const Ack& ack : acks) {
      must(ack.sequence == request.sequence && text_of(ack.client) == machine.client);
      must(ack.state < static_cast<std::uint32_t>(AckState::kCount) && is_ended(ack.text));
      if (ack.repeated != 0) must(machine.executed == before);
    }
    const auto kind = static_cast<RequestKind>(request.kind);
    if (kind == RequestKind::kClientGone || kind == RequestKind::kGatewayBegan || step > 240) done.clear();
    // A hold of a client without a place is remembered nowhere, and may be executed again: it stops what stands already.
    if (machine.executed > before && kind != RequestKind::kFeedHold) must(done.insert({machine.client, request.sequence}).second);
  }
  return 0;
}
