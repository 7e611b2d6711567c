// SPDX-License-Identifier: Apache-2.0
// Fuzz target: any bytes as a machine configuration. The result is a configuration from which a control can be made, or
// errors that name the file and a line, except errors about the whole file.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "runtime/config.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  nc::rt::Config config;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto errors = nc::rt::parse_config(text, "fuzz.toml", &config);
  for (const nc::rt::ConfigError& error : errors)
    if (error.message.empty() || error.text().rfind("fuzz.toml", 0) != 0) std::abort();
  if (errors.empty() && nc_memory_required(&config.nc) == 0) std::abort();
  return 0;
}
