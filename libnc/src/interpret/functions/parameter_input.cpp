// SPDX-License-Identifier: Apache-2.0
// Parameters by program: G10 L70 (L50), data blocks, G11 or G11.1 (M700 13.11 prints both). A change is journalled like an offset: reading ahead may be
// taken back.
#include <cmath>
#include <initializer_list>

#include "dialect/text.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/work_rotation.hpp"

namespace nc {
namespace {

Did refuse(Interpreter& in, char letter) {
  in.raise(Condition::parameter_input, letter);
  if (letter >= 'A' && letter <= 'Z' && in.words.has(letter)) in.raise(Condition::parameter_input, letter, in.words.get(letter));
  return Did::fault;
}

/// Parameters of the axes; all others take no notice of A (note 3).
bool per_axis(uint32_t number) { return (number >= 2000 && number < 2300) || (number >= 8200 && number < 8300) || number == 1013 || number == 1015; }

/// D rounded to the setting unit (note 5), as text for the parameter store.
void put_data(TextWriter& out, double value, double unit) {
  const double steps = std::nearbyint(std::fabs(value) / unit);
  const auto per_whole = static_cast<unsigned long long>(std::nearbyint(1 / unit));
  const auto whole = static_cast<unsigned long long>(steps);
  unsigned digits = 0;
  for (unsigned long long n = per_whole; n > 1; n /= 10) ++digits;
  if (value < 0 && whole != 0) out.put('-');
  out.put_integer(whole / per_whole);
  if (digits > 0) out.put('.').put_integer(whole % per_whole, digits);
}

bool ends_input(const Interpreter& in) {
  return in.words.g.size() == 1 && in.words.g[0]->function == Function::data_input_end && in.block->words.size() == 1;
}

/// Note 1: the data stand behind the number, the part system and the axis, in the order of the format; of a word that comes twice the
/// last one counts.
bool in_sequence(const Interpreter& in) {
  unsigned place_of[26] = {};
  unsigned place = 0;
  for (const Word& word : in.block->words) place_of[word.letter - 'A'] = ++place;
  unsigned before = 0;
  for (const char letter : {'P', 'S', 'A', 'H', 'D'}) {
    const unsigned at = place_of[letter - 'A'];
    if (at == 0) continue;
    if (at < before) return false;
    before = at;
  }
  return true;
}

/// The text to store and, for a bit, the end of the key.
Did read_data(Interpreter& in, TextWriter& key, TextWriter& text) {
  const BlockWords& w = in.words;
  const unsigned kinds = (w.has('H') ? 1u : 0u) + (w.has('D') ? 1u : 0u) + (in.block->name_length > 0 ? 1u : 0u);
  if (kinds != 1) return refuse(in, kinds == 0 ? 'D' : 'P');
  if (w.has('H')) {  // note 4: bit number and its value
    uint32_t data = 0;
    if (!whole_number(w.get('H'), &data) || data / 10 > 7 || data % 10 > 1) return refuse(in, 'H');
    key.put("/bit").put_integer(data / 10);
    text.put_integer(data % 10);
  } else if (w.has('D')) {
    if (!(std::fabs(w.get('D')) < 1e9)) return refuse(in, 'D');
    put_data(text, w.get('D'), in.settings.setting_unit_mm);
  } else {
    if (in.block->name_length > 63) return refuse(in, '<');
    for (unsigned i = 0; i < in.block->name_length; ++i) text.put(in.block->text[in.block->name + i]);
  }
  return Did::done;
}

}  // namespace

Did begin_parameter_input(Interpreter& in) {
  // "in independent blocks"; appendix 1, P421: not in a fixed cycle and not under radius compensation.
  const bool alone = in.block->words.size() == 2;
  if (!alone || in.state.cycle.kind != CycleKind::none || in.state.comp.side != 0) return refuse(in, 'L');
  in.state.parameter_input = true;
  return Did::done;
}

Did parameter_block(Interpreter& in) {
  Did did = gather_words(in);
  if (did != Did::done) return did;
  const BlockWords& w = in.words;
  if (!w.g.empty() || !w.m.empty()) {
    if (!ends_input(in)) return refuse(in, w.g.empty() ? 'M' : 'G');
    in.state.parameter_input = false;
    return Did::done;
  }
  uint32_t number = 0, system = 0, axis = 1;
  if ((w.present & ~letters("PSAHD")) != 0 || !w.has('P') || !whole_number(w.get('P'), &number)) return refuse(in, 'P');
  if (!in_sequence(in)) return refuse(in, 'P');
  if (w.has('S') && (!whole_number(w.get('S'), &system) || system != in.system_number)) return refuse(in, 'S');
  if (w.has('A') && (!whole_number(w.get('A'), &axis) || axis < 1 || axis > in.axis_count)) return refuse(in, 'A');
  char key_text[24], data_text[64];
  TextWriter key(key_text, sizeof key_text), data(data_text, sizeof data_text);
  key.put_integer(number);
  did = read_data(in, key, data);
  if (did != Did::done) return did;
  if (!in.set_parameter(key_text, per_axis(number) ? static_cast<int>(axis) - 1 : -1, data_text)) return refuse(in, 'P');
  if (number >= 8621 && number <= 8627) take_work_rotation(in, false);  // 13.21 (4): what a program sets holds at once
  return Did::done;
}

}  // namespace nc
