// SPDX-License-Identifier: Apache-2.0
// See service_line.hpp.
#include "dds/service_line.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "runtime/services/call.hpp"

namespace nc::dds {
namespace {

using rt::services::Json;
using rt::services::Right;

constexpr std::size_t kReadBytes = 65536;

std::string words_of(const Json& message, const char* member) {
  const auto found = message.find(member);
  return found != message.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace

bool ServiceLine::open(const std::string& path, const std::string& behalf, rt::services::RightSet rights, std::string* error) {
  close();
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof address.sun_path) {
    *error = path.empty() ? "no control has its services on this computer" : path + ": the path is too long";
    return false;
  }
  std::memcpy(address.sun_path, path.data(), path.size());
  socket_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (socket_ < 0 || connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    *error = path + ": " + (errno == ECONNREFUSED || errno == ENOENT ? "no control runs there" : std::strerror(errno));  // NOLINT(concurrency-mt-unsafe): only this thread of the gateway
    close();
    return false;
  }
  Json kept = Json::array();
  for (unsigned right = 0; right < rt::services::kRightCount; ++right)
    if (rights.has(static_cast<Right>(right))) kept.push_back(rt::services::right_name(static_cast<Right>(right)));
  limit_ = Json{{"id", 0}, {"service", "rights.limit"}, {"args", {{"rights", std::move(kept)}, {"behalf", behalf}}}}.dump();
  out_ = rt::services::frame_of(limit_);
  state_ = State::kGreets;
  return true;
}

void ServiceLine::close() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
  state_ = State::kClosed;
  greeted_ = false;
  waiting_.clear();
  out_.clear();
  sent_ = 0;
  in_ = {};
}

void ServiceLine::put(const std::string& text) {
  (state_ == State::kReady ? out_ : waiting_) += rt::services::frame_of(text);
}

bool ServiceLine::send_out() {
  while (sent_ < out_.size()) {
    const ssize_t count = send(socket_, out_.data() + sent_, out_.size() - sent_, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EAGAIN) return true;
    if (count <= 0) return false;
    sent_ += static_cast<std::size_t>(count);
  }
  out_.clear();
  sent_ = 0;
  return true;
}

bool ServiceLine::receive(std::string* error) {
  char bytes[kReadBytes];
  const ssize_t count = recv(socket_, bytes, sizeof bytes, MSG_DONTWAIT);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return true;
  if (count <= 0) {
    *error = "the control has ended the connection";
    return false;
  }
  in_.add({bytes, static_cast<std::size_t>(count)});
  return state_ != State::kGreets || take_greeting(error);
}

// The greeting, then the answer to the first request.
bool ServiceLine::take_greeting(std::string* error) {
  std::string text;
  while (state_ == State::kGreets && next(&text)) {
    const Json message = Json::parse(text, nullptr, false);
    const bool good = message.is_object() && message.contains("ok") && message["ok"].is_boolean();
    *error = "what listens there is no control of this version";
    if (!good || (!greeted_ && (!message.contains("ncrtd") || message["ncrtd"] != rt::services::kProtocol))) return false;
    if (!message["ok"].get<bool>()) {
      *error = "the control refuses the gateway: " + words_of(message, "text");
      if (greeted_ && words_of(message, "error") == rt::services::refused_name(rt::services::Refused::kBusy)) state_ = State::kTaken;
      return false;
    }
    if (!greeted_) {
      greeted_ = true;
      continue;
    }
    state_ = State::kReady;
    out_ += waiting_;
    waiting_.clear();
  }
  return true;
}

bool ServiceLine::next(std::string* text) { return in_.next(text) == rt::services::FrameReader::Next::kFrame; }

std::string find_service_socket(const std::string& share) {
  std::string system = "/run/ncrtd/" + share + ".sock";
  if (access(system.c_str(), F_OK) == 0) return system;
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nothing in this process changes its environment
  const char* folder = std::getenv("XDG_RUNTIME_DIR");
  return folder != nullptr && folder[0] == '/' ? std::string(folder) + "/ncrtd/" + share + ".sock" : system;
}

}  // namespace nc::dds
