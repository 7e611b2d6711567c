// SPDX-License-Identifier: Apache-2.0
// See change_log.hpp.
#include "runtime/services/change_log.hpp"

#include <fcntl.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <vector>

#include "runtime/services/system_error.hpp"

namespace nc::rt::services {
namespace {

// As it is shown.
Json to_json(const Change& change) {
  return {{"number", change.number}, {"time_ns", change.time_ns}, {"user", change.user},   {"client", change.client}, {"service", change.service},
          {"what", change.what},     {"before", change.before},   {"after", change.after}, {"undone_by", change.undone_by}, {"lost", is_lost(change)}};
}

// As it stands in the file.
std::string to_line(const Change& change) {
  Json json = to_json(change);
  json.erase("undone_by");  // it comes later: the undo says what it has taken back
  json.erase("lost");       // so does this: it is found at each start
  if (change.undoes != 0) json["undoes"] = change.undoes;
  if (!change.values.empty()) {
    Json values = Json::array();
    for (const ValueChange& value : change.values) values.push_back({place_key(value.place), value.before, value.after});
    json["values"] = std::move(values);
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

// The values of a change, none of them when one cannot be read.
std::vector<ValueChange> values_of(const Json& json) {
  std::vector<ValueChange> values;
  const auto list = json.find("values");
  if (list == json.end() || !list->is_array()) return {};
  for (const Json& row : *list) {
    ValueChange value;
    if (!row.is_array() || row.size() != 3 || !row[0].is_string() || !row[1].is_string() || !row[2].is_string()) return {};
    if (!parse_place(row[0].get<std::string>(), &value.place)) return {};
    value.before = row[1].get<std::string>();
    value.after = row[2].get<std::string>();
    values.push_back(std::move(value));
  }
  return values;
}

std::uint64_t number_of(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number_unsigned() ? found->get<std::uint64_t>() : 0;
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
  change->number = number_of(json, "number");
  change->undoes = number_of(json, "undoes");
  change->values = values_of(json);
  return text("user", &change->user) && text("client", &change->client) && text("service", &change->service) && text("what", &change->what) &&
         text("before", &change->before) && text("after", &change->after);
}

}  // namespace

bool is_lost(const Change& change) {
  return !change.values.empty() && std::all_of(change.values.begin(), change.values.end(), [](const ValueChange& value) { return value.lost; });
}

std::string user_name(uid_t user) {
  std::vector<char> buffer(16384);
  passwd entry{};
  passwd* found = nullptr;
  if (getpwuid_r(user, &entry, buffer.data(), buffer.size(), &found) == 0 && found != nullptr) return found->pw_name;
  return std::to_string(user);
}

ChangeLog::~ChangeLog() {
  std::string error;
  (void)settle(&error);  // what has no room even now is lost, as its answer has said
  if (file_ >= 0) close(file_);
}

void ChangeLog::read_back(const std::string& file) {
  std::ifstream lines(file, std::ios::binary);
  for (std::string line; std::getline(lines, line);) {
    Change change;
    if (!from_line(line, &change)) continue;
    if (const Change* same = change.number == 0 || change.number > last_ ? nullptr : find(change.number); same != nullptr && same->time_ns == change.time_ns && same->what == change.what && same->user == change.user) continue;
    if (change.number <= last_) change.number = last_ + 1;  // it was written before changes had numbers
    remember(std::move(change));
  }
}

void ChangeLog::remember(Change change) {
  last_ = change.number;
  if (change.undoes != 0)
    for (Change& other : changes_)
      if (other.number == change.undoes) other.undone_by = change.number;
  values_ += change.values.size();
  changes_.push_back(std::move(change));
  if (changes_.size() > kRemembered) {
    values_ -= changes_.front().values.size();
    changes_.pop_front();
  }
  for (auto oldest = changes_.begin(); values_ > kRememberedValues && oldest + 1 != changes_.end(); ++oldest) {
    values_ -= oldest->values.size();
    oldest->values = {};
  }
}

const Change* ChangeLog::find(std::uint64_t number) const {
  for (const Change& change : changes_)
    if (change.number == number) return &change;
  return nullptr;
}

const Change* ChangeLog::last_of(const std::string& user, Right right, std::vector<const Change*>* lost) const {
  std::vector<const Change*> left_out;
  const Change* found = nullptr;
  for (auto change = changes_.rbegin(); change != changes_.rend() && found == nullptr; ++change) {
    const ServiceRow* row = find_service(change->service);
    if (change->user != user || change->values.empty() || change->undoes != 0 || row == nullptr || row->right != right) continue;
    if (change->undone_by != 0) left_out.clear();  // the undo has named them
    else if (is_lost(*change)) left_out.push_back(&*change);
    else found = &*change;
  }
  if (lost != nullptr) *lost = std::move(left_out);
  return found;
}

std::vector<TablePlace> ChangeLog::places() const {
  std::map<std::string, TablePlace> all;
  for (const Change& change : changes_)
    for (const ValueChange& value : change.values) all.emplace(place_key(value.place), value.place);
  std::vector<TablePlace> places;
  places.reserve(all.size());
  for (auto& [key, place] : all) places.push_back(std::move(place));
  return places;
}

bool ChangeLog::open(std::string* error) {
  if (path_.empty()) return true;
  read_back(path_ + ".1");
  read_back(path_);
  return open_file(error) && settle(error);
}

bool ChangeLog::open_file(std::string* error) {
  file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0640);
  struct stat info {};
  if (file_ < 0 || fstat(file_, &info) != 0 || !S_ISREG(info.st_mode)) {
    *error = file_ < 0 ? system_error(path_) : path_ + " is no file";
    if (file_ >= 0) close(file_);
    file_ = -1;
    return false;
  }
  // A line that a power cut has cut off must not run into the next one.
  if (info.st_size != 0) waiting_.insert(0, "\n");
  return true;
}

// A file that has its size becomes PATH.1. When there can be no new one, it keeps its name.
bool ChangeLog::turn(std::string* error) {
  struct stat info {};
  if (fstat(file_, &info) != 0 || info.st_size < kMostBytes) return true;
  const std::string old = path_ + ".1";
  const bool renamed = rename(path_.c_str(), old.c_str()) == 0;
  const int next = renamed ? ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0640) : -1;
  if (next < 0) {
    *error = system_error(path_);
    if (renamed) (void)rename(old.c_str(), path_.c_str());
    return false;
  }
  close(file_);
  file_ = next;
  return true;
}

bool ChangeLog::add(Change change, std::string* error) {
  change.number = last_ + 1;
  const std::string line = to_line(change);
  remember(std::move(change));
  if (path_.empty()) return true;
  bool dropped = false;
  while (!waiting_.empty() && waiting_.size() + line.size() > kMostWaiting) {
    const std::size_t first = waiting_[0] == '\n' ? 1 : 0;  // the end of a line that was cut off stays
    waiting_.erase(first, waiting_.find('\n', first) + 1 - first);
    dropped = true;
  }
  waiting_ += line;
  if (settle(error)) return true;
  *error += dropped ? "; it waits for room, and older ones are lost" : "; it waits for room";
  return false;
}

bool ChangeLog::settle(std::string* error) {
  if (path_.empty() || (file_ >= 0 && waiting_.empty())) return true;
  if (file_ < 0 && !open_file(error)) return false;
  if (!turn(error)) return false;
  struct stat before {};
  const bool known = fstat(file_, &before) == 0;
  const ssize_t count = write(file_, waiting_.data(), waiting_.size());
  const bool whole = count == static_cast<ssize_t>(waiting_.size());
  if (whole && fdatasync(file_) == 0) {
    waiting_.clear();
    return true;
  }
  *error = count >= 0 && !whole ? path_ + ": the disk is full" : system_error(path_);
  if (count <= 0 || (known && ftruncate(file_, before.st_size) == 0)) return false;
  // What is left of it must not run into the next line; a line that is written twice counts once (read_back()).
  *error += ", and half of a line is left";
  if (waiting_[0] != '\n') waiting_.insert(0, "\n");
  return false;
}

Json ChangeLog::newest(std::uint64_t from, std::uint64_t count, const std::string& of) const {
  Json list = Json::array();
  std::uint64_t found = 0;
  for (auto change = changes_.rbegin(); change != changes_.rend() && list.size() < count; ++change) {
    const auto is_wanted = [&](const ValueChange& value) { return is_of(value.place, of); };
    if (!of.empty() && std::none_of(change->values.begin(), change->values.end(), is_wanted)) continue;
    if (found++ >= from) list.push_back(to_json(*change));
  }
  return {{"changes", std::move(list)}};
}

}  // namespace nc::rt::services
