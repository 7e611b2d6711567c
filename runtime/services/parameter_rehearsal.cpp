// SPDX-License-Identifier: Apache-2.0
// See parameter_rehearsal.hpp.
#include "runtime/services/parameter_rehearsal.hpp"

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "nc/nc.h"
#include "runtime/services/refusals.hpp"
#include "runtime/services/tables.hpp"

namespace nc::rt::services {
namespace {

constexpr std::size_t kAlignment = 64;
constexpr std::uint32_t kLookAhead = 1024;  // records of the ring, which nothing is planned in here

struct Free {
  void operator()(void* memory) const { std::free(memory); }
};

}  // namespace

Outcome rehearse_parameters(Runtime* runtime, const std::vector<TableValue>& wanted) {
  std::vector<TableValue> present;
  Outcome outcome;
  if (!read_parameters(runtime, &present, &outcome)) return outcome;
  nc_config config = runtime->config().nc;
  config.look_ahead = std::min(config.look_ahead, kLookAhead);
  const std::size_t size = (nc_memory_required(&config) + kAlignment - 1) / kAlignment * kAlignment;
  const std::unique_ptr<void, Free> memory(std::aligned_alloc(kAlignment, size));
  nc_status status = NC_E_MEMORY;
  nc_control* const control = memory == nullptr ? nullptr : nc_create(&config, memory.get(), size, &status);
  if (control == nullptr) return Outcome::refused(Refused::kFailed, std::string("there is no control to try them on: ") + nc_status_text(status));
  // Those of the machine, which has taken them.
  for (const TableValue& value : present) (void)write_value(control, config, value.place, value.value);
  Refusals refusals;
  for (const TableValue& value : wanted)
    if (const Outcome written = write_value(control, config, value.place, value.value); !written.ok) refusals.add(value, written);
  return refusals.empty() ? Outcome::done() : refusals.outcome();
}

}  // namespace nc::rt::services
