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
#include <set>
#include <string_view>
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
  if (change.undone_by == 0) json.erase("undone_by");  // it comes later: the undo says what it has taken back
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

// What a power cut, or a disk that was full, leaves of a line: its beginning, with nothing in it that a line never has.
bool is_cut_off(std::string_view line) {
  while (!line.empty() && line.back() == '\0') line.remove_suffix(1);  // room that was taken for it
  constexpr std::string_view kBegin = "{\"after\":\"";
  if (line.substr(0, kBegin.size()) != kBegin.substr(0, line.size())) return false;
  return std::none_of(line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; });
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
  change->undone_by = number_of(json, "undone_by");
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

// Returns the number of lines that are no changes, nor what a power cut leaves of one.
unsigned ChangeLog::read_back(const std::string& file) {
  unsigned damaged = 0;
  std::ifstream lines(file, std::ios::binary);
  for (std::string line; std::getline(lines, line);) {
    Change change;
    if (!from_line(line, &change)) {
      damaged += !is_cut_off(line);
      continue;
    }
    const Change* const same = change.number == 0 || change.number > last_ ? nullptr : find(change.number);
    if (same != nullptr && same->time_ns == change.time_ns && same->what == change.what && same->user == change.user) continue;
    if (change.number == 0 || same != nullptr) change.number = last_ + 1;  // it was written before changes had numbers
    remember(std::move(change));
  }
  return damaged;
}

// The damaged file gets another name, and what can be read of it goes on in a new one. When there can be no new one, everything stays as it is.
bool ChangeLog::keep_aside(const std::string& file, std::string* damage) {
  struct stat info {};
  std::string aside;
  for (unsigned n = 1; n <= kDamagedFiles && aside.empty(); ++n)
    if (const std::string name = path_ + ".damaged-" + std::to_string(n); lstat(name.c_str(), &info) != 0) aside = name;
  std::ifstream lines(file, std::ios::binary);
  std::string good;
  for (std::string line; std::getline(lines, line);)
    if (Change change; from_line(line, &change)) good += line + "\n";
  const std::string next = path_ + ".new";
  const int made = aside.empty() ? -1 : ::open(next.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0640);
  const bool written = made >= 0 && write(made, good.data(), good.size()) == static_cast<ssize_t>(good.size()) && fdatasync(made) == 0;
  if (made >= 0) close(made);
  // By a second name the file has one at each moment; a file system without such links has to do without.
  const bool kept = written && (link(file.c_str(), aside.c_str()) == 0 || rename(file.c_str(), aside.c_str()) == 0) && rename(next.c_str(), file.c_str()) == 0;
  if (!kept && made >= 0) (void)unlink(next.c_str());
  *damage += kept ? ": the file is kept as " + aside : ": the file stays as it is";
  return kept;
}

void ChangeLog::note_last(const Change& change) {
  for (const ValueChange& value : change.values) last_changes_[place_key(value.place)] = {change.user, change.time_ns, value.after};
}

// The newest is behind; one of an older number, which a new file has taken over from the one before it, gets its place.
void ChangeLog::remember(Change change) {
  if (change.undoes != 0)
    for (Change& other : changes_)
      if (other.number == change.undoes) other.undone_by = change.number;
  values_ += change.values.size();
  if (change.number > last_) {
    last_ = change.number;
    note_last(change);
    changes_.push_back(std::move(change));
  } else {
    const auto place = std::lower_bound(changes_.begin(), changes_.end(), change.number, [](const Change& one, std::uint64_t number) { return one.number < number; });
    for (const ValueChange& value : change.values) last_changes_.try_emplace(place_key(value.place), Last{change.user, change.time_ns, value.after});
    changes_.insert(place, std::move(change));
  }
  if (changes_.size() >= look_at_) {
    forget_older();
    look_at_ = std::max(changes_.size(), kRemembered) + kLookEvery;
  }
  if (values_ > kRememberedValues) forget_values();
}

// What is known of the values of a change ends.
void ChangeLog::forget(Change* change) {
  values_ -= change->values.size();
  for (const ValueChange& value : change->values) {
    std::uint64_t& newest = forgotten_[place_key(value.place)];
    newest = std::max(newest, change->number);
  }
  change->values = {};
}

void ChangeLog::forget_older() {
  std::set<std::string> seen;
  std::map<std::string, std::size_t> of_user;
  std::size_t count = 0, older = 0;
  std::deque<Change> kept;
  for (auto change = changes_.rbegin(); change != changes_.rend(); ++change) {
    bool wanted = count++ < kRemembered;
    if (!change->values.empty() && change->undoes == 0) wanted |= of_user[change->user]++ < kOfUser;
    for (const ValueChange& value : change->values) wanted |= seen.insert(place_key(value.place)).second;
    if (wanted && count > kRemembered) wanted = older++ < kMostOlder;
    if (wanted) kept.push_front(std::move(*change));
    else forget(&*change);
  }
  changes_ = std::move(kept);
}

// Who imports whole tables again and again loses what he has changed himself.
void ChangeLog::forget_values() {
  while (values_ > kRememberedValues) {
    std::map<std::string, std::size_t> of_user;
    for (const Change& change : changes_)
      if (&change != &changes_.back()) of_user[change.user] += change.values.size();
    const auto most = std::max_element(of_user.begin(), of_user.end(), [](const auto& one, const auto& other) { return one.second < other.second; });
    if (most == of_user.end() || most->second == 0) return;  // it is the newest change alone
    const auto oldest = std::find_if(changes_.begin(), changes_.end(), [&](const Change& change) { return change.user == most->first && !change.values.empty(); });
    forget(&*oldest);
  }
}

const ChangeLog::Last* ChangeLog::last_change_of(const TablePlace& place) const {
  const auto found = last_changes_.find(place_key(place));
  return found == last_changes_.end() ? nullptr : &found->second;
}

void ChangeLog::compare(const ValueOf& value_of) {
  for (Change& change : changes_)
    for (ValueChange& value : change.values) {
      const auto newest = forgotten_.find(place_key(value.place));
      value.apart = newest != forgotten_.end() && change.number < newest->second;
    }
  mark_lost(&changes_, value_of);
  // What is lost is not who has changed a value last: that is the change before it.
  std::set<std::string> lost;
  for (const Change& change : changes_)
    for (const ValueChange& value : change.values)
      if (value.lost) lost.insert(place_key(value.place));
  for (const std::string& key : lost) last_changes_.erase(key);
  for (const Change& change : changes_)
    for (const ValueChange& value : change.values)
      if (const std::string key = place_key(value.place); !value.lost && lost.count(key) != 0) last_changes_[key] = {change.user, change.time_ns, value.after};
}

// Of those that are remembered and stand in front of the file that becomes PATH.1, the newest for which there is room.
std::string ChangeLog::lines_of_older(std::uint64_t first) const {
  std::vector<std::string> newest;
  std::size_t bytes = 0;
  for (auto change = changes_.rbegin(); change != changes_.rend(); ++change) {
    if (change->number >= first || change->values.empty()) continue;
    newest.push_back(to_line(*change));
    bytes += newest.back().size();
    if (bytes > kMostOlderBytes) break;
  }
  std::string lines;
  for (auto line = newest.rbegin(); line != newest.rend(); ++line) lines += *line;
  return lines;
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

bool ChangeLog::open(std::string* error, std::string* damage) {
  if (path_.empty()) return true;
  for (const std::string& file : {path_ + ".1", path_}) {
    if (file == path_) first_in_file_ = last_ + 1;
    const unsigned damaged = read_back(file);
    if (damaged == 0) continue;
    std::string said = file + ": " + std::to_string(damaged) + (damaged == 1 ? " line is" : " lines are") + " no change, the others were read";
    (void)keep_aside(file, &said);
    if (damage != nullptr) *damage += (damage->empty() ? "" : "; ") + said;
  }
  forget_older();
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
  waiting_.insert(0, lines_of_older(first_in_file_));  // their lines were in the file that is gone now, and those of the file that is PATH.1 are there
  first_in_file_ = last_ + 1;
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
