// SPDX-License-Identifier: Apache-2.0
// Configuration section [share].
#include "runtime/config_sections.hpp"
#include "runtime/share/text.hpp"

namespace nc::rt {

void read_share(TableReader* root, Config* config) {
  root->table("share", [&](TableReader& reader) {
    ShareConfig& share = config->share;
    reader.boolean("enabled", &share.enabled);
    if (reader.string("name", &share.name, TableReader::Empty::kTaken) && !share.name.empty() && share::share_name(share.name) != share.name)
      reader.error("name", "must be lower case letters, digits and '-', at most 48, not \"" + share.name + "\"");
    reader.boolean("commands", &share.commands);
    share.commands_place = {reader.line("commands"), reader.path("commands")};
    reader.boolean("group", &share.group);
  });
}

}  // namespace nc::rt
