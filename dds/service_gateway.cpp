// SPDX-License-Identifier: Apache-2.0
// See service_gateway.hpp.
#include "dds/service_gateway.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <vector>

#include "runtime/clock.hpp"
#include "runtime/services/history.hpp"
#include "runtime/services/places.hpp"
#include "runtime/share/text.hpp"

namespace nc::dds {
namespace {

constexpr int kTakenAtOnce = 16;
constexpr std::size_t kMatched = 256;              // partners of a reader or a writer that are looked at
constexpr int kLookMs = 100;
constexpr int kWritesMs = 5;                       // interval of trying to write again
constexpr std::int64_t kRestNs = 20'000'000;       // a client that does not read is not tried again for so long
constexpr std::int64_t kMissEveryNs = 200'000'000;
constexpr dds_duration_t kBlocking = DDS_MSECS(1);
constexpr std::chrono::milliseconds kBothReceive{20};  // far longer than one sample takes from one reader of this process to the next
constexpr dds_duration_t kBeforeNext = DDS_MSECS(200);  // for which the replies that were written are waited for before another gateway goes on with them

std::int64_t now() { return nc::rt::RealClock().now_ns(); }

void wake(dds_entity_t, void* descriptor) {
  const std::uint64_t one = 1;
  (void)!::write(*static_cast<int*>(descriptor), &one, sizeof one);  // a full counter wakes as well
}

Topic topic_at(unsigned right) { return static_cast<Topic>(static_cast<unsigned>(Topic::kServiceView) + right); }

struct DeleteQos {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, DeleteQos>;

using rt::services::Place;
using rt::services::Service;

std::string text_of_key(const std::array<unsigned char, 16>& key) { return {key.begin(), key.end()}; }

}  // namespace

ServiceGateway::~ServiceGateway() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
  for (const dds_entity_t reader : readers_)
    if (reader > 0) dds_delete(reader);  // from here on nobody wakes this
  if (wake_ >= 0) close(wake_);
}

bool ServiceGateway::open(dds_entity_t participant, std::string* error) {
  participant_ = participant;
  request_ = std::make_unique<nc_ServiceRequest>();
  sample_ = std::make_unique<nc_ServiceReply>();
  wake_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  reply_topic_ = dds_create_topic(participant, topic_type(Topic::kServiceReply), topic_name(Topic::kServiceReply), nullptr, nullptr);
  if (wake_ < 0 || reply_topic_ <= 0) {
    *error = "the services over DDS cannot be begun";
    return false;
  }
  for (unsigned right = 0; right < kTopics; ++right) {
    readers_[right] = make_reader(participant, topic_at(right), partition_, error);
    if (readers_[right] <= 0) return false;
    dds_listener_t* listener = dds_create_listener(nullptr);
    (void)dds_get_listener(readers_[right], listener);
    (void)dds_lset_data_available_arg(listener, &wake, &wake_, false);
    (void)dds_set_listener(readers_[right], listener);
    dds_delete_listener(listener);
  }
  next_session_ = static_cast<std::uint64_t>(rt::share::wall_ns());  // other numbers than those of the gateway before
  thread_ = std::thread([this] { serve(); });
  return true;
}

void ServiceGateway::set_gate(const ServiceGate& gate) {
  const std::lock_guard lock(gate_mutex_);
  gate_ = gate;
}

ServiceGate ServiceGateway::gate() {
  const std::lock_guard lock(gate_mutex_);
  return gate_;
}

// Prints a sentence, but not again while it is the same as the last one.
void ServiceGateway::say(const std::string& text) {
  if (text == said_) return;
  said_ = text;
  std::fprintf(stderr, "ncdds: services: %s\n", text.c_str());
}

void ServiceGateway::serve() {
  while (!stop_) {
    wait();
    const std::lock_guard serving(serving_mutex_);
    dds_sample_info_t info{};
    for (unsigned topic = 0; topic < kTopics; ++topic) {
      int count = 0;
      while (count < kTakenAtOnce && take_request(topic, &info)) ++count;
      if (count == kTakenAtOnce) wake(0, &wake_);  // there may be more
    }
    serve_clients();
  }
  const std::lock_guard serving(serving_mutex_);
  while (!clients_.empty()) remove(clients_.begin()->second.get());
}

void ServiceGateway::serve_clients() {
  std::erase_if(ending_, [](const std::future<void>& end) { return end.wait_for(std::chrono::seconds(0)) == std::future_status::ready; });
  admit_newcomers();
  std::vector<Client*> silent;
  for (const auto& [name, client] : clients_) {
    pass_early(client.get());
    serve_line(client.get());
    if (!is_undecided(*client)) settle(client.get(), true);
    write_replies(client.get());
    if (client->held_ns != 0 && now() - client->held_ns > kPatienceNs) silent.push_back(client.get());
  }
  for (Client* client : silent) {
    if (client->served || !reads_replies(*client, client->participant)) say("client " + client->name + " does not read its replies: its connection ends");
    else say("no place was found for client " + client->name + ": it gets no answer");
    remove(client);
  }
  miss_clients();
}

// ---- places ----

// Whom a place counts for. Without DDS Security a name says nothing.
std::string ServiceGateway::owner_of(const Client& client) {
  return gate().by_permissions ? rt::services::user_of_behalf(client.name) : text_of_key(client.participant);
}

// Gives a place to those who have shown that they read their replies. Those without one wait for it.
void ServiceGateway::admit_newcomers() {
  std::vector<Client*> ready;
  for (const auto& [name, client] : clients_)
    if (!client->served && !client->early.empty() && reads_replies(*client, client->participant)) ready.push_back(client.get());
  std::sort(ready.begin(), ready.end(), [](const Client* a, const Client* b) { return a->came_ns < b->came_ns; });
  for (Client* client : ready) {
    client->served = make_place(*client);
    if (!client->served) hold(client, now());
  }
}

bool ServiceGateway::make_place(const Client& newcomer) {
  std::vector<Client*> served;
  std::vector<Place> taken;
  for (const auto& [name, client] : clients_) {
    if (!client->served) continue;
    served.push_back(client.get());
    taken.push_back({owner_of(*client), 0, client->heard_ns, name == controls_});
  }
  if (served.size() < kClients) return true;
  const auto given = rt::services::place_to_give_up(taken, owner_of(newcomer), 0);
  if (given) give_up(served[*given]);
  return given.has_value();
}

// A participant can ask under as many names as it likes, whether it may have them or not: so until that is known each participant has the same right to wait.
bool ServiceGateway::make_room_for_newcomer(const Client& newcomer) {
  std::vector<Client*> waiting;
  std::vector<Place> taken;
  Client* oldest = nullptr;
  for (const auto& [name, client] : clients_) {
    if (client->served) continue;
    waiting.push_back(client.get());
    taken.push_back({text_of_key(client->participant), 0, client->came_ns, false});
    if (oldest == nullptr || client->came_ns < oldest->came_ns) oldest = client.get();
  }
  if (waiting.size() < kNewcomers) return true;
  if (const auto given = rt::services::place_to_give_up(taken, text_of_key(newcomer.participant), 0)) oldest = waiting[*given];
  else if (now() - oldest->came_ns < kUndisturbedNs) return false;
  give_up(oldest);
  return true;
}

// What it has asked is refused, as far as it reads that at once; its connection ends, and with it what it has begun. Of a newcomer nobody knows whether another
// gateway answers it.
void ServiceGateway::give_up(Client* client) {
  say("client " + client->name + " loses its place to another one");
  if (client->served && !is_undecided(*client)) {
    lose_line(client, "another client needs the place of this one");
    client->next_write_ns = 0;
    write_replies(client);
  }
  remove(client);
}

// Until something comes, or is to be tried again.
void ServiceGateway::wait() {
  std::vector<pollfd> ready{{wake_, POLLIN, 0}};
  int timeout = kLookMs;
  {
    const std::lock_guard serving(serving_mutex_);
    for (const auto& [name, client] : clients_) {
      if (!client->replies.empty() || !client->early.empty()) timeout = kWritesMs;
      if (client->line.socket() < 0) continue;
      const bool reads = client->waiting < kMostWaiting;
      ready.push_back({client->line.socket(), static_cast<short>((reads ? POLLIN : 0) | (client->line.writes() ? POLLOUT : 0)), 0});
    }
  }
  if (poll(ready.data(), ready.size(), timeout) <= 0 || (ready[0].revents & POLLIN) == 0) return;
  std::uint64_t woken = 0;
  (void)!read(wake_, &woken, sizeof woken);
}

// ---- requests ----

// False when there is none.
bool ServiceGateway::take_request(unsigned topic, dds_sample_info_t* info) {
  std::memset(request_.get(), 0, sizeof *request_);  // the bytes behind the end of a text are known then
  void* samples[1] = {request_.get()};
  if (dds_take(readers_[topic], samples, info, 1, 1) <= 0) return false;
  if (stands_by_) return true;  // the other gateway receives this, too, and does what is to be done
  if (info->valid_data && taken_.erase({info->publication_handle, info->source_timestamp}) == 0) take(topic, *info);
  if (info->instance_state != DDS_IST_ALIVE) gone(topic, info->instance_handle);
  return true;
}

void ServiceGateway::take(unsigned topic, const dds_sample_info_t& info) {
  Client* client = client_of(topic, info);
  if (client != nullptr) receive(client, read_request(*request_, static_cast<Right>(topic), info.source_timestamp));
}

// The client of a request. Null when it gets no answer; or it is refused already.
ServiceGateway::Client* ServiceGateway::client_of(unsigned topic, const dds_sample_info_t& info) {
  const std::string name(request_->client, strnlen(request_->client, sizeof request_->client));
  if (!is_client_name(name)) {
    say("a client without a name of letters, digits, '.', '-', '_', '@' gets no answer");
    return nullptr;
  }
  auto found = clients_.find(name);
  ParticipantKey asks{};
  const bool displaced = found != clients_.end() && !is_of(found->second.get(), topic, info.publication_handle) && participant_of(topic, info.publication_handle, &asks) &&
                         !reads_replies(*found->second, found->second->participant) && reads_replies(*found->second, asks);
  if (displaced) {  // who had the name cannot have it: it does not read, or may not read, what is for this name
    say("client " + name + " does not read its replies, and another participant does: it has the name now");
    remove(found->second.get());
    found = clients_.end();
  }
  if (found != clients_.end()) {
    Client* client = found->second.get();
    if (!is_of(client, topic, info.publication_handle)) {
      say("two clients have the name " + name + ": the second one is refused");
      const bool same = std::any_of(client->open.begin(), client->open.end(), [&](const auto& entry) { return entry.second.number == request_->number; });
      if (!same) write_later(client, &client->replies, refusal_message(request_->number, Outcome::refused(Refused::kBusy, "another participant has the name " + name)));
      return nullptr;
    }
    client->instance[topic] = info.instance_handle;
    return client;
  }
  auto client = std::make_unique<Client>();
  client->name = name;
  client->instance[topic] = info.instance_handle;
  if (!is_of(client.get(), topic, info.publication_handle)) return nullptr;  // it has gone already
  client->came_ns = client->heard_ns = now();
  if (!make_room_for_newcomer(*client)) {
    say("more than " + std::to_string(kNewcomers) + " new clients at once: " + name + " gets no answer");
    return nullptr;
  }
  if (!make_writer_for(client.get())) return nullptr;
  return clients_.emplace(name, std::move(client)).first->second.get();
}

// Whether a writer belongs to the participant of the client; the first one that asks decides which one that is.
bool ServiceGateway::is_of(Client* client, unsigned topic, dds_instance_handle_t publication) {
  if (client->writers.count(publication) != 0) return true;
  ParticipantKey participant{};
  if (!participant_of(topic, publication, &participant)) return false;
  if (client->writers.empty()) client->participant = participant;
  if (client->participant != participant) return false;
  client->writers.insert(publication);
  return true;
}

// False when the writer has gone.
bool ServiceGateway::participant_of(unsigned topic, dds_instance_handle_t publication, ParticipantKey* key) const {
  dds_builtintopic_endpoint_t* writer = dds_get_matched_publication_data(readers_[topic], publication);
  if (writer == nullptr) return false;
  std::memcpy(key->data(), writer->participant_key.v, key->size());
  dds_builtintopic_free_endpoint(writer);
  return true;
}

// Whether a participant has a reader in the partition of the replies of a client.
bool ServiceGateway::reads_replies(const Client& client, const ParticipantKey& participant) {
  std::array<dds_instance_handle_t, kMatched> readers{};
  const dds_return_t count = dds_get_matched_subscriptions(client.writer, readers.data(), readers.size());
  for (std::size_t i = 0; count > 0 && i < std::min<std::size_t>(static_cast<std::size_t>(count), readers.size()); ++i) {
    dds_builtintopic_endpoint_t* reader = dds_get_matched_subscription_data(client.writer, readers[i]);
    if (reader == nullptr) continue;
    const bool same = std::memcmp(participant.data(), reader->participant_key.v, participant.size()) == 0;
    dds_builtintopic_free_endpoint(reader);
    if (same) return true;
  }
  return false;
}

bool ServiceGateway::make_writer_for(Client* client) {
  const Qos where(dds_create_qos()), how(dds_create_qos());
  dds_qset_partition1(where.get(), (partition_ + "/" + client->name).c_str());
  dds_qset_reliability(how.get(), DDS_RELIABILITY_RELIABLE, kBlocking);
  dds_qset_durability(how.get(), DDS_DURABILITY_VOLATILE);
  dds_qset_history(how.get(), DDS_HISTORY_KEEP_ALL, DDS_LENGTH_UNLIMITED);
  dds_qset_writer_data_lifecycle(how.get(), false);
  client->publisher = dds_create_publisher(participant_, where.get(), nullptr);
  if (client->publisher > 0) client->writer = dds_create_writer(client->publisher, reply_topic_, how.get(), nullptr);
  if (client->writer > 0) return true;
  say("no writer for the replies to " + client->name + ": " + dds_strretcode(client->writer));
  if (client->publisher > 0) dds_delete(client->publisher);
  return false;
}

void ServiceGateway::gone(unsigned topic, dds_instance_handle_t instance) {
  for (const auto& [name, client] : clients_) {
    if (client->instance[topic] != instance) continue;
    client->instance[topic] = 0;
    if (client->instance == std::array<dds_instance_handle_t, kTopics>{}) remove(client.get());
    return;
  }
}

// A client that has sent nothing since this gateway has taken over has no instance here whose end could be seen; its writers are looked for instead.
void ServiceGateway::miss_clients() {
  if (clients_.empty() || now() < next_miss_ns_) return;
  next_miss_ns_ = now() + kMissEveryNs;
  std::set<dds_instance_handle_t> known;
  for (const dds_entity_t reader : readers_) {
    std::array<dds_instance_handle_t, kMatched> writers{};
    const dds_return_t count = dds_get_matched_publications(reader, writers.data(), writers.size());
    if (count < 0 || static_cast<std::size_t>(count) > writers.size()) return;
    known.insert(writers.begin(), writers.begin() + count);
  }
  std::vector<Client*> missed;
  for (const auto& [name, client] : clients_)
    if (std::none_of(client->writers.begin(), client->writers.end(), [&](dds_instance_handle_t writer) { return known.count(writer) != 0; })) missed.push_back(client.get());
  for (Client* client : missed) remove(client);
}

// The writer waits up to a second for a reader that has not taken everything, and nobody else waits for that.
void ServiceGateway::end_writer(dds_entity_t publisher) {
  ending_.push_back(std::async(std::launch::async, [publisher] { (void)dds_delete(publisher); }));
}

void ServiceGateway::remove(Client* client) {
  end_writer(client->publisher);
  const std::string name = client->name;
  clients_.erase(name);
}

void ServiceGateway::receive(Client* client, ServiceRequest request) {
  const std::uint64_t number = request.number;
  client->heard_ns = now();
  const bool same = std::any_of(client->open.begin(), client->open.end(), [&](const auto& open) { return open.second.number == number; }) ||
                    std::any_of(client->early.begin(), client->early.end(), [&](const ServiceRequest& early) { return early.number == number; });
  if (number != 0 && same) return say("client " + client->name + " gives a number to two requests: the second one is not taken");
  const rt::services::ServiceRow* row = rt::services::find_service(request.service);
  const std::size_t most = row != nullptr && row->of_command().stops() ? 2 * kOpen : kOpen;  // what stops the machine has room behind other requests
  if (client->open.size() + client->early.size() >= most)
    return reply(client, refusal_message(number, Outcome::refused(Refused::kBusy, "a client has at most " + std::to_string(kOpen) + " requests without an answer")));
  client->early.push_back(std::move(request));
  pass_early(client);
}

void ServiceGateway::pass_early(Client* client) {
  if (client->early.empty()) return;
  if (!reads_replies(*client, client->participant)) return hold(client, now());
  if (!client->served) return;  // until it is admitted
  if (client->replies.empty()) client->held_ns = 0;
  for (; !client->early.empty(); client->early.pop_front()) pass(client, client->early.front());
}

// Nothing can be written to a client at this time.
void ServiceGateway::hold(Client* client, std::int64_t at) {
  if (client->held_ns == 0) client->held_ns = at;
  client->next_write_ns = now() + kRestNs;
}

void ServiceGateway::pass(Client* client, const ServiceRequest& request) {
  const std::uint64_t number = request.number;
  const auto refuse = [&](Refused why, const std::string& text) { reply(client, refusal_message(number, Outcome::refused(why, text))); };
  if (number == 0) return refuse(Refused::kMalformed, "the number of a request is at least 1");
  const ServiceGate gate = this->gate();
  std::string frame, error;
  Outcome outcome;
  const std::uint64_t id = next_id_++;
  if (!service_frame(request, id, rt::share::wall_ns(), gate, &frame, &outcome)) return reply(client, refusal_message(number, outcome));
  if (client->line.state() == ServiceLine::State::kClosed) {
    if (!client->line.open(socket_.empty() ? find_service_socket(partition_) : socket_, "dds:" + client->name, gate.most, &error)) return refuse(Refused::kFailed, error);
    client->session = next_session_++;
  }
  client->open[id] = {number, rt::services::find_service(request.service)};
  client->line.put(frame);
}

// ---- the connections ----

void ServiceGateway::serve_line(Client* client) {
  ServiceLine& line = client->line;
  if (line.socket() < 0) return;
  std::string error = "the control has ended the connection";
  if (!line.send_out()) return lose_line(client, error);
  if (client->waiting < kMostWaiting && !line.receive(&error)) {
    if (line.state() != ServiceLine::State::kTaken) return lose_line(client, error);
    // Another gateway has this client, and answers it. When that one is gone the next request comes through here.
    client->open.clear();
    settle(client, false);
    return line.close();
  }
  if (line.state() == ServiceLine::State::kReady) take_messages(client);
  if (line.writes() && !line.send_out()) lose_line(client, error);
}

void ServiceGateway::take_messages(Client* client) {
  std::string text;
  while (client->line.next(&text)) {
    std::uint64_t id = 0;
    ServiceMessage message;
    if (!read_message(text, &id, &message)) return lose_line(client, "the control sends what is no reply");
    if (id == 0 && message.status != nc_SERVICE_UPDATE) return lose_line(client, "the control does not read what this gateway sends: is it of another version?");
    if (id != 0) {
      const auto found = client->open.find(id);
      if (found == client->open.end()) continue;
      message.number = found->second.number;
      const rt::services::ServiceRow* row = found->second.row;
      if (row != nullptr && (row->service == Service::kRights || row->service == Service::kLimit)) narrow_rights(&message, rights_of(*client));
      const bool done = row != nullptr && message.status == nc_SERVICE_DONE;
      if (done && row->service == Service::kTakeControl) controls_ = client->name;
      if (done && row->service == Service::kReleaseControl && controls_ == client->name) controls_.clear();
      client->open.erase(found);
    }
    reply(client, std::move(message));
  }
}

void ServiceGateway::lose_line(Client* client, const std::string& why) {
  client->line.close();
  for (const auto& entry : client->open) reply(client, refusal_message(entry.second.number, Outcome::refused(Refused::kFailed, why)));
  client->open.clear();
}

// ---- the change from one gateway to the next ----

unsigned ServiceGateway::partners() const {
  unsigned count = 0;
  for (const dds_entity_t reader : readers_) {
    dds_subscription_matched_status_t writers{};
    if (reader > 0 && dds_get_subscription_matched_status(reader, &writers) >= 0) count += writers.current_count;
  }
  return count;
}

// From here on nothing more is written, and what has been written is waited for: so replies keep their order over the change, unless a client has not read for
// so long. Requests are passed on meanwhile.
void ServiceGateway::hush() {
  std::vector<dds_entity_t> writers;
  {
    const std::lock_guard serving(serving_mutex_);
    hushed_ = true;
    for (const auto& [name, client] : clients_) writers.push_back(client->writer);
  }
  const std::int64_t until_ns = now() + kBeforeNext;
  for (const dds_entity_t writer : writers) (void)dds_wait_for_acks(writer, std::max<std::int64_t>(until_ns - now(), 0));
}

void ServiceGateway::take_over(ServiceGateway* other) {
  other->hush();
  const std::scoped_lock serving(serving_mutex_, other->serving_mutex_);
  // What this gateway has received is dropped, because the other one has received it, too, or does so in a moment; then the other one takes what it has.
  // What comes after that is in this gateway's reader, perhaps in both; taken_ has what the other one has taken of it.
  dds_sample_info_t info{};
  for (unsigned topic = 0; topic < kTopics; ++topic)
    while (take_request(topic, &info)) continue;
  std::this_thread::sleep_for(kBothReceive);
  taken_.clear();
  for (unsigned topic = 0; topic < kTopics; ++topic)
    while (other->take_request(topic, &info))
      if (info.valid_data) taken_.emplace(info.publication_handle, info.source_timestamp);
  for (auto& [name, client] : other->clients_) {
    other->end_writer(client->publisher);
    client->written = 0;  // a reply of which some parts were written comes again from its first one
    client->held_ns = client->next_write_ns = 0;
    if (make_writer_for(client.get())) clients_[name] = std::move(client);
  }
  other->clients_.clear();
  controls_ = other->controls_;
  next_id_ = std::max(next_id_, other->next_id_);
  next_session_ = std::max(next_session_, other->next_session_);
  other->stands_by_ = true;
  stands_by_ = false;
  wake(0, &wake_);
}

// ---- replies ----

void ServiceGateway::reply(Client* client, ServiceMessage message) { write_later(client, is_undecided(*client) ? &client->withheld : &client->replies, std::move(message)); }

void ServiceGateway::write_later(Client* client, std::deque<ServiceMessage>* messages, ServiceMessage message) {
  // More than this comes only from a client that goes on asking without reading its refusals.
  if (client->waiting > 2 * kMostWaiting + rt::services::kMostFrameBytes * kOpen) return say("client " + client->name + " does not read its replies: it gets no more of them");
  client->waiting += message.body.size() + sizeof message;
  messages->push_back(std::move(message));
}

// What was refused before it was known whose client this is.
void ServiceGateway::settle(Client* client, bool own) {
  for (ServiceMessage& message : client->withheld) {
    if (own) client->replies.push_back(std::move(message));
    else client->waiting -= message.body.size() + sizeof message;
  }
  client->withheld.clear();
}

// What this gateway passes on for a client. With DDS Security a client may what the permissions let it write, and nothing tells a gateway what is in them; but
// its participant has no reader that hears a writer which they do not allow. So the rights are those on whose topics the client is heard.
RightSet ServiceGateway::rights_of(const Client& client) {
  const ServiceGate gate = this->gate();
  if (!gate.by_permissions) return gate.rights;
  RightSet heard;
  for (unsigned topic = 0; topic < kTopics; ++topic) {
    std::array<dds_instance_handle_t, kMatched> writers{};
    const dds_return_t count = dds_get_matched_publications(readers_[topic], writers.data(), writers.size());
    for (std::size_t i = 0; count > 0 && i < std::min<std::size_t>(static_cast<std::size_t>(count), writers.size()); ++i) {
      ParticipantKey key{};
      if (participant_of(topic, writers[i], &key) && key == client.participant) heard.add(static_cast<Right>(topic));
    }
  }
  return gate.rights.both(heard);
}

// Writes what the writer takes. It waits for the client's reader, which may not have been found yet.
void ServiceGateway::write_replies(Client* client) {
  const std::int64_t at = now();
  if (hushed_ || client->replies.empty() || at < client->next_write_ns) return;
  dds_publication_matched_status_t matched{};
  if (dds_get_publication_matched_status(client->writer, &matched) < 0 || matched.current_count == 0) return hold(client, at);
  while (!client->replies.empty()) {
    const ServiceMessage& message = client->replies.front();
    const std::vector<std::string_view> parts = parts_of(message.body, rt::services::kPartBytes);
    while (client->written < parts.size()) {
      if (!write_part(client, message, client->written, client->written + 1 == parts.size(), parts[client->written])) return hold(client, at);
      ++client->written;
      client->held_ns = 0;
      client->heard_ns = now();
    }
    client->waiting -= message.body.size() + sizeof message;
    client->written = 0;
    client->replies.pop_front();
  }
}

// False when the writer does not take it now.
bool ServiceGateway::write_part(Client* client, const ServiceMessage& message, std::size_t part, bool last, std::string_view body) {
  nc_ServiceReply& sample = *sample_;
  const auto put = [](char* to, std::size_t size, std::string_view text) {
    const std::size_t count = std::min(size - 1, text.size());
    std::memcpy(to, text.data(), count);
    to[count] = '\0';
  };
  put(sample.client, sizeof sample.client, client->name);
  put(sample.refusal, sizeof sample.refusal, message.refusal);
  put(sample.body, sizeof sample.body, body);
  sample.number = message.number;
  sample.status = message.status;
  sample.session = client->session;
  sample.part = static_cast<std::uint32_t>(part + 1);
  sample.last = last;
  const dds_return_t result = dds_write(client->writer, &sample);
  if (result == DDS_RETCODE_TIMEOUT) return false;
  if (result < 0) say(std::string("write: ") + dds_strretcode(result));
  return true;
}

}  // namespace nc::dds
