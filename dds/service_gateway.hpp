// SPDX-License-Identifier: Apache-2.0
// The services over DDS: passes requests to the socket of the local services and brings their replies back, in a thread of its own.
//
// Each client has a connection to the local services, which asks on its behalf, and a writer for its replies in a partition of its own, "MACHINE/CLIENT". So a
// client that does not read holds up nobody else: its replies wait here up to a bound, then in the local services, which leave out updates and end the
// connection as that of a local client. A client is gone when none of its writers is alive; then the connection ends, and with it what the client has begun.
//
// A request is passed on when its participant reads the replies in the partition of its client. So with DDS Security, whose permissions say who may read which
// of these partitions, nobody asks in the name of another.
//
// Nobody keeps others out by taking names: places are bounded, and when all are taken the one with the most of them gives one up (places.hpp). With DDS Security that
// is an identity, else a participant. Who has not shown yet that it reads the replies under its name waits for that in one of a few other places.
//
// Of several gateways one has a client: the one whose connection the control lets ask for it. What another one finds to refuse before it knows that, for example
// because it comes late and to many requests at once, it keeps until then, and forgets it when the client is not its own.
//
// A gateway with new keys takes the place of another one of this process (identity_keeper.hpp): it stands by first, which means that it takes no requests, and
// then takes over the clients with their connections. What they have begun goes on.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <deque>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "dds/participant.hpp"
#include "dds/service_line.hpp"
#include "dds/service_request.hpp"

namespace nc::dds {

class ServiceGateway {
 public:
  static constexpr std::size_t kClients = 16;
  static constexpr std::size_t kNewcomers = 16;               // clients without a place: their reader has not been found, or there is no place
  static constexpr std::int64_t kUndisturbedNs = 1'000'000'000;  // for which a newcomer is not sent away for the next one, unless its participant has more of them
  static constexpr std::size_t kOpen = 8;                   // requests of a client without an answer, as of a local client
  static constexpr std::size_t kMostWaiting = 256 * 1024;   // bytes of replies; above that nothing more is read from the connection of this client
  static constexpr std::int64_t kPatienceNs = 10'000'000'000;

  // `partition`: name of the control. `socket`: path of its services, "" = where they usually are.
  ServiceGateway(std::string partition, std::string socket) : partition_(std::move(partition)), socket_(std::move(socket)) {}
  ~ServiceGateway();
  ServiceGateway(const ServiceGateway&) = delete;
  ServiceGateway& operator=(const ServiceGateway&) = delete;
  // False with a sentence in *error.
  bool open(dds_entity_t participant, std::string* error);
  // From now on this is passed on. Any thread.
  void set_gate(const ServiceGate& gate);
  // To be called before open(): requests are left to another gateway of this process, until take_over().
  void stand_by() { stands_by_ = true; }
  // From here on this gateway has the requests, the clients and their connections in place of another one, which stands by. Each request is passed on once.
  void take_over(ServiceGateway* other);
  // Number of writers of requests that this gateway talks with.
  unsigned partners() const;

 private:
  static constexpr unsigned kTopics = rt::services::kRightCount;
  using ParticipantKey = std::array<unsigned char, 16>;
  struct Client {
    std::string name;
    bool served = false;                            // has a place
    std::int64_t came_ns = 0, heard_ns = 0;         // heard: when it has asked or read something
    std::array<dds_instance_handle_t, kTopics> instance{};  // on each topic; 0 = it has no writer there
    ParticipantKey participant{};
    std::set<dds_instance_handle_t> writers;
    dds_entity_t publisher = 0, writer = 0;
    std::deque<ServiceRequest> early;              // requests that have come before the reader of their replies was found
    ServiceLine line;
    std::uint64_t session = 0;                     // number of the connection
    struct Open {
      std::uint64_t number;  // that the client has given it
      const rt::services::ServiceRow* row;  // null = there is none of this name
    };
    std::map<std::uint64_t, Open> open;            // by the number of the request in the connection
    std::deque<ServiceMessage> replies;
    std::deque<ServiceMessage> withheld;           // refusals from before it was known whether another gateway answers this client
    std::size_t waiting = 0;                       // bytes of `replies` and `withheld`
    std::size_t written = 0;                       // parts of the first one that were written
    std::int64_t held_ns = 0;                      // since when nothing could be written; 0 = it goes on
    std::int64_t next_write_ns = 0;
  };
  void serve();
  void serve_clients();
  void admit_newcomers();
  bool make_place(const Client& newcomer);
  bool make_room_for_newcomer(const Client& newcomer);
  std::string owner_of(const Client& client);
  void give_up(Client* client);
  void wait();
  bool take_request(unsigned topic, dds_sample_info_t* info);
  void take(unsigned topic, const dds_sample_info_t& info);
  Client* client_of(unsigned topic, const dds_sample_info_t& info);
  bool is_of(Client* client, unsigned topic, dds_instance_handle_t publication);
  bool participant_of(unsigned topic, dds_instance_handle_t publication, ParticipantKey* key) const;
  static bool reads_replies(const Client& client, const ParticipantKey& participant);
  bool make_writer_for(Client* client);
  void end_writer(dds_entity_t publisher);
  void gone(unsigned topic, dds_instance_handle_t instance);
  void miss_clients();
  void remove(Client* client);
  void receive(Client* client, ServiceRequest request);
  void pass_early(Client* client);
  void hush();
  void pass(Client* client, const ServiceRequest& request);
  static void hold(Client* client, std::int64_t at);
  void serve_line(Client* client);
  void take_messages(Client* client);
  void lose_line(Client* client, const std::string& why);
  static bool is_undecided(const Client& client) { return !client.early.empty() || client.line.state() == ServiceLine::State::kGreets; }
  static void settle(Client* client, bool own);
  RightSet rights_of(const Client& client);
  void reply(Client* client, ServiceMessage message);
  void write_later(Client* client, std::deque<ServiceMessage>* messages, ServiceMessage message);
  void write_replies(Client* client);
  bool write_part(Client* client, const ServiceMessage& message, std::size_t part, bool last, std::string_view body);
  ServiceGate gate();
  void say(const std::string& text);

  const std::string partition_, socket_;
  dds_entity_t participant_ = 0, reply_topic_ = 0;
  std::array<dds_entity_t, kTopics> readers_{};
  int wake_ = -1;
  std::atomic<bool> stop_{false};
  std::mutex gate_mutex_;
  ServiceGate gate_;
  std::thread thread_;

  std::mutex serving_mutex_;  // of everything below; the thread has it while it does not wait
  bool stands_by_ = false;
  bool hushed_ = false;  // writes no replies, because another gateway takes over
  std::set<std::pair<dds_instance_handle_t, dds_time_t>> taken_;  // requests, by writer and time, that may come here but were taken by the gateway before this one
  std::int64_t next_miss_ns_ = 0;
  std::map<std::string, std::unique_ptr<Client>> clients_;
  std::string controls_;                   // the last client that has taken control through this gateway and not given it back
  std::vector<std::future<void>> ending_;  // writers of clients that have gone
  std::uint64_t next_id_ = 1, next_session_ = 1;
  std::unique_ptr<nc_ServiceRequest> request_;
  std::unique_ptr<nc_ServiceReply> sample_;
  std::string said_;
};

}  // namespace nc::dds
