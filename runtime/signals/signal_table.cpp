// SPDX-License-Identifier: Apache-2.0
// The table of signals. A row is the only place where a signal is described.
#include "runtime/signals/signal_table.hpp"

#include <algorithm>
#include <cmath>

namespace nc::rt {
namespace {

using Image = const LadderImage&;
using Type = ladder::DeviceType;
constexpr auto kBit = Type::kBit;
constexpr auto kWord16 = Type::kWord16;
constexpr auto kWord32 = Type::kWord32;
constexpr auto kFrom = SignalDirection::kFromNc;
constexpr auto kTo = SignalDirection::kToNc;
constexpr auto kControl = SignalScope::kControl;
constexpr auto kNumberedControl = SignalScope::kNumberedControl;
constexpr auto kSystem = SignalScope::kSystem;
constexpr auto kAxis = SignalScope::kAxis;
constexpr auto kNumbered = SignalScope::kNumbered;
constexpr auto kSpindle = SignalScope::kSpindle;
constexpr auto kSpindleAxis = SignalScope::kSpindleAxis;

constexpr double kAtSpeed = 0.03;  // a spindle is at speed within this fraction of the commanded speed

enum : std::uint8_t { kStrobeM = 1, kStrobeS = 2, kStrobeT = 4, kStrobeB = 8 };

std::int32_t to_int(double value) {
  constexpr double kMost = 2147483647.0;
  if (!(value > -kMost)) return value == value ? -2147483647 : 0;
  return value < kMost ? static_cast<std::int32_t>(std::lround(value)) : 2147483647;
}

const nc_outputs& out(Image image, unsigned system) {
  return image.nc_out[system];
}
bool strobe(Image image, unsigned system, std::uint8_t group) {
  return (out(image, system).strobe & group) != 0;
}
bool decoded(Image image, unsigned system, std::uint32_t code) {
  return strobe(image, system, kStrobeM) && out(image, system).m == code;
}
AxisFlags axes(Image image, unsigned system) {
  return image.status->axes != nullptr ? image.status->axes[system] : AxisFlags{};
}
bool flag(std::uint32_t bits, unsigned axis) {
  return (bits >> axis & 1u) != 0;
}
SearchResult search_result(Image image, unsigned system) {
  return image.status->search != nullptr ? image.status->search[system].shown() : SearchResult::kNone;
}
void complete(std::int32_t value, LadderImage* image, unsigned system, std::uint8_t group) {
  if (value != 0) image->nc_in[system].fin_groups = static_cast<std::uint8_t>(image->nc_in[system].fin_groups | group);
}
void set_bit(std::int32_t value, unsigned index, std::uint8_t* bits) {
  *bits = static_cast<std::uint8_t>(*bits | static_cast<unsigned>(value != 0) << index);
}
bool state(Image image, unsigned system, nc_run_state wanted) {
  return out(image, system).state == wanted;
}

}  // namespace

#define NC_READ [](Image image, [[maybe_unused]] unsigned s, [[maybe_unused]] unsigned i) -> std::int32_t
#define NC_WRITE [](std::int32_t value, LadderImage* image, [[maybe_unused]] unsigned s, [[maybe_unused]] unsigned i)

const SignalRow kSignals[] = {
    // ---- state of the control ----
    {"ready", kBit, kFrom, kControl, 0, 0, "drives are on and no alarm is active", "level",
     NC_READ { return image.status->drives_on && !image.status->alarm; }, nullptr},
    {"alarm", kBit, kFrom, kControl, 0, 0, "an alarm is active that stops the machine", "level, until reset with the cause gone",
     NC_READ { return image.status->alarm; }, nullptr},
    {"warning", kBit, kFrom, kControl, 0, 0, "an alarm is active that lets a program end (R19, R20, printed lines are lost)", "level, until reset with the cause gone",
     NC_READ { return image.status->warning; }, nullptr},
    {"resetting", kBit, kFrom, kControl, 0, 0, "a reset is going on, or plc.reset is still on", "at least 2 scans",
     NC_READ { return image.status->resetting; }, nullptr},
    {"mode_auto", kBit, kFrom, kControl, 0, 0, "automatic mode is selected", "level",
     NC_READ { return image.status->mode == Mode::kAuto; }, nullptr},
    {"mode_mdi", kBit, kFrom, kControl, 0, 0, "MDI mode is selected", "level",
     NC_READ { return image.status->mode == Mode::kMdi; }, nullptr},
    {"mode_manual", kBit, kFrom, kControl, 0, 0, "manual mode is selected", "level",
     NC_READ { return image.status->mode == Mode::kManual; }, nullptr},
    {"in_auto", kBit, kFrom, kSystem, 0, 0, "a program is in execution or interrupted (OP)", "level",
     NC_READ {
       return state(image, s, NC_STATE_RUNNING) || state(image, s, NC_STATE_HOLD) ||
              state(image, s, NC_STATE_STOPPED);
     },
     nullptr},
    {"cycle_lamp", kBit, kFrom, kSystem, 0, 0, "a program is in execution (STL)", "level",
     NC_READ { return state(image, s, NC_STATE_RUNNING); }, nullptr},
    {"hold_lamp", kBit, kFrom, kSystem, 0, 0, "feed hold (SPL)", "level",
     NC_READ { return state(image, s, NC_STATE_HOLD); }, nullptr},
    {"block_stop", kBit, kFrom, kSystem, 0, 0, "stopped between two blocks: single block, M00, M01", "level",
     NC_READ { return state(image, s, NC_STATE_STOPPED); }, nullptr},
    {"stop_cause", kWord16, kFrom, kSystem, 0, 0,
     "why: 1 FIN, 2 dwell, 3 position, 4 M00, 5 block, 6 hold, 7 interlock, 8 override, 9 starved, 10 alarm, 11 F1-F5 0, 12 spindle, "
     "13 angle, 14 thread, 15 servo, 16 tap, 17 unmeasured, 18 no law, 19 reset, 20 reversed, 21 in hole, 22 MDI, 23 dry 0, 24 restart",
     "level", NC_READ { return out(image, s).cause; }, nullptr},

    // ---- M, S, T, B ----
    {"m_strobe", kBit, kFrom, kSystem, 0, 0, "an M code waits to be done", "on with the code, off when FIN is seen",
     NC_READ { return strobe(image, s, kStrobeM); }, nullptr},
    {"s_strobe", kBit, kFrom, kSystem, 0, 0, "an S code waits to be done", "as m_strobe",
     NC_READ { return strobe(image, s, kStrobeS); }, nullptr},
    {"t_strobe", kBit, kFrom, kSystem, 0, 0, "a T code waits to be done", "as m_strobe",
     NC_READ { return strobe(image, s, kStrobeT); }, nullptr},
    {"b_strobe", kBit, kFrom, kSystem, 0, 0, "a second auxiliary function waits to be done", "as m_strobe",
     NC_READ { return strobe(image, s, kStrobeB); }, nullptr},
    {"m_code", kWord32, kFrom, kSystem, 0, 0, "the M code", "stays until the next one",
     NC_READ { return static_cast<std::int32_t>(out(image, s).m); }, nullptr},
    {"s_code", kWord32, kFrom, kSystem, 0, 0, "the S code, r/min", "stays until the next one",
     NC_READ { return to_int(out(image, s).s); }, nullptr},
    {"t_code", kWord32, kFrom, kSystem, 0, 0, "the T code", "stays until the next one",
     NC_READ { return static_cast<std::int32_t>(out(image, s).t); }, nullptr},
    {"b_code", kWord32, kFrom, kSystem, 0, 0, "the second auxiliary function's code", "stays until the next one",
     NC_READ { return static_cast<std::int32_t>(out(image, s).b); }, nullptr},
    {"dm00", kBit, kFrom, kSystem, 0, 0, "decoded M00", "with m_strobe", NC_READ { return decoded(image, s, 0); },
     nullptr},
    {"dm01", kBit, kFrom, kSystem, 0, 0, "decoded M01", "with m_strobe", NC_READ { return decoded(image, s, 1); },
     nullptr},
    {"dm02", kBit, kFrom, kSystem, 0, 0, "decoded M02", "with m_strobe", NC_READ { return decoded(image, s, 2); },
     nullptr},
    {"dm30", kBit, kFrom, kSystem, 0, 0, "decoded M30", "with m_strobe", NC_READ { return decoded(image, s, 30); },
     nullptr},
    {"fin_wait", kWord16, kFrom, kSystem, 0, 0, "groups that wait for FIN: bit 0 M, 1 S, 2 T, 3 B; bit 11 the clamp of an index table",
     "from the strobe until FIN1 has fallen or FIN2 has risen; as long as motion waits for plc.unclamped", NC_READ { return out(image, s).fin_wait; }, nullptr},

    {"dwell", kBit, kFrom, kSystem, 0, 0, "a dwell is in execution", "level",
     NC_READ { return state(image, s, NC_STATE_RUNNING) && out(image, s).cause == NC_CAUSE_DWELL; }, nullptr},
    {"manual_allowed", kBit, kFrom, kSystem, 0, 0, "axes may be moved by hand: no program, one between two blocks, or one in a feed hold", "level",
     NC_READ { return out(image, s).manual_allowed; }, nullptr},
    {"macro_output", kWord16, kFrom, kNumberedControl, 2 * NC_WORDS, 0,
     "outputs of the macro interface, 16 bits each: word 1 is #1100 to #1115, word 3 #1300 to #1315", "from the block that sets them on, kept over reset",
     NC_READ {
       const std::uint32_t* words = image.status->macro_output;
       return words != nullptr ? static_cast<std::int16_t>(words[i / 2] >> 16 * (i % 2) & 0xffffu) : 0;
     },
     nullptr},

    // ---- motion ----
    {"distance_end", kBit, kFrom, kSystem, 0, 0, "no axis is commanded to move (DEN)", "level",
     NC_READ { return out(image, s).distance_zero; }, nullptr},
    {"rapid", kBit, kFrom, kSystem, 0, 0, "a rapid move is in execution", "level",
     NC_READ { return out(image, s).rapid; }, nullptr},
    {"cutting", kBit, kFrom, kSystem, 0, 0, "a cutting move is in execution", "level",
     NC_READ { return !out(image, s).rapid && !out(image, s).distance_zero && state(image, s, NC_STATE_RUNNING); },
     nullptr},
    {"tapping", kBit, kFrom, kSystem, 0, 0, "tapping mode G63", "level",
     NC_READ { return out(image, s).tapping; }, nullptr},
    {"f_digit_on", kBit, kFrom, kSystem, 0, 0, "the feed in execution was commanded by one digit", "level",
     NC_READ { return out(image, s).feed_digit_on; }, nullptr},
    {"f_digit", kWord16, kFrom, kSystem, 0, 0, "that digit, 0 to 5", "with f_digit_on",
     NC_READ { return out(image, s).feed_digit; }, nullptr},
    {"feed", kWord32, kFrom, kSystem, 0, 0, "actual path speed, mm/min", "every scan",
     NC_READ { return to_int(out(image, s).feed_mm_min); }, nullptr},
    {"spindle_speed", kWord32, kFrom, kSystem, 0, 0, "measured spindle speed, r/min, signed; of several spindles the one whose encoder counts", "every scan",
     NC_READ {
       const unsigned number = out(image, s).spindle_encoder;
       return number == 0 ? 0 : to_int(image.feedback->system[s].spindle[number - 1].rev_per_s * 60);
     },
     nullptr},
    {"spindle_measured", kBit, kFrom, kSystem, 0, 0, "something measures that speed; without it what needs it waits", "level",
     NC_READ {
       const unsigned number = out(image, s).spindle_encoder;
       return number != 0 && !image.feedback->system[s].spindle[number - 1].unmeasured;
     },
     nullptr},
    {"spindle_command", kWord32, kFrom, kSpindle, 0, 0, "speed that the spindle is wanted at, r/min", "kept while it is not selected; 0 while it is a C axis",
     NC_READ { return to_int(out(image, s).spindle_rev_min[i]); }, nullptr},
    {"spindle_actual", kWord32, kFrom, kSpindle, 0, 0, "its measured speed, r/min, signed", "every scan",
     NC_READ { return to_int(image.feedback->system[s].spindle[i].rev_per_s * 60); }, nullptr},
    {"spindle_at_speed", kBit, kFrom, kSpindle, 0, 0, "it turns within 3 % of the speed that it is wanted at", "level",
     NC_READ {
       const double wanted = out(image, s).spindle_rev_min[i];
       return wanted > 0 && !image.feedback->system[s].spindle[i].unmeasured && std::abs(std::abs(image.feedback->system[s].spindle[i].rev_per_s) * 60 - wanted) <= kAtSpeed * wanted;
     },
     nullptr},
    {"spindle_selected", kBit, kFrom, kSpindle, 0, 0, "it follows the S command", "level; kept during a thread and in the tapping mode",
     NC_READ { return out(image, s).spindle_selected >> i & 1; }, nullptr},
    {"line", kWord32, kFrom, kSystem, 0, 0, "line of the block in execution", "every scan",
     NC_READ { return static_cast<std::int32_t>(out(image, s).source.line); }, nullptr},
    {"program", kWord32, kFrom, kSystem, 0, 0, "O number of the program in execution", "every scan",
     NC_READ { return static_cast<std::int32_t>(out(image, s).source.program); }, nullptr},
    {"moving_p", kBit, kFrom, kAxis, 0, 0, "the axis is commanded to move in +", "every scan",
     NC_READ { return out(image, s).velocity.v[i] > 0; }, nullptr},
    {"moving_m", kBit, kFrom, kAxis, 0, 0, "the axis is commanded to move in -", "every scan",
     NC_READ { return out(image, s).velocity.v[i] < 0; }, nullptr},
    {"in_position", kBit, kFrom, kAxis, 0, 0, "the axis is where it is commanded to be, within its width (INP)", "every scan",
     NC_READ {
       const hal::SystemFeedback& machine = image.feedback->system[s];
       const double width = image.nc->system[s].axis[i].in_position;
       return !machine.actual_valid || std::abs(machine.actual.v[i] - out(image, s).command.v[i]) <= width;
     },
     nullptr},
    {"moved_by_hand", kBit, kFrom, kAxis, 0, 0, "the axis was moved by hand in a block stop, and stays there until a block names it",
     "until the program moves it, or has ended", NC_READ { return (out(image, s).moved_by_hand >> i & 1u) != 0; }, nullptr},
    {"at_reference", kBit, kFrom, kAxis, 0, 0, "the axis is commanded to its first reference position and stands (ZP1); not where it is only counted there in a machine lock", "every scan",
     NC_READ { return out(image, s).velocity.v[i] == 0 && flag(out(image, s).at_reference, i) && !flag(axes(image, s).beside, i); }, nullptr},
    {"unclamp", kBit, kFrom, kAxis, 0, 0, "the index table is to be unclamped (#2076)",
     "before the axis moves, until it stands where the program goes on without it",
     NC_READ { return static_cast<std::int32_t>(out(image, s).unclamp >> i & 1u); }, nullptr},
    {"servo_ready", kBit, kFrom, kSpindleAxis, 0, 0, "the spindle is this axis and holds its position", "level",
     NC_READ { return out(image, s).servo_ready >> i & 1; }, nullptr},
    {"referenced", kBit, kFrom, kSpindleAxis, 0, 0, "its reference position return is complete: the Z phase has been passed", "level, with servo_ready",
     NC_READ { return out(image, s).referenced >> i & 1; }, nullptr},
    {"axis_locked", kBit, kFrom, kAxis, 0, 0, "machine lock is in force for the axis", "level",
     NC_READ { return flag(axes(image, s).locked, i); }, nullptr},
    {"lock_left", kBit, kFrom, kAxis, 0, 0, "the axis was moved in the machine lock: it is not where it is shown", "until a reset",
     NC_READ { return flag(axes(image, s).beside, i); }, nullptr},
    {"drive_fault", kBit, kFrom, kAxis, 0, 0, "the drive reports a fault", "level",
     NC_READ { return static_cast<std::int32_t>(image.feedback->system[s].drive_fault >> i & 1u); }, nullptr},
    {"position", kWord32, kFrom, kAxis, 0, 0, "measured machine position, 0.001 mm or 0.001 deg; in a machine lock where the axis stands, not what is counted", "every scan",
     NC_READ { return to_int((image.feedback->system[s].actual.v[i] - axes(image, s).counted[i]) * 1000); }, nullptr},
    {"screw", kWord32, kFrom, kAxis, 0, 0, "what the drive is given beyond the machine position for backlash and pitch, 0.0001 mm or 0.0001 deg", "every scan",
     NC_READ { return to_int(axes(image, s).screw[i] * 10000); }, nullptr},
    {"homed", kBit, kFrom, kAxis, 0, 0, "the axis knows where it stands: it has been homed, or needs no homing", "level",
     NC_READ { return flag(axes(image, s).homed, i); }, nullptr},
    {"all_homed", kBit, kFrom, kControl, 0, 0, "every axis does", "level", NC_READ { return image.status->all_homed; }, nullptr},
    {"homing", kBit, kFrom, kSystem, 0, 0, "an axis is being homed", "from the request until it stands at its reference position, or has given up",
     NC_READ { return axes(image, s).homing != 0; }, nullptr},

    // ---- to the NC ----
    {"fin1", kBit, kTo, kSystem, 0, 0, "completion, FIN1: strobes go off when it rises, the program goes on when it falls",
     "on for at least one scan; on before the strobe it does not count until it was off", nullptr,
     NC_WRITE { image->nc_in[s].fin = value != 0; }},
    {"fin2", kBit, kTo, kSystem, 0, 0, "completion, FIN2: strobes go off and the program goes on when it rises",
     "as fin1", nullptr, NC_WRITE { image->nc_in[s].fin2 = value != 0; }},
    {"mfin", kBit, kTo, kSystem, 0, 0, "completion of the M code alone (MFIN)", "as fin1", nullptr,
     NC_WRITE { complete(value, image, s, kStrobeM); }},
    {"sfin", kBit, kTo, kSystem, 0, 0, "completion of the S code alone (SFIN)", "as fin1", nullptr,
     NC_WRITE { complete(value, image, s, kStrobeS); }},
    {"tfin", kBit, kTo, kSystem, 0, 0, "completion of the T code alone (TFIN)", "as fin1", nullptr,
     NC_WRITE { complete(value, image, s, kStrobeT); }},
    {"bfin", kBit, kTo, kSystem, 0, 0, "completion of the second auxiliary function alone (BFIN)", "as fin1", nullptr,
     NC_WRITE { complete(value, image, s, kStrobeB); }},
    {"auxiliary_lock", kBit, kTo, kSystem, 0, 0, "M, S, T and B are not given out, but for M00, M01, M02 and M30 (AFL)", "level, where a code would be given out", nullptr,
     NC_WRITE { image->nc_in[s].auxiliary_lock = value != 0; }},
    {"dry_run", kBit, kTo, kSystem, 0, 0, "cuts go at plc.jog_feed in place of F, with plc.jog_rapid as fast as the axes may cut (DRN); rapid traverse too where a parameter says so",
     "level; of a thread where it begins", nullptr, NC_WRITE { image->nc_in[s].dry_run = value != 0; }},
    {"machine_lock", kBit, kTo, kSystem, 0, 0, "every axis is locked: it is commanded and shown, and its drive stands (MLK)",
     "level; acts at rest: no program, or one between two blocks. Off: what was moved is given up by a reset before anything moves", nullptr,
     NC_WRITE { image->requests->system[s].machine_lock = value != 0; }},
    {"axis_lock", kBit, kTo, kAxis, 0, 0, "the axis alone is locked; that of the tool's axis is the Z lock (MLKn, Z axis cancel)", "as machine_lock", nullptr,
     NC_WRITE { image->requests->system[s].axis_lock |= static_cast<std::uint32_t>(value != 0) << i; }},
    {"cycle_start", kBit, kTo, kControl, 0, 0, "start or go on (ST)", "acts when it falls after 2 scans or more", nullptr,
     NC_WRITE { image->requests->cycle_start = value != 0; }},
    {"feed_hold_n", kBit, kTo, kSystem, 0, 1, "0: decelerate on the path and stay (*SP)", "level", nullptr,
     NC_WRITE { image->nc_in[s].feed_hold |= value == 0; }},
    {"reset", kBit, kTo, kControl, 0, 0, "give the program up; acknowledge alarms; while it is on nothing starts, and jogs that it ended wait for their button to be let go", "acts when it rises", nullptr,
     NC_WRITE { image->requests->reset = value != 0; }},
    {"single_block", kBit, kTo, kSystem, 0, 0, "stop at the end of each block", "level, at block end; or the operator's",
     nullptr, NC_WRITE { image->nc_in[s].single_block |= value != 0; }},
    {"optional_stop", kBit, kTo, kSystem, 0, 0, "M01 stops", "level, when M01 is reached; or the operator's", nullptr,
     NC_WRITE { image->nc_in[s].optional_stop |= value != 0; }},
    {"manual_absolute_n", kBit, kTo, kSystem, 0, 1, "0: manual absolute is off: what is moved by hand in a block stop takes the coordinate systems along",
     "level, when cycle start goes on from a block stop", nullptr, NC_WRITE { image->nc_in[s].manual_absolute_off |= value == 0; }},
    {"macro_interrupt", kBit, kTo, kSystem, 0, 0, "the interrupt program of M96 (UIT)", "by level or when it rises; at once or at block end (#1113)", nullptr,
     NC_WRITE { image->nc_in[s].macro_interrupt |= value != 0; }},
    {"interlock_n", kBit, kTo, kSystem, 0, 1, "0: axes decelerate to rest and none starts: chuck, coolant; they go on by themselves at 1, so a door takes plc.feed_hold_n too",
     "level", nullptr, NC_WRITE { image->nc_in[s].interlock |= value == 0; }},
    {"feed_override", kWord16, kTo, kSystem, 0, -1, "feed override in 0.01 %, at most the machine's; -1: the operator's counts, below that 0",
     "every scan; while it is not -1 the operator's commands for it are refused", nullptr, NC_WRITE { image->requests->system[s].feed_override = value; }},
    {"feed_code", kBit, kTo, kNumbered, 5, 0,
     "feed override as a code in steps of 10 %, inverted: .1 off is 10 %, .2 off 20 %, .3 off 40 %, .4 off 80 %, .5 off 160 % (*FV1 to *FV16); all off: 0 %",
     "as feed_override, which wins; counts from the first scan in which one is on", nullptr,
     NC_WRITE { set_bit(value, i, &image->requests->system[s].feed_code); }},
    {"f_digit_pulses", kWord16, kTo, kSystem, 0, 0,
     "pulses of the first handle since the last scan: they change F1 to F5 (#1506, #1507)", "every scan, during a cut with F1 to F5",
     nullptr, NC_WRITE { image->nc_in[s].feed_pulses = value; }},
    {"rapid_override", kWord16, kTo, kSystem, 0, -1, "rapid override in 0.01 %, at most 10000; -1: the operator's counts, below that 0",
     "as feed_override", nullptr, NC_WRITE { image->requests->system[s].rapid_override = value; }},
    {"block_skip", kBit, kTo, kNumbered, 9, 0, "optional block skip: blocks with / or /1, /2 ... /9 are left out", "level, as a block is read ahead; or the operator's",
     nullptr, NC_WRITE { if (value != 0) image->requests->system[s].skip_switches |= 2u << i; }},
    {"mirror", kBit, kTo, kAxis, 0, 0, "mirror image of the axis, about where it stands at the start", "level, when a program is started", nullptr,
     NC_WRITE { image->nc_in[s].mirror |= static_cast<std::uint32_t>(value != 0) << i; }},
    {"recalculate", kBit, kTo, kSystem, 0, 0, "what was read ahead is given up and read again: switches and variables act from the next block",
     "acts when it rises: in a block stop or a feed hold at rest, else at the end of the block in execution", nullptr,
     NC_WRITE { image->requests->system[s].recalculate = value != 0; }},
    {"macro_input", kWord16, kTo, kNumberedControl, 2 * NC_WORDS, 0,
     "inputs of the macro interface, 16 bits each, beside the points: word 1 is #1000 to #1015, word 3 #1200 to #1215", "every scan", nullptr,
     NC_WRITE { image->requests->macro_input[i / 2] |= static_cast<std::uint32_t>(value & 0xffff) << 16 * (i % 2); }},
    {"spindle_select", kBit, kTo, kSpindle, 0, 0, "the spindle follows the S command (SWS); at 0 it keeps its speed",
     "level; not taken over during a thread and in the tapping mode", nullptr,
     NC_WRITE { if (value != 0) image->nc_in[s].spindle_select = static_cast<std::uint8_t>(image->nc_in[s].spindle_select | 1u << i); }},
    {"spindle_encoder", kWord16, kTo, kSystem, 0, 0,
     "number of the spindle whose encoder counts for threads, feed per revolution and dwell; 0: the selected one's; one that there is not: none", "as spindle_select", nullptr,
     NC_WRITE { image->nc_in[s].spindle_encoder = static_cast<std::uint8_t>(std::clamp(value, -1, 255)); }},
    {"servo_on", kBit, kTo, kSpindleAxis, 0, 0, "1: the spindle is this axis (C axis), 0: a spindle", "level; a turning spindle stops first", nullptr,
     NC_WRITE { if (value != 0) image->nc_in[s].servo_on = static_cast<std::uint8_t>(image->nc_in[s].servo_on | 1u << i); }},
    {"jog_p", kBit, kTo, kAxis, 0, 0, "the axis goes in + as long as it is on", "level, in manual mode; one that was refused or stopped acts when it was let go", nullptr,
     NC_WRITE { if (value != 0) image->requests->system[s].jog_p |= 1u << i; }},
    {"jog_m", kBit, kTo, kAxis, 0, 0, "the axis goes in -; with jog_p it stands", "level, in manual mode", nullptr,
     NC_WRITE { if (value != 0) image->requests->system[s].jog_m |= 1u << i; }},
    {"jog_feed", kWord32, kTo, kSystem, 0, 0, "speed of jogs, mm/min or deg/min, at most the axis' own", "every scan", nullptr,
     NC_WRITE { image->requests->system[s].jog_feed = value; }},
    {"jog_rapid", kBit, kTo, kSystem, 0, 0, "jogs at the rapid rate of the axis (RT)", "level", nullptr,
     NC_WRITE { image->requests->system[s].rapid = value != 0; }},
    {"handle", kWord16, kTo, kAxis, 0, 0, "handle: the axis goes so many increments of 0.001 mm or deg further", "in each scan in which it is not 0, in manual mode", nullptr,
     NC_WRITE { image->requests->system[s].handle[i] = static_cast<std::int16_t>(value); }},
    {"reference", kBit, kTo, kAxis, 0, 0, "the axis goes to its first reference position; one that is not homed yet is homed", "acts when it rises, in manual mode at rest", nullptr,
     NC_WRITE { if (value != 0) image->requests->system[s].reference |= 1u << i; }},
    {"skip", kBit, kTo, kNumbered, 8, 0, "skip signal, beside the machine's own", "level, sampled once a scan", nullptr,
     NC_WRITE { image->nc_in[s].skip |= static_cast<std::uint32_t>(value != 0) << i; }},
    {"unclamped", kBit, kTo, kAxis, 0, 0, "the index table is unclamped, and at 0 clamped",
     "level: follows nc.unclamp; where it goes off during the movement the axes stop until it is back", nullptr,
     NC_WRITE {
       const std::uint32_t bit = 1u << i;
       image->nc_in[s].unclamped = value != 0 ? image->nc_in[s].unclamped | bit : image->nc_in[s].unclamped & ~bit;
     }},
    {"mode_auto", kBit, kTo, kControl, 0, 0, "select automatic mode",
     "acts when it rises; refused while a program runs; none or two of the modes: the old one stays", nullptr,
     NC_WRITE { image->requests->mode[0] = value != 0; }},
    {"mode_mdi", kBit, kTo, kControl, 0, 0, "select MDI mode", "as mode_auto", nullptr,
     NC_WRITE { image->requests->mode[1] = value != 0; }},
    {"mode_manual", kBit, kTo, kControl, 0, 0, "select manual mode", "as mode_auto", nullptr,
     NC_WRITE { image->requests->mode[2] = value != 0; }},
    {"alarm", kBit, kTo, kNumberedControl, kLadderAlarms, 0, "alarm of the ladder: motion stops, no start until reset",
     "level; comes back as long as it is on", nullptr,
     NC_WRITE { image->requests->alarm = static_cast<std::uint8_t>(image->requests->alarm | (value != 0 ? 1u << i : 0u)); }},
    {"home", kBit, kTo, kControl, 0, 0, "every axis that can be homed is, in the order of the configuration", "acts when it rises, in manual mode at rest", nullptr,
     NC_WRITE { image->requests->home = value != 0; }},
    {"interlock_p_n", kBit, kTo, kAxis, 0, 1, "0: the axis may not go in + (*+IT): by hand it stops and is given up; in a program the path comes to rest, and goes on by itself at 1",
     "level", nullptr, NC_WRITE { image->requests->system[s].interlocked[1] |= static_cast<std::uint32_t>(value == 0) << i; }},
    {"interlock_m_n", kBit, kTo, kAxis, 0, 1, "0: the axis may not go in - (*-IT)", "as interlock_p_n", nullptr,
     NC_WRITE { image->requests->system[s].interlocked[0] |= static_cast<std::uint32_t>(value == 0) << i; }},
    {"servo_off", kBit, kTo, kAxis, 0, 0, "the drive of the axis is off, behind its brake if it has one; its position is followed meanwhile (SVF)",
     "level; acts at rest when no program is in execution or interrupted", nullptr,
     NC_WRITE { image->requests->system[s].servo_off |= static_cast<std::uint32_t>(value != 0) << i; }},
    {"tap_retract_possible", kBit, kFrom, kSystem, 0, 0, "a tap was given up in its hole and stands there: plc.tap_retract draws it out", "level",
     NC_READ { return out(image, s).tap_retract_possible; }, nullptr},
    {"tool_life_ended", kBit, kFrom, kSystem, 0, 0, "the life of the tool in the spindle has ended: the next T of its group takes another one", "level",
     NC_READ { return (out(image, s).tool_life & NC_TOOL_LIFE_ENDED) != 0; }, nullptr},
    {"tool_group_ended", kBit, kFrom, kSystem, 0, 0, "no tool of the group of the tool in the spindle is left", "level",
     NC_READ { return (out(image, s).tool_life & NC_TOOL_GROUP_ENDED) != 0; }, nullptr},
    {"tool_group", kWord32, kFrom, kSystem, 0, 0, "group of tool life management of the tool in the spindle; 0: none", "level",
     NC_READ { return static_cast<std::int32_t>(out(image, s).tool_group); }, nullptr},
    {"tap_retract", kBit, kTo, kSystem, 0, 0, "the tap that stands in a hole is drawn out, the spindle with it, as long as it is on", "begins when it rises, in manual mode",
     nullptr, NC_WRITE { image->nc_in[s].tap_retract |= value != 0; }},
    {"power_failed", kBit, kFrom, kControl, 0, 0, "the supply has said that it fails (plc.power_fail_n)", "until reset, with the supply good again",
     NC_READ { return image.status->power_failed; }, nullptr},
    {"power_fail_done", kBit, kFrom, kControl, 0, 0, "and what is to be done then is done: axes at rest or drives off, brakes closed, retained data written", "with power_failed",
     NC_READ { return image.status->power_done; }, nullptr},
    {"power_fail_n", kBit, kTo, kControl, 0, 1, "0: the supply fails: all paths come to rest, retained data are written, brakes close, drives go off (R24)",
     "level; latched until reset; [power] has its times", nullptr, NC_WRITE { image->requests->power_fails = value == 0; }},
    {"restart_at_place", kBit, kFrom, kSystem, 0, 0, "a program that is begun inside stands at its place: cycle start goes on", "level", NC_READ { return flag(image.status->restart_stands, s); }, nullptr},
    {"restart_open", kBit, kFrom, kSystem, 0, 0, "and cycle start is refused, because what the program has given to the machine before the place is neither there nor confirmed", "level",
     NC_READ { return flag(image.status->restart_stands & image.status->restart_bars, s); }, nullptr},
    {"restart_axes_away", kBit, kFrom, kAxis, 0, 0, "cycle start is refused, because this axis is not where the program goes on: at the place of a restart, in a feed hold, or in the block stop that one is behind a thread", "every scan",
     NC_READ { return flag(out(image, s).restart_axes, i); }, nullptr},
    {"restart_approach", kBit, kTo, kAxis, 0, 0, "in a block stop or a feed hold the axis goes back to where the program goes on, at the speed of jogs; one axis at a time",
     "level, in manual mode; one that was refused or stopped acts when it was let go", nullptr,
     NC_WRITE { image->requests->system[s].approach |= static_cast<std::uint32_t>(value != 0) << i; }},
    {"search", kBit, kTo, kSystem, 0, 0, "external search: the program plc.search_program is selected, and its place plc.search_sequence looked for, at which the next cycle start begins",
     "acts when it rises; on until nc.search_finished", nullptr, NC_WRITE { image->requests->system[s].search = value != 0; }},
    {"search_program", kWord32, kTo, kSystem, 0, 0, "O number of the program; 0: the one that is selected", "when plc.search rises", nullptr,
     NC_WRITE { image->requests->system[s].search_for.program = value; }},
    {"search_sequence", kWord32, kTo, kSystem, 0, 0, "sequence number of the block; 0: the head of the program", "when plc.search rises", nullptr,
     NC_WRITE { image->requests->system[s].search_for.sequence = value; }},
    {"search_finished", kBit, kFrom, kSystem, 0, 0, "the external search has come to its end: nc.search_result says how", "until plc.search goes off",
     NC_READ { return search_result(image, s) != SearchResult::kNone; }, nullptr},
    {"search_result", kWord16, kFrom, kSystem, 0, 0, "0 none yet, 1 found, 2 bad number, 3 refused (mode, program in execution, alarm, reset), 4 no such program, 5 not passed its check, 6 no such place", "with nc.search_finished",
     NC_READ { return static_cast<std::int32_t>(search_result(image, s)); }, nullptr},
    {"tool_broken", kBit, kTo, kSystem, 0, 0, "the tool in the spindle is not to be used any more (tool life management)", "acts when it rises", nullptr,
     NC_WRITE { image->nc_in[s].tool_broken |= value != 0; }},
    {"tool_length_by_handle", kBit, kTo, kSystem, 0, 0,
     "in automatic and MDI mode the handle of the third axis changes the length that is compensated along the tool axis, by 0.001 mm for an increment (YC92 with YC5E)",
     "in each scan in which that handle is not 0, with G43.1 in a block stop, a feed hold or a cut; the next block has the new length", nullptr,
     NC_WRITE { image->requests->system[s].length_by_handle = value != 0; }},
    {"tool_tilt", kWord32, kTo, kSystem, 0, 0, "angle about X or Y of a head that is no axis (`tool_axis` of [machine]), 0.001 deg (R2628 to R2631)",
     "where a block needs it: one with G43.1, and with it in force one behind M, S, T and B", nullptr, NC_WRITE { image->nc_in[s].tool_angle[0] = value * 1e-3; }},
    {"tool_turn", kWord32, kTo, kSystem, 0, 0, "its angle about Z, 0.001 deg (R2628 to R2631)", "as tool_tilt", nullptr,
     NC_WRITE { image->nc_in[s].tool_angle[1] = value * 1e-3; }},
    {"tool_length_added", kWord32, kFrom, kSystem, 0, 0, "what the handle has added to the length along the tool axis, 0.001 mm", "until another number, G49, a reset or the end of the program",
     NC_READ { return static_cast<std::int32_t>(std::lround(std::clamp(out(image, s).tool_length_added, -2e6, 2e6) * 1e3)); }, nullptr},
};

const unsigned kSignalCount = sizeof(kSignals) / sizeof(kSignals[0]);

#undef NC_READ
#undef NC_WRITE

std::vector<Signal> machine_signals(const nc_config& nc) {
  std::vector<Signal> all;
  for (unsigned r = 0; r < kSignalCount; ++r) {
    const SignalRow& row = kSignals[r];
    const bool once = row.scope == SignalScope::kControl || row.scope == SignalScope::kNumberedControl;
    for (unsigned s = 0; s < (once ? 1u : nc.system_count); ++s) {
      std::string base = row.direction == SignalDirection::kFromNc ? "nc" : "plc";
      if (s > 0) base += std::to_string(s + 1);
      base += std::string(".") + row.name;
      const auto add = [&](unsigned index, const std::string& name) {
        all.push_back({&row, static_cast<std::uint8_t>(s), static_cast<std::uint8_t>(index), name});
      };
      if (row.scope == SignalScope::kSpindle) {
        const unsigned from = row.direction == SignalDirection::kFromNc ? 1 : 2;  // a single spindle has a speed, too, and nothing selects it
        for (unsigned n = 0; nc.system[s].spindle_count >= from && n < nc.system[s].spindle_count; ++n) add(n, base + "." + std::to_string(n + 1));
      } else if (row.scope == SignalScope::kAxis || row.scope == SignalScope::kSpindleAxis) {
        for (unsigned a = 0; a < nc.system[s].axis_count; ++a)
          if (row.scope == SignalScope::kAxis || nc.system[s].axis[a].spindle != 0) add(a, base + "." + std::string(1, nc.system[s].axis[a].name));
      } else if (row.scope == SignalScope::kNumbered || row.scope == SignalScope::kNumberedControl) {
        for (unsigned n = 0; n < row.count; ++n) add(n, base + "." + std::to_string(n + 1));
      } else {
        add(0, base);
      }
    }
  }
  return all;
}

namespace {

const char* type_text(ladder::DeviceType type) {
  return type == kBit ? "bit" : type == kWord16 ? "16 bit" : "32 bit";
}

std::string shown_name(const SignalRow& row) {
  std::string name = std::string(row.direction == SignalDirection::kFromNc ? "nc." : "plc.") + row.name;
  if (row.scope == SignalScope::kAxis) name += ".X";
  if (row.scope == SignalScope::kSpindleAxis) name += ".C";
  if (row.scope == SignalScope::kSpindle) name += ".1 ... ." + std::to_string(NC_MAX_SPINDLES);
  if (row.scope == SignalScope::kNumbered || row.scope == SignalScope::kNumberedControl)
    name += ".1 ... ." + std::to_string(row.count);
  return name;
}

}  // namespace

std::string signal_document() {
  std::string text;
  for (const auto direction : {SignalDirection::kFromNc, SignalDirection::kToNc}) {
    const bool from = direction == SignalDirection::kFromNc;
    text += from ? "## From the NC to the ladder\n\n| signal | type | meaning | timing |\n|---|---|---|---|\n"
                 : "\n## From the ladder to the NC\n\n| signal | type | safe value | meaning | timing |\n|---|---|---|---|---|\n";
    for (unsigned r = 0; r < kSignalCount; ++r) {
      const SignalRow& row = kSignals[r];
      if (row.direction != direction) continue;
      text += "| `" + shown_name(row) + "` | " + type_text(row.type) + " | ";
      if (!from) text += std::to_string(row.safe) + " | ";
      text += std::string(row.meaning) + " | " + row.timing + " |\n";
    }
  }
  return text;
}

}  // namespace nc::rt
