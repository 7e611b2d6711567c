// SPDX-License-Identifier: Apache-2.0
// What may be commanded in high-speed high-accuracy control I and II and in SSS control: the tables of M700 13.17.1 "relation with
// other functions" (2) and 13.17.2 (2).
#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

enum : uint8_t { kMode1 = 1, kMode2 = 2, kSmooth = 4, kBoth = kMode1 | kMode2, kAll = kBoth | kSmooth };

struct Allowed {
  Function function;
  uint8_t modes;
};

// The columns of the first table are missing in the manual; where no other sentence decides, a row counts for both modes (docs/decisions.md).
constexpr Allowed kAllowed[] = {
    {Function::rapid, kAll},
    {Function::linear, kAll},
    {Function::arc_cw, kAll},             // also as a helix
    {Function::arc_ccw, kAll},
    {Function::spiral_cw, kSmooth},
    {Function::spiral_ccw, kSmooth},
    {Function::nurbs, kMode2},            // 6.15
    {Function::plane_xy, kAll},
    {Function::plane_zx, kAll},
    {Function::plane_yz, kAll},
    {Function::comp_off, kAll},
    {Function::comp_left, kAll},
    {Function::comp_right, kAll},
    {Function::length_plus, kBoth},
    {Function::length_minus, kBoth},
    {Function::length_off, kBoth},
    {Function::mirror_off, kAll},
    {Function::mirror_on, kAll},
    {Function::absolute, kAll},
    {Function::incremental, kAll},
    {Function::coordinate_set, kBoth},
    {Function::machine_move, kBoth},
    {Function::work_system, kBoth},
    {Function::data_input, kBoth},        // L50, L10
    {Function::data_input_end, kBoth},    // ends data_input; so does G11.1 (13.11)
    {Function::parameter_input_end, kBoth},
    {Function::high_speed, kAll},         // cancelling and the spline have rules of their own
    {Function::high_speed_accuracy, kAll},
    {Function::macro_call, kMode1},       // precaution (12): user macros cannot be used in II
    {Function::macro_modal, kMode1},
    {Function::macro_every_block, kMode1},
    {Function::macro_modal_off, kMode1},
};

uint8_t bit_of(FineMode mode) { return mode == FineMode::accuracy1 ? kMode1 : mode == FineMode::accuracy2 ? kMode2 : kSmooth; }

/// The G10 is L10, or the input of parameters, which is L70 in 13.11 and L50 in 13.17.
bool data_input_allowed(const BlockInHand& in) {
  const Command& w = in.words;
  uint32_t kind = 0;
  if (!w.has(Role::input_kind) || !whole_number(w.get(Role::input_kind), &kind)) return false;
  for (const DataInputRow& row : in.dialect->data_input)
    if (row.l == kind) return row.input == DataInput::tool_length || row.input == DataInput::parameters;
  return false;
}

/// Words that have a meaning in the block.
WordSet known_words(const BlockInHand& in) {
  const Command& w = in.words;
  // Axis words, F, M S T, B and the words in its place, I J K R of arcs, D of radius compensation. O, and N behind other words, have alarms of their own.
  WordSet known = in.axis_words.all() | in.set_of({Role::second_function, Role::second_function_2, Role::second_function_3, Role::offset_number, Role::feed, Role::vector_x,
                                                      Role::vector_y, Role::vector_z, Role::sequence_number, Role::program_number, Role::arc_radius,
                                                      Role::spindle_speed, Role::tool});
  if (allowed_in_fine_mode(in.state.fine_mode, Function::length_plus)) known |= in.set_of({Role::length_number});  // H of length compensation may stand in any block (12.1 (2))
  const Function motion = w.motion != nullptr ? w.motion->function : in.state.modal.of(Mode::motion);
  if (is_arc(motion) || is_spiral(motion) || motion == Function::nurbs) known |= in.set_of({Role::arc_turns, Role::curve_order, Role::spiral_step, Role::spiral_pitches});
  for (const FunctionRow* row : w.functions) {
    if (row->function == Function::high_speed || row->function == Function::high_speed_accuracy || row->function == Function::data_input)
      known = ~uint32_t{0};
  }
  for (const Auxiliary& m : w.auxiliary)
    if (!goes_out(m.function)) known |= in.set_of({Role::call_program, Role::call_sequence, Role::call_repeats, Role::call_option});
  return known;
}

/// 13.18 (1) (c): any block other than one of G01 ends the spline.
bool goes_on_with_spline(const BlockInHand& in) {
  const Command& w = in.words;
  const Function motion = w.motion != nullptr ? w.motion->function : in.state.modal.of(Mode::motion);
  return motion == Function::linear && w.one_shot == nullptr && w.any(in.axis_words.all());
}

}  // namespace

bool allowed_in_fine_mode(FineMode mode, Function function) {
  for (const Allowed& row : kAllowed)
    if (row.function == function) return (row.modes & bit_of(mode)) != 0;
  return false;
}

Execution check_fine_block(BlockInHand& in) {
  State& state = in.state;
  const Command& w = in.words;
  const FineMode mode = state.fine_mode;
  if (mode != FineMode::accuracy1 && !in.block->code.empty()) {  // precaution (12): variables cannot be used in II
    const WordSlot word = first_expression(*in.block);
    if (word != kNoWord) return in.raise(Condition::format_error, word);
  }
  if (mode == FineMode::smooth && w.has(Role::feed) && is_feed_digit(in, w.get(Role::feed))) return in.raise(Condition::format_error, Role::feed, w.get(Role::feed));  // 13.17.2 (3)
  if (state.spline.on && !goes_on_with_spline(in)) state.spline_way = {};
  if (w.has_angle) return in.raise(Condition::format_error, Role::option_angle, w.angle.value);  // 13.8
  if (w.functions.empty() && w.auxiliary.empty() && !w.any(~(in.axis_words.all() | in.set_of({Role::feed})))) return Execution::done;
  for (const FunctionRow* row : w.functions) {
    const bool allowed = allowed_in_fine_mode(mode, row->function) && (row->function != Function::data_input || data_input_allowed(in));
    if (!allowed) return in.raise_code(Condition::illegal_g, *row);
  }
  if (w.one_shot != nullptr && is_macro_call(w.one_shot->function)) return Execution::done;  // its words are arguments
  for (const Auxiliary& m : w.auxiliary)  // note 1
    if (mode != FineMode::accuracy1 && m.switches_interrupt()) return in.raise(Condition::format_error, Role::misc_code, m.number);
  const uint32_t unknown = w.present & ~known_words(in);
  if (unknown == 0) return Execution::done;
  return in.raise_first(Condition::format_error, unknown);
}

}  // namespace nc
