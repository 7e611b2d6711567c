// SPDX-License-Identifier: Apache-2.0
// What parameters behind interpolation do not do on this machine, and where they and not the feed are what limits it: sentences for whoever
// sets it up.
#include <cmath>

#include "control/control.hpp"
#include "dialect/text.hpp"

namespace nc {
namespace {

/// Counts off the notes and writes the one that is asked for.
class ParameterNotes {
 public:
  ParameterNotes(const nc_control& control, unsigned system, unsigned wanted, char* text, size_t size)
      : config_(control.config), system_(control.config.system[system]), in_(control.system[system].interpreter), left_(wanted), text_(text, size) {}

  bool find() {
    if (in_.dialect->id != NC_DIALECT_M700) return false;
    return without_effect() || axes();
  }

 private:
  bool is_wanted() { return left_-- == 0; }
  double value(const char* key, int axis = -1) const {
    double value = 0;
    in_.parameters.get(key, axis, &value);
    return value;
  }
  bool on_some_axis(const char* key) const {
    for (unsigned i = 0; i < system_.axis_count; ++i)
      if (value(key, static_cast<int>(i)) != 0) return true;
    return false;
  }
  bool say(const char* key, const char* sentence) {
    text_.put('#').put(key).put(": ").put(sentence);
    return true;
  }
  bool say(char axis, const char* keys, const char* sentence) {
    text_.put(axis).put(": ").put(keys).put(' ').put(sentence);
    return true;
  }

  bool without_effect() {
    struct Row {
      const char* key;
      bool by_axis;
    };
    // M700 13.15, 15.5: what acts behind interpolation, and the speeds and the slope of high-accuracy control.
    static constexpr Row kRows[] = {{"1205", false}, {"1206", false}, {"1207", false}, {"1209", false}, {"1568", false}, {"1569", false},
                                    {"1570", false}, {"2004", true},  {"2005", true},  {"2007", true},  {"2008", true},  {"2069", true},
                                    {"2096", true},  {"2102", true},  {"2103", true},  {"2109", true},  {"2110", true},  {"8019", false},
                                    {"8020", false}, {"8022", false}, {"8023", false}, {"8034", false}, {"8107", false}, {"8108", false}};
    const bool optimal = config_.motion_mode == NC_MOTION_OPTIMAL;
    for (const Row& row : kRows) {
      if (!(row.by_axis ? on_some_axis(row.key) : value(row.key) != 0)) continue;
      if (optimal && is_wanted()) return say(row.key, "no effect in the time-optimal mode, which keeps acceleration and jerk by itself");
    }
    if (optimal) return false;
    const bool chosen = value("8107") != 0 && value("8108") != 0;
    if (value("8108") != 0 && !chosen && is_wanted()) return say("8108", "no effect while #8107 is 0");
    if (value("8107") != 0 && !chosen && is_wanted()) return say("8107", "no effect while #8108 is 0: there is no compensation but that for each axis");
    if (on_some_axis("2069") && !chosen && is_wanted()) return say("2069", "no effect while #8107 and #8108 are not both 1");
    const bool rapid = on_some_axis("2004") || on_some_axis("2005");
    if (value("1205") != 0 && rapid && is_wanted()) return say("1205", "rapid traverse is accelerated before interpolation: #2004 and #2005 have no effect");
    return false;
  }

  bool axes() {
    if (config_.motion_mode == NC_MOTION_OPTIMAL) return false;
    const FilterParameters& p = in_.settings.filters;
    for (unsigned i = 0; i < system_.axis_count; ++i) {
      const nc_axis_config& axis = system_.axis[i];
      const double rapid = axis.rapid > 0 ? axis.rapid : axis.max_velocity;
      if (kind(i, p.cut, FilteredMove::Kind::cut, axis.max_velocity, "#2007 #2008", "cuts")) return true;
      if (!p.rapid_before && kind(i, p.rapid, FilteredMove::Kind::rapid, rapid, "#2004 #2005", "rapid traverse")) return true;
      if (kind(i, p.skip, FilteredMove::Kind::skip, axis.max_velocity, "#2102 #2103", "skip moves")) return true;
    }
    return false;
  }

  bool kind(unsigned i, const TimeConstants& constants, FilteredMove::Kind kind, double limit, const char* keys, const char* moves) {
    const nc_axis_config& axis = system_.axis[i];
    bool others = false;
    for (unsigned k = 0; k < system_.axis_count; ++k) others = others || constants.linear_ms[k] > 0 || constants.exponential_ms[k] > 0;
    if (!others || !(axis.max_acceleration > 0)) return false;
    FilterParameters only;
    only.cut = only.rapid = only.skip = constants;
    FilteredMove move;
    move.kind = kind;
    move.moving = move.limited = 1u << i;
    const FilterTimes times = filter_times(only, move, config_.cycle_s);
    if (times.kind == FilterTimes::Kind::none) {
      if (!is_wanted()) return false;
      say(axis.name, keys, "not set, of other axes they are: ");
      text_.put(moves).put(" of this axis are accelerated before interpolation, and the path rests beside them");
      return true;
    }
    const double speed = filter_speed(times, i, axis.max_acceleration, config_.cycle_s);
    if ((limit > 0 && speed >= limit) || !is_wanted()) return false;
    say(axis.name, keys, "let ");
    text_.put(moves).put(" go at ").put_number(std::floor(speed * 600) / 10).put(axis.rotary ? " deg/min" : " mm/min");
    if (limit > 0) text_.put(", the axis could go at ").put_number(limit * 60);
    text_.put(": faster would break its limit of acceleration");
    return true;
  }

  const nc_config& config_;
  const nc_system_config& system_;
  const Interpreter& in_;
  unsigned left_;
  TextWriter text_;
};

}  // namespace
}  // namespace nc

nc_status nc_parameter_note(const nc_control* c, unsigned system, unsigned index, char* text, size_t size) {
  if (c == nullptr || system >= c->config.system_count || text == nullptr || size == 0) return NC_E_ARGUMENT;
  return nc::ParameterNotes(*c, system, index, text, size).find() ? NC_OK : NC_E_NOT_FOUND;
}
