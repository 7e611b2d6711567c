// SPDX-License-Identifier: Apache-2.0
// The gateway. See gateway.hpp.
#include "dds/gateway.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <set>

#include "runtime/clock.hpp"
#include "runtime/refusal.hpp"
#include "runtime/services/service_table.hpp"
#include "runtime/share/request_table.hpp"
#include "runtime/share/text.hpp"

namespace nc::dds {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kAttachEveryNs = 100 * kMs;
constexpr std::int64_t kLookEveryNs = 50 * kMs;  // interval of looking at the segment when nothing new is published there
constexpr std::int64_t kSignalsNs = 100 * kMs;   // shortest interval between two signal images
constexpr std::int64_t kSignalsForcedNs = 1000 * kMs;
constexpr std::int64_t kClaimEveryNs = 500 * kMs;
constexpr std::int64_t kMissEveryNs = 200 * kMs;
constexpr std::chrono::milliseconds kBothReceive{20};  // far longer than one sample takes from one reader of this process to the next
constexpr int kTaken = 16;
constexpr std::size_t kAnswersWaiting = 256;       // when so many answers wait, or the first one for so long,
constexpr std::int64_t kAnswersPatience = 200 * kMs;  // nobody is waited for any more
constexpr std::int64_t kRoomPatience = 100 * kMs;    // for room among the commands, where one must not be lost
constexpr int kNewestAnswers = 16;                   // of each client, for who does not take them as they come

std::int64_t now() {
  return nc::rt::RealClock().now_ns();
}

// Who may write nc_Command may operate, and DDS does not tell whether he may do more. Devices of the ladder need the right to maintain.
bool needs_maintain(const share::Request& request) {
  const auto* row = rt::services::find_service(static_cast<share::RequestKind>(request.kind));
  return row != nullptr && row->right == Right::kMaintain;
}

}  // namespace

Gateway::Gateway(const GatewayOptions& options)
    : options_(options),
      partition_(share::share_name(options.share)),
      period_ns_(static_cast<std::int64_t>(1e9 / options.rate_hz)),
      history_block_(std::make_unique<share::HistoryBlock>()),
      points_(std::make_unique<share::PointsBlock>()),
      last_points_(std::make_unique<share::PointsBlock>()),
      control_signals_(std::make_unique<share::SignalsBlock>()),
      last_control_signals_(std::make_unique<share::SignalsBlock>()),
      signal_sample_(std::make_unique<SignalSample>()),
      received_(kTaken) {}

Gateway::~Gateway() {
  stop_ = true;
  if (commands_.joinable()) commands_.join();
}

bool Gateway::open(std::string* error) {
  if (!participant_.open(options_.access, error)) return false;
  const double period_s = 1.0 / options_.rate_hz;
  const struct {
    dds_entity_t* writer;
    Topic topic;
  } writers[] = {{&machine_, Topic::kMachineInfo},     {&status_, Topic::kStatus},
                 {&alarm_, Topic::kAlarm},             {&history_, Topic::kAlarmHistory},
                 {&signal_table_, Topic::kSignalTable},
                 {&signals_, Topic::kSignalImage},     {&status_core_, Topic::kStatusCore},
                 {&alarm_core_, Topic::kAlarmCore},    {&ack_, Topic::kCommandAck}};
  for (const auto& entry : writers) {
    if (entry.topic == Topic::kCommandAck && !options_.commands) continue;
    *entry.writer = make_writer(participant_.get(), entry.topic, partition_, period_s, error);
    if (*entry.writer <= 0) return false;
  }
  if (options_.commands && (newest_acks_ = make_writer(participant_.get(), Topic::kCommandAck, partition_, period_s, error, kNewestAnswers)) <= 0) return false;
  if (options_.services) {
    services_ = std::make_unique<ServiceGateway>(partition_, options_.socket);
    services_->set_gate(service_gate());
    if (stands_by_) services_->stand_by();
    if (!services_->open(participant_.get(), error)) return false;
  }
  if (!options_.commands) return true;
  command_ = make_reader(participant_.get(), Topic::kCommand, partition_, error);
  if (command_ <= 0) return false;
  waitset_ = dds_create_waitset(participant_.get());
  const dds_entity_t condition = dds_create_readcondition(command_, DDS_ANY_STATE);
  if (waitset_ <= 0 || condition <= 0 || dds_waitset_attach(waitset_, condition, 0) < 0) {
    *error = "the commands cannot be waited for";
    return false;
  }
  commands_ = std::thread([this] { command_thread(); });
  return true;
}

// Prints a sentence, but not again while it is the same as the last one.
void Gateway::say(const std::string& text) {
  if (text == said_) return;
  said_ = text;
  std::fprintf(stderr, "ncdds: %s\n", text.c_str());
}

bool Gateway::write(dds_entity_t writer, const void* sample) {
  const dds_return_t result = dds_write(writer, sample);
  // A time-out is no error: a reader that does not keep up misses this value and gets the next one.
  if (result < 0 && result != DDS_RETCODE_TIMEOUT) say(std::string("write: ") + dds_strretcode(result));
  return result >= 0;
}

// ---- the segment ----

bool Gateway::attach() {
  if (now() < next_attach_ns_) return false;
  next_attach_ns_ = now() + kAttachEveryNs;
  std::string error;
  const std::lock_guard lock(segment_mutex_);
  if (!segment_.open(options_.share, &error) || segment_.owner_gone()) {
    say("waits: " + (error.empty() ? "the control that made the shared memory is gone" : error));
    segment_.close();
    return false;
  }
  if (options_.commands && stands_by_) another_commands_ = segment_.get()->identity.commands != 0;
  else if (options_.commands && !claim_commands(&error))
    std::fprintf(stderr, "ncdds: warning: no commands: %s%s\n", error.c_str(), passes_services() ? "; the services, and what they command, are passed on all the same" : "");
  if (services_) services_->set_gate(service_gate());
  heart_.restart();
  written_any_ = false;
  history_sequence_ = 0;
  MachineSample machine;
  machine.fill(segment_.get()->machine, partition_.c_str(), may_command_ || another_commands_);
  write(machine_, &machine.info);
  const auto table = std::make_unique<SignalTableSample>();
  table->fill(segment_.get()->machine, partition_.c_str());
  write(signal_table_, &table->table);
  say("publishes \"" + std::string(share::text_of(segment_.get()->machine.machine)) + "\" as " + partition_ +
      " in domain " + std::to_string(options_.access.domain) + (may_command_ ? ", takes commands" : passes_services() ? ", passes services on, and no other commands" : ""));
  return true;
}

// Whether clients of the services may do more than view: they do not need the commands of this gateway.
bool Gateway::passes_services() { return services_ && service_gate().rights.has(Right::kOperate); }

// What clients of the services may do: see all that the services show, and more where commands are on at both ends; with DDS Security each client only what
// its permissions let it write. Without it DDS does not know who asks, so over a network nobody may do anything.
ServiceGate Gateway::service_gate() {
  ServiceGate gate;
  if (options_.access.security.empty() && user_configures()) {
    gate.why = "over a network the services need DDS Security";
    return gate;
  }
  gate.rights.add(Right::kView);
  gate.most = options_.commands ? RightSet::all() : gate.rights;  // not by the control of this moment: a connection may be begun before it is seen here
  gate.by_permissions = !options_.access.security.empty();
  const bool control = segment_.is_open() && segment_.get()->identity.commands != 0;
  gate.why = !options_.commands ? "this gateway lets clients view only: ncdds --commands" : "there is no control that takes commands: commands = true in [share]";
  if (options_.commands && control) gate.rights = RightSet::all();
  return gate;
}

// Tries to become the gateway that passes commands to the control. Only one gateway does that; a second one waits until the first one is gone.
bool Gateway::claim_commands(std::string* error) {
  may_command_ = segment_.claim_commands(error);
  another_commands_ = !may_command_ && segment_.get()->identity.commands != 0;
  next_claim_ns_ = now() + kClaimEveryNs;
  if (!may_command_) return false;
  share::Request began{};
  began.kind = static_cast<std::uint32_t>(share::RequestKind::kGatewayBegan);
  (void)segment_.get()->commands.push(began);
  share::wake(&segment_.get()->wake_intake);
  return true;
}

// The published values are no longer valid. The instances are disposed, so that every subscriber notices it.
void Gateway::detach(const char* why) {
  say(why);
  if (written_any_) {
    const share::MachineBlock& machine = segment_.get()->machine;
    for (unsigned s = 0; s < machine.system_count; ++s) {
      StatusSample sample;
      sample.fill(machine, block_, s, partition_.c_str());
      const nc_Status_v1 core = core_status(machine, block_, s, partition_.c_str());
      (void)dds_writedispose(status_, &sample.status);
      (void)dds_writedispose(status_core_, &core);
    }
  }
  for (const auto& [id, shown] : active_) clear_alarm(shown);
  active_.clear();
  for (std::uint64_t id = 1; id <= history_block_->last_sequence && id <= share::kHistory; ++id) {
    const nc_AlarmHistory old = history(history_block_->entry[id - 1], partition_.c_str());
    (void)dds_writedispose(history_, &old);  // the next control begins with new numbers
  }
  *history_block_ = {};
  const std::lock_guard lock(segment_mutex_);
  may_command_ = another_commands_ = false;
  segment_.close();
  if (services_) services_->set_gate(service_gate());
}

// Looks at the segment once and publishes what is new. False when the control is gone.
bool Gateway::look() {
  const std::int64_t at = now();
  const bool ended =
      segment_.get()->life.load(std::memory_order_acquire) == static_cast<std::uint32_t>(share::Life::kEnded);
  const bool beats = heart_.alive(segment_.get()->heartbeat.load(std::memory_order_acquire), at);
  publish_acks();
  if (another_commands_ && !stands_by_ && at >= next_claim_ns_) {
    const std::lock_guard lock(segment_mutex_);
    std::string error;
    if (claim_commands(&error)) say("takes the commands now: the other gateway is gone");
  }
  if (ended || (beats && at >= next_status_ns_)) {
    if (publish_status(at)) publish_alarms();
    publish_history();
    publish_signals(at);
  }
  if (ended) {
    detach("the control has ended");
    return false;
  }
  if (!beats && segment_.owner_gone()) {
    detach("the control is gone");
    return false;
  }
  if (!beats) say("the control does not answer: its process lives, its heartbeat stands still");
  return true;
}

void Gateway::run() {
  while (!stop_) {
    if (!segment_.is_open() && !attach()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      continue;
    }
    std::atomic<std::uint32_t>* word = &segment_.get()->wake_reader;
    const std::uint32_t seen = word->load(std::memory_order_acquire);
    if (!look()) continue;
    share::wait_for_change(word, seen, kLookEveryNs);
  }
  if (commands_.joinable()) commands_.join();
  // Nothing is disposed, because the control goes on; only this gateway ends.
  const std::lock_guard lock(segment_mutex_);
  segment_.close();
}

// ---- publications ----

bool Gateway::publish_status(std::int64_t now_ns) {
  std::string error;
  if (!segment_.status(&block_, &error)) {
    say(error);
    return false;
  }
  // Each write asserts the liveliness of the topic, so nothing is written while the scan stands still.
  if (written_any_ && block_.scan == written_scan_) return true;
  written_any_ = true;
  written_scan_ = block_.scan;
  // The next status is due up to 5 ms early: the segment is updated every 10 ms, and otherwise the next status would be up to 10 ms late.
  next_status_ns_ = now_ns + period_ns_ - std::min<std::int64_t>(period_ns_ / 2, 5 * kMs);
  const share::MachineBlock& machine = segment_.get()->machine;
  for (unsigned s = 0; s < block_.system_count; ++s) {
    StatusSample sample;
    sample.fill(machine, block_, s, partition_.c_str());
    write(status_, &sample.status);
    const nc_Status_v1 core = core_status(machine, block_, s, partition_.c_str());
    write(status_core_, &core);
  }
  return true;
}

void Gateway::clear_alarm(const Shown& shown) {
  const nc_Alarm gone = alarm(shown.entry, shown.slot, partition_.c_str());
  const nc_Alarm_v1 gone_core = core_alarm(shown.entry, shown.slot, partition_.c_str());
  (void)dds_writedispose(alarm_, &gone);
  (void)dds_writedispose(alarm_core_, &gone_core);
}

void Gateway::publish_alarms() {
  std::uint32_t used = 0;  // bit n: slot n is in use
  for (auto it = active_.begin(); it != active_.end();) {
    const bool active = std::any_of(block_.alarm.begin(), block_.alarm.begin() + block_.alarm_count,
                                    [&](const share::Entry& entry) { return entry.sequence == it->first; });
    if (active) {
      used |= 1u << it->second.slot;
      ++it;
    } else {
      clear_alarm(it->second);
      it = active_.erase(it);
    }
  }
  for (unsigned i = 0; i < block_.alarm_count; ++i) {
    const share::Entry& entry = block_.alarm[i];
    if (active_.count(entry.sequence) != 0) continue;
    const auto slot = static_cast<std::uint32_t>(std::countr_one(used));  // one is free, because there are as many slots as there can be alarms
    used |= 1u << slot;
    active_[entry.sequence] = {entry, slot};
    const nc_Alarm come = alarm(entry, slot, partition_.c_str());
    const nc_Alarm_v1 come_core = core_alarm(entry, slot, partition_.c_str());
    write(alarm_, &come);
    write(alarm_core_, &come_core);
  }
}

void Gateway::publish_history() {
  std::uint64_t sequence = segment_.get()->history.sequence();
  if (sequence == history_sequence_ || sequence == 0) return;
  std::string error;
  const auto block = std::make_unique<share::HistoryBlock>();
  if (!segment_.history(block.get(), &sequence, &error)) {
    say(error);
    return;
  }
  history_sequence_ = sequence;
  const std::uint64_t filled = std::min<std::uint64_t>(block->last_sequence, share::kHistory);
  for (std::uint64_t i = 0; i < filled; ++i) {
    const std::uint64_t place = (block->last_sequence - filled + i) % share::kHistory;
    const share::Entry &entry = block->entry[place], &before = history_block_->entry[place];
    if (entry.sequence == before.sequence && entry.cleared_ns == before.cleared_ns) continue;
    const nc_AlarmHistory sample = history(entry, partition_.c_str());
    write(history_, &sample);
  }
  *history_block_ = *block;
}

void Gateway::publish_signals(std::int64_t now_ns) {
  if (now_ns < next_signals_ns_) return;
  dds_publication_matched_status_t matched{};
  if (dds_get_publication_matched_status(signals_, &matched) < 0 || matched.current_count == 0) return;
  next_signals_ns_ = now_ns + kSignalsNs;
  segment_.get()->points_until.store(now_ns + share::kPointsWantedNs, std::memory_order_relaxed);
  if (segment_.get()->points.sequence() == 0 || segment_.get()->signals.sequence() == 0) return;  // they have just been asked for and come with the next look
  std::string error;
  if (!segment_.points(points_.get(), &error) || !segment_.signals(control_signals_.get(), &error)) {
    say(error);
    return;
  }
  const bool same = points_->count == last_points_->count && points_->value == last_points_->value &&
                    points_->good == last_points_->good &&
                    control_signals_->value == last_control_signals_->value;
  if (same && now_ns < forced_signals_ns_) return;
  forced_signals_ns_ = now_ns + kSignalsForcedNs;
  *last_points_ = *points_;
  *last_control_signals_ = *control_signals_;
  signal_sample_->fill(segment_.get()->machine, *points_, *control_signals_, partition_.c_str());
  write(signals_, &signal_sample_->image);
}

// ---- commands ----

// Answers are not lost when a reader is slow: those that the writer does not take wait here. When a reader takes none for kAnswersPatience, because it stands still or has no
// room, the next ones are written by a second writer, which keeps the newest of each client and waits for nobody: so all the others get theirs, and commands
// are taken as before. When everything has been taken, the first writer goes on.
void Gateway::answer(const share::Ack& ack) {
  const std::lock_guard lock(answers_mutex_);
  answers_.push_back(ack);
}

// Publishes the waiting answers as far as the writer takes them. True when so many still wait that there is no room. Both threads.
bool Gateway::answers_wait() {
  const std::lock_guard lock(answers_mutex_);
  while (!answers_.empty() && write_answer(answers_.front())) answers_.pop_front();
  return answers_.size() >= kAnswersWaiting;
}

// False when the answer has to wait. Behind answers_mutex_.
bool Gateway::write_answer(const share::Ack& one) {
  const nc_CommandAck sample = ack(one);
  if (newest_only_ && dds_wait_for_acks(ack_, 0) == DDS_RETCODE_OK) {
    newest_only_ = false;
    std::fprintf(stderr, "ncdds: the answers to commands are taken again; %llu were not given to everybody\n", static_cast<unsigned long long>(lost_answers_));
  }
  if (newest_only_) return write_newest(sample);
  if (dds_write(ack_, &sample) != DDS_RETCODE_TIMEOUT) {
    untaken_since_ns_ = 0;
    return true;
  }
  if (untaken_since_ns_ == 0) untaken_since_ns_ = now();
  if (now() - untaken_since_ns_ < kAnswersPatience && answers_.size() < kAnswersWaiting) return false;
  newest_only_ = true;
  untaken_since_ns_ = 0;
  lost_answers_ = 0;
  std::fprintf(stderr, "ncdds: warning: a reader of nc_CommandAck does not take the answers to commands: it is not waited for, and gets the newest %d of each client when it goes on\n", kNewestAnswers);
  return write_newest(sample);
}

bool Gateway::write_newest(const nc_CommandAck& sample) {
  if (dds_write(newest_acks_, &sample) == DDS_RETCODE_TIMEOUT) ++lost_answers_;
  return true;
}

void Gateway::publish_acks() {
  const std::lock_guard passing(passing_mutex_);
  if (!may_command_) return;
  share::Ack one;
  while (!answers_wait() && segment_.get()->acks.pop(&one)) answer(one);
}

void Gateway::refuse(const share::Request& request, share::AckReason reason, const char* text) {
  share::Ack refusal{};
  refusal.client = request.client;
  refusal.sequence = request.sequence;
  refusal.kind = request.kind;
  refusal.state = static_cast<std::uint32_t>(share::AckState::kRejected);
  refusal.reason = static_cast<std::uint32_t>(reason);
  if (reason == share::AckReason::kRefused) refusal.refusal = static_cast<std::uint32_t>(rt::RefusalCause::kNoAnswer);
  refusal.time_ns = share::wall_ns();
  share::set_text(&refusal.text, text);
  answer(refusal);
}

// A command for which the ring has no room is refused. What stops the machine waits for room behind a flood of others, which the control empties within some
// milliseconds; so does the news that a client has gone, which nobody would repeat.
void Gateway::put(const share::Request& request) {
  const bool waits = share::request_row(request).stops() || share::is_from_gateway(request);
  const std::int64_t give_up = now() + kRoomPatience;
  share::Segment& control = *segment_.get();
  while (!control.commands.push(request)) {
    share::wake(&control.wake_intake);
    if (!waits || now() > give_up) {
      if (!share::is_from_gateway(request)) refuse(request, share::AckReason::kOverflow, "too many commands at once");
      return;
    }
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  share::wake(&control.wake_intake);
}

void Gateway::client_gone(const share::Text<32>& name, std::uint64_t writer) {
  share::Request gone{};
  gone.kind = static_cast<std::uint32_t>(share::RequestKind::kClientGone);
  gone.client = name;
  gone.writer = writer;
  if (segment_.is_open() && may_command_) put(gone);
}

void Gateway::take_commands() {
  const std::lock_guard passing(passing_mutex_);
  take_samples();
}

// False when there is nothing more to take.
bool Gateway::take_samples() {
  // The samples are read into this memory, which is set to zero each time, so that the bytes after the end of a text are known.
  std::fill(received_.begin(), received_.end(), nc_Command{});
  void* samples[kTaken];
  for (int i = 0; i < kTaken; ++i) samples[i] = &received_[static_cast<std::size_t>(i)];
  dds_sample_info_t infos[kTaken];
  const int count = dds_take(command_, samples, infos, kTaken, kTaken);
  if (count <= 0) return false;
  const std::lock_guard lock(segment_mutex_);
  std::set<dds_instance_handle_t> left;  // clients that have left; they are removed after their commands have been taken
  for (int i = 0; i < count; ++i) {
    const dds_sample_info_t& info = infos[i];
    if (info.instance_state != DDS_IST_ALIVE) left.insert(info.instance_handle);
    if (info.valid_data) {
      const auto& command = *static_cast<const nc_Command*>(samples[i]);
      static const share::MachineBlock kNoMachine{};
      const bool open = segment_.is_open() && may_command_;
      const share::Request wanted = request(command, open ? segment_.get()->machine : kNoMachine,
                                            info.publication_handle, info.source_timestamp);
      Client& client = clients_[info.instance_handle];
      client.name = wanted.client;
      client.writer = info.publication_handle;
      const auto known = inherited_.find(std::string(share::text_of(wanted.client)));
      if (known != inherited_.end() && !stands_by_) {
        const bool taken = known->second.writer == client.writer && info.source_timestamp <= known->second.last_ns;
        if (taken) continue;  // the gateway before this one has received it, too, and has passed it on
        inherited_.erase(known);
      }
      client.last_ns = info.source_timestamp;
      if (another_commands_ || stands_by_) continue;  // the other gateway receives this command, too, and answers it
      if (has_hidden_text(command)) refuse(wanted, share::AckReason::kMalformed, "a text has a NUL in its middle");
      else if (!options_.access.security.empty() && needs_maintain(wanted))
        refuse(wanted, share::AckReason::kRefused, "devices of the ladder are for who may maintain: nc_ServiceMaintain");
      else if (open) put(wanted);
      else refuse(wanted, share::AckReason::kRefused, "there is no control that takes commands");
    }
  }
  for (const dds_instance_handle_t handle : left) {
    const auto found = clients_.find(handle);
    if (found == clients_.end()) continue;
    client_gone(found->second.name, found->second.writer);
    inherited_.erase(std::string(share::text_of(found->second.name)));
    clients_.erase(found);
  }
  return true;
}

// A client of the gateway before this one that has sent nothing since has no instance here whose end could be seen; its writer is looked for instead.
void Gateway::miss_inherited() {
  const std::lock_guard passing(passing_mutex_);
  if (inherited_.empty() || now() < next_miss_ns_) return;
  next_miss_ns_ = now() + kMissEveryNs;
  std::vector<dds_instance_handle_t> writers(256);
  const dds_return_t count = dds_get_matched_publications(command_, writers.data(), writers.size());
  if (count < 0) return;
  writers.resize(std::min<std::size_t>(static_cast<std::size_t>(count), writers.size()));
  const std::lock_guard lock(segment_mutex_);
  for (auto it = inherited_.begin(); it != inherited_.end();) {
    if (std::find(writers.begin(), writers.end(), it->second.writer) != writers.end()) {
      ++it;
      continue;
    }
    client_gone(it->second.name, it->second.writer);
    it = inherited_.erase(it);
  }
}

void Gateway::take_over(Gateway* other) {
  if (services_ && other->services_) services_->take_over(other->services_.get());
  if (!options_.commands) return;
  const std::scoped_lock passing(passing_mutex_, other->passing_mutex_);
  // What this gateway has received is dropped, because the other one has received it, too, or does so in a moment; then the other one passes on what it has.
  // What comes after that is in this gateway's reader, perhaps in both; inherited_ says up to where the other one has taken it.
  while (take_samples()) continue;
  std::this_thread::sleep_for(kBothReceive);
  while (other->take_samples()) continue;
  const std::scoped_lock segments(segment_mutex_, other->segment_mutex_);
  for (const auto& [handle, client] : other->clients_) inherited_[std::string(share::text_of(client.name))] = client;
  for (const auto& [name, client] : other->inherited_) inherited_.emplace(name, client);
  const bool both = segment_.is_open() && other->segment_.is_open();
  if (both && other->may_command_) {
    segment_.take_claim_of(&other->segment_);
    may_command_ = true;
    another_commands_ = false;
  }
  other->stands_by_ = true;
  other->another_commands_ = other->may_command_ || other->another_commands_;
  other->may_command_ = false;
  stands_by_ = false;
  const std::scoped_lock answers(answers_mutex_, other->answers_mutex_);
  answers_.insert(answers_.begin(), other->answers_.begin(), other->answers_.end());
  other->answers_.clear();
}

unsigned Gateway::partners() const {
  dds_publication_matched_status_t readers{};
  dds_subscription_matched_status_t writers{};
  unsigned count = 0;
  if (status_ > 0 && dds_get_publication_matched_status(status_, &readers) >= 0) count += readers.current_count;
  if (command_ > 0 && dds_get_subscription_matched_status(command_, &writers) >= 0) count += writers.current_count;
  if (services_) count += services_->partners();
  return count;
}

void Gateway::command_thread() {
  while (!stop_) {
    dds_attach_t triggered[1];
    if (answers_wait()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    } else if (dds_waitset_wait(waitset_, triggered, 1, DDS_MSECS(100)) > 0) {
      take_commands();
      (void)answers_wait();
    }
    if (!stands_by_) miss_inherited();
  }
}

}  // namespace nc::dds
