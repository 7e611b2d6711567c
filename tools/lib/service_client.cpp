// SPDX-License-Identifier: Apache-2.0
// See service_client.hpp.
#include "tools/lib/service_client.hpp"

#include <dirent.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "runtime/services/call.hpp"
#include "runtime/services/frames.hpp"

namespace nc::tools {
namespace {

constexpr timeval kPatience{30, 0};
constexpr std::size_t kReadBytes = 65536;

int status_of(const std::string& error) {
  using rt::services::Refused;
  const auto is = [&](Refused why) { return error == rt::services::refused_name(why); };
  if (is(Refused::kMalformed) || is(Refused::kUnknownService)) return kControlUsage;
  if (is(Refused::kNoRight)) return kControlNoRight;
  if (is(Refused::kNoControl)) return kControlNoControl;
  if (is(Refused::kNotReached) || is(Refused::kFailed)) return kControlFailed;
  return kControlRefused;
}

// The refusal that a message holds.
ServiceRefusal refusal_of(const Json& message) { return refusal_named(message.value("error", "failed"), message.value("text", "")); }

// An update of a watch list comes without a request.
bool is_update(const Json& message) { return message.contains("watch") && !message.contains("id"); }

void add_sockets(const std::string& folder, std::vector<std::string>* paths) {
  DIR* stream = opendir(folder.c_str());
  if (stream == nullptr) return;
  const std::string ending = ".sock";
  while (const dirent* entry = readdir(stream)) {  // NOLINT(concurrency-mt-unsafe): only this function uses the stream
    const std::string name = entry->d_name;
    if (name.size() > ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0) paths->push_back(folder + "/" + name);
  }
  closedir(stream);
}

class LocalClient : public ServiceClient {
 public:
  LocalClient() {}  // not = default, which would be noexcept: a Json may need memory
  ~LocalClient() override {
    if (socket_ >= 0) close(socket_);
  }
  bool open(const std::string& path, ServiceRefusal* refusal);
  bool call(const std::string& service, const Json& args, Json* reply, ServiceRefusal* refusal) override;
  bool next_update(Json* update, ServiceRefusal* refusal) override;
  bool may_use(const rt::services::ServiceRow& row) override { return row.allows(rights_); }

 private:
  bool receive(Json* message, ServiceRefusal* refusal);
  int socket_ = -1;
  rt::services::RightSet rights_;  // as the greeting names them; they stay until the connection ends
  std::uint64_t next_id_ = 1;
  rt::services::FrameReader in_;
};

}  // namespace

ServiceRefusal refusal_named(const std::string& error, const std::string& text) { return {status_of(error), error, text}; }

ServiceRefusal no_connection(const std::string& text) { return {kControlNobody, "no connection", text}; }

std::unique_ptr<ServiceClient> open_local_client(const std::string& path, ServiceRefusal* refusal) {
  auto client = std::make_unique<LocalClient>();
  if (client->open(path, refusal)) return client;
  return nullptr;
}

std::vector<std::string> find_sockets() {
  std::vector<std::string> paths;
  add_sockets("/run/ncrtd", &paths);
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nothing in this process changes its environment
  if (const char* folder = std::getenv("XDG_RUNTIME_DIR"); folder != nullptr && folder[0] == '/') add_sockets(std::string(folder) + "/ncrtd", &paths);
  std::sort(paths.begin(), paths.end());
  return paths;
}

bool LocalClient::open(const std::string& path, ServiceRefusal* refusal) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) {
    *refusal = no_connection(path + ": the path is too long");
    return false;
  }
  std::memcpy(address.sun_path, path.data(), path.size());
  socket_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (socket_ < 0 || connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    *refusal = no_connection(path + ": " + (errno == ECONNREFUSED || errno == ENOENT ? "no control runs there" : std::strerror(errno)));
    return false;
  }
  (void)setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &kPatience, sizeof kPatience);
  (void)setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &kPatience, sizeof kPatience);
  Json greeting;
  if (!receive(&greeting, refusal)) return false;
  if (greeting.value("ncrtd", 0u) != rt::services::kProtocol) {
    *refusal = no_connection(path + ": it speaks another protocol");
    return false;
  }
  for (const Json& name : greeting.value("rights", Json::array()))
    if (const auto right = name.is_string() ? rt::services::find_right(name.get_ref<const std::string&>()) : std::nullopt) rights_.add(*right);
  if (greeting.value("ok", false)) return true;
  *refusal = refusal_of(greeting);
  return false;
}

bool LocalClient::receive(Json* message, ServiceRefusal* refusal) {
  std::string text;
  for (;;) {
    const auto next = in_.next(&text);
    if (next == rt::services::FrameReader::Next::kFrame) break;
    char bytes[kReadBytes];
    const ssize_t count = next == rt::services::FrameReader::Next::kTooLong ? 0 : recv(socket_, bytes, sizeof bytes, 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      *refusal = no_connection(count == 0 ? "the control has ended the connection" : "the control does not answer");
      return false;
    }
    in_.add({bytes, static_cast<std::size_t>(count)});
  }
  *message = Json::parse(text, nullptr, false);
  if (message->is_object()) return true;
  *refusal = no_connection("the control sends what is no reply");
  return false;
}

bool LocalClient::call(const std::string& service, const Json& args, Json* reply, ServiceRefusal* refusal) {
  const Json request = {{"id", next_id_}, {"service", service}, {"args", args}};
  const std::string frame = rt::services::frame_of(request.dump(-1, ' ', false, Json::error_handler_t::replace));
  for (std::size_t sent = 0; sent < frame.size();) {
    const ssize_t count = send(socket_, frame.data() + sent, frame.size() - sent, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      *refusal = no_connection("the control has ended the connection");
      return false;
    }
    sent += static_cast<std::size_t>(count);
  }
  Json message;
  do {
    if (!receive(&message, refusal)) return false;
  } while (is_update(message) || (message.value("id", std::uint64_t{0}) != next_id_ && message.value("ok", false)));
  ++next_id_;
  if (!message.value("ok", false)) {
    *refusal = refusal_of(message);
    return false;
  }
  *reply = message.value("reply", Json::object());
  return true;
}

bool LocalClient::next_update(Json* update, ServiceRefusal* refusal) {
  do {
    if (!receive(update, refusal)) return false;
  } while (!is_update(*update));
  return true;
}

}  // namespace nc::tools
