// SPDX-License-Identifier: Apache-2.0
// The position that the counters show of an axis whose position goes on growing with every turn (M700 14.13).
#include "frame/rotary.hpp"
#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

AxisVec shown(const InForce& in, uint32_t axes, const AxisVec& position) {
  AxisVec out = position;
  for (unsigned i = 0; axes != 0 && i < in.axis_count; ++i)
    if (((axes >> i) & 1) != 0) out[i] = within_one_turn(position[i]);
  return out;
}

}  // namespace

AxisVec work_shown(const InForce& in, const AxisVec& work) {
  // In the plane of G12.1 the rotary axis holds a length (M700 6.10).
  const uint32_t lengths = in.state.map.kind == AxisMap::Kind::polar ? 1u << in.state.map.rotary : 0u;
  return shown(in, in.settings.turning & ~lengths, work);
}
AxisVec machine_shown(const InForce& in, const AxisVec& machine) { return shown(in, in.settings.machine_turn, machine); }

}  // namespace nc
