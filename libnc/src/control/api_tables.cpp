// SPDX-License-Identifier: Apache-2.0
// Parameters, offset tables, variables, programs, switches: the public functions of nc/control.h that need a control.
#include <cmath>
#include <cstring>

#include "base/struct_size.hpp"
#include "control/alarm_texts.hpp"
#include "control/control.hpp"
#include "control/life_count.hpp"
#include "dialect/dialect.hpp"
#include "dialect/function_table.hpp"
#include "dialect/text.hpp"

namespace {

using nc::Frames;

/// The number is small enough to be added to a position.
bool sane(double value) { return std::fabs(value) < 1e9; }

/// Key of a work offset in the frames' table; false = no such offset.
bool work_key(const nc_control* c, unsigned system, unsigned index, unsigned axis, unsigned* key) {
  if (!has_system(c, system) || axis >= c->config.system[system].axis_count) return false;
  if (index == 0) {
    *key = Frames::external_key(axis);
  } else if (index <= 6) {
    *key = Frames::work_key(index - 1, axis);
  } else if (index > 100 && index - 100 <= c->config.work_offsets) {
    *key = Frames::work_key(6 + index - 101, axis);
  } else {
    return false;
  }
  return true;
}

bool tool_number(const nc_control* c, unsigned number, nc_tool_column column) {
  return c != nullptr && number >= 1 && number <= c->config.tool_offsets && static_cast<unsigned>(column) <= NC_TOOL_RADIUS_WEAR;
}

/// What stands behind the folders of a name; nullptr = nothing, or it is too long for the store. Which number it means is known to the store.
const char* file_of(const char* name) {
  if (name == nullptr) return nullptr;
  const char* base = name;
  for (const char* p = name; *p != 0; ++p)
    if (*p == '/' || *p == '\\') base = p + 1;
  const size_t length = std::strlen(base);
  return length != 0 && length < NC_MAX_NAME ? base : nullptr;
}

/// A parameter protects the programs with this number.
bool protects_number(const nc_control* c, uint32_t number) {
  constexpr nc::Parameter kLocks[] = {nc::Parameter::edit_lock_b, nc::Parameter::edit_lock_c};
  for (unsigned i = 0; i < 2; ++i) {
    const nc::NumberRange range = c->dialect->parameters->locked_programs[i];
    if (number >= range.first && number <= range.last && c->system[0].interpreter.tables().parameter(kLocks[i]) != 0) return true;
  }
  return false;
}

bool is_protected(const nc_control* c, unsigned file) { return protects_number(c, c->store.entry(file)->number); }

bool is_referred_to(const nc_control* c, unsigned file, bool only_busy) {
  for (unsigned i = 0; i < c->config.system_count; ++i)
    if ((!only_busy || c->system[i].busy()) && c->system[i].interpreter.refers_to(file)) return true;
  return false;
}

/// The text of the program must not be changed, because the program runs or is protected.
bool kept(const nc_control* c, unsigned file) { return is_referred_to(c, file, true) || is_protected(c, file); }

nc_status add_entry(nc_control* c, const char* name, const nc::TextEntry& entry, unsigned* file, bool own = false) {
  const char* const base = file_of(name);
  if (c == nullptr || base == nullptr) return NC_E_ARGUMENT;
  const int before = c->store.find_exactly(base);
  if (before >= 0 && kept(c, static_cast<unsigned>(before))) return NC_E_STATE;
  unsigned index = 0;
  const nc_status status = c->store.add(entry, base, &index, own);
  if (status == NC_OK && before >= 0)  // a place in a text is not one in another text
    for (unsigned i = 0; i < c->config.system_count; ++i)
      if (c->system[i].interpreter.refers_to(static_cast<unsigned>(before))) {
        c->system[i].interpreter.keep_place(false);
        c->system[i].outdate_restart();
      }
  if (status == NC_OK && file != nullptr) *file = index;
  return status;
}

}  // namespace

// ---- parameters -------------------------------------------------------------------------------------------------------------

nc_status nc_parameter_set(nc_control* c, unsigned system, const char* key, char axis, const char* text) {
  if (!has_system(c, system) || key == nullptr || text == nullptr) return NC_E_ARGUMENT;
  const nc::HostTables in = c->system[system].interpreter.tables();
  const int index = in.axis_named(axis);
  if (axis != 0 && index < 0) return NC_E_ARGUMENT;
  const nc_status status = in.set_parameter(key, index, text);
  if (status == NC_OK) c->system[system].tell_axis_parameters();
  return status;
}

nc_status nc_parameter_get(const nc_control* c, unsigned system, const char* key, char axis, double* value) {
  if (!has_system(c, system) || key == nullptr || value == nullptr) return NC_E_ARGUMENT;
  const nc::HostTables in = c->system[system].interpreter.tables();
  const int index = in.axis_named(axis);
  if (axis != 0 && index < 0) return NC_E_ARGUMENT;
  return in.parameter(key, index, value) ? NC_OK : NC_E_NOT_FOUND;
}

nc_status nc_undotted_get(const nc_control* c, unsigned system, bool* whole) {
  if (!has_system(c, system) || whole == nullptr) return NC_E_ARGUMENT;
  *whole = c->system[system].interpreter.tables().whole_positions();
  return NC_OK;
}

nc_status nc_parameter_key_get(const nc_control* c, nc_parameter_role role, char key[24]) {
  using nc::Parameter;
  constexpr Parameter kRoles[] = {Parameter::decimal_type_2, Parameter::dwell_p_decimal, Parameter::tool_memory_type, Parameter::power_off_clears_common, Parameter::digit_feed};
  const auto index = static_cast<unsigned>(role);
  if (c == nullptr || key == nullptr || index >= sizeof kRoles / sizeof kRoles[0]) return NC_E_ARGUMENT;
  char whole[nc::kParameterKeySize];
  int bit = -1;
  if (!nc::parameter_place(*c->dialect, kRoles[index], whole, &bit)) return NC_E_NOT_FOUND;
  nc::TextWriter text(key, nc::kParameterKeySize);
  text.put(whole);
  if (bit >= 0) text.put("/bit").put_integer(static_cast<unsigned>(bit));
  return NC_OK;
}

nc_status nc_parameter_next(const nc_control* c, unsigned system, unsigned from, unsigned* place, char key[24], char* axis, double* value,
                            char text[64]) {
  if (!has_system(c, system) || place == nullptr || key == nullptr || axis == nullptr || value == nullptr || text == nullptr) return NC_E_ARGUMENT;
  const nc::HostTables in = c->system[system].interpreter.tables();
  unsigned at = from;
  int of_axis = -1;
  if (!in.next_parameter(&at, key, &of_axis, value, text)) return NC_E_NOT_FOUND;
  *place = at;
  *axis = of_axis >= 0 ? c->config.system[system].axis[of_axis].name : '\0';
  return NC_OK;
}

void nc_look_executed(nc_control* c, nc_look look, void* user) {
  if (c == nullptr || look == nullptr) return;
  nc::BlockSeq executed[NC_MAX_SYSTEMS];
  bool ahead[NC_MAX_SYSTEMS];
  const unsigned count = c->config.system_count;
  c->system[0].publish_all();
  for (unsigned i = 0; i < count; ++i) {
    ahead[i] = c->system[i].executed_block(&executed[i]);
    if (ahead[i]) c->system[i].interpreter.look_back(executed[i], true);
  }
  look(user, c);
  for (unsigned i = 0; i < count; ++i)
    if (ahead[i]) c->system[i].interpreter.look_back(executed[i], false);
}

nc_status nc_program_edit(nc_control* c, unsigned file, bool editing) {
  if (c == nullptr || c->store.entry(file) == nullptr) return NC_E_ARGUMENT;
  if (editing && kept(c, file)) return NC_E_STATE;
  c->store.set_edited(file, editing);
  return NC_OK;
}

nc_status nc_program_tape(nc_control* c, unsigned file, uint8_t tape, unsigned unit) {
  if (c == nullptr || c->store.entry(file) == nullptr || tape > NC_TAPE_EIA || unit < 1 || unit > 5) return NC_E_ARGUMENT;
  if (kept(c, file)) return NC_E_STATE;
  return c->store.set_tape(file, tape, static_cast<uint8_t>(unit)) ? NC_OK : NC_E_READ;
}

// ---- offsets ----------------------------------------------------------------------------------------------------------------

nc_status nc_work_offset_set(nc_control* c, unsigned system, unsigned index, unsigned axis, double value) {
  unsigned key = 0;
  if (!sane(value) || !work_key(c, system, index, axis, &key)) return NC_E_ARGUMENT;
  c->system[system].interpreter.tables().set_table(key, value);
  return NC_OK;
}

nc_status nc_work_offset_get(const nc_control* c, unsigned system, unsigned index, unsigned axis, double* value) {
  unsigned key = 0;
  if (value == nullptr || !work_key(c, system, index, axis, &key)) return NC_E_ARGUMENT;
  *value = c->system[system].interpreter.tables().frames().get(key);
  return NC_OK;
}

nc_status nc_tool_offset_set(nc_control* c, unsigned number, nc_tool_column column, double value) {
  if (!sane(value) || !tool_number(c, number, column)) return NC_E_ARGUMENT;
  c->system[0].interpreter.tables().set_tool(number, column, value);
  return NC_OK;
}

nc_status nc_tool_offset_get(const nc_control* c, unsigned number, nc_tool_column column, double* value) {
  if (value == nullptr || !tool_number(c, number, column)) return NC_E_ARGUMENT;
  const Frames& frames = c->system[0].interpreter.tables().frames();
  *value = frames.get(frames.tool_key(number, column));
  return NC_OK;
}

namespace {

bool life_place(const nc_control* c, unsigned number, nc_life_column column) {
  return c != nullptr && number >= 1 && number <= NC_TOOL_LIVES && column <= NC_LIFE_AUXILIARY;
}

/// The value is in the range of its column. What is counted says in which range a life is, so the life of a tool that is registered cannot become minutes while
/// it is longer than those. Where no tool is registered the row may be written in any order.
bool life_value(const nc_control* c, const nc::ToolLife& tool, nc_life_column column, double value) {
  constexpr double kFlags = 255, kStates = 4;
  const nc::RangeRules& range = c->dialect->rules.range;
  const double most = column <= NC_LIFE_TOOL      ? range.largest_life_number
                      : column == NC_LIFE_FLAGS   ? kFlags
                      : column == NC_LIFE_STATUS  ? kStates
                      : column <= NC_LIFE_USED    ? range.most_life(tool.flags.method == nc::LifeMethod::time)
                      : column <= NC_LIFE_RADIUS  ? c->config.tool_offsets
                                                  : 0;
  if (column == NC_LIFE_AUXILIARY) return sane(value);
  if (!(value >= 0 && value <= most) || (column != NC_LIFE_USED && value != std::trunc(value))) return false;
  if (column != NC_LIFE_FLAGS && column != NC_LIFE_GROUP) return true;
  if (column == NC_LIFE_FLAGS ? tool.is_free() : value == 0) return true;
  nc::LifeFlags flags = tool.flags;
  if (column == NC_LIFE_FLAGS) nc::from_life_number(value, flags);
  const double longest = range.most_life(flags.method == nc::LifeMethod::time);
  return static_cast<double>(tool.life) <= longest && tool.used <= longest;
}

}  // namespace

static_assert(NC_TOOL_LIVES == nc::kLifeTools && NC_LIFE_AUXILIARY == static_cast<int>(nc::LifeColumn::auxiliary));

nc_status nc_tool_life_set(nc_control* c, unsigned number, nc_life_column column, double value) {
  if (!life_place(c, number, column)) return NC_E_ARGUMENT;
  const nc::HostTables tables = c->system[0].interpreter.tables();
  if (!life_value(c, tables.lives().tool[number - 1], column, value)) return NC_E_ARGUMENT;
  nc::visit_column(static_cast<nc::LifeColumn>(column), [&](auto member) {
    auto typed = tables.lives().tool[number - 1].*member;
    nc::from_life_number(value, typed);
    tables.set_life(number - 1, member, typed);
  });
  return NC_OK;
}

nc_status nc_tool_life_get(const nc_control* c, unsigned number, nc_life_column column, double* value) {
  if (value == nullptr || !life_place(c, number, column)) return NC_E_ARGUMENT;
  *value = nc::life_number(c->system[0].interpreter.tables().lives().tool[number - 1], static_cast<nc::LifeColumn>(column));
  return NC_OK;
}

nc_status nc_tool_life_cut(nc_control* c, unsigned number, uint32_t tool, double minutes) {
  if (!life_place(c, number, NC_LIFE_USED) || !(minutes >= 0) || !std::isfinite(minutes)) return NC_E_ARGUMENT;
  const nc::HostTables tables = c->system[0].interpreter.tables();
  nc::count_minutes(tables, tables.lives().find({number - 1, tool}), minutes, c->dialect->rules.range.most_life_minutes);
  return NC_OK;
}

// ---- variables --------------------------------------------------------------------------------------------------------------

nc_status nc_variable_set(nc_control* c, unsigned system, uint32_t number, double value, bool vacant) {
  if (!has_system(c, system) || (!vacant && !std::isfinite(value))) return NC_E_ARGUMENT;
  return c->system[system].interpreter.tables().set_variable(number, {value, vacant}) ? NC_OK : NC_E_NOT_FOUND;
}

nc_status nc_variable_get(const nc_control* c, unsigned system, uint32_t number, double* value, bool* vacant) {
  if (!has_system(c, system) || value == nullptr || vacant == nullptr) return NC_E_ARGUMENT;
  nc::Value v;
  if (!c->system[system].interpreter.tables().variable(number, &v)) return NC_E_NOT_FOUND;
  *value = v.number;
  *vacant = v.vacant;
  return NC_OK;
}

nc_dialect nc_control_dialect(const nc_control* c) { return c == nullptr ? nc::kDefaultDialect : static_cast<nc_dialect>(c->config.dialect); }

nc_status nc_variable_kind_get(nc_dialect dialect, nc_variable_kind kind, nc_variable_range* range) {
  if (!nc::known(dialect) || range == nullptr) return NC_E_ARGUMENT;
  const nc::FamilyVariables& family = *nc::dialect(dialect).variables;
  const nc::VariableRange kinds[] = {{1, family.last_local}, family.named, family.cleared};
  const auto index = static_cast<unsigned>(kind);
  if (index >= sizeof kinds / sizeof kinds[0]) return NC_E_ARGUMENT;
  *range = {kinds[index].first, kinds[index].last};
  return NC_OK;
}

nc_status nc_variable_name_get(const nc_control* c, uint32_t number, char name[8]) {
  if (c == nullptr || name == nullptr) return NC_E_ARGUMENT;
  const unsigned length = c->system[0].interpreter.tables().variable_name(number, name);
  name[length] = 0;
  return NC_OK;
}

nc_status nc_variable_name_set(nc_control* c, uint32_t number, const char* name) {
  if (c == nullptr || name == nullptr) return NC_E_ARGUMENT;
  return c->system[0].interpreter.tables().set_variable_name(number, name) ? NC_OK : NC_E_ARGUMENT;
}

void nc_device_on_read(nc_control* c, nc_device_read callback, void* user) {
  if (c == nullptr) return;
  for (unsigned i = 0; i < c->config.system_count; ++i) c->system[i].interpreter.tables().set_devices(callback, user);
}

nc_status nc_variable_next(const nc_control* c, unsigned system, uint32_t from, uint32_t* number, double* value) {
  if (!has_system(c, system) || number == nullptr || value == nullptr) return NC_E_ARGUMENT;
  return c->system[system].interpreter.tables().next_variable(from, number, value) ? NC_OK : NC_E_NOT_FOUND;
}

nc_status nc_program_state_hash(const nc_control* c, unsigned system, uint64_t* hash) {
  if (!has_system(c, system) || hash == nullptr) return NC_E_ARGUMENT;
  *hash = c->system[system].interpreter.state_hash();
  return NC_OK;
}

nc_status nc_interface_output_get(const nc_control* c, unsigned system, unsigned word, uint32_t* bits) {
  if (!has_system(c, system) || word >= NC_WORDS || bits == nullptr) return NC_E_ARGUMENT;
  *bits = c->system[system].interpreter.tables().interface_output(word);
  return NC_OK;
}

nc_status nc_interface_output_set(nc_control* c, unsigned system, unsigned word, uint32_t mask, uint32_t bits) {
  uint32_t now = 0;
  if (const nc_status status = nc_interface_output_get(c, system, word, &now); status != NC_OK) return status;
  c->system[system].interpreter.tables().set_interface_output(word, mask, bits);
  return NC_OK;
}

// ---- programs ---------------------------------------------------------------------------------------------------------------

nc_status nc_program_add(nc_control* c, const char* name, nc_read_at read, void* user, uint64_t size, unsigned* file) {
  if (read == nullptr) return NC_E_ARGUMENT;
  nc::TextEntry entry;
  entry.read = read;
  entry.user = user;
  entry.size = size;
  return add_entry(c, name, entry, file);
}

nc_status nc_program_add_text(nc_control* c, const char* name, const char* text, size_t length, unsigned* file) {
  if (text == nullptr && length > 0) return NC_E_ARGUMENT;
  nc::TextEntry entry;
  entry.memory = text != nullptr ? text : "";
  entry.size = length;
  return add_entry(c, name, entry, file);
}

nc_status nc_program_get(const nc_control* c, unsigned file, nc_program_info* info) {
  if (c == nullptr || info == nullptr || nc::caller_bytes(info) == 0) return NC_E_ARGUMENT;
  const nc::TextEntry* entry = c->store.entry(file);
  if (entry == nullptr) return NC_E_NOT_FOUND;
  nc_program_info known{};
  std::memcpy(known.name, entry->name, sizeof known.name);
  known.number = entry->number;
  known.size = entry->size;
  known.used = entry->used;
  known.in_use = entry->own || is_referred_to(c, file, false);
  known.is_protected = is_protected(c, file);
  nc::give_struct(known, info);
  return NC_OK;
}

nc_status nc_program_name_protected(const nc_control* c, const char* name, bool* is_protected) {
  const char* const base = file_of(name);
  if (c == nullptr || base == nullptr || is_protected == nullptr) return NC_E_ARGUMENT;
  *is_protected = protects_number(c, c->store.number_of(base));
  return NC_OK;
}

nc_status nc_program_remove(nc_control* c, unsigned file) {
  if (c == nullptr) return NC_E_ARGUMENT;
  if (c->store.entry(file) == nullptr) return NC_E_NOT_FOUND;
  return is_protected(c, file) ? NC_E_STATE : nc_program_give_up(c, file);
}

nc_status nc_program_give_up(nc_control* c, unsigned file) {
  if (c == nullptr) return NC_E_ARGUMENT;
  if (c->store.entry(file) == nullptr) return NC_E_NOT_FOUND;
  if (c->store.entry(file)->own || is_referred_to(c, file, false)) return NC_E_STATE;
  c->store.remove(file);
  return NC_OK;
}

void nc_program_on_missing(nc_control* c, nc_program_missing callback, void* user) {
  if (c != nullptr) c->store.on_missing(callback, user, c);
}

nc_status nc_program_select(nc_control* c, unsigned system, unsigned file) {
  if (!has_system(c, system)) return NC_E_ARGUMENT;
  if (c->store.entry(file) == nullptr) return NC_E_NOT_FOUND;
  nc::ProgramRef program;
  program.file = static_cast<uint16_t>(file);
  c->store.touch(file);
  return c->system[system].select(program);
}

nc_status nc_mdi_load(nc_control* c, unsigned system, const char* text, size_t length) {
  if (!has_system(c, system) || text == nullptr || length > sizeof(c->mdi[0]) - 6) return NC_E_ARGUMENT;
  nc::PartSystem& part = c->system[system];
  const bool interrupts = part.occupied();
  if (interrupts && !part.may_take_mdi()) return NC_E_STATE;
  // A line end is put behind the blocks, and the start mark before them where the dialect requires one. A program that is interrupted has had it.
  char* mdi = c->mdi[system];
  size_t at = 0;
  size_t first = 0;
  while (first < length && std::strchr(" \t\r\n", text[first]) != nullptr) ++first;
  if (interrupts && first == length) {
    part.take_mdi({});
    return NC_OK;
  }
  const bool marked = first < length && text[first] == '%';
  if (interrupts && marked) {
    text += first + 1;
    length -= first + 1;
  } else if (!interrupts && c->dialect->percent_required && !marked) {
    mdi[at++] = '%';
    mdi[at++] = '\n';
  }
  std::memcpy(mdi + at, text, length);
  at += length;
  mdi[at++] = '\n';
  unsigned file = 0;
  char name[] = "MDI0";
  name[3] = static_cast<char>('0' + system);
  nc::TextEntry entry;
  entry.memory = mdi;
  entry.size = at;
  const nc_status status = interrupts ? c->store.add(entry, name, &file, true) : add_entry(c, name, entry, &file, true);
  if (status != NC_OK) return status;
  c->store.set_mdi(file);
  nc::ProgramRef program;
  program.file = static_cast<uint16_t>(file);
  if (!interrupts) return part.select(program, true);
  part.take_mdi(program);
  return NC_OK;
}

// ---- state ------------------------------------------------------------------------------------------------------------------

nc_status nc_position_set(nc_control* c, unsigned system, const nc_axes* machine) {
  if (!has_system(c, system) || machine == nullptr) return NC_E_ARGUMENT;
  if (c->system[system].occupied() || c->system[system].has_search()) return NC_E_STATE;  // the next start would begin at the head, and nobody has said so
  nc::AxisVec position;
  for (unsigned i = 0; i < c->config.system[system].axis_count; ++i) {
    if (!sane(machine->v[i])) return NC_E_ARGUMENT;
    position[i] = machine->v[i];
  }
  c->system[system].set_position(position);
  return NC_OK;
}

void nc_position_shown(const nc_control* c, unsigned system, nc_axes* machine, nc_axes* work) {
  if (!has_system(c, system)) return;
  const nc::PartInterpreter& in = c->system[system].interpreter;
  const auto show = [&in](nc_axes* axes, nc::AxisVec (nc::PartInterpreter::*shown)(const nc::AxisVec&) const) {
    if (axes == nullptr) return;
    nc::AxisVec position;
    std::memcpy(position.v, axes->v, sizeof position.v);
    position = (in.*shown)(position);
    std::memcpy(axes->v, position.v, sizeof position.v);
  };
  show(machine, &nc::PartInterpreter::machine_shown);
  show(work, &nc::PartInterpreter::work_shown);
}

void nc_switches_set(nc_control* c, unsigned system, uint32_t optional_skip, uint32_t mirror_axes) {
  if (!has_system(c, system)) return;
  c->system[system].interpreter.set_switches(optional_skip, mirror_axes);
}

nc_status nc_alarm_get(const nc_control* c, unsigned system, nc_alarm* alarm) {
  if (!has_system(c, system) || alarm == nullptr || nc::caller_bytes(alarm) == 0) return NC_E_ARGUMENT;
  nc_alarm known;
  if (!c->system[system].alarm(&known)) return NC_E_NOT_FOUND;
  nc::own_text(c->config, known.code, known.message, sizeof known.message);
  nc::give_struct(known, alarm);
  return NC_OK;
}

unsigned nc_alarm_calls_get(const nc_control* c, unsigned system, nc_source* calls, unsigned capacity) {
  if (!has_system(c, system) || (calls == nullptr && capacity != 0)) return 0;
  return c->system[system].alarm_calls(calls, capacity);
}

nc_status nc_modal_get(const nc_control* c, unsigned system, uint32_t id, nc_modal* modal) {
  if (!has_system(c, system) || modal == nullptr || nc::caller_bytes(modal) == 0) return NC_E_ARGUMENT;
  nc_modal known;
  if (!c->system[system].interpreter.modal(id, &known)) return NC_E_NOT_FOUND;
  nc::give_struct(known, modal);
  return NC_OK;
}

nc_status nc_text_get(const nc_control* c, unsigned system, uint32_t id, nc_text* text) {
  if (!has_system(c, system) || text == nullptr) return NC_E_ARGUMENT;
  return c->system[system].interpreter.text(id, text) ? NC_OK : NC_E_NOT_FOUND;
}

unsigned nc_modal_codes_get(const nc_control* c, const nc_modal* given, char (*codes)[8], unsigned capacity) {
  nc_modal modal{};
  for (int16_t& code : modal.code) code = -1;
  if (c == nullptr || given == nullptr || codes == nullptr || !nc::take_struct(given, &modal)) return 0;
  unsigned count = 0;
  for (unsigned group = 1; group < NC_GROUPS && count < capacity; ++group) {
    if (modal.code[group] < 0) continue;
    nc::g_code_text(*c->dialect, modal.code[group], codes[count++], sizeof(codes[0]));
  }
  return count;
}
