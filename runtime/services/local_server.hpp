// SPDX-License-Identifier: Apache-2.0
// The services on a local socket. Each connection has the rights of its peer (rights.hpp) until it ends; a peer without any right is told so and put out.
//
// Nothing here waits for a client. One thread moves the bytes of all connections, two others execute what takes time (Lane). A connection has at most kOutstanding
// requests without an answer, and at most kMostOut bytes of answers that it has not read; above that no more are taken from it, but a hold among the next
// kMostAhead bytes is given to the machine. One that does not read its
// answers, or does not end a frame that it has begun, is closed after kPatienceNs. A frame that is too long ends the connection. What a client has begun ends
// with it: control, jogs, uploads.
//
// Connections are bounded, and nobody keeps others out by holding them: a user has at most kPerUser, those without the right to operate have at most kWithoutOperate
// together, and when there is no room a connection is closed that has to make room for the newcomer (places.hpp). Never one of root or the user of ncrtd, nor that of the client with control.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "runtime/rt_thread.hpp"
#include "runtime/services/frames.hpp"
#include "runtime/services/services.hpp"
#include "runtime/services/turn_table.hpp"

namespace nc::rt::services {

inline constexpr std::size_t kLongestSocketPath = 107;  // of sockaddr_un

// The path of the socket of a control: as configured; else in the folder that the service manager gives (RUNTIME_DIRECTORY) or that the user's session has
// (XDG_RUNTIME_DIR); "" = there is none. `share`: name of the control.
std::string socket_path(const ServicesConfig& config, const std::string& share);

// What is known of requests that were looked at before they are taken, in their order. A hold is one of its own; others are counted together as long as no hold comes,
// so a client that sends the shortest frames does not fill it.
class ArrivalsAhead {
 public:
  void add(const share::Arrival& arrival) {
    if (!runs_.empty() && runs_.back().arrival == arrival) ++runs_.back().requests;
    else runs_.push_back({arrival, 1});
  }
  // Of the next request that is taken; false when it was not looked at.
  bool take(share::Arrival* arrival) {
    if (runs_.empty()) return false;
    *arrival = runs_.front().arrival;
    if (--runs_.front().requests == 0) runs_.pop_front();
    return true;
  }

 private:
  struct Run {
    share::Arrival arrival;
    std::size_t requests;
  };
  std::deque<Run> runs_;
};

class LocalServer {
 public:
  // What rights a peer has.
  using Judge = std::function<RightSet(const Credentials&)>;
  // Who is at the other end of a socket, as credentials_of().
  using Witness = std::function<bool(int socket, Credentials* peer)>;

  static constexpr unsigned kConnections = 64, kPerUser = 24, kWithoutOperate = 48, kOutstanding = 8;
  static constexpr std::size_t kMostOut = 1u << 20;
  static constexpr std::size_t kMostAhead = 64 * 1024;  // bytes that are read from a client which may have no more requests, to find a hold in them
  static constexpr int kMostUnread = 32 * 1024;  // bytes on their way to a client that it has not read; above that it gets no update of a watch list
  static constexpr std::int64_t kPatienceNs = 10'000'000'000;
  static constexpr std::int64_t kDenyNs = 60'000'000'000;  // a user's refusals are written down once in this time

  // `services` must outlive the server. `control`: name of the control, for the greeting.
  LocalServer(Services* services, std::string control, Judge judge);
  ~LocalServer() { stop(); }
  LocalServer(const LocalServer&) = delete;
  LocalServer& operator=(const LocalServer&) = delete;

  // Who is asked for the credentials of peers in place of the kernel. Before start().
  void set_witness(Witness witness) { witness_ = std::move(witness); }
  // How long a client may keep its answers unread, or a frame unended, in place of kPatienceNs. Before start().
  void set_patience(std::int64_t ns) { patience_ns_ = ns; }
  // Makes the socket. A path at which a living process listens is refused. False with a sentence in *error.
  bool open(const std::string& path, std::string* error);
  // Starts the threads. False with a sentence in *error.
  bool start(std::string* error);
  void stop();
  // The most bytes that have waited for one client since the start. Any thread.
  std::size_t most_waiting() const { return most_waiting_.load(); }
  // The most jobs that have waited for a thread since the start. Any thread.
  std::size_t most_queued() const { return most_queued_.load(); }
  // The commands of local clients that were answered later. Any thread.
  void settled(const share::Ack& ack);

 private:
  struct Connection {
    int socket = -1;
    std::shared_ptr<Session> session;
    FrameReader in;
    ArrivalsAhead ahead;       // of the requests in `in` that were looked at before their turn
    std::string out;
    std::size_t sent = 0;      // bytes of `out` that were sent
    unsigned outstanding = 0;  // requests without an answer
    std::int64_t read_ns = 0, written_ns = 0;  // since when the rest of a frame, or a reader, is waited for
    std::map<std::uint32_t, std::uint64_t> left_out;  // updates of its watch lists that were left out since the last one
    bool closing = false;      // nothing more is read; the connection ends when everything was sent
    unsigned rank = 0;         // of its peer, when it came (rank_of)
  };
  struct Job {
    std::shared_ptr<Session> session;
    Call call;
    std::int64_t came_ns = 0;
    share::Arrival arrival{};
    bool gone = false;  // the client has gone, and there is no call
    bool denied = false;  // it had not the right; `more` refusals to its user before this one were not written down
    unsigned more = 0;
  };
  // A thread with a queue. It is bounded, because each connection has a bounded number of requests, which are dropped at its end.
  struct Worker {
    RtThread thread;
    std::mutex mutex;
    std::condition_variable wake;
    std::deque<Job> jobs;
    TurnTable turns;  // of the lane of the data; commands are executed in the order in which they have come
    std::set<std::uint64_t> begun;  // sessions of which something was executed, so that it has to be told when they are gone
    bool stop = false;
  };
  struct Answer {
    std::uint64_t session;
    std::string frame;
    std::uint32_t watch = 0;  // an update of this watch list, 0 = the answer to a request
  };

  void serve();
  void greet();
  bool make_room(const Session& session, unsigned rank);
  void turn(Connection* connection, short events);
  void receive(Connection* connection);
  void take_frames(Connection* connection);
  bool take_while_room(Connection* connection);
  void look_ahead(Connection* connection);
  static bool takes_more(const Connection& connection);
  void take(Connection* connection, const std::string& frame);
  Outcome limit(Connection* connection, const Call& call);
  void send_out(Connection* connection);
  void deny(const std::shared_ptr<Session>& session, const Call& call);
  void put(Connection* connection, const std::string& text);
  void close_connection(Connection* connection);
  void deliver();
  void give_update(Connection* connection, const Answer& update);
  static bool has_room(const Connection& connection);
  bool late(const Connection& connection, std::int64_t now_ns) const;
  static std::size_t next_in_turn(Worker* worker);
  void work(Worker* worker, Lane lane);
  void execute(const Job& job, Lane lane);
  void execute_command(const Job& job);
  void answer(std::uint64_t session, std::uint64_t id, const Outcome& outcome);
  void post(Lane lane, Job job);
  void end_session(const std::shared_ptr<Session>& session, Lane lane);
  void post_updates();
  void wake_up();

  Services& services_;
  const std::string control_;
  const Judge judge_;
  std::int64_t patience_ns_ = kPatienceNs;
  Witness witness_ = credentials_of;
  std::string path_;
  int listen_ = -1, wake_ = -1;
  bool started_ = false;
  RtThread thread_;
  Worker command_, data_;
  std::vector<std::unique_ptr<Connection>> connections_;
  std::uint64_t next_session_ = 1;
  struct Denied {
    std::int64_t written_ns = 0;
    unsigned more = 0;
  };
  std::map<uid_t, Denied> denied_;  // who was refused, so that nobody fills the history by it
  std::atomic<std::size_t> most_waiting_{0}, most_queued_{0};
  bool full_ = false;  // no descriptors are left: nobody is let in for a while

  std::mutex mutex_;  // guards what follows
  bool stop_ = false;
  std::deque<Answer> answers_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::uint64_t> waiting_;  // (session, sequence) of a command -> id of its request
};

}  // namespace nc::rt::services
