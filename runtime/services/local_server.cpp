// SPDX-License-Identifier: Apache-2.0
// See local_server.hpp.
#include "runtime/services/local_server.hpp"

#include <fcntl.h>
#include <linux/sockios.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "runtime/services/places.hpp"
#include "runtime/services/system_error.hpp"

namespace nc::rt::services {
namespace {

constexpr int kWaiting = 16;                // peers that may connect at the same time
constexpr int kLookMs = 500;                // interval at which clients that do not go on are looked for
constexpr std::size_t kReadBytes = 65536;
constexpr std::size_t kMostDenied = 1000;     // users whose refusals are counted

// What makes the machine safer counts although its client has gone.
bool stops(const Call& call) { return call.row != nullptr && call.row->of_command().stops(); }

bool address_of(const std::string& path, sockaddr_un* address) {
  *address = {};
  address->sun_family = AF_UNIX;
  if (path.empty() || path.size() > kLongestSocketPath) return false;
  std::memcpy(address->sun_path, path.data(), path.size());
  return true;
}

// Whether a process listens there.
bool answers(const sockaddr_un& address) {
  const int probe = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (probe < 0) return false;
  const bool connected = connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 || errno == EAGAIN;
  close(probe);
  return connected;
}

std::int64_t now_ns() { return RealClock().now_ns(); }

}  // namespace

std::string socket_path(const ServicesConfig& config, const std::string& share) {
  if (!config.socket.empty()) return config.socket;
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nothing in this process changes its environment
  if (const char* folder = std::getenv("RUNTIME_DIRECTORY"); folder != nullptr && folder[0] == '/') {
    const std::string first = std::string(folder).substr(0, std::string(folder).find(':'));
    return first + "/" + share + ".sock";
  }
  // NOLINTNEXTLINE(concurrency-mt-unsafe)
  if (const char* folder = std::getenv("XDG_RUNTIME_DIR"); folder != nullptr && folder[0] == '/') return std::string(folder) + "/ncrtd/" + share + ".sock";
  return "";
}

LocalServer::LocalServer(Services* services, std::string control, Judge judge)
    : services_(*services), control_(std::move(control)), judge_(std::move(judge)) {}

bool LocalServer::open(const std::string& path, std::string* error) {
  sockaddr_un address;
  if (!address_of(path, &address)) {
    *error = "the path of the socket is empty or too long: \"" + path + "\"";
    return false;
  }
  (void)mkdir(path.substr(0, path.rfind('/')).c_str(), 0755);  // it is there already, or bind() says why not
  struct stat info {};
  if (lstat(path.c_str(), &info) == 0) {
    if (!S_ISSOCK(info.st_mode) || answers(address)) {
      *error = path + (S_ISSOCK(info.st_mode) ? " belongs to another process that runs" : " is there and is no socket");
      return false;
    }
    (void)unlink(path.c_str());  // of a process that has ended without removing it
  }
  listen_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  wake_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  // Everybody may connect: who may do what is asked of the kernel for each peer, and the file cannot say it for four groups.
  const bool good = listen_ >= 0 && wake_ >= 0 && bind(listen_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  if (good) path_ = path;
  if (good && chmod(path.c_str(), 0666) == 0 && listen(listen_, kWaiting) == 0) return true;
  *error = system_error(path);
  stop();
  return false;
}

bool LocalServer::start(std::string* error) {
  started_ = true;
  return command_.thread.start([this] { work(&command_, Lane::kCommand); }, error) && data_.thread.start([this] { work(&data_, Lane::kData); }, error) &&
         thread_.start([this] { serve(); }, error);
}

void LocalServer::stop() {
  if (started_) {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    wake_up();
    thread_.join();
    for (Worker* worker : {&command_, &data_}) {
      {
        const std::lock_guard lock(worker->mutex);
        worker->stop = true;
      }
      worker->wake.notify_all();
      worker->thread.join();
    }
    started_ = false;
  }
  if (listen_ >= 0) close(listen_);
  if (wake_ >= 0) close(wake_);
  if (!path_.empty()) (void)unlink(path_.c_str());
  listen_ = wake_ = -1;
  path_.clear();
}

void LocalServer::wake_up() {
  const std::uint64_t one = 1;
  while (wake_ >= 0 && write(wake_, &one, sizeof one) < 0 && errno == EINTR) continue;  // a full counter wakes as well
}

// ---- the thread of the sockets ----

void LocalServer::serve() {
  std::vector<pollfd> ready;
  for (;;) {
    {
      const std::lock_guard lock(mutex_);
      if (stop_) break;
    }
    ready.assign({{wake_, POLLIN, 0}, {full_ ? -1 : listen_, POLLIN, 0}});
    for (const auto& connection : connections_) {
      const bool reads = !connection->closing && (takes_more(*connection) || connection->in.waiting() < kMostAhead);
      const bool writes = connection->sent < connection->out.size();
      ready.push_back({connection->socket, static_cast<short>((reads ? POLLIN : 0) | (writes ? POLLOUT : 0)), 0});
    }
    const int count = poll(ready.data(), ready.size(), full_ ? 100 : kLookMs);
    full_ = false;
    if (count < 0) continue;
    std::uint64_t woken = 0;
    if ((ready[0].revents & POLLIN) != 0 && read(wake_, &woken, sizeof woken) > 0) deliver();
    for (std::size_t i = 0; i + 2 < ready.size(); ++i) turn(connections_[i].get(), ready[i + 2].revents);
    if ((ready[1].revents & POLLIN) != 0) greet();
    const std::int64_t now = now_ns();
    for (const auto& connection : connections_)
      if (connection->socket >= 0 && late(*connection, now)) close_connection(connection.get());
    std::erase_if(connections_, [](const auto& connection) { return connection->socket < 0; });
  }
  for (const auto& connection : connections_) close_connection(connection.get());
  connections_.clear();
}

bool LocalServer::has_room(const Connection& connection) { return connection.out.size() - connection.sent < kMostOut; }

bool LocalServer::late(const Connection& connection, std::int64_t now) const {
  const bool frame = connection.in.waits() && connection.outstanding == 0 && has_room(connection) && now - connection.read_ns > patience_ns_;
  const bool reader = connection.sent < connection.out.size() && now - connection.written_ns > patience_ns_;
  return frame || reader;
}

// Whether there is room for one connection more, after one has been closed for it where that must be.
bool LocalServer::make_room(const Session& session, unsigned rank) {
  std::vector<Connection*> held;
  unsigned same = 0, without = 0;
  for (const auto& connection : connections_) {
    if (connection->socket < 0) continue;
    held.push_back(connection.get());
    same += connection->session->user == session.user;
    without += connection->rank < kRankOfOperating;
  }
  if (same >= kPerUser) return false;
  const bool of_those_without = rank < kRankOfOperating && without >= kWithoutOperate;
  if (held.size() < kConnections && !of_those_without) return true;
  const std::string controls = services_.controlling();
  std::vector<Place> taken;
  for (const Connection* connection : held) {
    const bool kept = connection->rank == kHighestRank || connection->session->client == controls;
    taken.push_back({std::to_string(connection->session->user), connection->rank, std::max(connection->read_ns, connection->written_ns), kept});
  }
  const auto given = place_to_give_up(taken, std::to_string(session.user), rank);
  if (!given) return false;
  Connection* last = held[*given];
  put(last, encode_reply(0, Outcome::refused(Refused::kBusy, "this connection ends: another user needs its place")));
  send_out(last);
  close_connection(last);
  return true;
}

// Lets in one peer.
void LocalServer::greet() {
  const int client = accept4(listen_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
  if (client < 0) {
    full_ = errno == EMFILE || errno == ENFILE || errno == ENOMEM;
    return;
  }
  Credentials peer;
  auto connection = std::make_unique<Connection>();
  connection->socket = client;
  connection->session = std::make_shared<Session>();
  Session& session = *connection->session;
  std::string why;
  if (!witness_(client, &peer)) why = "the system does not say who you are";
  session.number = next_session_++;
  session.user = peer.user;
  session.owner = std::to_string(peer.user);
  session.client = "uid" + std::to_string(peer.user) + "/" + std::to_string(peer.process) + "." + std::to_string(session.number % 1'000'000);
  session.may_speak = peer.user == 0 || peer.user == geteuid();
  if (why.empty()) session.rights = judge_(peer);
  if (why.empty() && session.rights.none()) why = "this user has none of the rights to view, operate, set up and maintain";
  connection->rank = rank_of(session.rights, session.may_speak);
  Refused refused = Refused::kNoRight;
  if (why.empty() && !make_room(session, connection->rank)) {
    why = "too many clients";
    refused = Refused::kBusy;
  }
  Json rights = Json::array();
  for (unsigned right = 0; right < kRightCount; ++right)
    if (session.rights.has(static_cast<Right>(right))) rights.push_back(right_name(static_cast<Right>(right)));
  Json greeting = {{"ncrtd", kProtocol}, {"control", control_}, {"client", session.client}, {"rights", std::move(rights)}, {"ok", why.empty()}};
  if (!why.empty()) {
    greeting["error"] = refused_name(refused);
    greeting["text"] = why;
    if (refused == Refused::kNoRight) deny(connection->session, Call());
    connection->closing = true;
  }
  put(connection.get(), greeting.dump());
  send_out(connection.get());
  if (connection->socket >= 0 && connections_.size() < 2 * kConnections) connections_.push_back(std::move(connection));
  else close_connection(connection.get());
}

void LocalServer::turn(Connection* connection, short events) {
  if (connection->socket < 0 || events == 0) return;
  if ((events & POLLIN) != 0) receive(connection);
  else if ((events & (POLLERR | POLLHUP | POLLNVAL)) != 0) close_connection(connection);
  if (connection->socket >= 0 && (events & POLLOUT) != 0) {
    send_out(connection);
    if (connection->socket >= 0) take_frames(connection);  // those that had to wait for room
  }
}

void LocalServer::receive(Connection* connection) {
  char bytes[kReadBytes];
  const ssize_t count = recv(connection->socket, bytes, sizeof bytes, 0);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (count <= 0) return close_connection(connection);
  connection->in.add({bytes, static_cast<std::size_t>(count)});
  connection->read_ns = now_ns();
  take_frames(connection);
}

// Takes the frames that have come, as long as the client may have more requests and reads their answers.
void LocalServer::take_frames(Connection* connection) {
  bool more = true;
  while (more && connection->socket >= 0) {
    more = take_while_room(connection);
    send_out(connection);
    more = more && has_room(*connection);  // else it goes on when the client has read
  }
  if (connection->socket >= 0 && !connection->closing && !takes_more(*connection)) look_ahead(connection);
}

// A hold does not wait until its client may have one request more. What the client has sent before it, and is taken later, has come before it all the same.
void LocalServer::look_ahead(Connection* connection) {
  connection->in.look_ahead([&](std::string_view frame) {
    Call call;
    Outcome outcome;
    if (!decode_call(frame, &call, &outcome)) call.row = nullptr;
    connection->ahead.add(services_.arrived(*connection->session, call, now_ns() - call.age_ns));
  });
}

bool LocalServer::takes_more(const Connection& connection) { return connection.outstanding < kOutstanding && has_room(connection); }

// True when there was no more room for answers.
bool LocalServer::take_while_room(Connection* connection) {
  std::string frame;
  while (!connection->closing && connection->outstanding < kOutstanding) {
    if (!has_room(*connection)) return true;
    const FrameReader::Next next = connection->in.next(&frame);
    if (next == FrameReader::Next::kNone) break;
    if (next == FrameReader::Next::kTooLong) {
      put(connection, encode_reply(0, Outcome::refused(Refused::kMalformed, "a frame has at most " + std::to_string(kMostFrameBytes) + " bytes")));
      connection->closing = true;
      break;
    }
    take(connection, frame);
  }
  return false;
}

void LocalServer::take(Connection* connection, const std::string& frame) {
  Job job;
  Outcome outcome;
  const bool was_ahead = connection->ahead.take(&job.arrival);
  if (!decode_call(frame, &job.call, &outcome)) return put(connection, encode_reply(job.call.id, outcome));
  if (job.call.right) {
    RightSet came = connection->session->came.load(std::memory_order_relaxed);
    came.add(*job.call.right);
    connection->session->came.store(came, std::memory_order_relaxed);
  }
  const Session& session = *connection->session;
  if (const std::string lacks = Services::lack(session, job.call); !lacks.empty()) {
    deny(connection->session, job.call);
    return put(connection, encode_reply(job.call.id, Outcome::refused(Refused::kNoRight, lacks)));
  }
  if (job.call.row->service == Service::kLimit) return put(connection, encode_reply(job.call.id, limit(connection, job.call)));
  if (job.call.row->lane == Lane::kNow) return put(connection, encode_reply(job.call.id, services_.show(session, job.call)));
  ++connection->outstanding;
  job.session = connection->session;
  job.came_ns = now_ns() - job.call.age_ns;
  if (!was_ahead) job.arrival = services_.arrived(session, job.call, job.came_ns);
  const Lane lane = job.call.row->lane;
  post(lane, std::move(job));
}

// The session is replaced and not changed, because other threads may still look at it.
Outcome LocalServer::limit(Connection* connection, const Call& call) {
  if (connection->outstanding != 0) return Outcome::refused(Refused::kBusy, "requests of this connection are open");
  auto after = std::make_shared<Session>();
  Outcome outcome = Services::limit(*connection->session, call, after.get());
  if (!outcome.ok) return outcome;
  for (const auto& other : connections_)
    if (other.get() != connection && other->socket >= 0 && !after->behalf.empty() && other->session->behalf == after->behalf)
      return Outcome::refused(Refused::kBusy, "another connection asks for " + after->behalf);
  connection->session = std::move(after);
  return outcome;
}

// Has it written down who was refused, in a thread that may look up his name.
void LocalServer::deny(const std::shared_ptr<Session>& session, const Call& call) {
  const std::int64_t now = now_ns();
  if (denied_.size() >= kMostDenied) denied_.clear();
  const auto [place, first] = denied_.try_emplace(session->user);
  Denied& denied = place->second;
  if (!first && now - denied.written_ns < kDenyNs) {
    ++denied.more;
    return;
  }
  Job job;
  job.session = session;
  job.call.row = call.row;
  job.denied = true;
  job.more = denied.more;
  denied = {now, 0};
  post(Lane::kData, std::move(job));
}

void LocalServer::put(Connection* connection, const std::string& text) {
  if (connection->sent == connection->out.size()) {
    connection->out.clear();
    connection->sent = 0;
    connection->written_ns = now_ns();
  }
  connection->out += frame_of(text);
  most_waiting_.store(std::max(most_waiting_.load(), connection->out.size() - connection->sent));
}

// An update is left out, as a whole, while the client has not read what it has got before: so what it gets is fresh, and nobody waits for it.
void LocalServer::give_update(Connection* connection, const Answer& update) {
  send_out(connection);  // a reply, or the update of another list, that has come just now is nothing that the client does not read
  if (connection->socket < 0) return;
  std::uint64_t& left_out = connection->left_out[update.watch];
  int unread = 0;
  if (connection->sent < connection->out.size() || (ioctl(connection->socket, SIOCOUTQ, &unread) == 0 && unread > kMostUnread)) {
    ++left_out;
    return;
  }
  put(connection, "{\"left_out\":" + std::to_string(left_out) + "," + update.frame.substr(1));
  left_out = 0;
}

void LocalServer::send_out(Connection* connection) {
  while (connection->sent < connection->out.size()) {
    const ssize_t count = send(connection->socket, connection->out.data() + connection->sent, connection->out.size() - connection->sent, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EAGAIN) return;
    if (count <= 0) return close_connection(connection);
    connection->sent += static_cast<std::size_t>(count);
    connection->written_ns = now_ns();
  }
  connection->out.clear();
  connection->sent = 0;
  if (connection->closing) close_connection(connection);
}

void LocalServer::close_connection(Connection* connection) {
  if (connection->socket < 0) return;
  close(connection->socket);
  connection->socket = -1;
  connection->session->open = false;
  for (const Lane lane : {Lane::kCommand, Lane::kData}) end_session(connection->session, lane);
  const std::lock_guard lock(mutex_);
  std::erase_if(waiting_, [&](const auto& entry) { return entry.first.first == connection->session->number; });
}

// Gives the answers of the other threads to their connections.
void LocalServer::deliver() {
  std::deque<Answer> answers;
  {
    const std::lock_guard lock(mutex_);
    answers.swap(answers_);
  }
  for (const Answer& answer : answers)
    for (const auto& connection : connections_) {
      if (connection->socket < 0 || connection->session->number != answer.session) continue;
      if (answer.watch != 0) {
        if (!connection->closing) give_update(connection.get(), answer);
        continue;
      }
      --connection->outstanding;
      put(connection.get(), answer.frame);
    }
  for (const auto& connection : connections_)
    if (connection->socket >= 0) take_frames(connection.get());
}

// ---- the threads that execute ----

void LocalServer::post(Lane lane, Job job) {
  Worker& worker = lane == Lane::kCommand ? command_ : data_;
  {
    const std::lock_guard lock(worker.mutex);
    worker.jobs.push_back(std::move(job));
    most_queued_.store(std::max(most_queued_.load(), worker.jobs.size()));
  }
  worker.wake.notify_one();
}

// What a client has asked and has not had its turn yet is dropped; what it has begun ends. So whoever comes and goes leaves nothing in a queue that does not go on.
// A hold or a reset counts although its client has gone; of those that wait one of a kind is enough, which bounds them as well.
void LocalServer::end_session(const std::shared_ptr<Session>& session, Lane lane) {
  Worker& worker = lane == Lane::kCommand ? command_ : data_;
  bool wanted = false;
  {
    const std::lock_guard lock(worker.mutex);
    std::set<std::pair<Service, double>> waiting;  // stops of clients that have gone, and their part system
    std::erase_if(worker.jobs, [&](const Job& job) {
      if (job.gone || job.denied || job.session->open) return false;
      return !stops(job.call) || !waiting.emplace(job.call.row->service, job.call.value_or(Field::kSystem, 0)).second;
    });
    wanted = std::any_of(worker.jobs.begin(), worker.jobs.end(), [&](const Job& job) { return job.session->number == session->number && !job.denied; });
    if (worker.begun.erase(session->number) == 0 && !wanted) return;
  }
  Job job;
  job.session = session;
  job.gone = true;
  post(lane, std::move(job));
}

// Users take turns, and so do the clients of a user: who asks for much at once waits for himself. The requests of one client stay in their order.
std::size_t LocalServer::next_in_turn(Worker* worker) {
  std::vector<TurnTable::Waiting> waiting;
  waiting.reserve(worker->jobs.size());
  for (const Job& job : worker->jobs) waiting.push_back({job.session->owner, job.session->number});
  return worker->turns.take(waiting);
}

void LocalServer::work(Worker* worker, Lane lane) {
  if (lane == Lane::kData) services_.find_lost_changes();
  for (;;) {
    Job job;
    {
      std::unique_lock lock(worker->mutex);
      const auto woken = [&] { return worker->stop || !worker->jobs.empty(); };
      // The lists that are watched belong to this thread.
      const std::int64_t next = lane == Lane::kData ? services_.next_update_ns() : WatchDesk::kNever;
      if (next == WatchDesk::kNever) worker->wake.wait(lock, woken);
      else worker->wake.wait_for(lock, std::chrono::nanoseconds(std::max(std::int64_t{0}, next - now_ns())), woken);
      if (!woken() || (next <= now_ns() && !worker->stop)) {
        lock.unlock();
        post_updates();
        continue;
      }
      if (worker->jobs.empty()) return;  // it stops only when everything was executed, so that uploads are removed
      const auto next_job = worker->jobs.begin() + static_cast<std::ptrdiff_t>(lane == Lane::kData ? next_in_turn(worker) : 0);
      job = std::move(*next_job);
      worker->jobs.erase(next_job);
      if (job.gone) worker->begun.erase(job.session->number);
      else if (!job.denied) worker->begun.insert(job.session->number);
    }
    execute(job, lane);
  }
}

void LocalServer::post_updates() {
  std::vector<Update> updates = services_.updates(now_ns());
  if (updates.empty()) return;
  {
    const std::lock_guard lock(mutex_);
    for (Update& update : updates) answers_.push_back({update.session, std::move(update.text), update.watch});
  }
  wake_up();
}

void LocalServer::execute(const Job& job, Lane lane) {
  if (job.gone) return lane == Lane::kCommand ? services_.command_gone(*job.session) : services_.data_gone(*job.session);
  if (job.denied) return services_.notes()->denied(job.session->user, job.session->behalf, job.session->client, job.call.row == nullptr ? "" : job.call.row->name, job.more);
  if (!job.session->open && !stops(job.call)) return;  // its client has gone before its turn came
  if (lane == Lane::kCommand) return execute_command(job);
  answer(job.session->number, job.call.id, services_.data(*job.session, job.call));
}

void LocalServer::execute_command(const Job& job) {
  Session* session = job.session.get();
  std::uint64_t sequence = 0;
  const auto expect = [&](std::uint64_t number) {
    sequence = number;
    const std::lock_guard lock(mutex_);
    waiting_[{session->number, number}] = job.call.id;
  };
  Outcome outcome;
  if (!services_.command(session, job.call, job.came_ns, expect, &outcome, job.arrival)) return;
  {
    const std::lock_guard lock(mutex_);
    waiting_.erase({session->number, sequence});
  }
  answer(session->number, job.call.id, outcome);
}

void LocalServer::settled(const share::Ack& ack) {
  std::uint64_t id = 0;
  {
    const std::lock_guard lock(mutex_);
    const auto found = waiting_.find({ack.writer, ack.sequence});
    if (found == waiting_.end()) return;  // its client has gone
    id = found->second;
    waiting_.erase(found);
  }
  answer(ack.writer, id, Services::outcome_of(ack));
}

void LocalServer::answer(std::uint64_t session, std::uint64_t id, const Outcome& outcome) {
  {
    const std::lock_guard lock(mutex_);
    answers_.push_back({session, encode_reply(id, outcome), 0});
  }
  wake_up();
}

}  // namespace nc::rt::services
