// SPDX-License-Identifier: Apache-2.0
// G60: positioning whose last part is always in the same direction (M700 6.8).
#include "interpret/functions/functions.hpp"

namespace nc {

AxisVec before_creep(const InForce& in, const AxisVec& target, uint32_t axes) {
  AxisVec before = target;
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (((axes >> i) & 1) != 0) before[i] -= in.settings.creep[i];  // the sign of the parameter is the final direction
  return before;
}

Execution do_unidirectional(BlockContext& in) {
  const FunctionRow* const beside = in.words.motion;
  if (beside != nullptr && beside->function != Function::rapid && in.dialect->rules.block.unused_words_are_faults)
    return in.raise_code(Condition::illegal_address, *beside);  // HX 4.2 prints G00 and cycles: it is no cut
  const uint32_t axes = in.words.target.axes();
  const AxisVec target = target_of_words(in), before = before_creep(in, target, axes);
  uint32_t creeps = 0;
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (((axes >> i) & 1) != 0 && in.settings.creep[i] != 0) creeps |= 1u << i;
  LinearStyle style;
  style.kind = NC_MOVE_RAPID;
  move_linear(in, before, axes, style);
  move_linear(in, target, creeps, style);
  return Execution::done;
}

}  // namespace nc
