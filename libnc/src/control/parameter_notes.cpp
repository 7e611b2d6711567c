// SPDX-License-Identifier: Apache-2.0
// Sentences for the person who sets a machine up: which parameters that act behind interpolation have no effect on it, and where such a parameter
// and not the feed limits its speed.
#include <cmath>
#include <cstring>

#include "base/struct_size.hpp"
#include "control/control.hpp"
#include "dialect/dialect.hpp"
#include "dialect/text.hpp"

namespace nc {
namespace {

using P = Parameter;

/// Goes through the notes in their order and writes the one whose number is asked for.
class ParameterNotes {
 public:
  ParameterNotes(const nc_control& control, unsigned system, unsigned wanted, nc_parameter_note* note)
      : config_(control.config), system_(control.config.system[system]), dialect_(*control.dialect), in_(control.system[system].interpreter.tables()), left_(wanted), note_(*note), text_(note->text, sizeof note->text) {}

  bool find() {
    return without_effect() || axes();
  }

 private:
  bool is_wanted() { return left_-- == 0; }
  double value(ParameterOf parameter, int axis = -1) const {
    return in_.parameter(parameter, axis);
  }
  bool on_some_axis(ParameterOf parameter) const {
    for (unsigned i = 0; i < system_.axis_count; ++i)
      if (value(parameter, static_cast<int>(i)) != 0) return true;
    return false;
  }
  /// "#1205", as the family calls the parameter.
  void put(ParameterOf parameter) {
    char key[kParameterKeySize];
    int bit = -1;
    if (!parameter_place(dialect_, parameter, key, &bit)) return;
    text_.put('#').put(key);
    static_assert(sizeof key == sizeof note_.key[0]);
    if (note_.key_count < NC_NOTE_KEYS) std::memcpy(note_.key[note_.key_count++], key, sizeof key);
  }
  /// Writes a sentence about `parameter`, in which {1} and {2} stand for the parameters `first` and `second`.
  bool say(ParameterOf parameter, const char* sentence, ParameterOf first = Parameter::none, ParameterOf second = Parameter::none) {
    put(parameter);
    text_.put(": ");
    for (; *sentence != 0; ++sentence) {
      if (*sentence != '{') {
        text_.put(*sentence);
        continue;
      }
      put(sentence[1] == '1' ? first : second);
      sentence += 2;
    }
    return true;
  }
  void about(char axis, const Parameter (&keys)[2], const char* sentence) {
    note_.axis = axis;
    text_.put(axis).put(": ");
    put(keys[0]);
    text_.put(' ');
    put(keys[1]);
    text_.put(' ').put(sentence);
  }

  bool without_effect() {
    struct Row {
      ParameterOf parameter;
      bool by_axis;
    };
    // M700 13.15, 15.5: what acts behind interpolation, and the speeds and the slope of high-accuracy control.
    static constexpr Row kRows[] = {
        {P::rapid_before, false}, {P::accuracy_speed, false}, {P::accuracy_time, false}, {P::arc_joint_speed, false},
        {P::pattern_filter, false}, {{P::pattern_filter, 1}, false}, {P::pattern_second, false},
        {P::rapid_linear, true}, {P::rapid_exponential, true}, {P::cut_linear, true}, {P::cut_exponential, true},
        {P::arc_radius_shift, true}, {P::corner_least_speed, true}, {P::skip_linear, true}, {P::skip_exponential, true},
        {P::accuracy_clamp, true}, {{P::accuracy_clamp, 1}, true}, {P::radius_percent, false}, {P::corner_angle, false},
        {P::corner_percent, false}, {{P::corner_percent, 1}, false}, {P::acceleration_clamp, false},
        {P::arc_compensation, false}, {P::arc_compensation_by_axis, false}};
    const bool optimal = config_.motion_mode == NC_MOTION_OPTIMAL;
    for (const Row& row : kRows) {
      if (!(row.by_axis ? on_some_axis(row.parameter) : value(row.parameter) != 0)) continue;
      if (optimal && is_wanted())
        return say(row.parameter, "no effect in the time-optimal mode, which keeps acceleration and jerk by itself");
    }
    if (optimal) return false;
    // The compensation of arcs acts only when both switches are on and some axis has a radius.
    const bool every = value(P::arc_compensation) != 0, by_axis = value(P::arc_compensation_by_axis) != 0, chosen = every && by_axis;
    if (by_axis && !chosen && is_wanted()) return say(P::arc_compensation_by_axis, "no effect while {1} is 0", P::arc_compensation);
    if (every && !chosen && is_wanted())
      return say(P::arc_compensation, "no effect while {1} is 0: there is no compensation but that for each axis", P::arc_compensation_by_axis);
    if (on_some_axis(P::arc_radius_shift) && !chosen && is_wanted())
      return say(P::arc_radius_shift, "no effect while {1} and {2} are not both 1", P::arc_compensation, P::arc_compensation_by_axis);
    const bool rapid = on_some_axis(P::rapid_linear) || on_some_axis(P::rapid_exponential);
    if (value(P::rapid_before) != 0 && rapid && is_wanted())
      return say(P::rapid_before, "rapid traverse is accelerated before interpolation: {1} and {2} have no effect", P::rapid_linear, P::rapid_exponential);
    return false;
  }

  bool axes() {
    if (config_.motion_mode == NC_MOTION_OPTIMAL) return false;
    const FilterParameters& p = in_.filters();
    for (unsigned i = 0; i < system_.axis_count; ++i) {
      const nc_axis_config& axis = system_.axis[i];
      const double rapid = axis.rapid > 0 ? axis.rapid : axis.max_velocity;
      if (kind(i, p.cut, FilteredMove::Kind::cut, axis.max_velocity, {P::cut_linear, P::cut_exponential}, "cuts")) return true;
      if (!p.rapid_before && kind(i, p.rapid, FilteredMove::Kind::rapid, rapid, {P::rapid_linear, P::rapid_exponential}, "rapid traverse")) return true;
      if (kind(i, p.skip, FilteredMove::Kind::skip, axis.max_velocity, {P::skip_linear, P::skip_exponential}, "skip moves")) return true;
    }
    return false;
  }

  bool kind(unsigned i, const TimeConstants& constants, FilteredMove::Kind kind, double limit, const Parameter (&keys)[2], const char* moves) {
    const nc_axis_config& axis = system_.axis[i];
    bool others = false;
    for (unsigned k = 0; k < system_.axis_count; ++k) others = others || constants.linear_ms[k] > 0 || constants.exponential_ms[k] > 0;
    if (!others || !(axis.max_acceleration > 0)) return false;
    FilterParameters only;
    only.cut = only.rapid = only.skip = constants;
    FilteredMove move;
    move.kind = kind;
    move.moving = move.limited = 1u << i;
    const FilterTimes times = dialect_.rules.motion.filter_times(only, move, config_.cycle_s);
    if (times.kind == FilterTimes::Kind::none) {
      if (!is_wanted()) return false;
      about(axis.name, keys, "not set, of other axes they are: ");
      text_.put(moves).put(" of this axis are accelerated before interpolation, and the path rests beside them");
      return true;
    }
    const double speed = filter_speed(times, i, axis.max_acceleration, config_.cycle_s);
    if ((limit > 0 && speed >= limit) || !is_wanted()) return false;
    about(axis.name, keys, "let ");
    text_.put(moves).put(" go at ").put_number(std::floor(speed * 600) / 10).put(axis.rotary ? " deg/min" : " mm/min");
    if (limit > 0) text_.put(", the axis could go at ").put_number(limit * 60);
    text_.put(": faster would break its limit of acceleration");
    return true;
  }

  const nc_config& config_;
  const nc_system_config& system_;
  const Dialect& dialect_;
  const HostTables in_;
  unsigned left_;
  nc_parameter_note& note_;
  TextWriter text_;
};

}  // namespace
}  // namespace nc

nc_status nc_parameter_note_row(const nc_control* c, unsigned system, unsigned index, nc_parameter_note* note) {
  if (c == nullptr || system >= c->config.system_count || note == nullptr || nc::caller_bytes(note) == 0) return NC_E_ARGUMENT;
  nc_parameter_note found{};
  if (!nc::ParameterNotes(*c, system, index, &found).find()) return NC_E_NOT_FOUND;
  nc::give_struct(found, note);
  return NC_OK;
}
