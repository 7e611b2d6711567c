// SPDX-License-Identifier: Apache-2.0
// A simulated machine in real time with the services on a socket in a folder of its own, and a client.
#pragma once

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "hal/sim/sim_machine.hpp"
#include "runtime/services/local_server.hpp"
#include "runtime/share/service.hpp"
#include "runtime/test_config.hpp"
#include "tools/lib/program_check.hpp"
#include "tools/lib/program_files.hpp"

namespace nc::test {

using rt::services::Json;

class ServiceClient {
 public:
  explicit ServiceClient(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, path.data(), std::min(path.size(), sizeof address.sun_path - 1));
    socket_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const timeval patience{60, 0};
    (void)setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    if (connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) greeting = receive();
  }
  ~ServiceClient() { leave(); }
  ServiceClient(const ServiceClient&) = delete;
  ServiceClient& operator=(const ServiceClient&) = delete;

  void leave() {
    if (socket_ >= 0) close(socket_);
    socket_ = -1;
  }
  // False when the server has closed the connection.
  bool send_bytes(const std::string& bytes) {
    for (std::size_t sent = 0; sent < bytes.size();) {
      const ssize_t count = send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (count <= 0) return false;
      sent += static_cast<std::size_t>(count);
    }
    return true;
  }
  bool ask(std::uint64_t id, const std::string& service, const Json& args = Json::object()) {
    return send_bytes(rt::services::frame_of(Json{{"id", id}, {"service", service}, {"args", args}}.dump()));
  }
  // From now on only a few requests have room on their way to the server.
  void queue_little() {
    const int least = 1;  // the system makes more of it
    EXPECT_EQ(setsockopt(socket_, SOL_SOCKET, SO_SNDBUF, &least, sizeof least), 0);
  }
  // Sends a request of some size without waiting. False when there is no room for it, as the server has not read those before.
  bool offer(std::uint64_t id, const std::string& service) {
    const std::string frame = rt::services::frame_of(Json{{"id", id}, {"service", service}}.dump() + std::string(1000, ' '));
    return send(socket_, frame.data(), frame.size(), MSG_NOSIGNAL | MSG_DONTWAIT) == static_cast<ssize_t>(frame.size());
  }
  // The next message as it has come. False when the connection has ended.
  bool receive_text(std::string* text) {
    char bytes[4096];
    while (in_.next(text) != rt::services::FrameReader::Next::kFrame) {
      const ssize_t count = recv(socket_, bytes, sizeof bytes, 0);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return false;
      in_.add({bytes, static_cast<std::size_t>(count)});
    }
    return true;
  }
  // The next message; null when the connection has ended.
  Json receive() {
    std::string text;
    return receive_text(&text) ? Json::parse(text) : Json(nullptr);
  }
  Json call(const std::string& service, const Json& args = Json::object()) {
    if (!ask(++id_, service, args)) return nullptr;
    return receive();
  }
  // "" = done, else the name of the refusal.
  std::string outcome(const std::string& service, const Json& args = Json::object()) {
    const Json message = call(service, args);
    return message.is_null() ? "no connection" : message["ok"] == true ? "" : message["error"].get<std::string>();
  }

  Json greeting;

 private:
  int socket_ = -1;
  std::uint64_t id_ = 0;
  rt::services::FrameReader in_;
};

// The members of a reply, as the table of services writes them: "tools[].number".
inline void collect_members(const Json& value, const std::string& path, std::set<std::string>* paths) {
  if (value.is_object())
    for (const auto& [key, member] : value.items()) collect_members(member, path.empty() ? key : path + "." + key, paths);
  else if (value.is_array())
    for (const Json& element : value) collect_members(element, path + "[]", paths);
  else
    paths->insert(path);
}

class LocalMachine : public testing::Test {
 protected:
  void SetUp() override {
    char pattern[] = "/tmp/nc-services-XXXXXX";
    ASSERT_NE(mkdtemp(pattern), nullptr);
    folder_ = pattern;
    std::filesystem::create_directory(folder_ + "/programs");
    path_ = folder_ + "/control.sock";
    start();
  }
  void TearDown() override {
    stop();
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }

  virtual std::string machine_text() {
    return base_toml() + "[scheduling]\npolicy = \"other\"\nlock_memory = false\noverrun = \"count\"\n[services]\nchanges = \"changes\"\nhistory = \"history\"\nprogram_mb = 4\nprograms_mb = 8\n" + check_text();
  }
  // Whether commands come through the segment, too.
  virtual bool has_commands() { return false; }
  // Whether programs are checked; most tests start those that they have just written.
  virtual std::string check_text() { return "check = \"off\"\n"; }
  // How long the server waits for a client that does not read.
  virtual std::int64_t patience_ns() { return rt::services::LocalServer::kPatienceNs; }
  void start() {
    std::string text = machine_text();
    text.replace(text.find("name = \"test\"\n"), 0, "programs = \"programs\"\nvariables = \"variables\"\noffsets = \"offsets\"\n");
    config_ = rt::Config();
    for (const rt::ConfigError& error : rt::parse_config(text, folder_ + "/machine.toml", &config_)) FAIL() << error.text();
    sim_ = std::make_unique<hal::SimMachine>(config_.sim, config_.points);
    std::vector<rt::ConfigError> refused;
    runtime_ = rt::Runtime::create(config_, {&clock_, sim_.get(), nullptr, nullptr}, &refused);
    ASSERT_NE(runtime_, nullptr);
    programs_ = std::make_unique<rt::share::ProgramTable>(static_cast<nc_dialect>(config_.nc.dialect));
    files_ = std::make_unique<tools::ProgramFiles>(config_.programs_folder(), config_.program_text);
    files_->set_stop([this] { return runtime_->reads_too_long(); });
    files_->attach(runtime_->control());
    files_->set_watch([this](unsigned file, const std::string& path, const tools::ProgramFiles::Text& read) { programs_->add_name(file, path, read); }, [this](unsigned file) { programs_->drop(file); });
    runtime_->set_program_loader([this](const std::string& name, unsigned* file, std::string* why) {
      const std::string path = config_.programs_folder() + "/" + name;
      if (files_->add(runtime_->control(), path, file, why) != NC_OK) return false;
      programs_->add(*file, path, files_->text_of(*file));
      return true;
    });
    rt::share::ServiceOptions options;
    options.name = "unit-s" + std::to_string(getpid());
    options.local = true;
    options.commands = has_commands();
    share_ = std::make_unique<rt::share::Service>(runtime_.get(), programs_.get(), nullptr, options);
    std::string error;
    ASSERT_TRUE(share_->create(&error)) << error;
    history_ = std::make_unique<rt::history::Recorder>(runtime_.get(), programs_.get(), config_.history_path(), rt::history::StoreLimits{}, [this](const std::string& what) {
      const std::lock_guard lock(mutex_);
      said_ += what + "\n";
    });
    runtime_->set_history(history_->tap());
    services_ = std::make_unique<rt::services::Services>(runtime_.get(), programs_.get(), share_->desk(), share_->segment(), history_.get());
    checks_ = std::make_unique<rt::services::ProgramChecks>(config_, programs_.get(), [this](const rt::services::CheckOrder& order, const std::atomic<bool>& given_up) {
      return tools::check_program(config_, tools::machine_tables(runtime_.get()), order, given_up);
    });
    services_->set_checks(checks_.get());
    runtime_->set_start_gate(checks_.get());
    services_->open(&error);
    ASSERT_EQ(error, "");
    server_ = std::make_unique<rt::services::LocalServer>(services_.get(), options.name, [this](const rt::services::Credentials&) {
      const std::lock_guard lock(mutex_);
      return rights_;
    });
    server_->set_witness([this](int socket, rt::services::Credentials* peer) {
      const std::lock_guard lock(mutex_);
      const bool known = rt::services::credentials_of(socket, peer);
      if (user_) peer->user = *user_;
      return known;
    });
    server_->set_patience(patience_ns());
    ASSERT_TRUE(server_->open(path_, &error)) << error;
    share_->desk()->set_local([this](const rt::share::Ack& ack) { server_->settled(ack); });
    ASSERT_TRUE(runtime_->start(&error)) << error;
    ASSERT_TRUE(history_->start(&error)) << error;
    ASSERT_TRUE(checks_->start(&error)) << error;
    ASSERT_TRUE(share_->start(&error)) << error;
    ASSERT_TRUE(server_->start(&error)) << error;
  }
  void stop() {
    if (server_ != nullptr) server_->stop();
    if (checks_ != nullptr) checks_->stop();
    if (share_ != nullptr) share_->stop();
    if (runtime_ != nullptr) runtime_->stop();
    if (history_ != nullptr) history_->stop();
    server_.reset();
    services_.reset();
    checks_.reset();
    share_.reset();
    history_.reset();
    runtime_.reset();
  }
  // The rights of clients that connect from now on.
  void give(std::initializer_list<rt::services::Right> rights) {
    const std::lock_guard lock(mutex_);
    rights_ = {};
    for (const auto right : rights) rights_.add(right);
  }
  // Calls the service until its reply fulfils the condition.
  template <class Condition>
  Json until(ServiceClient* client, const std::string& service, Condition condition, const Json& args = Json::object()) {
    for (;;) {
      const Json reply = client->call(service, args);
      if (reply.is_null() || condition(reply["reply"])) return reply.is_null() ? reply : reply["reply"];
      usleep(5000);
    }
  }
  std::string in_programs(const std::string& name) const { return folder_ + "/programs/" + name; }
  void write_program(const std::string& name, const std::string& text) const { std::ofstream(in_programs(name), std::ios::binary) << text; }

  std::string folder_, path_;
  rt::Config config_;
  rt::RealClock clock_;
  std::unique_ptr<hal::SimMachine> sim_;
  std::unique_ptr<rt::Runtime> runtime_;
  std::unique_ptr<tools::ProgramFiles> files_;
  std::unique_ptr<rt::share::ProgramTable> programs_;
  std::unique_ptr<rt::share::Service> share_;
  std::unique_ptr<rt::history::Recorder> history_;
  std::string said_;  // by the history; guarded by mutex_
  std::unique_ptr<rt::services::ProgramChecks> checks_;
  std::unique_ptr<rt::services::Services> services_;
  std::unique_ptr<rt::services::LocalServer> server_;
  std::mutex mutex_;
  rt::services::RightSet rights_ = rt::services::RightSet::all();
  std::optional<uid_t> user_;  // clients that connect from now on are this one, and not who runs the test
};

}  // namespace nc::test
