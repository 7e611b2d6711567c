// SPDX-License-Identifier: Apache-2.0
// A front end of a family with a core that is only a few variables and answers.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "alarm/condition.hpp"
#include "command/reader.hpp"
#include "command/words_of_block.hpp"

namespace nc::test {

class FrontEndTest : public testing::Test {
 protected:
  explicit FrontEndTest(const Dialect& family = nc::dialect(NC_DIALECT_M700)) { use(family); }

  void use(const Dialect& family) {
    family_ = &family;
    codes.create(family);
    const nc_axis_config axes[] = {axis('X'), axis('Y'), axis('Z'), axis('C')};
    axis_words.name(axes, 4);
    vendor.create(nullptr, 0, family, nullptr, arena_);
    front.dialect = &family;
    front.codes = &codes;
    front.axis_words = &axis_words;
    front.vendor = &vendor;
    front.calls = &calls;
    front.misc_codes = &misc_codes;
    front.code_words = family.addresses.set({Role::code, Role::misc_code, Role::sequence_number, Role::program_number});
    front.core = this;
    front.questions = &kAnswers;
    front.fault = &fault;
    front.sync = &sync;
    command.addresses = &family.addresses;
  }

  /// A text as a block of the family.
  const Block& compile(const std::string& text) {
    blocks_.push_back(std::make_unique<Block>());
    family_->lex->read(text.data(), text.size(), *family_->lex, family_->lex->semicolon, nullptr, *blocks_.back());
    EXPECT_FALSE(blocks_.back()->has_fault) << text;
    return *blocks_.back();
  }
  Reading read(const std::string& text) { return read_command(compile(text), front, command); }
  WordSlot word(Role role) const { return family_->addresses.word(role); }
  WordSet set(std::initializer_list<Role> roles) const { return family_->addresses.set(roles); }

  CodeIndex codes;
  AxisWords axis_words;
  VendorCodes vendor;
  CodeCalls calls;
  MiscCodes misc_codes;
  FrontEnd front;
  Command command;
  Fault fault;
  uint32_t sync = 0;
  std::map<uint32_t, double> variables;   ///< others are vacant
  uint32_t waits_for = 0;                 ///< the variable that needs a sync
  std::vector<Function> asked;            ///< codes that the core was asked about
  Function refused = Function::count_;    ///< the one that it does not allow
  bool modal_call = false;

 private:
  static nc_axis_config axis(char name) {
    nc_axis_config config{};
    config.name = name;
    return config;
  }
  static FrontEndTest& self(void* core) { return *static_cast<FrontEndTest*>(core); }
  static Eval read_variable(void* core, uint32_t number, Value* value, Fault*, uint32_t* sync) {
    if (number == self(core).waits_for) {
      *sync = 4;
      return Eval::need_sync;
    }
    const auto found = self(core).variables.find(number);
    *value = found == self(core).variables.end() ? Value{} : Value::of(found->second);
    return Eval::ok;
  }
  static Evaluation evaluation(void* core) {
    VariableReader reader;
    reader.self = core;
    reader.read = read_variable;
    return Evaluation{reader, {}};
  }
  static Reading check_code(void* core, const FunctionRow& row, double) {
    self(core).asked.push_back(row.function);
    return row.function == self(core).refused ? Reading::fault : Reading::done;
  }
  static bool has_modal_call(const void* core) { return static_cast<const FrontEndTest*>(core)->modal_call; }
  static double length(const void*, Written number) { return number.value; }
  static constexpr CoreQuestions kAnswers = {evaluation, check_code, has_modal_call, length};

  const Dialect* family_ = nullptr;
  std::vector<std::unique_ptr<Block>> blocks_;
  char memory_[1024];
  Arena arena_{memory_, sizeof memory_};
};

}  // namespace nc::test
