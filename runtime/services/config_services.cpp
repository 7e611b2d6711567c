// SPDX-License-Identifier: Apache-2.0
// Configuration section [services].
#include <algorithm>

#include "runtime/config_sections.hpp"
#include "runtime/services/local_server.hpp"
#include "runtime/services/rights.hpp"

namespace nc::rt {
namespace {

constexpr std::size_t kMostGroups = 16, kLongestName = 32;

void read_groups(TableReader* reader, const char* key, std::vector<std::string>* groups) {
  std::vector<std::pair<std::string, unsigned>> names;
  if (!reader->strings(key, &names)) return;
  groups->clear();
  if (names.size() > kMostGroups) reader->error(key, "must be at most " + std::to_string(kMostGroups) + " groups");
  for (const auto& [name, line] : names) {
    bool good = !name.empty() && name.size() <= kLongestName;
    for (const char c : name) good = good && c > ' ' && c <= '~' && c != ':';
    if (good) groups->push_back(name);
    else reader->errors()->add(line, reader->path(key), "\"" + name + "\" cannot be the name of a group");
  }
}

}  // namespace

void read_services(TableReader* root, Config* config) {
  root->table("services", [&](TableReader& reader) {
    ServicesConfig& services = config->services;
    reader.boolean("enabled", &services.enabled);
    if (reader.string("socket", &services.socket, TableReader::Empty::kTaken)) services.socket_place = {reader.line("socket"), reader.path("socket")};
    if (services.socket.size() > services::kLongestSocketPath || services.socket.find('\0') != std::string::npos)
      reader.error("socket", "must have at most " + std::to_string(services::kLongestSocketPath) + " bytes");
    else if (!services.socket.empty() && services.socket[0] != '/')
      reader.error("socket", "must begin with /, because clients look for it from any folder");
    constexpr const char* kKeys[services::kRightCount] = {"view", "operate", "setup", "maintain"};
    for (unsigned right = 0; right < services::kRightCount; ++right) read_groups(&reader, kKeys[right], &services.holders[right]);
    reader.string("changes", &services.changes, TableReader::Empty::kTaken);
    reader.string("history", &services.history, TableReader::Empty::kTaken);
    if (!services.history.empty() && services.history == services.changes) reader.error("history", "is the file of the changes too");
    reader.integer("history_entries", &services.history_entries, 1000, 10'000'000);
    reader.integer("history_days", &services.history_days, 1, 36'500);
    reader.integer("history_mb", &services.history_mb, 1, 100'000);
    reader.integer("program_mb", &services.program_mb, 1, 1'000'000);
    std::string check = "required";
    constexpr const char* kChecks[] = {"required", "warn", "off"};  // in the order of ProgramCheck
    reader.string("check", &check);
    const auto found = std::find(std::begin(kChecks), std::end(kChecks), check);
    if (found == std::end(kChecks)) reader.error("check", "must be \"required\", \"warn\" or \"off\"");
    else services.check = static_cast<ProgramCheck>(found - std::begin(kChecks));
    reader.integer("check_seconds", &services.check_seconds, 1, 86'400);
    reader.integer("programs_mb", &services.programs_mb, 1, 100'000'000);
  });
}

}  // namespace nc::rt
