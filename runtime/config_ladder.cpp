// SPDX-License-Identifier: Apache-2.0
// Configuration section [ladder].
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "runtime/config_sections.hpp"
#include "runtime/share/text.hpp"

namespace nc::rt {
namespace {

constexpr unsigned kLastD = 8191;

// Path of a file in the folder that a service manager gives to the control; "" when there is none.
std::string state_file(const std::string& machine, const char* ending) {
  const char* folder = std::getenv("STATE_DIRECTORY");  // set by systemd; several folders are separated by colons
  if (folder == nullptr || *folder == '\0') return {};
  const std::string first = std::string(folder).substr(0, std::string(folder).find(':'));
  return first + "/" + share::share_name(machine) + ending;
}

// A file whose name the configuration gives, relative to its own folder, or that has its place in the state directory.
std::string kept_file(const Config& config, const std::string& given, const char* ending) {
  if (!given.empty()) return (std::filesystem::path(config.file).parent_path() / given).string();
  return state_file(config.name, ending);
}

}  // namespace

void read_ladder(TableReader* root, Config* config) {
  root->table("ladder", [&](TableReader& reader) {
    LadderConfig& ladder = config->ladder;
    reader.require("program");
    reader.string("program", &ladder.program, TableReader::Empty::kTaken);
    ladder.program_place = {reader.line("program"), reader.path("program")};
    reader.number("fin_timeout_s", &ladder.fin_timeout_s, quantity::kActionTime);
    reader.string("retain", &ladder.retain, TableReader::Empty::kTaken);
    ladder.retain_place = {reader.line("retain"), reader.path("retain")};
    reader.boolean("retain_counters", &ladder.retain_counters);
    std::vector<double> range;
    if (reader.numbers("retain_d", &range, 2, 2)) {
      const bool whole = range[0] == std::floor(range[0]) && range[1] == std::floor(range[1]);
      if (!whole || range[0] < 0 || range[1] < range[0] || range[1] > kLastD)
        reader.error("retain_d", "must be the first and the last of a row of D devices, 0 to " + std::to_string(kLastD));
      else {
        ladder.retain_d_first = static_cast<unsigned>(range[0]);
        ladder.retain_d_count = static_cast<unsigned>(range[1] - range[0]) + 1;
      }
    }
    if (same_file(ladder.retain, config->variables))
      reader.error("retain", "is the file of the common variables too: [machine] variables");
    if (same_file(ladder.retain, config->offsets))
      reader.error("retain", "is the file of the offsets too: [machine] offsets");
    std::vector<std::pair<std::string, unsigned>> texts;
    if (!reader.strings("alarms", &texts)) return;
    if (texts.size() > ladder.alarm.size())
      reader.error("alarms", "has more than " + std::to_string(ladder.alarm.size()) + " texts");
    for (std::size_t i = 0; i < texts.size() && i < ladder.alarm.size(); ++i) ladder.alarm[i] = texts[i].first;
  });
}

std::string Config::ladder_file() const {
  if (ladder.program.empty()) return {};
  return (std::filesystem::path(file).parent_path() / ladder.program).string();
}

std::string Config::retain_path() const {
  if (ladder.program.empty()) return {};
  return kept_file(*this, ladder.retain, ".retain");
}

std::string Config::variables_path() const {
  return kept_file(*this, variables, ".variables");
}

std::string Config::offsets_path() const {
  return kept_file(*this, offsets, ".offsets");
}

std::string Config::place_path() const {
  return kept_file(*this, place, ".place");
}

std::string Config::changes_path() const {
  return kept_file(*this, services.changes, ".changes");
}

std::string Config::history_path() const {
  return kept_file(*this, services.history, ".history");
}

}  // namespace nc::rt
