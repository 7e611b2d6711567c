// SPDX-License-Identifier: Apache-2.0
// Configuration section [ladder].
#include <filesystem>

#include "runtime/config_sections.hpp"
#include "runtime/ladder_hook.hpp"

namespace nc::rt {



void read_ladder(TableReader* root, Config* config) {
  root->table("ladder", [&](TableReader& reader) {
    LadderConfig& ladder = config->ladder;
    reader.require("program");
    reader.string("program", &ladder.program);
    reader.number("fin_timeout_s", &ladder.fin_timeout_s, 0, 3600);
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

}  // namespace nc::rt
