// SPDX-License-Identifier: Apache-2.0
// See call.hpp.
#include "runtime/services/call.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "runtime/programs/encoding.hpp"

namespace nc::rt::services {
namespace {

constexpr Field kOfLines[] = {Field::kBlocks, Field::kToml, Field::kParameterToml, Field::kLadderText};  // texts of several lines

constexpr int kDeepest = 4;  // of a request: itself, its arguments, and what could be wrong in them
constexpr double kMostId = 9007199254740991.0;
constexpr double kMostAgeMs = 86'400'000;
constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

// Whether a text that is no JSON fails by a number beyond those of the computer.
class NumberWatch final : public nlohmann::json_sax<Json> {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(string_t& name) override {
    member = name;
    return true;
  }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t, const std::string&, const Json::exception& error) override {
    constexpr int kNumberOverflow = 406;
    too_large = error.id == kNumberOverflow;
    return false;
  }
  bool too_large = false;
  std::string member;  // the last one
};

// Where the first text with the sign that replaces bytes of no character is: its member, or the member that is named so. "" = nowhere.
std::string place_of_replaced(const Json& value, const std::string& member) {
  constexpr char kReplaced[] = "\xef\xbf\xbd";
  if (value.is_string()) return value.get_ref<const std::string&>().find(kReplaced) == std::string::npos ? "" : member;
  if (value.is_array())
    for (const Json& element : value)
      if (std::string found = place_of_replaced(element, member); !found.empty()) return found;
  if (value.is_object())
    for (const auto& [key, element] : value.items()) {
      if (key.find(kReplaced) != std::string::npos) return key;
      if (std::string found = place_of_replaced(element, key); !found.empty()) return found;
    }
  return "";
}

std::string what_is_no_json(std::string_view text) {
  NumberWatch watch;
  (void)Json::sax_parse(text.begin(), text.end(), &watch);
  if (watch.too_large) return "has a number that is too large" + (watch.member.empty() ? "" : ": \"" + watch.member + "\"");
  const std::string mended = valid_utf8(text);  // JSON apart from its bytes: the text was in Latin-1, Shift-JIS or the like
  const Json read = mended == text ? Json() : Json::parse(mended.begin(), mended.end(), nullptr, false);
  const std::string member = read.is_structured() ? place_of_replaced(read, "") : "";
  return member.empty() ? "is no JSON in UTF-8" : "is no JSON in UTF-8: \"" + member + "\" has other bytes";
}

std::string range_text(const FieldInfo& row) {
  const auto shown = [](double value) { return Json(value == std::floor(value) ? Json(static_cast<std::int64_t>(value)) : Json(value)).dump(); };
  return shown(row.least) + " to " + shown(row.most);
}

bool has_unseen(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (unseen_length(text.substr(i)) != 0) return true;
  return false;
}

// A text of several lines is no name, and is cleaned where it is shown.
bool is_printable(std::string_view text, bool lines) {
  if (!lines) return !has_unseen(text);
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) >= ' ' || c == '\n' || c == '\r' || c == '\t'; });
}

// Takes one value. "" = it is good, else what is wrong with it.
std::string take(const FieldInfo& row, const Json& value, Call* call) {
  const auto at = static_cast<unsigned>(row.field);
  switch (row.kind) {
    case Kind::kFlag:
      if (!value.is_boolean()) return "must be true or false";
      call->number[at] = value.get<bool>() ? 1 : 0;
      return "";
    case Kind::kNumber:
    case Kind::kWhole: {
      if (!value.is_number()) return "must be a number";
      const double number = value.get<double>();
      if (!std::isfinite(number) || number < row.least || number > row.most) return "must be " + range_text(row);
      if (row.kind == Kind::kWhole && number != std::floor(number)) return "must be a whole number";
      call->number[at] = number + 0.0;  // zero has no sign
      return "";
    }
    case Kind::kText:
    case Kind::kName: {
      if (!value.is_string()) return "must be a text";
      const auto& text = value.get_ref<const std::string&>();
      if (static_cast<double>(text.size()) < row.least || static_cast<double>(text.size()) > row.most) return "must have " + range_text(row) + " bytes";
      if (row.kind == Kind::kName && !is_program_name(text)) return "must be a name in the folder of programs, without a path";
      if (!is_printable(text, std::find(std::begin(kOfLines), std::end(kOfLines), row.field) != std::end(kOfLines))) return "must not have control characters";
      call->text[at] = text;
      return "";
    }
    case Kind::kList:
      if (!value.is_array() || static_cast<double>(value.size()) < row.least || static_cast<double>(value.size()) > row.most) return "must be a list of " + range_text(row) + " texts";
      for (const Json& element : value) {
        if (!element.is_string()) return "must be a list of texts";
        const auto& text = element.get_ref<const std::string&>();
        if (text.empty() || text.size() > kLongestText || !is_printable(text, false)) return "must hold texts of 1 to " + std::to_string(kLongestText) + " bytes without control characters";
        call->texts.push_back(text);
      }
      return "";
    case Kind::kData: {
      if (!value.is_string() || !from_base64(value.get_ref<const std::string&>(), &call->text[at])) return "must be bytes in base64";
      const auto size = static_cast<double>(call->text[at].size());
      return size < row.least || size > row.most ? "must be " + range_text(row) + " bytes" : "";
    }
  }
  return "?";
}

// With which right the request has come, and how long it was on its way. "" = good.
std::string take_origin(const Json& message, Call* call) {
  if (const auto right = message.find("right"); right != message.end()) {
    if (!right->is_string()) return "right must be the name of a right";
    call->right = find_right(right->get_ref<const std::string&>());
    if (!call->right) return "right must be view, operate, set up or maintain";
  }
  if (const auto age = message.find("age_ms"); age != message.end()) {
    if (!age->is_number_unsigned() || age->get<double>() > kMostAgeMs) return "age_ms must be a whole number from 0 to a day";
    call->age_ns = age->get<std::int64_t>() * 1'000'000;
  }
  return "";
}

const FieldInfo* field_of(const ServiceRow& row, std::string_view name) {
  for (const Wanted& wanted : row.request)
    if (name == row_of(wanted.field).name) return &row_of(wanted.field);
  return nullptr;
}

}  // namespace

const char* refused_name(Refused why) {
  switch (why) {
    case Refused::kMalformed: return "malformed";
    case Refused::kUnknownService: return "unknown service";
    case Refused::kNoRight: return "no right";
    case Refused::kNoControl: return "no control";
    case Refused::kLate: return "late";
    case Refused::kState: return "refused";
    case Refused::kBusy: return "busy";
    case Refused::kNotFound: return "not found";
    case Refused::kProtected: return "protected";
    case Refused::kNoSpace: return "no space";
    case Refused::kNotReached: return "not reached";
    case Refused::kFailed: return "failed";
    case Refused::kCount: break;
  }
  return "?";
}

bool is_program_name(std::string_view name) {
  if (name.empty() || name[0] == '.') return false;
  if (name.find('/') != std::string_view::npos || name.find('\\') != std::string_view::npos || name.find('\x7f') != std::string_view::npos) return false;
  return is_printable(name, false) && valid_utf8(name) == name;
}

// Parses without exceptions, and refuses a key that stands twice in one object: of two values nobody knows which one is meant.
bool read_json(std::string_view text, Json* out, std::string* why) {
  if (text.find('\0') != std::string_view::npos) {  // the parser would take it for the end of the text
    *why = "is no JSON: it has a NUL";
    return false;
  }
  std::vector<std::vector<std::string>> keys;
  bool deep = false, twice = false;
  const auto watch = [&](int depth, Json::parse_event_t event, Json& value) {
    if (depth > kDeepest) deep = true;
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end && !keys.empty()) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.empty()) {
      const std::string& key = value.get_ref<const std::string&>();
      for (const std::string& other : keys.back()) twice = twice || other == key;
      if (keys.back().size() < kFields) keys.back().push_back(key);
      else deep = true;
    }
    return !deep;
  };
  *out = Json::parse(text.begin(), text.end(), watch, false);
  *why = deep ? "has too many members, or is nested too deep" : twice ? "has a member twice" : out->is_discarded() ? what_is_no_json(text) : "";
  return why->empty();
}

bool decode_call(std::string_view frame, Call* call, Outcome* outcome) {
  const auto bad = [&](Refused why, std::string text) {
    *outcome = Outcome::refused(why, std::move(text));
    return false;
  };
  Json message;
  std::string why;
  if (!read_json(frame, &message, &why)) return bad(Refused::kMalformed, "the request " + why);
  if (!message.is_object()) return bad(Refused::kMalformed, "the request is no object");
  const auto id = message.find("id");
  if (id == message.end() || !id->is_number_unsigned() || id->get<double>() > kMostId) return bad(Refused::kMalformed, "id must be a whole number from 0");
  call->id = id->get<std::uint64_t>();
  for (const auto& [key, value] : message.items())
    if (key != "id" && key != "service" && key != "args" && key != "right" && key != "age_ms") return bad(Refused::kMalformed, "the request has no member \"" + key + "\"");
  const auto name = message.find("service");
  if (name == message.end() || !name->is_string()) return bad(Refused::kMalformed, "service must be the name of a service");
  call->row = find_service(name->get_ref<const std::string&>());
  if (call->row == nullptr) return bad(Refused::kUnknownService, "there is no such service");
  if (const std::string wrong = take_origin(message, call); !wrong.empty()) return bad(Refused::kMalformed, wrong);
  const auto args = message.find("args");
  if (args != message.end() && !args->is_object()) return bad(Refused::kMalformed, "args must be an object");
  if (args != message.end()) {
    for (const auto& [key, value] : args->items()) {
      const FieldInfo* field = field_of(*call->row, key);
      if (field == nullptr) return bad(Refused::kMalformed, std::string(call->row->name) + " has no member \"" + key + "\"");
      if (const std::string wrong = take(*field, value, call); !wrong.empty()) return bad(Refused::kMalformed, std::string(key).append(" ").append(wrong));
      call->given.set(static_cast<unsigned>(field->field));
    }
  }
  for (const Wanted& wanted : call->row->request)
    if (wanted.required && !call->has(wanted.field)) return bad(Refused::kMalformed, std::string(call->row->name) + " needs " + row_of(wanted.field).name);
  return true;
}

std::string encode_reply(std::uint64_t id, const Outcome& outcome) {
  Json message = {{"id", id}, {"ok", outcome.ok}};
  if (outcome.ok) {
    message["reply"] = outcome.reply;
  } else {
    message["error"] = refused_name(outcome.why);
    message["text"] = outcome.text;
  }
  // Texts come from programs and files, too: bytes that are no character are replaced.
  std::string text = message.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() <= kMostFrameBytes) return text;
  return encode_reply(id, Outcome::refused(Refused::kFailed, "the reply is too long: ask for fewer entries"));
}

std::string to_base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t group = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
    for (std::size_t i = 0; i < 3; ++i) group = group << 8 | (i < count ? static_cast<unsigned char>(bytes[at + i]) : 0u);
    for (std::size_t i = 0; i < 4; ++i) text += i <= count ? kDigits[group >> (18 - 6 * i) & 63u] : '=';
  }
  return text;
}

bool from_base64(std::string_view text, std::string* bytes) {
  static constexpr std::array<std::int8_t, 256> kValues = [] {
    std::array<std::int8_t, 256> values{};
    values.fill(-1);
    for (int i = 0; i < 64; ++i) values[static_cast<unsigned char>(kDigits[i])] = static_cast<std::int8_t>(i);
    return values;
  }();
  bytes->clear();
  if (text.size() % 4 != 0) return false;
  std::size_t padding = 0;
  while (padding < 2 && padding < text.size() && text[text.size() - 1 - padding] == '=') ++padding;
  bytes->reserve(text.size() / 4 * 3);
  for (std::size_t at = 0; at < text.size(); at += 4) {
    const std::size_t digits = at + 4 == text.size() ? 4 - padding : 4;
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const int value = i < digits ? kValues[static_cast<unsigned char>(text[at + i])] : 0;
      if (value < 0) return false;
      group = group << 6 | static_cast<std::uint32_t>(value);
    }
    for (std::size_t i = 0; i + 1 < digits; ++i) *bytes += static_cast<char>(group >> (16 - 8 * i) & 0xffu);
    // Bits behind the last byte must be 0: otherwise two texts would stand for the same bytes.
    if ((digits == 2 && (group & 0xffffu) != 0) || (digits == 3 && (group & 0xffu) != 0)) return false;
  }
  return true;
}

}  // namespace nc::rt::services
