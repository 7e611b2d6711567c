// SPDX-License-Identifier: Apache-2.0
// Parameters set by a program: G10 L70 (L50), data blocks, and G11 or G11.1 (M700 13.11 has both). A change is journalled as that of an offset is, because
// blocks that were read ahead may be taken back.
#include <cmath>
#include <initializer_list>

#include "dialect/text.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/work_rotation.hpp"

namespace nc {
namespace {

Execution refuse(BlockInHand& in, Role word) {
  return in.words.has(word) ? in.raise(Condition::parameter_input, word, in.words.get(word)) : in.raise(Condition::parameter_input, word);
}

/// The number of a word that has to be whole: a part of one is an illegal number (appendix 1, P421).
bool number_of(const BlockInHand& in, Role word, uint32_t* number) { return whole_number(in.words.get(word), number) && std::fabs(in.words.get(word) - *number) < 1e-6; }

/// D rounded to the setting unit (note 5).
double data_of(double value, double unit) {
  const double steps = std::nearbyint(std::fabs(value) / unit), rounded = steps / std::nearbyint(1 / unit);
  return value < 0 && steps != 0 ? -rounded : rounded;
}

/// The parameter belongs to the rotation of the workpiece coordinate systems (13.21).
bool turns_work(const InForce& in, uint32_t number) {
  const ParameterRow* row = find_parameter(*in.dialect, ParameterKey{number, 0, -1});
  if (row == nullptr) return false;
  return row->what == Parameter::work_turn_axis || row->what == Parameter::work_turn_center || row->what == Parameter::work_turn_vector ||
         row->what == Parameter::work_turn_angle;
}

bool ends_input(const BlockInHand& in) {
  return in.words.functions.size() == 1 && ends_data_input(in.words.functions[0]->function) && word_count(*in.block) == 1;
}

/// Note 1: number, part system, axis and data stand in the order of the format; when a word comes twice the last one counts.
bool in_sequence(const BlockInHand& in) {
  unsigned before = 0;
  for (const Role word : {Role::parameter_number, Role::parameter_system, Role::parameter_axis, Role::parameter_bit, Role::parameter_data}) {
    const unsigned at = place_of(*in.block, in.word(word));
    if (at == 0) continue;
    if (at < before) return false;
    before = at;
  }
  return true;
}

/// The data of a block for a parameter, or for one bit of it.
struct ParameterData {
  int bit = -1;
  double number = 0;
  bool is_text = false;
  char text[64] = {};
};

Execution read_data(BlockInHand& in, ParameterData* data) {
  const Command& w = in.words;
  const unsigned kinds = (w.has(Role::parameter_bit) ? 1u : 0u) + (w.has(Role::parameter_data) ? 1u : 0u) + (in.block->name_length > 0 ? 1u : 0u);
  if (kinds != 1) return refuse(in, kinds == 0 ? Role::parameter_data : Role::parameter_number);
  if (w.has(Role::parameter_bit)) {  // note 4: bit number and its value
    uint32_t bit = 0;
    if (!number_of(in, Role::parameter_bit, &bit) || bit / 10 > 7 || bit % 10 > 1) return refuse(in, Role::parameter_bit);
    data->bit = static_cast<int>(bit / 10);
    data->number = bit % 10;
  } else if (w.has(Role::parameter_data)) {
    if (!(std::fabs(w.get(Role::parameter_data)) < 1e9)) return refuse(in, Role::parameter_data);
    data->number = data_of(w.get(Role::parameter_data), in.settings.initial_inch ? in.settings.setting_unit_inch : in.settings.setting_unit_mm);
  } else {
    if (in.block->name_length >= sizeof data->text) return in.raise(Condition::parameter_input, Sign::file_name);
    data->is_text = true;
    TextWriter text(data->text, sizeof data->text);
    for (unsigned i = 0; i < in.block->name_length; ++i) text.put(in.block->text[in.block->name + i]);
  }
  return Execution::done;
}

}  // namespace

Execution begin_parameter_input(BlockInHand& in) {
  // The block has no other words ("in independent blocks"). Appendix 1, P421: it is not allowed in a fixed cycle or under radius compensation.
  const bool alone = word_count(*in.block) == 2;
  if (!alone || in.state.cycle.kind != CycleKind::none || in.state.compensated()) return refuse(in, Role::input_kind);
  in.state.parameter_input = true;
  return Execution::done;
}

Execution parameter_block(BlockInHand& in) {
  const Command& w = in.words;
  if (!w.functions.empty() || !w.auxiliary.empty()) {
    if (!ends_input(in)) return refuse(in, w.functions.empty() ? Role::misc_code : Role::code);
    in.state.parameter_input = false;
    return Execution::done;
  }
  uint32_t number = 0, system = 0, axis = 1;
  if ((w.present & ~in.set_of({Role::parameter_number, Role::parameter_system, Role::parameter_axis, Role::parameter_bit, Role::parameter_data})) != 0 || !w.has(Role::parameter_number) || !number_of(in, Role::parameter_number, &number)) return refuse(in, Role::parameter_number);
  if (!parameter_exists(in, number) || !in_sequence(in)) return refuse(in, Role::parameter_number);
  if (w.has(Role::parameter_system) && (!number_of(in, Role::parameter_system, &system) || (system != in.system_index + 1u && !parameter_is_common(*in.dialect, number)))) return refuse(in, Role::parameter_system);
  if (w.has(Role::parameter_axis) && (!number_of(in, Role::parameter_axis, &axis) || axis < 1 || axis > in.axis_count)) return refuse(in, Role::parameter_axis);
  // Which part system has which data may depend on it: what comes before is executed as it was, and what another part system has written is known.
  if (parameter_is_common(*in.dialect, number) && !in.shared_known()) return in.need(NC_SYNC_SHARED);
  ParameterData data;
  const Execution did = read_data(in, &data);
  if (did != Execution::done) return did;
  if (data.is_text && !in.parameters.has_text_place()) {
    // Texts that a rewind could bring back take up all places. Behind the blocks that the machine has executed none has to.
    if (!in.world_fresh) return in.need(NC_SYNC_STOPPED);
    in.variables.journal().lose(in.state.seq);
  }
  // Note 3: A is ignored for a parameter that axes do not have for themselves.
  const int of = parameter_of_axis(*in.dialect, number) ? static_cast<int>(axis) - 1 : -1;
  const ParameterId id = ParameterId::of_number(number);
  if (data.bit < 0 && !data.is_text) data.number *= unit_of_parameter(in, number, of, data.number);
  const bool kept = data.is_text ? in.set_parameter(id, -1, of, static_cast<const char*>(data.text)) : in.set_parameter(id, data.bit, of, data.number);
  if (!kept) return refuse(in, Role::parameter_number);
  if (turns_work(in, number)) take_work_rotation(in, false);  // 13.21 (4): what a program sets acts at once
  return Execution::done;
}

}  // namespace nc
