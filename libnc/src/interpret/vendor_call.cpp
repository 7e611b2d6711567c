// SPDX-License-Identifier: Apache-2.0
// A code of the vendor that calls a function of the host (nc/vendor.h). The block waits for a sync, as one that reads the state of the machine, so that
// everything that the program has commanded before has been executed when the function is called.
#include <cstring>

#include "command/caller.hpp"
#include "dialect/text.hpp"
#include "interpret/calls.hpp"
#include "interpret/interpreter.hpp"

namespace nc {
namespace {

/// Prepares the alarm with which the program stops, unless the function gives another one.
void prepare_alarm(Interpreter& in, const Fault& fault) {
  const AlarmText text = alarm_text(*in.dialect, fault);
  in.vendor_alarm = nc_alarm{};
  TextWriter(in.vendor_alarm.code, sizeof in.vendor_alarm.code).put(text.code);
  TextWriter(in.vendor_alarm.message, sizeof in.vendor_alarm.message).put(text.message);
  alarm_detail(*in.dialect, fault, "", in.vendor_alarm.detail.s, sizeof in.vendor_alarm.detail.s);
  in.vendor_alarm.axis = -1;
  in.vendor_alarm.source = in.source;
}

/// Makes sure that the texts of the alarm are ended and that it has a code, whatever the function has written.
void take_alarm(nc_alarm* alarm, const nc_alarm& prepared) {
  end_text(alarm->code, sizeof alarm->code);
  end_text(alarm->message, sizeof alarm->message);
  end_text(alarm->detail.s, sizeof alarm->detail.s);
  if (alarm->code[0] == '\0') std::memcpy(alarm->code, prepared.code, sizeof alarm->code);
}

}  // namespace

Execution call_vendor(Interpreter& in, const Caller& caller) {
  const nc_vendor_code& code = *caller.call->vendor;
  VendorWords words;
  const Execution did = in.executed(read_vendor_words(*in.block, in.front, caller.at, words));
  if (did != Execution::done || in.vendor_called()) return did;
  in.raise(Condition::vendor_function, caller.word, caller.word == in.word(Role::code) ? code.number / 10.0 : code.number);
  prepare_alarm(in, in.fault);
  const Fault failed = in.fault;
  const nc_alarm prepared = in.vendor_alarm;
  nc_vendor_block block = block_of(code, words);
  block.source = in.source;
  block.online = in.feeding;
  for (unsigned i = 0; i < in.axis_count; ++i) block.machine.v[i] = in.world.machine.v[i];
  in.in_vendor_function = true;
  const nc_status status = code.function(code.user, in.vendor->control(), &block, &in.vendor_alarm);
  in.in_vendor_function = false;
  if (status == NC_OK) {
    in.note_vendor_call();
    return Execution::done;
  }
  take_alarm(&in.vendor_alarm, prepared);
  in.fault = failed;
  return Execution::fault;
}

}  // namespace nc
