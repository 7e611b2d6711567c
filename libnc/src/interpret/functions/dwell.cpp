// SPDX-License-Identifier: Apache-2.0
// G04.
#include <cmath>

#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

/// M700 8.1 note 3: an X before G04 is read as a length; what is inch with one decimal more comes out tenfold.
bool read_as_inch(const Interpreter& in) {
  if (in.state.modal.code[kGroupUnit] != 200 || !in.words.pointed('X')) return false;
  for (const Word& word : in.block->words) {
    if (word.letter == 'X') return true;
    if (word.letter == 'G' && word.value == 4) return false;
  }
  return false;
}

/// M700 8.1, table of X and P against #1078 and #8112.
double m700_seconds(const Interpreter& in, char letter) {
  const BlockWords& w = in.words;
  const double raw = w.get(letter);
  const bool pointed = w.pointed(letter);
  if (letter == 'X' && read_as_inch(in)) return raw * 10;
  if (letter == 'P' && !in.settings.dwell_p_decimal) return std::trunc(raw) / 1000;  // always whole ms
  if (pointed) return raw;
  return in.settings.decimal_type_2 ? raw : raw / 1000;
}

/// DGSHAPE G04: P is always ms; X with a point seconds, else ms, or seconds where the calculator type reads X.
double dgshape_seconds(const Interpreter& in, char letter) {
  const double raw = in.words.get(letter);
  if (letter == 'P') return raw / 1000;
  const bool whole = in.settings.calculator && (in.settings.calculator_words == 1 || in.settings.calculator_words == 3);
  return in.words.pointed('X') || whole ? raw : raw / 1000;
}

}  // namespace

Did do_dwell(Interpreter& in) {
  const BlockWords& w = in.words;
  const char letter = w.has('X') ? 'X' : 'P';
  const bool m700 = in.dialect->id == NC_DIALECT_M700;
  if (!w.has(letter) && !m700) return in.raise(Condition::words_missing, 'G', 4);
  // M700 15.2 prints "G04" alone behind G31, "machine stop check": the axes come to rest, and that is all.
  const double seconds = !w.has(letter) ? 0 : m700 ? m700_seconds(in, letter) : dgshape_seconds(in, letter);
  const double longest = m700 ? 99999.999 : 3600;  // M700 8.1; DGSHAPE G04
  if (!(seconds >= 0) || seconds > longest) return in.raise(Condition::value_range, letter, w.get(letter));
  Gate& gate = in.emit(ItemKind::gate).gate;
  gate.kind = NC_GATE_DWELL_SECONDS;
  gate.announce = w.has(letter);
  gate.value = seconds;
  gate.skip_mask = in.settings.dwell_skip;
  if (in.words.fin_behind_dwell) await_fin(in);
  return Did::done;
}

}  // namespace nc
