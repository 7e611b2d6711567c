// SPDX-License-Identifier: Apache-2.0
#include "interpret/shared_tables.hpp"

#include "interpret/interpreter.hpp"
#include "interpret/journal_keys.hpp"

namespace nc {
namespace {

JournalValue value_of(const Interpreter& in, uint32_t key) {
  if (key < kFrameKey) return in.variables.value_of(key);
  if (key < kRecordKey) return JournalValue::of(in.frames.get(key - kFrameKey));
  return in.parameters.stored(key - kParameterKey).journalled();
}

/// `value` is what the machine has come to; what `in` has read ahead comes behind it. Parameters are numbered by each part system as they are
/// set, so `key` is its own.
void take(Interpreter& in, uint32_t key, JournalValue value) {
  if (key < kFrameKey) {
    in.variables.take_published(key, value);
  } else if (in.variables.journal().precede(key, value)) {
    if (key < kRecordKey) {
      in.frames.set(key - kFrameKey, value.as<double>());
      take_changed_amounts(in);
    } else {
      in.parameters.restore(key - kParameterKey, ParameterValue::of(value));
      in.refresh_settings();
    }
  }
}

}  // namespace

void SharedTables::join(Interpreter& in) {
  system_[count_++] = &in;
  last_100_ = in.settings.shared_100;
  last_500_ = in.settings.shared_500;
  in.shared = this;
  in.variables.journal().before_loss(&in, [](void* self, BlockSeq seq) {
    Interpreter& writer = *static_cast<Interpreter*>(self);
    writer.shared->publish(writer, seq);
  });
}

bool SharedTables::shares(const Interpreter& in, uint32_t key) {
  if (key < kFrameKey) return in.variables.shares(key);
  if (key < kRecordKey) return in.frames.is_tool_key(key - kFrameKey);
  return key >= kParameterKey && in.parameters.is_common(key - kParameterKey);
}

void SharedTables::publish(Interpreter& writer, BlockSeq executed) {
  writer.variables.journal().publish(
      executed, [&](uint32_t key) { return shares(writer, key); },
      [&](uint32_t key, const JournalValue* value) { publish_to_others(writer, key, value); });
}

void SharedTables::publish_taken_back(Interpreter& writer) {
  writer.variables.journal().each_published_taken_back([&](uint32_t key) {
    if (shares(writer, key)) publish_to_others(writer, key, nullptr);
  });
}

void SharedTables::publish_to_others(const Interpreter& writer, uint32_t key, const JournalValue* value) {
  const JournalValue published = value != nullptr ? *value : value_of(writer, key);
  for (unsigned i = 0; i < count_; ++i) {
    if (system_[i] == &writer) continue;
    if (key < kParameterKey) {
      take(*system_[i], key, published);
      continue;
    }
    unsigned index = 0;  // as many parameters fit into each part system, and common ones are common to the tables
    if (system_[i]->parameters.same_entry(writer.parameters, key - kParameterKey, &index)) take(*system_[i], kParameterKey + index, published);
  }
  if (key >= kParameterKey) divide_again(writer.settings.shared_100, writer.settings.shared_500);
}

void SharedTables::set_variable(uint32_t number, Value value) {
  for (unsigned i = 0; i < count_; ++i) system_[i]->variables.set_from_outside(number, 0, value);
}

void SharedTables::set_name(uint32_t number, const char* name) {
  for (unsigned i = 0; i < count_; ++i) system_[i]->variables.name_from_outside(number, name);
}

void SharedTables::set_tool(unsigned key, double value) {
  for (unsigned i = 0; i < count_; ++i) system_[i]->set_table_from_outside(key, value);
}

void SharedTables::parameter_changed(const Interpreter& in, unsigned index) {
  if (!in.parameters.is_common(index)) return;
  for (unsigned i = 0; i < count_; ++i) {
    Interpreter& other = *system_[i];
    unsigned there = 0;
    if (!other.parameters.same_entry(in.parameters, index, &there)) continue;
    other.parameters.restore(there, in.parameters.stored(index));
    other.variables.changed_from_outside(kParameterKey + there, in.parameters.stored(index).journalled());
    other.refresh_settings();
  }
  divide_again(in.settings.shared_100, in.settings.shared_500);
}

/// The parameters that divide the common variables have changed: what becomes common is for all what the first part system has, and what is
/// common no longer stays with that one and is vacant in the others.
void SharedTables::divide_again(uint32_t last_100, uint32_t last_500) {
  const auto between = [this](uint32_t before, uint32_t now) {
    if (before < now) divide_again(before + 1, now + 1, true);
    if (now < before) divide_again(now + 1, before + 1, false);
  };
  constexpr uint32_t kLast100 = 199, kLast500 = 999;
  const auto up_to = [](uint32_t last, uint32_t begin, uint32_t end) { return last < begin ? begin - 1 : last < end ? last : end; };
  between(up_to(last_100_, 100, kLast100), up_to(last_100, 100, kLast100));
  between(up_to(last_500_, 500, kLast500), up_to(last_500, 500, kLast500));
  last_100_ = last_100;
  last_500_ = last_500;
}

void SharedTables::divide_again(uint32_t first, uint32_t end, bool common) {
  Interpreter& one = *system_[0];
  for (uint32_t number = first; number < end; ++number) {
    if (!one.common->exists(number) || !one.common->divided(number)) continue;
    const JournalValue kept = one.variables.journal().published(number, Variables::journalled(one.common->get(number)));
    for (unsigned i = 1; i < count_; ++i) take(*system_[i], number, common ? kept : Variables::journalled(Value{}));
  }
}

}  // namespace nc
