// SPDX-License-Identifier: Apache-2.0
// What may be commanded in high-speed high-accuracy control I and II and in SSS control: the tables of M700 13.17.1 "relation with
// other functions" (2) and 13.17.2 (2).
#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

enum : uint8_t { kMode1 = 1, kMode2 = 2, kSmooth = 4, kBoth = kMode1 | kMode2, kAll = kBoth | kSmooth };

struct Allowed {
  int16_t first, last;  ///< codes times 10
  uint8_t modes;
};

// The columns of the first table are lost; where no other sentence tells, a row counts for both modes (docs/decisions.md).
constexpr Allowed kAllowed[] = {
    {0, 0, kAll},           // positioning
    {10, 10, kAll},         // cutting feed
    {20, 20, kAll},         // arcs and helices
    {30, 30, kAll},
    {21, 21, kSmooth},      // spiral interpolation
    {31, 31, kSmooth},
    {62, 62, kMode2},       // NURBS: 6.15
    {170, 190, kAll},       // planes
    {400, 400, kAll},       // tool radius compensation
    {410, 410, kAll},
    {420, 420, kAll},
    {430, 430, kBoth},      // tool length compensation
    {440, 440, kBoth},
    {490, 490, kBoth},
    {501, 501, kAll},       // mirror image
    {511, 511, kAll},
    {900, 910, kAll},       // absolute, incremental
    {920, 920, kBoth},      // workpiece coordinates
    {530, 530, kBoth},      // machine coordinates
    {540, 540, kBoth},
    {550, 590, kBoth},
    {100, 111, kBoth},      // G10 L50, L10; G11 (G11.1, 13.11) ends the first
    {50, 51, kAll},         // cancel, spline: rules of their own
    {650, 670, kMode1},     // precaution (12): user macros cannot be used in II
};

uint8_t bit_of(FineMode mode) { return mode == FineMode::accuracy1 ? kMode1 : mode == FineMode::accuracy2 ? kMode2 : kSmooth; }

bool data_input_allowed(const BlockWords& w) {
  uint32_t l = 0;
  if (!w.has('L') || !whole_number(w.get('L'), &l)) return false;
  return l == 10 || l == 50 || l == 70;  // 13.11 prints L70 for what 13.17 calls L50
}

/// G02, G03.
bool is_arc(int16_t code) { return code == 20 || code == 30; }

/// Addresses that have a meaning in the block.
uint32_t addresses(const Interpreter& in) {
  const BlockWords& w = in.words;
  // Axis movement, F, M S T B with what stands for B, I J K R of arcs, D of radius compensation; O and a late N have errors of their own.
  uint32_t known = in.axis_letters | letters("ABCDFIJKNORST");
  if (allowed_in_fine_mode(in.state.fine_mode, 430)) known |= letters("H");  // of length compensation, in any block (12.1 (2))
  const int16_t motion = in.state.modal.code[kGroupMotion];
  const int16_t own = w.motion != nullptr ? w.motion->code : motion;
  if (is_arc(own) || own == 21 || own == 31 || own == 62) known |= letters("PQL");
  for (const FunctionRow* row : w.g) {
    if (row->function == Function::high_speed || row->function == Function::high_speed_accuracy || row->function == Function::data_input)
      known = ~uint32_t{0};
  }
  for (const uint32_t m : w.m) {
    const MiscRow* row = find_misc(*in.dialect, m);
    if (row != nullptr && row->function != MiscFunction::output) known |= letters("PHLQ");
  }
  return known;
}

/// 13.18 (1) (c): anything but a block of G01 breaks the spline.
bool goes_on_with_spline(const Interpreter& in) {
  const BlockWords& w = in.words;
  const int16_t motion = w.motion != nullptr ? w.motion->code : in.state.modal.code[kGroupMotion];
  return motion == 10 && w.one_shot == nullptr && w.any(in.axis_letters);
}

}  // namespace

bool allowed_in_fine_mode(FineMode mode, int16_t code) {
  for (const Allowed& row : kAllowed)
    if (code >= row.first && code <= row.last) return (row.modes & bit_of(mode)) != 0;
  return false;
}

Did check_fine_block(Interpreter& in) {
  State& state = in.state;
  const BlockWords& w = in.words;
  const FineMode mode = state.fine_mode;
  if (mode != FineMode::accuracy1 && !in.block->code.empty())  // precaution (12): no variables in II
    for (const Word& word : in.block->words)
      if ((word.flags & kWordExpression) != 0) return in.raise(Condition::format_error, word.letter);
  if (mode == FineMode::smooth && w.has('F') && is_feed_digit(in, w.get('F'))) return in.raise(Condition::format_error, 'F', w.get('F'));  // 13.17.2 (3)
  if (state.spline.on && !goes_on_with_spline(in)) state.spline.joined = state.spline.moved = false;
  if (w.g.empty() && w.m.empty() && !w.any(~(in.axis_letters | letters("F")))) return Did::done;
  for (const FunctionRow* row : w.g) {
    const bool allowed = allowed_in_fine_mode(mode, row->code) && (row->function != Function::data_input || data_input_allowed(w));
    if (!allowed) return in.raise(Condition::illegal_g, 'G', row->code / 10.0);
  }
  if (w.one_shot != nullptr && is_macro_call(w.one_shot->function)) return Did::done;  // arguments
  for (const uint32_t m : w.m)  // note 1
    if (mode != FineMode::accuracy1 && (is_interrupt_on(in, m) || is_interrupt_off(in, m))) return in.raise(Condition::format_error, 'M', m);
  const uint32_t unknown = w.present & ~addresses(in);
  for (char letter = 'A'; unknown != 0 && letter <= 'Z'; ++letter)
    if (((unknown >> (letter - 'A')) & 1) != 0) return in.raise(Condition::format_error, letter, w.get(letter));
  return Did::done;
}

}  // namespace nc
