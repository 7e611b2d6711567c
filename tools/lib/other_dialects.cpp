// SPDX-License-Identifier: Apache-2.0
#include "tools/lib/other_dialects.hpp"

#include "tools/lib/dialect_names.hpp"
#include "tools/lib/item_source.hpp"
#include "tools/lib/virtual_world.hpp"

namespace nc::tools {
namespace {

bool ends_well(const SessionOptions& options, const RunLimits& limits) {
  Session session;
  std::string error;
  if (!session.configure(options, &error) || !session.start(options, &error)) return false;
  ControlSource items(session.control(), session.dialect());
  VirtualWorld world(session.setup(), session.config().system[0]);
  RunSink nothing;
  const RunResult result = run_offline(&items, &world, &nothing, session.decides(), limits.silent_blocks, true, {}, limits.loops);
  // A program without moves does not show that it is of this family, even when it has no alarm.
  return result.how == RunResult::How::kEnded && result.moves > 0;
}

}  // namespace

std::vector<std::string> dialects_without_alarm(const SessionOptions& options, const RunLimits& limits) {
  std::vector<std::string> found;
  if (options.program == "-" || !options.setup.empty() || !options.machine.empty() || !options.tape.empty()) return found;
  for (const std::string& name : dialect_names()) {  // its own family is tried as well: the alarm comes again there
    SessionOptions other = options;
    other.dialect = name;
    other.dialect_given = true;
    other.print.clear();
    if (ends_well(other, limits)) found.push_back(name);
  }
  return found;
}

std::string dialect_note(const std::vector<std::string>& dialects) {
  if (dialects.empty()) return "";
  std::string names;
  for (size_t i = 0; i < dialects.size(); ++i) names += (i == 0 ? "" : i + 1 == dialects.size() ? " or " : ", ") + dialects[i];
  return "note: as a program of " + names + " it ends without an alarm: --dialect " + dialects.front();
}

}  // namespace nc::tools
