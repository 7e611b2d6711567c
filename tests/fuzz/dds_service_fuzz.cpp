// SPDX-License-Identifier: Apache-2.0
// The services over DDS without a network: any bytes as a request become a frame for the local services that says just what the request says, for a service that
// the gateway lets pass, or a refusal with a sentence; any bytes as a message of the control become a reply, whose parts are the whole when they are put together.
#include <array>
#include <cstring>
#include <memory>

#include "dds/service_request.hpp"
#include "fuzz/input.hpp"
#include "runtime/programs/encoding.hpp"
#include "runtime/services/frames.hpp"

namespace {

using namespace nc::dds;
using namespace nc::rt::services;
using nc::fuzz::Bytes;
using nc::fuzz::require;

void require_refusal(const ServiceMessage& message, std::uint64_t number) {
  const Json body = Json::parse(message.body, nullptr, false);
  require(message.number == number && message.status == nc_SERVICE_REFUSED && !message.refusal.empty() && message.refusal.size() < sizeof nc_ServiceReply::refusal);
  require(body.is_object() && body["text"].is_string() && !body["text"].get<std::string>().empty());
}

void ask(Bytes* in) {
  static const auto sample = std::make_unique<nc_ServiceRequest>();
  std::memset(static_cast<void*>(sample.get()), 0, sizeof *sample);
  const auto right = static_cast<Right>(in->byte() % kRightCount);
  const std::uint8_t rights = in->byte();
  ServiceGate gate;
  gate.why = "the gateway lets nothing more pass";
  for (unsigned r = 0; r < kRightCount; ++r)
    if ((rights >> r & 1) != 0) gate.rights.add(static_cast<Right>(r));
  const auto sent_ns = in->value<std::int64_t>();
  constexpr std::int64_t kNow = 1'800'000'000'000'000'000;
  constexpr std::uint64_t kId = 77;
  const std::size_t length = in->byte() % (sizeof sample->service);
  const std::string service = in->text(length), args = in->rest().substr(0, sizeof sample->args - 1);
  std::memcpy(sample->service, service.data(), service.size());
  std::memcpy(sample->args, args.data(), args.size());
  sample->number = 5;
  const ServiceRequest request = read_request(*sample, right, sent_ns);
  const bool hides = service.find('\0') < service.find_last_not_of('\0') + 1 || args.find('\0') < args.find_last_not_of('\0') + 1;
  require(request.hides == hides && request.number == 5 && request.right == right);
  std::string frame;
  Outcome outcome;
  if (!service_frame(request, kId, kNow, gate, &frame, &outcome)) {
    require(!outcome.ok);
    return require_refusal(refusal_message(request.number, outcome), 5);
  }
  require(!hides && frame.size() <= kMostFrameBytes);
  Call call;
  require(decode_call(frame, &call, &outcome));
  require(call.id == kId && call.right == right && request.service == call.row->name && gate.rights.has(call.row->right));
  require(call.age_ns >= 0 && (call.row->lane != Lane::kCommand || sent_ns <= kNow + 1'000'000'000));
  const Json whole = Json::parse(frame, nullptr, false);
  require(whole.size() == 5 && whole["args"] == (request.args.empty() ? Json::object() : Json::parse(request.args, nullptr, false)));
}

void require_parts(const std::string& text, std::size_t most) {
  const bool valid = nc::rt::valid_utf8(text) == text;
  std::string joined;
  for (const std::string_view part : parts_of(text, most)) {
    require(part.size() <= most && (!valid || nc::rt::valid_utf8(part) == part));
    require(!part.empty() || text.empty());
    joined += part;
  }
  require(joined == text);
}

void hear(Bytes* in) {
  const std::size_t most = 4 + in->byte();
  const std::string text = in->rest();
  require_parts(text, most);
  std::uint64_t id = 0;
  ServiceMessage message;
  if (!read_message(text, &id, &message)) return;
  require(message.number == 0 && (message.status != nc_SERVICE_UPDATE || id == 0));
  require(message.refusal.empty() || message.status == nc_SERVICE_REFUSED);
  require(Json::accept(message.body));
  require_parts(message.body, most);
}

// A name becomes the end of a partition, in which none of these means something else than itself.
void name(Bytes* in) {
  const std::string text = in->rest();
  if (is_client_name(text)) require(!text.empty() && text.size() < sizeof nc_ServiceRequest::client && text.find_first_of(std::string_view("/*?[]\\\0 ", 8)) == std::string::npos);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes in(data, size);
  constexpr void (*kWays[])(Bytes*) = {ask, hear, name};
  kWays[in.byte() % std::size(kWays)](&in);
  return 0;
}
