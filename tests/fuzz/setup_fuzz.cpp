// SPDX-License-Identifier: Apache-2.0
// Any bytes as a setup file: the result is a setup, or one line that says what is wrong, never a crash. A setup is then
// given to a control, which refuses what it does not have.
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>

#include "nc/nc.h"
#include "tools/lib/item_source.hpp"
#include "tools/lib/machine_limits.hpp"
#include "tools/lib/setup.hpp"

namespace {

struct Release {
  void operator()(void* memory) const { std::free(memory); }
};

void require(bool holds) {
  if (!holds) std::abort();
}

// The message is one line that begins with the name of the file, as the command line prints it.
void require_message(const std::string& error) {
  require(error.rfind("s.json", 0) == 0);
  require(error.find('\n') == std::string::npos);
}

void apply(const nc::tools::Setup& setup, nc_dialect dialect) {
  nc_config config;
  nc_config_init(&config);
  config.dialect = static_cast<uint8_t>(dialect);
  config.window_bytes = 4096;
  nc::tools::apply_setup(setup, &config);
  const size_t size = nc_memory_required(&config);
  if (size == 0) return;
  const std::unique_ptr<void, Release> memory(std::aligned_alloc(64, (size + 63) / 64 * 64));
  require(memory != nullptr);
  nc_status status = NC_OK;
  nc_control* control = nc_create(&config, memory.get(), size, &status);
  require(control != nullptr);
  std::string error;
  if (!nc::tools::apply_setup(setup, control, &error)) require_message(error);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  nc::tools::Setup setup;
  std::string error;
  if (nc::tools::parse_setup(text, "s.json", &setup, &error)) {
    apply(setup, NC_DIALECT_M700);
    apply(setup, NC_DIALECT_DGSHAPE);
  } else {
    require_message(error);
  }
  nc_config config;
  nc_config_init(&config);
  if (!nc::tools::parse_machine_limits(text, "s.json", &config, &error)) require_message(error);
  return 0;
}
