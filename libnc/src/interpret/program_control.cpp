// SPDX-License-Identifier: Apache-2.0
// What M codes do behind the moves of their block: those that send the program elsewhere or end it (M700 13.3, 13.12) here, those that only
// act on the machine in functions/auxiliary.cpp.
#include "interpret/functions/functions.hpp"
#include "interpret/interpreter.hpp"

namespace nc {
namespace {

/// M98, M198 or M99 beside another of these, M02 or M30: only the first would ever act.
bool two_ways_on(const BlockContext& in) {
  unsigned ways = 0;
  bool call = false;
  for (const Auxiliary& m : in.words.auxiliary) {
    const bool here = calls_program(m.function) || m.function == MiscFunction::return_sub;
    call = call || here;
    ways += here || m.function == MiscFunction::program_end ? 1u : 0u;
  }
  return call && ways > 1;
}

}  // namespace

/// A code by which the block goes on in another program, or ends: it comes behind all others of its block, wherever it stands (M700 13.5.2, "Differences between M98 and G65" (3)).
static bool leads_on(const Auxiliary& m) { return calls_program(m.function) || m.function == MiscFunction::return_sub || m.function == MiscFunction::program_end; }

static Execution lead_on(Interpreter& in, const Auxiliary& m) {
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

Execution codes_behind(Interpreter& in) {
  if (in.words.auxiliary.size() > 1 && two_ways_on(in)) return in.raise(Condition::format_error, Role::misc_code, in.words.auxiliary.back().number);
  const Auxiliary* on = nullptr;
  for (const Auxiliary& m : in.words.auxiliary) {
    in.state.stop_reading |= m.stops_reading;  // M700 4.2
    if (m.function == MiscFunction::interrupt_on || m.function == MiscFunction::interrupt_off) {
      const Execution did = m.function == MiscFunction::interrupt_on ? enable_interrupt(in) : disable_interrupt(in);
      if (did != Execution::done) return did;
    } else if (leads_on(m)) {
      if (on == nullptr) on = &m;
    } else if (!in.words.stops_given_out || !stops_program(m.function)) {
      auxiliary_behind(in, m);
    }
  }
  return on == nullptr ? Execution::done : lead_on(in, *on);
}

}  // namespace nc
