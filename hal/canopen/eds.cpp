// SPDX-License-Identifier: Apache-2.0
// Electronic data sheets. See eds.hpp.
#include "hal/canopen/eds.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <optional>

#include "hal/canopen/sdo_client.hpp"
#include "hal/canopen/setup_plan.hpp"

namespace nc::hal::canopen {
namespace {

constexpr std::size_t kMostErrors = 20;  // a file that is no data sheet would give an error for each line
constexpr unsigned kMostSubs = 254;

std::string_view trimmed(std::string_view text) {
  const auto space = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && space(text.front())) text.remove_prefix(1);
  while (!text.empty() && space(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

// A control character besides the tab; none stands in a text.
bool is_control(char c) { return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7f; }

// The beginning of what a line has, for a message: in which encoding the file is nobody says, so only ASCII is shown as it is.
std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text.substr(0, 40)) result += is_control(c) || static_cast<unsigned char>(c) >= 0x80 ? std::string("\xEF\xBF\xBD") : std::string(1, c);
  return result + "\"";
}

// A number such as 0x1A or 26.
std::optional<std::uint32_t> number_of(std::string_view text) {
  const bool hex = text.size() > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X');
  if (hex) text.remove_prefix(2);
  if (text.empty()) return {};
  std::uint64_t value = 0;
  for (const char c : text) {
    const auto symbol = static_cast<unsigned char>(c);
    if (hex ? std::isxdigit(symbol) == 0 : std::isdigit(symbol) == 0) return {};
    value = value * (hex ? 16 : 10) + static_cast<unsigned>(std::isdigit(symbol) != 0 ? c - '0' : std::tolower(symbol) - 'a' + 10);
    if (value > 0xFFFFFFFF) return {};
  }
  return static_cast<std::uint32_t>(value);
}

// The bits of a data type (CiA 301, table "data types"); 0 = it has no fixed length, or is unknown.
unsigned bits_of_type(unsigned type) {
  switch (type) {
    case 0x01: return 1;
    case 0x02:
    case 0x05: return 8;
    case 0x03:
    case 0x06: return 16;
    case 0x10:
    case 0x16: return 24;
    case 0x04:
    case 0x07:
    case 0x08: return 32;
    case 0x12:
    case 0x18: return 40;
    case 0x13:
    case 0x19: return 48;
    case 0x14:
    case 0x1A: return 56;
    case 0x11:
    case 0x15:
    case 0x1B: return 64;
    default: return 0;
  }
}

struct Section {
  enum class Kind : std::uint8_t { kOther, kObject, kDeviceInfo };
  Kind kind = Kind::kOther;
  std::uint32_t key = 0;
  bool is_sub = false;
};

// Which section a heading begins. "6040" and "1A00sub1" are objects; "1018Value" and others are not.
Section section_of(std::string_view name) {
  const std::string word = lower(name);
  if (word == "deviceinfo") return {Section::Kind::kDeviceInfo, 0, false};
  std::size_t digits = 0;
  std::uint32_t index = 0, sub = 0;
  while (digits < word.size() && digits < 4 && std::isxdigit(static_cast<unsigned char>(word[digits])) != 0) ++digits;
  if (digits != 4 || !number_of("0x" + word.substr(0, 4))) return {};
  index = *number_of("0x" + word.substr(0, 4));
  if (word.size() == 4) return {Section::Kind::kObject, index << 8, false};
  if (word.compare(4, 3, "sub") != 0) return {};
  const auto read = number_of("0x" + word.substr(7));
  if (!read || *read > 0xFF) return {};
  sub = *read;
  return {Section::Kind::kObject, index << 8 | sub, true};
}

class Reader {
 public:
  explicit Reader(Eds* eds) : eds_(eds) {}
  std::vector<EdsError> read(std::string_view text);

 private:
  void take_line(std::string_view line);
  void take_key(const std::string& key, std::string_view value);
  void take_device(const std::string& key, std::string_view value);
  void finish_object();
  void error(const std::string& text) {
    if (errors_.size() < kMostErrors) errors_.push_back({line_, text});
  }

  Eds* eds_;
  std::vector<EdsError> errors_;
  Section section_;
  EdsObject object_;
  unsigned compact_ = 0;   // number of sub-objects that share one description
  bool has_subs_ = false;  // an array or a record: the section without a sub-index only describes the whole
  bool any_ = false, compact_pdos_ = false;
  unsigned takes_ = 0, sends_ = 0;  // number of PDOs by [DeviceInfo]
  unsigned line_ = 0;
};

void Reader::finish_object() {
  if (section_.kind != Section::Kind::kObject) return;
  object_.bits = bits_of_type(object_.type);
  if (eds_->objects.contains(section_.key) && (section_.is_sub || !has_subs_)) {
    const unsigned before = eds_->objects[section_.key].line;
    if (before != 0) errors_.push_back({object_.line, object_text(section_.key >> 8, section_.key & 0xFF) + " is described twice, before in line " + std::to_string(before)});
  }
  if (section_.is_sub || !has_subs_) eds_->objects[section_.key] = object_;
  for (unsigned sub = 1; sub <= compact_; ++sub) eds_->objects[section_.key | sub] = object_;
  if (compact_ != 0) eds_->objects[section_.key] = {object_.line, 0x05, 8, "ro", false};
}

void Reader::take_device(const std::string& key, std::string_view value) {
  const bool counted = key == "vendornumber" || key == "productnumber" || key == "compactpdo" || key == "nrofrxpdo" || key == "nroftxpdo";
  const auto number = counted ? number_of(value) : std::optional<std::uint32_t>(0);
  if (!number && !value.empty()) return error(key + " is no number: " + quoted(value));
  if (key == "vendornumber") eds_->vendor = number.value_or(0);
  if (key == "productnumber") eds_->product = number.value_or(0);
  if (key == "compactpdo") compact_pdos_ = number.value_or(0) != 0;
  if (key == "nrofrxpdo") takes_ = number.value_or(0);
  if (key == "nroftxpdo") sends_ = number.value_or(0);
}

void Reader::take_key(const std::string& key, std::string_view value) {
  if (section_.kind == Section::Kind::kDeviceInfo) return take_device(key, value);
  if (section_.kind != Section::Kind::kObject) return;
  const bool counted = key == "datatype" || key == "pdomapping" || key == "objecttype" || key == "compactsubobj" || key == "subnumber";
  const auto number = counted ? number_of(value) : std::optional<std::uint32_t>(0);
  if (!number && !value.empty()) return error(key + " is no number: " + quoted(value));
  if (key == "datatype") object_.type = number.value_or(0);
  if (key == "pdomapping") object_.mappable = number.value_or(0) != 0;
  if (key == "accesstype") object_.access = lower(value);
  if (key == "objecttype") has_subs_ = number.value_or(7) == 8 || number.value_or(7) == 9;  // ARRAY, RECORD
  if (key == "compactsubobj") {
    compact_ = number.value_or(0);
    if (compact_ > kMostSubs) {
      error("an object has at most " + std::to_string(kMostSubs) + " sub-indices");
      compact_ = 0;
    }
  }
}

void Reader::take_line(std::string_view raw) {
  const std::string_view line = trimmed(raw);
  if (line.empty() || line[0] == ';' || line[0] == '#') return;
  if (std::any_of(line.begin(), line.end(), is_control)) return error("is no text: an EDS has lines [section] and key=value");
  if (line[0] == '[') {
    finish_object();
    object_ = {};
    object_.line = line_;
    compact_ = 0;
    has_subs_ = false;
    section_ = {};
    if (line.back() != ']') return error("the name of a section ends with ]");
    section_ = section_of(line.substr(1, line.size() - 2));
    any_ = true;
    return;
  }
  const std::size_t equal = line.find('=');
  if (equal == std::string_view::npos) return error("neither [section] nor key=value: " + quoted(line));
  if (!any_) return error("a key in front of the first [section]");
  const std::string_view value = line.substr(equal + 1);
  take_key(lower(trimmed(line.substr(0, equal))), trimmed(value.substr(0, value.find(';'))));  // no key that is read here has a text with a semicolon
}

std::vector<EdsError> Reader::read(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";  // with which some editors begin UTF-8
  if (text.size() > kMostEdsBytes) return {{0, "is larger than 4 MiB: no data sheet"}};
  if (text.substr(0, kMark.size()) == kMark) text.remove_prefix(kMark.size());
  while (!text.empty() && errors_.size() < kMostErrors) {
    ++line_;
    const std::size_t end = text.find('\n');
    take_line(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  finish_object();
  if (compact_pdos_) eds_->compact_takes = takes_, eds_->compact_sends = sends_;
  if (errors_.empty() && eds_->objects.empty()) errors_.push_back({0, "describes no object"});
  return errors_;
}

// Checks whether one PDO can have its mapping.
void check_pdo(const Eds& eds, const std::vector<std::uint32_t>& mapping, bool taken, const char* device, std::vector<EdsError>* errors) {
  for (const std::uint32_t entry : mapping) {
    const unsigned index = entry >> 16, sub = entry >> 8 & 0xFF, bits = entry & 0xFF;
    const std::string name = object_text(index, sub);
    const EdsObject* object = eds.find(index, sub);
    if (object == nullptr) {
      errors->push_back({0, name + " does not exist in this " + device});
      continue;
    }
    if (!object->mappable) errors->push_back({object->line, name + " cannot be mapped into a PDO (PDOMapping)"});
    if (object->bits != bits) errors->push_back({object->line, name + " has " + std::to_string(object->bits) + " bits, not " + std::to_string(bits) + " (DataType)"});
    const std::string& access = object->access;
    const bool readable = access == "ro" || access == "rw" || access == "rwr" || access == "const" || access == "rww";
    const bool writable = access == "wo" || access == "rw" || access == "rww" || access == "rwr";
    if (taken ? !writable : !readable) errors->push_back({object->line, std::string(name).append(taken ? " cannot be written" : " cannot be read").append(" (AccessType=").append(access).append(")")});
  }
}

void check_exists(const Eds& eds, unsigned index, unsigned sub, const char* device, std::vector<EdsError>* errors) {
  if (eds.find(index, sub) == nullptr) errors->push_back({0, object_text(index, sub) + " does not exist in this " + device});
}

// A PDO has to be there, and its mapping not for reading only: it is written.
void check_pdo_exists(const Eds& eds, bool taken, unsigned number, const char* device, std::vector<EdsError>* errors) {
  const unsigned index = (taken ? 0x1600u : 0x1A00u) + number - 1;
  const EdsObject* found = eds.find(index, 0);
  if (found == nullptr && number <= (taken ? eds.compact_takes : eds.compact_sends)) return;
  check_exists(eds, index, 0, device, errors);
  if (found != nullptr && (found->access == "ro" || found->access == "const"))
    errors->push_back({found->line, object_text(index, 0) + " cannot be written (AccessType=" + found->access + "): the mapping of this PDO is fixed"});
}

// What the set-up writes has to be there with its size, and not for reading only.
void check_written(const Eds& eds, const ObjectValue& object, const char* device, std::vector<EdsError>* errors) {
  check_exists(eds, object.index, object.sub, device, errors);
  const EdsObject* found = eds.find(object.index, object.sub);
  if (found == nullptr) return;
  const std::string name = object_text(object.index, object.sub);
  if (found->bits != 8u * object.bytes) errors->push_back({found->line, name + " has " + std::to_string(found->bits) + " bits, not " + std::to_string(8 * object.bytes)});
  if (found->access == "ro" || found->access == "const") errors->push_back({found->line, name + " cannot be written (AccessType=" + found->access + ")"});
}

// The objects 6000h to 9FFFh of the set-up of an axis that have to be there: of a step that may be skipped an object that is there has to fit all the same.
void check_axis_setup(const Eds& eds, const AxisMap& axis, const char* device, std::vector<EdsError>* errors) {
  for (const SetupStep& step : axis_setup(axis, 1000)) {
    if (step.kind == SetupStep::Kind::kIsZero && eds.find(step.object.index, step.object.sub) == nullptr) continue;
    if (step.kind != SetupStep::Kind::kWriteIfThere) check_written(eds, step.object, device, errors);
  }
}

}  // namespace

std::vector<EdsError> read_eds(std::string_view text, Eds* eds) {
  *eds = {};
  return Reader(eds).read(text);
}

std::vector<EdsError> check_eds(const Eds& eds, const NodeMap& node) {
  std::vector<EdsError> errors;
  const char* device = node.module ? "module" : "drive";
  for (const bool output : {false, true}) {
    if (!node.module) break;
    for (const ModulePdo& pdo : module_pdos(*node.module, output)) {
      check_pdo(eds, pdo.mapping, output, device, &errors);
      check_pdo_exists(eds, output, pdo.number, device, &errors);
    }
  }
  for (const AxisMap& axis : node.axes) {
    check_pdo(eds, rpdo_mapping(axis), true, device, &errors);
    check_pdo(eds, tpdo_mapping(axis), false, device, &errors);
    if (axis.has_probe()) check_pdo(eds, probe_mapping(axis), false, device, &errors);
    check_pdo_exists(eds, true, axis.rpdo, device, &errors);
    check_pdo_exists(eds, false, axis.tpdo, device, &errors);
    if (axis.has_probe()) check_pdo_exists(eds, false, axis.tpdo + 1, device, &errors);
    check_written(eds, {static_cast<std::uint16_t>(axis.object(0x6060)), 0, 1, 0}, device, &errors);
    check_exists(eds, axis.object(0x6061), 0, device, &errors);
    check_axis_setup(eds, axis, device, &errors);
  }
  for (const ObjectValue& object : node.objects) check_written(eds, object, device, &errors);
  if (node.vendor != 0 && eds.vendor != 0 && node.vendor != eds.vendor) errors.push_back({0, std::string("is of another vendor (VendorNumber) than the ") + device + " is to be"});
  if (node.product != 0 && eds.product != 0 && node.product != eds.product) errors.push_back({0, std::string("is of another product (ProductNumber) than the ") + device + " is to be"});
  return errors;
}

}  // namespace nc::hal::canopen
