// SPDX-License-Identifier: Apache-2.0
// G10 I J, G10 K: rotation of the workpiece coordinate systems by parameter, from the program (M700 13.21). The
// numbers of the parameters ("coord rot plane, centre, vector, angle") are those of the family; 13.11 prints
// the first of them.
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "dialect/text.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/work_rotation.hpp"

namespace nc {
namespace {

constexpr const char* kVectorH = "8625";
constexpr const char* kVectorV = "8626";
constexpr const char* kAngle = "8627";
constexpr double kLargestVector = 999999.999999, kLargestAngle = 360;

bool store(Interpreter& in, const char* key, double value) {
  constexpr double kDecimals = 1e9;
  const double steps = std::nearbyint(std::fabs(value) * kDecimals);
  char text[40];
  TextWriter out(text, sizeof text);
  if (value < 0 && steps != 0) out.put('-');
  const auto whole = static_cast<unsigned long long>(steps);
  constexpr auto kPerWhole = static_cast<unsigned long long>(kDecimals);
  out.put_integer(whole / kPerWhole).put('.').put_integer(whole % kPerWhole, 9);
  return in.set_parameter(key, -1, text);
}

}  // namespace

Did do_work_rotation(Interpreter& in) {
  const BlockWords& w = in.words;
  // Axis words, P and R are data of another G10.
  if (w.axes != 0 || w.any(letters("PR"))) return in.raise(Condition::format_error, 'G', 10);
  if (in.state.map.kind != AxisMap::Kind::none) return in.raise(Condition::mill_code, 'G', 10);
  // A component that is not there stays.
  const double i = w.has('I') ? length_of(in, 'I') : in.settings.work_turn_vector[0];
  const double j = w.has('J') ? length_of(in, 'J') : in.settings.work_turn_vector[1];
  for (const char letter : {'I', 'J'}) {
    const double component = letter == 'I' ? i : j;
    if (w.has(letter) && !(std::fabs(component) <= kLargestVector))
      return in.raise(Condition::value_range, letter, w.get(letter));
  }
  const bool vector = w.any(letters("IJ")) && (i != 0 || j != 0);
  bool kept = true;
  if (w.has('K')) {
    const double k = length_value(in, w.get('K'), w.flags['K' - 'A'], true, true);
    if (!(std::fabs(k) <= kLargestAngle)) return in.raise(Condition::value_range, 'K', w.get('K'));
    // "Set the vector contents to 0 when commanding coordinate rotation angle."
    if (vector) return in.raise(Condition::format_error, 'K', w.get('K'));
    kept = store(in, kVectorH, 0) && store(in, kVectorV, 0) && store(in, kAngle, k);
  } else {
    kept = store(in, kVectorH, i) && store(in, kVectorV, j);
    if (vector) kept = kept && store(in, kAngle, std::atan2(j, i) * 180 / std::numbers::pi);
  }
  if (!kept) return in.raise(Condition::parameter_input, 'G', 10);
  take_work_rotation(in, false);  // (4): at once
  const Compensation& comp = in.state.comp;
  const bool tilted = comp.side != 0 && tilts_plane(in, comp.axis[0], comp.axis[1]);
  return tilted ? in.raise(Condition::plane_mismatch, 'G', 10) : Did::done;
}

}  // namespace nc
