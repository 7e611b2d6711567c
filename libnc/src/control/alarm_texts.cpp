// SPDX-License-Identifier: Apache-2.0
#include "control/alarm_texts.hpp"

#include <cstring>

#include "control/control.hpp"
#include "dialect/dialect.hpp"
#include "dialect/text.hpp"

namespace nc {
namespace {

/// The name of a status, as in nc/types.h; "" = the number is no nc_status.
const char* name_of(nc_status status) {
  switch (status) {
    case NC_OK: return "NC_OK";
    case NC_WAITING: return "NC_WAITING";
    case NC_BUDGET: return "NC_BUDGET";
    case NC_ENDED: return "NC_ENDED";
    case NC_ALARMED: return "NC_ALARMED";
    case NC_E_ARGUMENT: return "NC_E_ARGUMENT";
    case NC_E_MEMORY: return "NC_E_MEMORY";
    case NC_E_STATE: return "NC_E_STATE";
    case NC_E_NOT_FOUND: return "NC_E_NOT_FOUND";
    case NC_E_READ: return "NC_E_READ";
  }
  return "";
}

}  // namespace

bool own_text(const nc_config& config, const char* code, char* text, size_t size) {
  if (config.alarm_text == nullptr || code[0] == '\0') return false;
  char own[NC_MAX_TEXT] = {};
  const size_t room = size < sizeof own ? size : sizeof own;
  if (!config.alarm_text(config.alarm_text_user, code, own, room)) return false;
  end_text(own, room);
  std::memcpy(text, own, room);
  return true;
}

}  // namespace nc

nc_status nc_alarm_text_get(const nc_control* c, const char* code, char* text, size_t size) {
  if (c == nullptr || code == nullptr || text == nullptr || size == 0) return NC_E_ARGUMENT;
  if (nc::own_text(c->config, code, text, size)) return NC_OK;
  for (const nc::AlarmText& alarm : c->dialect->alarms) {
    if (std::strcmp(alarm.code, code) != 0) continue;
    nc::TextWriter(text, size).put(alarm.message);
    return NC_OK;
  }
  return NC_E_NOT_FOUND;
}

nc_status nc_status_text_get(const nc_control* c, nc_status status, char* text, size_t size) {
  if (c == nullptr || text == nullptr || size == 0) return NC_E_ARGUMENT;
  if (!nc::own_text(c->config, nc::name_of(status), text, size)) nc::TextWriter(text, size).put(nc_status_text(status));
  return NC_OK;
}
