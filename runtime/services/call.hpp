// SPDX-License-Identifier: Apache-2.0
// One request with its values checked against the table of services, and the replies to it, as JSON.
//
//   request  {"id": 7, "service": "mode", "args": {"mode": "auto"}}
//            may have "right": "operate" (it may use services of this right and of view only) and "age_ms": 12 (it has been on its way for so long)
//   reply    {"id": 7, "ok": true, "reply": {"text": ""}}
//   refusal  {"id": 7, "ok": false, "error": "no right", "text": "tools.set needs the right to set up"}
//
// Everything in a request comes from another process. What is not in the table, of another kind, out of range, twice there or missing is malformed; nothing is
// clamped or ignored.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/services/service_table.hpp"

namespace nc::rt::services {

using Json = nlohmann::json;

// Why a request was refused. Programs go by the names, which never change.
enum class Refused : std::uint8_t {
  kMalformed,       // no request, or one with a wrong value
  kUnknownService,
  kNoRight,
  kNoControl,       // another client has control, or nobody: take it first
  kLate,            // older than its lifespan
  kState,           // the machine does not allow it now; the text says why
  kBusy,            // too many requests, clients or uploads at once
  kNotFound,        // no such program, tool, axis, variable, parameter
  kProtected,       // the program is protected, or runs
  kNoSpace,         // the disk or the quota is full
  kNotReached,      // the command was accepted, and its state did not come
  kFailed,          // the computer could not do it: the text has the reason
  kCount
};
const char* refused_name(Refused why);

struct Call {
  std::uint64_t id = 0;
  const ServiceRow* row = nullptr;
  std::bitset<kFields> given;
  std::array<double, kFields> number{};     // numbers, and flags as 0 or 1
  std::array<std::string, kFields> text{};  // texts, names, and data as bytes
  std::vector<std::string> texts = {};      // of the list, of which no request has two
  std::optional<Right> right = {};          // the only one besides view with which the request has come
  std::int64_t age_ns = 0;                  // it was on its way for so long before it came here

  bool has(Field field) const { return given[static_cast<unsigned>(field)]; }
  double value(Field field) const { return number[static_cast<unsigned>(field)]; }
  double value_or(Field field, double other) const { return has(field) ? value(field) : other; }
  bool flag(Field field) const { return value(field) != 0; }
  const std::string& words(Field field) const { return text[static_cast<unsigned>(field)]; }
  // Of a field that is a list.
  const std::vector<std::string>& list(Field) const { return texts; }
};

struct Outcome {
  bool ok = true;
  Refused why = Refused::kMalformed;
  std::string text;  // the sentence of a refusal
  Json reply = Json::object();

  static Outcome done(std::string text = "") {
    Outcome outcome;
    outcome.reply["text"] = std::move(text);
    return outcome;
  }
  static Outcome with(Json reply) {
    Outcome outcome;
    outcome.reply = std::move(reply);
    return outcome;
  }
  static Outcome refused(Refused why, std::string text) { return {false, why, std::move(text), Json()}; }
};

// Reads JSON from another process. False with what is wrong in *why, as the end of a sentence: no JSON, a member twice, nested too deep.
bool read_json(std::string_view text, Json* out, std::string* why);

// Reads a request. False with the refusal in *outcome; call->id is the number of the request as far as it could be read, else 0.
bool decode_call(std::string_view frame, Call* call, Outcome* outcome);

// The reply as the text of a frame, at most kMostFrameBytes long.
std::string encode_reply(std::uint64_t id, const Outcome& outcome);

// A name that a program may have: UTF-8 without control characters, '/' and '\', not beginning with a point.
bool is_program_name(std::string_view name);

std::string to_base64(std::string_view bytes);
// False when the text is not base64 of whole bytes with its padding.
bool from_base64(std::string_view text, std::string* bytes);

}  // namespace nc::rt::services
