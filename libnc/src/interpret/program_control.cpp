// SPDX-License-Identifier: Apache-2.0
// What M codes do behind the moves of their block: those that send the program elsewhere or end it (M700 13.3, 13.12) here, those that only
// act on the machine in functions/auxiliary.cpp.
#include "interpret/functions/functions.hpp"
#include "interpret/interpreter.hpp"

namespace nc {
namespace {

/// M98 or M99 beside another of M98 M99 M02 M30: only the first would ever act.
bool two_ways_on(const BlockContext& in) {
  unsigned ways = 0;
  bool call = false;
  for (const uint32_t m : in.words.m) {
    const MiscFunction function = misc_function(*in.dialect, m);
    const bool here = function == MiscFunction::call_sub || function == MiscFunction::return_sub;
    call = call || here;
    ways += here || function == MiscFunction::program_end ? 1u : 0u;
  }
  return call && ways > 1;
}

}  // namespace

Execution codes_behind(Interpreter& in) {
  if (in.words.m.size() > 1 && two_ways_on(in)) return in.raise(Condition::format_error, Role::misc_code, in.words.m.back());
  for (const uint32_t m : in.words.m) {
    if (in.settings.any_reading_stop)
      for (const uint32_t stops : in.settings.reading_stops) in.state.stop_reading |= stops != 0 && stops == m;  // M700 4.2
    if (is_interrupt_on(in, m) || is_interrupt_off(in, m)) {
      const Execution did = is_interrupt_on(in, m) ? enable_interrupt(in) : disable_interrupt(in);
      if (did != Execution::done) return did;
      continue;
    }
    const MiscFunction function = misc_function(*in.dialect, m);
    switch (function) {
      case MiscFunction::call_sub: return call_sub(in);
      case MiscFunction::call_external: return call_external(in);
      case MiscFunction::return_sub: return return_sub(in);
      case MiscFunction::program_end:
        if (check_loops_closed(in) != Execution::done) return Execution::fault;
        auxiliary_behind(in, function, m);
        return Execution::done;
      default: auxiliary_behind(in, function, m); break;
    }
  }
  return Execution::done;
}

}  // namespace nc
