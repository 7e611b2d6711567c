// SPDX-License-Identifier: Apache-2.0
// Auxiliary functions of a block by what they mean. Their numbers are those that the machine gets and that are shown; nothing is decided by them.
#pragma once

#include "dialect/dialect.hpp"

namespace nc {

/// M codes to which parameters give a meaning; kNoMisc = none.
struct MiscCodes {
  uint32_t interrupt_on = kNoMisc, interrupt_off = kNoMisc;   ///< act as M96, M97 (M700 13.12; where #1109 says so: #1110, #1111)
  uint32_t synchronous_tap = kNoMisc;                         ///< #1513 stapM, with #1272 bit 1
  uint32_t reading_stops[8] = {};    ///< PREREAD_STOP_M1 to _M8: behind them nothing is read ahead (M700 4.2), 0 = none
  bool any_reading_stop = false;

  bool stops_reading(uint32_t code) const {
    if (!any_reading_stop) return false;
    for (const uint32_t stop : reading_stops)
      if (stop != 0 && stop == code) return true;
    return false;
  }
};

/// One auxiliary function of a block.
struct Auxiliary {
  MiscFunction function = MiscFunction::output;   ///< interrupt_on and interrupt_off only where the control itself takes them
  uint8_t which = 0;                 ///< of several functions of this kind (MiscRow::number)
  bool taps_synchronously = false;   ///< the tap of the block, and those behind it, go with the spindle
  bool stops_reading = false;        ///< nothing behind its block is read before the machine has come there
  uint32_t number = 0;               ///< as it is put out and shown

  bool switches_interrupt() const { return function == MiscFunction::interrupt_on || function == MiscFunction::interrupt_off; }
  /// It is put out to the machine.
  bool is_output() const { return goes_out(function) && !switches_interrupt(); }
};

/// What the M code with this number means, where parameters give meanings to `codes`. `row`: the family's row of it, nullptr = it has none.
inline Auxiliary auxiliary_of(const Dialect& dialect, const MiscCodes& codes, const MiscRow* row, uint32_t number) {
  Auxiliary auxiliary;
  auxiliary.number = number;
  auxiliary.function = row != nullptr ? row->function : misc_function(dialect, number);
  if (row != nullptr) auxiliary.which = row->number;
  if (auxiliary.switches_interrupt()) auxiliary.function = MiscFunction::output;
  if (number == codes.interrupt_on) auxiliary.function = MiscFunction::interrupt_on;
  if (number == codes.interrupt_off) auxiliary.function = MiscFunction::interrupt_off;
  auxiliary.taps_synchronously = number == codes.synchronous_tap;
  auxiliary.stops_reading = codes.stops_reading(number);
  return auxiliary;
}

}  // namespace nc
