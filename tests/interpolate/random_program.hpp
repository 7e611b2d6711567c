// SPDX-License-Identifier: Apache-2.0
// Random programs for the property tests, and the check that a program was executed as it is written.
#pragma once

#include "interpolate/test_machine.hpp"

namespace nc::test {
namespace random_program_detail {

inline double uniform(std::mt19937_64& rng, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(rng);
}
inline unsigned pick(std::mt19937_64& rng, unsigned n) {
  return static_cast<unsigned>(rng() % n);
}
inline double log_uniform(std::mt19937_64& rng, double low, double high) {
  return std::exp(uniform(rng, std::log(low), std::log(high)));
}

/// A series of short lines, each turned a little from the one before, as in a surface program.
inline void polyline(Program& p, std::mt19937_64& rng, double& heading) {
  const double step = log_uniform(rng, 0.001, 1.0), turn = uniform(rng, -1, 1) * log_uniform(rng, 0.001, 0.4);
  const double feed = log_uniform(rng, 1, 300), lift = uniform(rng, -0.5, 0.5);
  const bool uneven = pick(rng, 2) == 0;
  const unsigned n = 3 + pick(rng, 40);
  for (unsigned i = 0; i < n; ++i) {
    AxisVec end = p.at();
    const double l = uneven ? step * log_uniform(rng, 0.05, 5) : step;
    heading += turn * (uneven ? uniform(rng, -1, 1) : 1);
    end[0] += l * std::cos(heading);
    end[1] += l * std::sin(heading);
    end[2] += l * lift * std::sin(0.3 * i);
    p.line(end, feed);
    p.mark();
  }
}

inline void one_line(Program& p, std::mt19937_64& rng, unsigned axes, double& heading) {
  heading += pick(rng, 2) ? uniform(rng, -0.3, 0.3) : uniform(rng, -3.2, 3.2);
  AxisVec end = p.at();
  const double l = log_uniform(rng, 0.002, 60);
  end[0] += l * std::cos(heading);
  end[1] += l * std::sin(heading);
  if (pick(rng, 3) == 0) end[2] += uniform(rng, -l, l);
  if (axes > 3 && pick(rng, 2) == 0) end[3] += uniform(rng, -90, 90);
  Segment& s = p.line(end, log_uniform(rng, 0.5, 300));
  s.exact_stop = pick(rng, 6) == 0;
}

/// An arc that begins along the present heading (tangent), or in any direction.
inline void one_arc(Program& p, std::mt19937_64& rng, unsigned axes, double& heading) {
  const double radius = log_uniform(rng, 0.05, 60);
  double sweep = uniform(rng, 0.05, 7) * (pick(rng, 2) ? 1 : -1);
  if (pick(rng, 4) == 0) heading += uniform(rng, -3, 3);
  const double angle = heading + (sweep > 0 ? -1 : 1) * std::numbers::pi / 2;
  double spiral = 0;
  if (pick(rng, 4) == 0) spiral = uniform(rng, -0.3, 0.3) * std::min(radius, 0.3);
  AxisVec others = p.at();
  if (pick(rng, 2) == 0) others[2] += uniform(rng, -1, 1) * radius;
  if (axes > 3 && pick(rng, 3) == 0) others[3] += uniform(rng, -120, 120);
  if (pick(rng, 4) == 0) {  // another plane: not tangent to anything
    const uint8_t h = pick(rng, 2) ? 2 : 1;
    others = p.at();
    p.arc(h, h == 2 ? 0 : 2, radius, uniform(rng, -3, 3), sweep, log_uniform(rng, 1, 300), spiral, &others);
    return;
  }
  p.arc(0, 1, radius, angle, sweep, log_uniform(rng, 1, 300), spiral, &others);
  heading += sweep;
}

inline void auxiliary(Program& p, std::mt19937_64& rng) {
  switch (pick(rng, 8)) {
    case 0:
      p.action(NC_ACTION_M, 8 + pick(rng, 3));
      p.gate(NC_GATE_FIN);
      break;
    case 1:
      p.gate(NC_GATE_DWELL_SECONDS, uniform(rng, 0, 0.01));
      break;
    case 2:
      p.gate(NC_GATE_IN_POSITION);
      break;
    case 3:
      p.sync();
      break;
    default:
      for (unsigned n = 1 + pick(rng, 12); n > 0; --n)
        p.action(NC_ACTION_OUTPUT, 0, pick(rng, 4), 1u << pick(rng, 32), ~0u);
      break;
  }
}

}  // namespace random_program_detail

/// A random program with everything: lines of all sizes, smooth and sharp corners, arcs, helices, spirals, rapids,
/// stops and actions.
inline Program random_program(const ExecutorConfig& config, std::mt19937_64& rng, unsigned blocks,
                              AxisVec start = {}) {
  using namespace random_program_detail;
  Program p(config, start);
  double heading = uniform(rng, -3, 3);
  for (unsigned n = 0; n < blocks; ++n) {
    const unsigned kind = pick(rng, 20);
    if (kind < 4) {
      polyline(p, rng, heading);
    } else if (kind < 10) {
      one_line(p, rng, config.axis_count, heading);
    } else if (kind < 16) {
      one_arc(p, rng, config.axis_count, heading);
    } else if (kind < 18) {
      AxisVec end = p.at();
      for (unsigned i = 0; i < config.axis_count; ++i) {
        if (pick(rng, 2)) end[i] += uniform(rng, -1, 1) * log_uniform(rng, 0.01, 80);
      }
      if (!(end == p.at())) p.rapid(end);
    } else {
      auxiliary(p, rng);
    }
    p.mark(pick(rng, 5) != 0, pick(rng, 5) != 0);
  }
  p.end();
  return p;
}

/// Checks that every record was executed once and in order, and that every move ended at its end.
inline std::string check_events(const Program& p, const std::vector<nc_event>& events, unsigned axis_count) {
  std::ostringstream s;
  if (events.size() != p.records.size())
    s << events.size() << " events for " << p.records.size() << " records\n";
  for (size_t i = 0; i < events.size() && i < p.records.size(); ++i) {
    const Record& r = p.records[i];
    if (events[i].serial != r.serial) {
      s << "event " << i << " is serial " << events[i].serial << ", not " << r.serial << "\n";
      break;
    }
    if (events[i].kind != static_cast<uint8_t>(r.kind)) s << "serial " << r.serial << " has another kind\n";
    if (r.kind != ItemKind::move) continue;
    for (unsigned a = 0; a < axis_count; ++a) {
      if (events[i].machine.v[a] != r.segment.curve.end[a])
        s << "serial " << r.serial << " ended beside its end on axis " << a << "\n";
    }
  }
  return s.str();
}

}  // namespace nc::test
