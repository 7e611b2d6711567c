// SPDX-License-Identifier: Apache-2.0
// See change_log.hpp.
#include "runtime/services/change_log.hpp"

#include <fcntl.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

#include "runtime/services/system_error.hpp"

namespace nc::rt::services {
namespace {

Json to_json(const Change& change) {
  return {{"time_ns", change.time_ns}, {"user", change.user},     {"client", change.client}, {"service", change.service},
          {"what", change.what},       {"before", change.before}, {"after", change.after}};
}

// The change that a line of the file stands for. False for a line that was cut off by a power cut, or written by somebody else.
bool from_line(const std::string& line, Change* change) {
  const Json json = Json::parse(line, nullptr, false);
  if (!json.is_object()) return false;
  const auto text = [&](const char* key, std::string* to) {
    const auto found = json.find(key);
    if (found == json.end() || !found->is_string()) return false;
    *to = found->get<std::string>();
    return true;
  };
  const auto time = json.find("time_ns");
  if (time == json.end() || !time->is_number_integer()) return false;
  change->time_ns = time->get<std::int64_t>();
  return text("user", &change->user) && text("client", &change->client) && text("service", &change->service) && text("what", &change->what) &&
         text("before", &change->before) && text("after", &change->after);
}

}  // namespace

std::string user_name(uid_t user) {
  std::vector<char> buffer(16384);
  passwd entry{};
  passwd* found = nullptr;
  if (getpwuid_r(user, &entry, buffer.data(), buffer.size(), &found) == 0 && found != nullptr) return found->pw_name;
  return std::to_string(user);
}

ChangeLog::~ChangeLog() {
  if (file_ >= 0) close(file_);
}

void ChangeLog::read_back(const std::string& file) {
  std::ifstream lines(file, std::ios::binary);
  for (std::string line; std::getline(lines, line);) {
    Change change;
    if (!from_line(line, &change)) continue;
    changes_.push_back(std::move(change));
    if (changes_.size() > kRemembered) changes_.pop_front();
  }
}

bool ChangeLog::open(std::string* error) {
  if (path_.empty()) return true;
  read_back(path_ + ".1");
  read_back(path_);
  file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0640);
  struct stat info {};
  if (file_ >= 0 && fstat(file_, &info) == 0 && S_ISREG(info.st_mode)) {
    // A line that a power cut has cut off must not run into the next one.
    if (info.st_size == 0 || write(file_, "\n", 1) == 1) return true;
  }
  *error = system_error(path_);
  return false;
}

bool ChangeLog::turn(std::string* error) {
  struct stat info {};
  if (fstat(file_, &info) != 0 || info.st_size < kMostBytes) return true;
  const int next = rename(path_.c_str(), (path_ + ".1").c_str()) == 0
                       ? ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0640)
                       : -1;
  if (next < 0) {
    *error = system_error(path_);
    return false;
  }
  close(file_);
  file_ = next;
  return true;
}

bool ChangeLog::add(const Change& change, std::string* error) {
  changes_.push_back(change);
  if (changes_.size() > kRemembered) changes_.pop_front();
  if (path_.empty()) return true;
  if (file_ < 0) {
    *error = path_ + " is not open";
    return false;
  }
  if (!turn(error)) return false;
  const std::string line = to_json(change).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  if (write(file_, line.data(), line.size()) == static_cast<ssize_t>(line.size()) && fdatasync(file_) == 0) return true;
  *error = system_error(path_);
  return false;
}

Json ChangeLog::newest(std::uint64_t from, std::uint64_t count) const {
  Json list = Json::array();
  for (std::uint64_t i = from; i < changes_.size() && i - from < count; ++i) list.push_back(to_json(changes_[changes_.size() - 1 - i]));
  return {{"changes", std::move(list)}};
}

}  // namespace nc::rt::services
