// SPDX-License-Identifier: Apache-2.0
// Machine configuration: defaults, reading of the file, its sections in order. See config.hpp.
#include "runtime/config.hpp"

#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "runtime/config_equipment.hpp"
#include "runtime/config_sections.hpp"
#include "runtime/hal_factory.hpp"
#include "runtime/point_uses.hpp"

namespace nc::rt {

std::string ConfigError::text() const {
  std::string result = file;
  if (line != 0) result += ":" + std::to_string(line);
  if (!key.empty()) result += ": " + key;
  return result + ": " + message;
}

MacroMap::MacroMap() {
  for (unsigned w = 0; w < NC_WORDS; ++w) {
    input_bit[w].fill(-1);
    output_bit[w].fill(-1);
  }
  input_word.fill(-1);
  output_word.fill(-1);
}

namespace {

// A path in the configuration is relative to the folder of the configuration's file, unless it is absolute.
std::string beside_file(const std::string& file, const std::string& path) {
  const std::filesystem::path own(path);
  if (own.is_absolute()) return own.string();
  return (std::filesystem::path(file).parent_path() / own).lexically_normal().string();
}

}  // namespace

Config::Config() {
  nc_config_init(&nc);
  nc.system_count = 1;
  for (nc_system_config& system : nc.system) system.axis_count = 0;
}

std::string Config::programs_folder() const { return beside_file(file, programs); }

std::string Config::external_folder() const { return external.empty() ? external : beside_file(file, external); }

std::string Config::print_file() const { return print.empty() ? print : beside_file(file, print); }

std::vector<ConfigError> parse_config(std::string_view text, const std::string& file, Config* config,
                                      Config* partial) {
  ErrorList errors(file);
  Config read;
  read.file = file;
  if (const unsigned line = line_of_too_deep_key(text)) {
    errors.add(line, "", "syntax: a key of too many parts");
    return errors.take();
  }
  toml::table root;
  try {
    root = toml::parse(text, std::string_view(file));
  } catch (const toml::parse_error& error) {
    const auto& place = error.source().begin;
    const std::string said(error.description());
    const bool of_number = said.find("integer") != std::string::npos || said.find("floating-point") != std::string::npos;
    errors.add(static_cast<unsigned>(place.line), of_number ? key_at(text, place.line, place.column) : "", "syntax: " + said);
    return errors.take();
  }
  TableReader reader(root, "", &errors);
  read_machine(&reader, &read);
  read_scheduling(&reader, &read);
  read_axes(&reader, &read);
  read_motion(&reader, &read);
  read_parameters(&reader, &read);
  read_work_offsets(&reader, &read);
  read_tool_offsets(&reader, &read);
  read_point_buses(&reader, point_bus_kinds(), &read);
  read_points(&reader, &read);
  check_point_buses(&reader, read);
  read_macro_interface(&reader, &read);
  read_ladder(&reader, &read);
  read_signals(&reader, &read);
  read_power(&reader, &read);
  read_handwheels(&reader, &read);
  read_joysticks(&reader, &read);
  resolve_equipment(&reader, &read);
  read_machine_sections(&reader, &read);
  read_spindle_feedback(&reader, &read);
  limit_taps(&read);
  check_point_uses(&reader, read);
  read_share(&reader, &read);
  read_services(&reader, &read);
  read.program_text.most_bytes = std::uint64_t{read.services.program_mb} << 20;
  reader.finish();
  nc_config_fault fault;
  if (errors.empty() && nc_config_check(&read.nc, &fault) != NC_OK)
    errors.add(0, "", std::string("the control refuses ") + fault.field + ": " + fault.reason);
  std::vector<ConfigError> found = errors.take();
  if (partial != nullptr) *partial = read;
  if (found.empty()) *config = std::move(read);
  return found;
}

std::vector<ConfigError> check_host(const Config& config) {
  ErrorList errors(config.file);
  const long processors = sysconf(_SC_NPROCESSORS_CONF);
  const SchedulingConfig& scheduling = config.scheduling;
  if (processors > 0 && scheduling.cpu >= processors)
    errors.add(scheduling.cpu_place.line, scheduling.cpu_place.key,
               "this computer has the processors 0 to " + std::to_string(processors - 1) + ", not " +
                   std::to_string(scheduling.cpu));
  std::error_code ignored;
  const std::string folder = config.programs_folder();
  if (!std::filesystem::is_directory(folder.empty() ? "." : folder, ignored))
    errors.add(config.programs_place.line, config.programs_place.key,
               "there is no folder \"" + folder + "\"");
  const auto check_file = [&](const std::string& path, const ConfigPlace& place) {
    const std::filesystem::path whole(path), parent = whole.parent_path();
    if (std::filesystem::is_directory(whole, ignored))
      errors.add(place.line, place.key, "\"" + path + "\" is a folder, not a file");
    else if (!std::filesystem::is_directory(parent.empty() ? "." : parent, ignored))
      errors.add(place.line, place.key, "there is no folder \"" + parent.string() + "\"");
  };
  if (!config.variables.empty()) check_file(config.variables_path(), config.variables_place);
  if (!config.offsets.empty()) check_file(config.offsets_path(), config.offsets_place);
  if (!config.place.empty()) check_file(config.place_path(), config.place_place);
  if (!config.ladder.retain.empty() && !config.ladder.program.empty()) check_file(config.retain_path(), config.ladder.retain_place);
  return errors.take();
}

std::vector<ConfigError> load_config(const std::string& path, Config* config, Config* partial) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_directory(status)) return {{path, 0, "", "cannot be read: is a folder"}};
  // Only regular files are read: opening a pipe would block, and reading a device may never end.
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    return {{path, 0, "", "cannot be read: is no file"}};
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    return {
        {path, 0, "", std::string("cannot be read: ") + (errno != 0 ? std::strerror(errno) : "not a file")}};
  std::ostringstream text;
  text << stream.rdbuf();
  return parse_config(text.str(), path, config, partial);
}

}  // namespace nc::rt
