// SPDX-License-Identifier: Apache-2.0
// What M codes do behind the moves of their block: those that send the program elsewhere or end it (M700 13.3, 13.12) here, those that only
// act on the machine in functions/auxiliary.cpp.
#include "interpret/functions/functions.hpp"
#include "interpret/interpreter.hpp"

namespace nc {
namespace {

/// M98, M198 or M99 beside another of these, M02 or M30: only the first would ever act.
bool two_ways_on(const BlockInHand& in) {
  unsigned ways = 0;
  bool call = false;
  for (const Auxiliary& m : in.words.auxiliary) {
    const bool here = calls_program(m.function) || m.function == MiscFunction::return_sub;
    call = call || here;
    ways += here || m.function == MiscFunction::program_end ? 1u : 0u;
  }
  return call && ways > 1;
}

/// Codes that act behind the moves of their block and let the program go on where it is.
Execution stay_here(Interpreter& in, const Auxiliary& m) {
  if (m.function == MiscFunction::interrupt_on) return enable_interrupt(in);
  if (m.function == MiscFunction::interrupt_off) return disable_interrupt(in);
  if (!in.words.stops_given_out || !stops_program(m.function)) auxiliary_behind(in, m);
  return Execution::done;
}

Execution go_on_elsewhere(Interpreter& in, const Auxiliary& m) {
  switch (m.function) {
    case MiscFunction::call_sub: return call_sub(in);
    case MiscFunction::call_external: return call_external(in);
    case MiscFunction::return_sub: return return_sub(in);
    default: break;
  }
  if (check_loops_closed(in) != Execution::done) return Execution::fault;
  auxiliary_behind(in, m);
  return Execution::done;
}

}  // namespace

Execution codes_behind(Interpreter& in) {
  if (in.words.auxiliary.size() > 1 && two_ways_on(in)) return in.raise(Condition::format_error, Role::misc_code, in.words.auxiliary.back().number);
  // M98, M198, M99, M02 and M30 act behind all other codes of the block, wherever they stand among them (M700 13.3.1, 13.3.2, 9.1).
  const Auxiliary* way_on = nullptr;
  for (const Auxiliary& m : in.words.auxiliary) {
    in.state.stop_reading |= m.stops_reading;  // M700 4.2
    if (leads_elsewhere(m.function)) {
      way_on = way_on == nullptr ? &m : way_on;
      continue;
    }
    const Execution did = stay_here(in, m);
    if (did != Execution::done) return did;
  }
  return way_on == nullptr ? Execution::done : go_on_elsewhere(in, *way_on);
}

}  // namespace nc
