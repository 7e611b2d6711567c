// SPDX-License-Identifier: Apache-2.0
#include "interpret/shared_tables.hpp"

#include <bit>

#include "interpret/interpreter.hpp"
#include "interpret/journal_keys.hpp"

namespace nc {
namespace {

JournalValue value_of(const Interpreter& in, uint32_t key) {
  const JournalPlace place = place_of(key);
  switch (place.table) {
    case JournalTable::variables: return in.variables.value_of(key);
    case JournalTable::frames: return JournalValue::of(in.frames.get(place.index));
    case JournalTable::records: return in.records.word(place.index);
    case JournalTable::lives: return in.lives.word(place.index);
    case JournalTable::parameters: break;
  }
  return in.parameters.stored(place.index).journalled();
}

/// Puts a value that the machine has executed into the copy of `in`, before what `in` has read ahead. `key` is the key of this part system: each numbers
/// its parameters in the order in which they are set.
void take(Interpreter& in, uint32_t key, JournalValue value) {
  const JournalPlace place = place_of(key);
  switch (place.table) {
    case JournalTable::variables: return in.variables.take_published(key, value);
    case JournalTable::records: return;  // each part system has its own
    case JournalTable::lives: return in.lives.take_published(place.index, value);
    case JournalTable::frames:
      if (!in.variables.journal().precede(key, value)) return;
      in.frames.set(place.index, value.as<double>());
      return take_changed_amounts(in);
    case JournalTable::parameters:
      if (!in.variables.journal().precede(key, value)) return;
      in.parameters.restore(place.index, ParameterValue::of(value));
      return in.refresh_settings();
  }
}

}  // namespace

void SharedTables::create(unsigned systems, unsigned look_ahead, Arena& arena) {
  history_.create(std::bit_ceil(systems) * Interpreter::journal_capacity(look_ahead), arena);
}

unsigned SharedTables::number_of(const Interpreter& in) const {
  unsigned number = 0;
  while (system_[number] != &in) ++number;
  return number;
}

void SharedTables::join(Interpreter& in) {
  system_[count_++] = &in;
  for (unsigned i = 0; i < CommonRanges::kExtended; ++i) last_[i] = in.settings.last_shared[i];
  in.shared = this;
  in.variables.journal().before_loss(&in, [](void* self, BlockSeq seq) {
    Interpreter& writer = *static_cast<Interpreter*>(self);
    writer.shared->publish(writer, seq);
  });
}

bool SharedTables::shares(const Interpreter& in, uint32_t key) {
  const JournalPlace place = place_of(key);
  switch (place.table) {
    case JournalTable::variables: return in.variables.shares(key);
    case JournalTable::frames: return in.frames.is_tool_key(place.index);
    case JournalTable::records: return false;
    case JournalTable::lives: return true;
    case JournalTable::parameters: break;
  }
  return in.parameters.is_common(place.index);
}

void SharedTables::publish(Interpreter& writer, BlockSeq executed) {
  writer.variables.journal().publish(
      executed, [&](uint32_t key) { return shares(writer, key); },
      [&](BlockSeq seq, uint32_t key, JournalValue before, const JournalValue* value) {
        uint32_t first = 0;
        if (same_place(*system_[0], writer, key, &first)) history_.note(number_of(writer), seq, first, before);
        publish_to_others(writer, key, value != nullptr ? *value : value_of(writer, key));
      });
}

void SharedTables::take_back(Interpreter& writer, BlockSeq seq) {
  history_.take_out(number_of(writer), seq, [&](uint32_t key, JournalValue value) {
    Interpreter& first = *system_[0];
    if (!shares(first, key)) return;
    take(first, key, value);
    publish_to_others(first, key, value);
  });
}

/// Finds the key that a shared place of `from` has in `to`. Each part system numbers its parameters in the order in which they are set; each has room for
/// the same number of them.
bool SharedTables::same_place(Interpreter& to, const Interpreter& from, uint32_t key, uint32_t* there) {
  *there = key;
  const JournalPlace place = place_of(key);
  if (place.table != JournalTable::parameters || &to == &from) return true;
  unsigned index = 0;
  if (!to.parameters.same_entry(from.parameters, place.index, &index)) return false;
  *there = kParameterKey + index;
  return true;
}

void SharedTables::publish_to_others(const Interpreter& writer, uint32_t key, JournalValue value) {
  for (unsigned i = 0; i < count_; ++i) {
    uint32_t there = 0;
    if (system_[i] != &writer && same_place(*system_[i], writer, key, &there)) take(*system_[i], there, value);
  }
  if (place_of(key).table == JournalTable::parameters) divide_again(writer.settings.last_shared);
}

/// The host has changed a place of `in`: no rewind brings its old value back.
void SharedTables::changed_by_host(const Interpreter& in, uint32_t key) {
  uint32_t first = 0;
  if (same_place(*system_[0], in, key, &first)) history_.replace(first, value_of(in, key));
}

void SharedTables::set_variable(uint32_t number, Value value) {
  write_to_all(number, [=](Interpreter& in) { in.variables.set_from_outside(number, 0, value); });
}

void SharedTables::set_name(uint32_t number, const char* name) {
  write_to_all(system_[0]->variables.name_key(number), [=](Interpreter& in) { in.variables.name_from_outside(number, name); });
}

void SharedTables::set_tool(unsigned key, double value) {
  write_to_all(kFrameKey + key, [=](Interpreter& in) { in.set_table_from_outside(key, value); });
}

void SharedTables::parameter_changed(const Interpreter& in, unsigned index) {
  if (!in.parameters.is_common(index)) return;
  changed_by_host(in, kParameterKey + index);
  for (unsigned i = 0; i < count_; ++i) {
    Interpreter& other = *system_[i];
    unsigned there = 0;
    if (!other.parameters.same_entry(in.parameters, index, &there)) continue;
    other.parameters.restore(there, in.parameters.stored(index));
    other.variables.changed_from_outside(kParameterKey + there, in.parameters.stored(index).journalled());
    other.refresh_settings();
  }
  divide_again(in.settings.last_shared);
}

/// The parameters that say which common variables are shared have changed. A variable that becomes shared gets the value of the first part system in all of
/// them; one that is not shared any more keeps its value in the first part system and becomes vacant in the others.
void SharedTables::divide_again(const uint32_t (&last)[2]) {
  const auto between = [this](uint32_t before, uint32_t now) {
    if (before < now) divide_again(before + 1, now + 1, true);
    if (now < before) divide_again(now + 1, before + 1, false);
  };
  const CommonRanges& ranges = system_[0]->common->ranges();
  for (unsigned i = 0; i < CommonRanges::kExtended; ++i) {
    if (ranges.size(i) == 0) continue;
    const uint32_t first = ranges.first[i], end = ranges.last[i];
    const auto up_to = [first, end](uint32_t number) { return number < first ? first - 1 : number < end ? number : end; };
    between(up_to(last_[i]), up_to(last[i]));
    last_[i] = last[i];
  }
}

void SharedTables::divide_again(uint32_t first, uint32_t end, bool common) {
  Interpreter& one = *system_[0];
  for (uint32_t number = first; number < end; ++number) {
    if (!one.common->exists(number) || one.common->divided(number) == CommonRanges::kExtended) continue;
    const JournalValue kept = one.variables.journal().published(number, Variables::journalled(one.common->get(number)));
    for (unsigned i = 1; i < count_; ++i) take(*system_[i], number, common ? kept : Variables::journalled(Value{}));
    history_.replace(number, kept);
  }
}

}  // namespace nc
