// SPDX-License-Identifier: Apache-2.0
// The groups of the interpreter's state (interpret/state.hpp) and of its records (interpret/program_records.hpp), and what each event does to them
// (interpret/lifetimes.hpp): every member is in exactly one group and is treated like that group, with the exceptions that are named here.
// kept_state_test.cpp shows what that means for programs.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "interpret/lifetimes.hpp"
#include "places/places.hpp"

namespace nc::test {
namespace {

// ---- every member is in one group ------------------------------------------------------------------------------------------

struct Anything {
  template <class T>
  operator T() const;
};
// State and StateValues are aggregates: one more initializer than there are bases is possible only if they have a member of their own.
template <class T, class... Base>
concept HasOnly = requires { T{Base{}...}; }
&&!requires { T{Base{}..., Anything{}}; };
static_assert(HasOnly<State, StateValues, CallStack, ModesInExecution>);
template <class... Group>
struct Groups {
  static constexpr size_t kCount = sizeof...(Group);
  static_assert(HasOnly<StateValues, Group...>);
};
using AllGroups = Groups<BlockLife, MachinePosition, AppliedLength, ModalLife, ModalInProgram, ProgramLife, UntilReset, UntilOperatorReset, UntilPowerOff,
                         Derived>;
static_assert(sizeof(State) == sizeof(StateValues) + sizeof(CallStack) + sizeof(ModesInExecution));

// An example of a member outside the groups.
struct OneMore : StateValues, CallStack, ModesInExecution {
  bool one_more = false;
};
static_assert(!HasOnly<OneMore, StateValues, CallStack, ModesInExecution>);

struct Bytes {
  std::string name;
  size_t offset, size;
};
using Fields = std::vector<Bytes>;

// Parts of a member that is a struct with padding, all of them: a structured binding names no less. Padding is copied or not, as the compiler likes.
template <class T>
constexpr bool kWithoutPadding = std::has_unique_object_representations_v<T> || std::is_floating_point_v<std::remove_all_extents_t<T>> ||
                                 std::is_same_v<T, AxisVec> || std::is_same_v<T, ModalState>;
template <class T, class Add>
void each_part(const T& member, const Add& add) {
  static_assert(kWithoutPadding<T>, "a struct with padding: give its parts below");
  add(&member, sizeof member);
}
#define NC_PARTS(Struct, ...)                                  \
  template <class Add>                                         \
  void each_part(const Struct& member, const Add& add) {       \
    const auto& [__VA_ARGS__] = member;                        \
    const auto each = [&](const auto&... part) { (add(&part, sizeof part), ...); }; \
    each(__VA_ARGS__);                                         \
  }
NC_PARTS(Repeat, active, items)
NC_PARTS(AxisMap, kind, linear, rotary, side, frozen, scale, angle)
NC_PARTS(MillReturn, feed, plane, feed_mode, plane_axis, third_axis, letter, moved)
NC_PARTS(SpindleControl, surface, axis, held)
NC_PARTS(SpindleClamp, any, always, has_s, s, q)
NC_PARTS(Compensation, side, transparent, has_vector, hold_vector, corner_arc, type_b, cancel_vector, check, walls, avoid, square_in_spike, axis, arc_cos, radius, vector, by_hand)
NC_PARTS(CycleState, kind, drill_axis, has_z, has_r, has_p, z, r, z_incremental, r_incremental, q, tap_q, p, shift, third, has_third, third_incremental, in_position,
         initial_level, tap, synchronous, returned, has_first, pitch, return_speed, first, in_hole, way_out)
NC_PARTS(LifeInput, kind, flags, group, life, registered)
NC_PARTS(NurbsState, first, knots, points, order, axes)
NC_PARTS(SplineWay, joined, moved, back)
NC_PARTS(MeetingFirst, kind, ccw, by_radius, by_hand, choice, angle_deg, center, radius, start)
NC_PARTS(SpaceVector, on, turns, axis, v)
NC_PARTS(InHand, called, selected, in_spindle, spindle_on, spindle_reverse)
NC_PARTS(LeftByEnd, feed, motion, feed_mode, any)

template <class... Member>
Fields fields_at(const StateValues& state, const char* names, const Member&... member) {
  Fields fields;
  const char* at = names;
  const auto add = [&](const auto& one) {
    at += std::strspn(at, ", ");
    const size_t length = std::strcspn(at, ", ");
    each_part(one, [&](const void* place, size_t size) {
      fields.push_back({std::string(at, length), static_cast<size_t>(static_cast<const char*>(place) - reinterpret_cast<const char*>(&state)), size});
    });
    at += length;
  };
  (add(member), ...);
  return fields;
}

// A structured binding names all members of its struct, so that this list cannot miss one.
#define NC_FIELDS(Group, ...)                              \
  {                                                        \
    const auto& [__VA_ARGS__] = static_cast<const Group&>(state); \
    groups[#Group] = fields_at(state, #__VA_ARGS__, __VA_ARGS__); \
  }

std::map<std::string, Fields> groups_of_state() {
  static const State state;
  std::map<std::string, Fields> groups;
  NC_FIELDS(BlockLife, seq, repeat, owes_mark, stop_reading, modes_ahead)
  NC_FIELDS(MachinePosition, machine)
  NC_FIELDS(AppliedLength, applied)
  NC_FIELDS(ModalLife, modal, tool_length, length_value, length_axis, plane_axis, third_axis, polar_angle_known, work_system, high_speed, fine_mode, accuracy_command, scaled,
            mirror, rotated, stitch, spline, held_point, stroke_box, polar_angle, polar_pole, thread_lead, last_feed, arc_radius, map_begins, map, mill, spindle)
  NC_FIELDS(ModalInProgram, comp, cycle, motion_off, moves_since_comp_off, moved_side, arc_points, nurbs, nurbs_order, arc_step, parameter_input, tap_code, switch_mirror, figure_scaled,
            figure_mirror, vacant_feed_file, vacant_feed, vacant_feed_line, spline_way, meeting, space, space_mirror, space_number, life_input, moved_space, by_hand)
  NC_FIELDS(ProgramLife, end_seen, percent_seen, unit_used, interrupt_on, interrupt_moved, interrupt_depth, suppressed, disabled)
  NC_FIELDS(UntilReset, spindle_on, spindle_reverse, spindle_clamp, length_handle_number, length_by_handle, length_changed_by_handle, tool_angles_old, tool_angle)
  NC_FIELDS(UntilOperatorReset, left_by_end)
  NC_FIELDS(UntilPowerOff, clock_base, clock_shift_s, port_open, selected_tool, spindle_tool, reads_beside_machine, machine_has)
  NC_FIELDS(Derived, special, high_accuracy, modal_call, mapped, work_turned, work_turn_pending)
  return groups;
}

TEST(StateGroups, NoTwoHaveAMemberInCommon) {
  EXPECT_EQ(groups_of_state().size(), AllGroups::kCount);
  std::map<std::string, std::string> group_of;
  std::vector<int> owner(sizeof(StateValues), 0);
  for (const auto& [group, fields] : groups_of_state()) {
    for (const Bytes& field : fields) {
      EXPECT_EQ(group_of.emplace(field.name, group).first->second, group) << field.name;
      ASSERT_LE(field.offset + field.size, sizeof(StateValues)) << group << "::" << field.name;
      for (size_t i = 0; i < field.size; ++i) EXPECT_EQ(owner[field.offset + i]++, 0) << group << "::" << field.name;
    }
  }
}

// ---- the table of state.hpp ------------------------------------------------------------------------------------------------

enum Column : unsigned { kCall, kInterrupt, kMdi, kEnd, kReset, kPowerOff, kColumns };

/// The rows of the table in the comment of state.hpp, by group; the tests below expect what is written there.
const std::map<std::string, std::vector<std::string>>& table() {
  static const auto rows = [] {
    std::map<std::string, std::vector<std::string>> all;
    const auto groups = groups_of_state();
    std::ifstream file(nc::test::kSourceDir + "/libnc/src/interpret/state.hpp");
    for (std::string line; std::getline(file, line);) {
      std::istringstream words(line);
      std::string slashes, group;
      if (!(words >> slashes >> group) || slashes != "//" || groups.count(group) == 0 || group == "Derived") continue;
      std::vector<std::string> cells;
      for (std::string cell; words >> cell;) cells.push_back(cell);
      all[group] = cells;
    }
    return all;
  }();
  return rows;
}

std::set<std::string> groups_with(Column column, const std::string& cell) {
  std::set<std::string> found;
  for (const auto& [group, cells] : table())
    if (cells.size() == kColumns && cells[column] == cell) found.insert(group);
  return found;
}

TEST(StateGroups, EachHasItsRowInTheTable) {
  for (const auto& [group, fields] : groups_of_state()) {
    if (group == "Derived") continue;
    ASSERT_EQ(table().count(group), 1u) << group;
    EXPECT_EQ(table().at(group).size(), kColumns) << group;
  }
  EXPECT_EQ(groups_with(kCall, "yes").size(), table().size());
  EXPECT_EQ(groups_with(kPowerOff, "-").size(), table().size());
}

// ---- what an event makes of a group -------------------------------------------------------------------------------------

// Patterns for every byte. Both 0 and 1 are valid values of a bool and of every enumeration.
constexpr int kPatterns[] = {0, 1};

std::unique_ptr<State> filled(int pattern) {
  auto state = std::make_unique<State>();
  std::memset(static_cast<void*>(state.get()), pattern, sizeof(StateValues));
  state->depth = state->loop_count = 0;
  return state;
}

const char* bytes_of(const State& state, const Bytes& field) { return reinterpret_cast<const char*>(&state) + field.offset; }

bool all_are(const State& state, const Bytes& field, int pattern) {
  const char* at = bytes_of(state, field);
  for (size_t i = 0; i < field.size; ++i)
    if (at[i] != pattern) return false;
  return true;
}

bool same(const State& a, const State& b, const Bytes& field) { return std::memcmp(bytes_of(a, field), bytes_of(b, field), field.size) == 0; }

/// `event` gets a state in which all bytes have a pattern. Afterwards kept members must still have it; the others must not depend on it.
void expect_kept(const std::function<void(State&)>& event, const std::set<std::string>& kept, const std::set<std::string>& exceptions) {
  std::unique_ptr<State> after[2];
  for (const int pattern : kPatterns) {
    after[pattern] = filled(pattern);
    event(*after[pattern]);
  }
  for (const auto& [group, fields] : groups_of_state()) {
    for (const Bytes& field : fields) {
      if (exceptions.count(field.name) != 0 || group == "Derived") continue;
      if (kept.count(group) != 0) {
        for (const int pattern : kPatterns) EXPECT_TRUE(all_are(*after[pattern], field, pattern)) << group << "::" << field.name;
      } else {
        EXPECT_TRUE(same(*after[0], *after[1], field)) << group << "::" << field.name;
      }
    }
  }
}

/// `event` makes of `now` and `before`, which differ in every byte, a state where these groups are those of `before` and all others those of `now`.
void expect_returned(const std::function<void(State&, const State&)>& event, const std::set<std::string>& returned, const std::set<std::string>& exceptions) {
  for (const int pattern : kPatterns) {
    const std::unique_ptr<State> before = filled(pattern), now = filled(1 - pattern);
    event(*now, *before);
    for (const auto& [group, fields] : groups_of_state()) {
      for (const Bytes& field : fields) {
        if (exceptions.count(field.name) != 0 || group == "Derived") continue;
        const int expected = returned.count(group) != 0 ? pattern : 1 - pattern;
        EXPECT_TRUE(all_are(*now, field, expected)) << group << "::" << field.name << " pattern " << pattern;
      }
    }
  }
}

InitialValues initial_values() {
  InitialValues initial;
  initial.modal.d = 77;  // told apart from every pattern
  initial.plane_axis[0] = 5;
  initial.third_axis = 4;
  return initial;
}

void begin(State& state) { begin_program(state, initial_values(), false); }
void begin_mdi(State& state) { begin_program(state, initial_values(), true); }

TEST(StateGroups, TheNextStartKeepsThePositionAndWhatNoProgramEnds) {  // M700 9.1, 3.7
  // What an end leaves is noted again by a program that has read something (see below).
  expect_kept(begin, groups_with(kEnd, "yes"), {"left_by_end"});
  State state;
  state.modal.tool = 9;
  begin(state);
  EXPECT_EQ(state.modal.d, 77u);
  EXPECT_EQ(state.modal.tool, 0u);
  EXPECT_EQ(state.plane_axis[0], 5);
  EXPECT_EQ(state.third_axis, 4);
}

TEST(StateGroups, TheNextTextOfMdiKeepsTheModes) {  // M700 5.1; exceptions: cycles, macro calls, radius compensation within `modal`
  expect_kept(begin_mdi, groups_with(kMdi, "yes"), {"left_by_end", "modal"});
  State state;
  state.modal.set(Function::comp_left);
  state.modal.set(Function::incremental);
  state.modal.set(Function::tapping_mode);
  state.modal.feed = 12;
  begin_mdi(state);
  EXPECT_TRUE(state.modal.is(initial_values().modal.of(Mode::radius)));
  EXPECT_TRUE(state.modal.is(initial_values().modal.of(Mode::cutting)));
  EXPECT_TRUE(state.modal.is(Function::incremental));
  EXPECT_EQ(state.modal.feed, 12);
  EXPECT_EQ(state.modal.d, 0u);
}

TEST(StateGroups, AnEndLeavesItsMotionToTheStartsBehindItUntilAReset) {  // M700 9.1
  InitialValues initial = initial_values();
  initial.modal.set(Function::rapid);
  initial.modal.set(Function::feed_per_minute);
  initial.motion_outlives_end = true;
  State state;
  state.seq = 3;
  state.modal.set(Function::linear);
  state.modal.set(Function::feed_per_minute);
  state.modal.feed = 250;
  state.end_seen = true;
  State ended = state;
  begin_program(state, initial, false);
  EXPECT_TRUE(state.modal.is(Function::linear));
  EXPECT_EQ(state.modal.feed, 250);
  begin_program(state, initial, false);  // selected once more before a block of it has been read
  EXPECT_TRUE(state.modal.is(Function::linear));
  State reset = state;
  end_by_operator(reset);
  begin_program(reset, initial, false);
  EXPECT_TRUE(reset.modal.is(Function::rapid));
  EXPECT_EQ(reset.modal.feed, 0);
  end_by_operator(ended);  // the reset comes right behind the end
  begin_program(ended, initial, false);
  EXPECT_TRUE(ended.modal.is(Function::rapid));
  state.seq = 1;  // this program is left before its end
  begin_program(state, initial, false);
  EXPECT_TRUE(state.modal.is(Function::rapid));
}

TEST(StateGroups, ParametersKeepThePolarCommandAndTheClampOverAReset) {  // M700 6.12 (3), 10.4 (3)
  for (const bool kept : {false, true}) {
    InitialValues initial;
    initial.keeps_clamp = initial.keeps_polar_command = kept;
    State state;
    state.spindle_clamp.any = true;
    state.modal.set(Function::polar_command_on);
    end_by_operator(state);
    begin_program(state, initial, false);
    EXPECT_EQ(state.spindle_clamp.any, kept);
    EXPECT_EQ(state.modal.is(Function::polar_command_on), kept);
  }
}

TEST(StateGroups, AResetByTheOperatorKeepsThePositionAndWhatNoProgramEnds) {
  expect_kept(
      [](State& state) {
        end_by_operator(state);
        begin(state);
      },
      groups_with(kReset, "yes"), {});
}

TEST(StateGroups, PowerOnIsAnInitialState) {
  State state, power_on;
  begin(state);
  power_on.modal = initial_values().modal;
  power_on.plane_axis[0] = 5;
  power_on.third_axis = 4;
  for (const auto& [group, fields] : groups_of_state())
    for (const Bytes& field : fields) EXPECT_TRUE(same(state, power_on, field)) << field.name;
}

TEST(StateGroups, AnInterruptProgramBeginsWithWhatIsInForce) {  // M700 13.12
  const AxisVec place;
  std::set<std::string> all;
  for (const auto& [group, fields] : groups_of_state()) all.insert(group);
  all.erase("MachinePosition");
  expect_kept([&](State& state) { begin_interrupt_program(state, place); }, all, {"repeat", "interrupt_moved", "parameter_input", "life_input"});
}

// Exceptions, tested below: `modal` holds the M code that was given out; `moves_since_comp_off`, `spline_way` and `by_hand` change with a move of the interrupt
// program.
const std::set<std::string> kReturnExceptions = {"modal", "moves_since_comp_off", "spline_way", "by_hand"};

TEST(StateGroups, AnInterruptGivesTheModesBackAndLeavesTheRest) {  // M700 13.12
  for (const bool inside_block : {false, true}) {
    std::set<std::string> returned = groups_with(kInterrupt, "RETURNS");
    if (inside_block) returned.merge(groups_with(kInterrupt, "place"));
    std::set<std::string> exceptions = kReturnExceptions;
    if (!inside_block) exceptions.insert("machine");  // the pattern holds an axis (AxisMap::frozen): below
    expect_returned([&](State& now, const State& before) { return_from_interrupt(now, before, inside_block); }, returned, exceptions);
  }
}

TEST(StateGroups, AnInterruptThatLosesTheBlockGivesNothingBackButParameterInput) {  // M700 13.12: type 1 with a move, M99 P
  expect_returned([](State& now, const State& before) { go_on_behind_interrupt(now, before); }, {}, {"parameter_input", "life_input"});
  State now, before;
  before.parameter_input = true;
  begin_interrupt_program(now, AxisVec{});
  go_on_behind_interrupt(now, before);
  EXPECT_TRUE(now.parameter_input);
  before.life_input.group = 7;
  begin_interrupt_program(now, AxisVec{});
  go_on_behind_interrupt(now, before);
  EXPECT_EQ(now.life_input.group, 7U);
}

TEST(StateGroups, WhatAnInterruptGivesBackInItsOwnWay) {
  State before, now;
  before.modal.m = 8, now.modal.m = 9;
  before.modal.tool = 1, now.modal.tool = 2;
  before.moves_since_comp_off = 0, now.moves_since_comp_off = 0;
  before.spline_way.joined = before.by_hand = true;
  before.map.frozen = 1;
  for (unsigned i = 0; i < kMaxAxes; ++i) before.machine[i] = 1, now.machine[i] = 2;
  State behind = now;
  return_from_interrupt(behind, before, false);
  EXPECT_EQ(behind.modal.m, 9u);
  EXPECT_EQ(behind.modal.tool, 1u);
  EXPECT_EQ(behind.moves_since_comp_off, 0u);
  EXPECT_TRUE(behind.spline_way.joined);
  EXPECT_TRUE(behind.by_hand);
  EXPECT_EQ(behind.machine[0], 1);  // the axis of G07 is beside where the program is
  for (unsigned i = 1; i < kMaxAxes; ++i) EXPECT_EQ(behind.machine[i], 2);

  now.interrupt_moved = true;
  now.moves_since_comp_off = 1;
  behind = now;
  return_from_interrupt(behind, before, false);
  EXPECT_FALSE(behind.spline_way.joined);
  EXPECT_FALSE(behind.by_hand);
  EXPECT_EQ(behind.moves_since_comp_off, 1u);
}

// ---- the records -----------------------------------------------------------------------------------------------------------

static_assert(HasOnly<ProgramRecords, ProgramRecordsLife, MapRecordsLife, MachineRecordsLife>);
static_assert(sizeof(ProgramRecords) == sizeof(ProgramRecordsLife) + sizeof(MapRecordsLife) + sizeof(MachineRecordsLife));

/// The rows of the table in program_records.hpp, by group.
std::map<std::string, std::vector<std::string>> record_table() {
  std::map<std::string, std::vector<std::string>> rows;
  std::ifstream file(nc::test::kSourceDir + "/libnc/src/interpret/program_records.hpp");
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string slashes, group;
    if (!(words >> slashes >> group) || slashes != "//") continue;
    if (group != "ProgramRecordsLife" && group != "MapRecordsLife" && group != "MachineRecordsLife") continue;
    for (std::string cell; words >> cell;) rows[group].push_back(cell);
    EXPECT_EQ(rows[group].size(), kColumns) << group;
  }
  EXPECT_EQ(rows.size(), 3u);
  return rows;
}

template <class Group>
void expect_group(const std::string& name, Column column, const ProgramRecords& before, const ProgramRecords& now) {
  const bool kept = record_table().at(name).at(column) == "yes";
  const ProgramRecords fresh;
  EXPECT_FALSE(static_cast<const Group&>(before) == static_cast<const Group&>(fresh)) << name;
  EXPECT_TRUE(static_cast<const Group&>(now) == static_cast<const Group&>(kept ? before : fresh)) << name;
}

TEST(RecordGroups, AProgramBeginsWithThoseThatItsRowKeeps) {
  for (const Column column : {kMdi, kEnd, kReset}) {
    for (const int pattern : kPatterns) {
      ProgramRecords before;
      std::memset(static_cast<void*>(&before), pattern, sizeof before);
      if (pattern == 0) before.maps.rotation_deg = before.skip.work[0] = 1;  // the others begin with something else than 0
      ProgramRecords now = before;
      begin_program(now, column == kMdi, false);
      expect_group<ProgramRecordsLife>("ProgramRecordsLife", column, before, now);
      expect_group<MapRecordsLife>("MapRecordsLife", column, before, now);
      expect_group<MachineRecordsLife>("MachineRecordsLife", column, before, now);
    }
  }
}

TEST(RecordGroups, IntermediatePointsEndWithTheProgramWhereTheFamilySaysSo) {  // DGSHAPE G28
  ProgramRecords records;
  records.midpoints.axis[1] = 5;
  records.skip.work[0] = 6;
  begin_program(records, false, true);
  EXPECT_FALSE(records.midpoints.axis[1].has_value());
  EXPECT_EQ(records.skip.work[0], 6);
}

TEST(RecordGroups, AnInterruptGivesBackTheMapsAlone) {  // M700 13.12; what that means for programs: interrupt_test.cpp
  for (const auto& [group, cells] : record_table()) EXPECT_EQ(cells.at(kInterrupt) == "RETURNS", group == "MapRecordsLife") << group;
}

}  // namespace
}  // namespace nc::test
