// SPDX-License-Identifier: Apache-2.0
// Names of dialects in options and messages; see dialect_names.hpp.
#include "tools/lib/dialect_names.hpp"

namespace nc::tools {

std::vector<std::string> dialect_names() {
  std::vector<std::string> names;
  for (int id = 0; nc_dialect_name(static_cast<nc_dialect>(id)) != nullptr; ++id) names.emplace_back(nc_dialect_name(static_cast<nc_dialect>(id)));
  return names;
}

std::string dialect_list(const char* conjunction) {
  const std::vector<std::string> names = dialect_names();
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) list += (i == 0 ? "" : i + 1 == names.size() ? std::string(" ") + conjunction + " " : ", ") + names[i];
  return list;
}

std::string default_dialect() {
  nc_config config;
  nc_config_init(&config);
  return nc_dialect_name(static_cast<nc_dialect>(config.dialect));
}

std::optional<nc_dialect> dialect_from_name(const std::string& name) {
  nc_dialect dialect{};
  if (nc_dialect_get(name.c_str(), &dialect) != NC_OK) return std::nullopt;
  return dialect;
}

std::string no_dialect(const std::string& name) { return "--dialect " + name + ": this version knows " + dialect_list("and"); }

}  // namespace nc::tools
