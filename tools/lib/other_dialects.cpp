// SPDX-License-Identifier: Apache-2.0
#include "tools/lib/other_dialects.hpp"

#include "tools/lib/dialect_names.hpp"
#include "tools/lib/item_source.hpp"
#include "tools/lib/virtual_world.hpp"

namespace nc::tools {
namespace {

bool ends_well(const SessionOptions& options, const RunLimits& limits, bool whole_numbers) {
  Session session;
  std::string error;
  if (!session.configure(options, &error) || !session.start(options, &error)) return false;
  bool whole = true;
  if (whole_numbers && (nc_undotted_get(session.control(), kPartSystem, &whole) != NC_OK || !whole)) return false;
  ControlSource items(session.control(), session.dialect());
  VirtualWorld world(session.setup(), session.config().system[0]);
  RunSink nothing;
  const RunResult result = run_offline(&items, &world, &nothing, session.decides(), limits.silent_blocks, true, {}, limits.loops);
  // A program without moves does not show that it is of this family, even when it has no alarm.
  return result.how == RunResult::How::kEnded && result.moves > 0;
}

}  // namespace

std::vector<std::string> dialects_without_alarm(const SessionOptions& options, const RunLimits& limits, const std::string& own, bool whole_numbers) {
  std::vector<std::string> found;
  if (options.program == "-" || !options.tape.empty()) return found;
  for (const std::string& name : dialect_names()) {
    SessionOptions other = options;
    other.dialect = name;
    other.dialect_given = true;
    other.print.clear();
    other.setup.clear();  // they belong to the family of the program as it was given
    other.machine.clear();
    if (!ends_well(other, limits, whole_numbers)) continue;
    if (name == own) return {};  // it is one of this family, and what is wrong comes from the setup or the machine
    found.push_back(name);
  }
  return found;
}

std::string dialect_note(const std::vector<std::string>& dialects) {
  if (dialects.empty()) return "";
  std::string names;
  for (size_t i = 0; i < dialects.size(); ++i) names += (i == 0 ? "" : i + 1 == dialects.size() ? " or " : ", ") + dialects[i];
  return "note: this looks like a program of " + names + ", as which it ends without an alarm; try --dialect " + dialects.front();
}

}  // namespace nc::tools
