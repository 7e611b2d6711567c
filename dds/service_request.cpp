// SPDX-License-Identifier: Apache-2.0
// See service_request.hpp.
#include "dds/service_request.hpp"

#include <algorithm>
#include <cstring>

namespace nc::dds {
namespace {

using rt::services::Json;
using rt::services::Lane;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kMostAhead = -1000 * kMs;  // the clock of a client may be ahead of this one by so much
constexpr std::int64_t kMostAgeNs = 86'400'000 * kMs;

// Whether something stands behind the end of a text: it had a NUL in its middle.
template <std::size_t kSize>
bool is_hiding(const char (&text)[kSize]) {
  const char* end = static_cast<const char*>(std::memchr(text, 0, kSize));
  return end == nullptr || std::any_of(end, text + kSize, [](char c) { return c != 0; });
}

}  // namespace

bool is_client_name(std::string_view name) {
  return !name.empty() && name.size() <= rt::services::kMostRemoteClient && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '_' || c == '@';
  });
}

ServiceRequest read_request(const nc_ServiceRequest& sample, Right right, std::int64_t sent_ns) {
  const auto text = [](const auto& from) { return std::string(from, strnlen(from, sizeof from)); };
  return {right, sample.number, text(sample.service), text(sample.args), is_hiding(sample.service) || is_hiding(sample.args), sent_ns};
}

bool service_frame(const ServiceRequest& request, std::uint64_t id, std::int64_t wall_ns, const ServiceGate& gate, std::string* frame, Outcome* outcome) {
  const auto bad = [&](Refused why, const std::string& text) {
    *outcome = Outcome::refused(why, text);
    return false;
  };
  if (request.hides) return bad(Refused::kMalformed, "a text has a NUL in its middle");
  const std::string args = request.args.empty() ? "{}" : request.args;
  // One object and nothing behind it: so the arguments cannot add members to the request.
  Json read;
  std::string wrong;
  if (!rt::services::read_json(args, &read, &wrong)) return bad(Refused::kMalformed, "the text of args " + wrong);
  if (!read.is_object()) return bad(Refused::kMalformed, "args must be an object in JSON");
  const ServiceRow* row = rt::services::find_service(request.service);
  if (gate.rights.none() || (row != nullptr && !gate.rights.has(row->right))) return bad(Refused::kNoRight, gate.why);
  const bool command = row != nullptr && row->lane == Lane::kCommand;
  const std::int64_t age_ns = wall_ns - std::clamp(request.sent_ns, wall_ns - kMostAgeNs, wall_ns + kMostAgeNs);  // any time may stand in a sample
  if (command && age_ns < kMostAhead) return bad(Refused::kLate, "the clock of the client is ahead by " + std::to_string(-age_ns / kMs) + " ms");
  const std::int64_t age_ms = std::max<std::int64_t>(age_ns / kMs, 0);
  *frame = "{\"id\":" + std::to_string(id) + ",\"service\":" + Json(request.service).dump(-1, ' ', true, Json::error_handler_t::replace) + ",\"right\":\"" + rt::services::right_name(request.right) +
           "\",\"age_ms\":" + std::to_string(command ? age_ms : 0) + ",\"args\":" + args + "}";
  rt::services::Call call;
  return rt::services::decode_call(*frame, &call, outcome);
}

ServiceMessage refusal_message(std::uint64_t number, const Outcome& outcome) {
  return {number, nc_SERVICE_REFUSED, rt::services::refused_name(outcome.why), Json{{"text", outcome.text}}.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

bool read_message(std::string_view text, std::uint64_t* id, ServiceMessage* message) {
  const Json read = Json::parse(text.begin(), text.end(), nullptr, false);
  if (!read.is_object()) return false;
  *id = 0;
  const auto number = read.find("id");
  if (number == read.end()) {
    if (!read.contains("watch")) return false;
    *message = {0, nc_SERVICE_UPDATE, "", std::string(text)};
    return true;
  }
  const auto ok = read.find("ok");
  if (!number->is_number_unsigned() || ok == read.end() || !ok->is_boolean()) return false;
  *id = number->get<std::uint64_t>();
  if (ok->get<bool>()) {
    const auto reply = read.find("reply");
    if (reply == read.end()) return false;
    *message = {0, nc_SERVICE_DONE, "", reply->dump()};
    return true;
  }
  const auto error = read.find("error"), why = read.find("text");
  if (error == read.end() || !error->is_string() || why == read.end()) return false;
  *message = {0, nc_SERVICE_REFUSED, error->get<std::string>(), Json{{"text", *why}}.dump()};
  return true;
}

void narrow_rights(ServiceMessage* message, RightSet rights) {
  Json body = Json::parse(message->body, nullptr, false);
  if (message->status != nc_SERVICE_DONE || !body.is_object() || !body.contains("rights")) return;
  Json kept = Json::array();
  for (unsigned right = 0; right < rt::services::kRightCount; ++right) {
    const Json name = rt::services::right_name(static_cast<Right>(right));
    const Json& had = body["rights"];
    if (rights.has(static_cast<Right>(right)) && std::find(had.begin(), had.end(), name) != had.end()) kept.push_back(name);
  }
  body["rights"] = std::move(kept);
  message->body = body.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<std::string_view> parts_of(std::string_view text, std::size_t most) {
  std::vector<std::string_view> parts;
  do {
    std::size_t size = std::min(most, text.size());
    // A byte 10xxxxxx goes on with a character, which has at most four bytes.
    while (size < text.size() && size > most - 3 && (static_cast<unsigned char>(text[size]) & 0xc0u) == 0x80u) --size;
    parts.push_back(text.substr(0, size));
    text.remove_prefix(size);
  } while (!text.empty());
  return parts;
}

}  // namespace nc::dds
