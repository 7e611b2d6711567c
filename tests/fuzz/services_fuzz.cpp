// SPDX-License-Identifier: Apache-2.0
// Any bytes on the socket of the services: they are cut into frames and read as requests. What is taken holds all that the table wants, in its range; what is
// refused has a sentence; a frame is never longer than it may be.
#include <cstdlib>

#include "fuzz/input.hpp"
#include "runtime/services/call.hpp"
#include "runtime/services/frames.hpp"

namespace {

using namespace nc::rt::services;
using nc::fuzz::require;

void require_taken(const Call& call) {
  require(call.row != nullptr);
  for (const Wanted& wanted : call.row->request) {
    const FieldInfo& row = row_of(wanted.field);
    if (!call.has(wanted.field)) {
      require(!wanted.required);
      continue;
    }
    const std::string& text = call.words(wanted.field);
    const double size = static_cast<double>(text.size());
    if (row.kind == Kind::kNumber || row.kind == Kind::kWhole) require(call.value(wanted.field) >= row.least && call.value(wanted.field) <= row.most);
    else if (row.kind == Kind::kFlag) require(call.value(wanted.field) == 0 || call.value(wanted.field) == 1);
    else if (row.kind == Kind::kList) require(static_cast<double>(call.list(wanted.field).size()) >= row.least && static_cast<double>(call.list(wanted.field).size()) <= row.most);
    else require(size >= row.least && size <= row.most);
    if (row.kind == Kind::kName) require(is_program_name(text) && text.find('/') == std::string::npos && text.find('\0') == std::string::npos && text[0] != '.');
    if (row.kind == Kind::kData) {
      std::string back;
      require(from_base64(to_base64(text), &back) && back == text);
    }
  }
  unsigned known = 0;
  for (const Wanted& wanted : call.row->request) known += call.has(wanted.field);
  require(known == call.given.count());
}

void read_frame(const std::string& frame) {
  Call call;
  Outcome outcome;
  if (decode_call(frame, &call, &outcome)) {
    require_taken(call);
    require(frame.find('\0') == std::string::npos);  // what stands behind it would not be read
    return;
  }
  require(!outcome.ok && !outcome.text.empty());
  const std::string reply = encode_reply(call.id, outcome);
  const Json json = Json::parse(reply, nullptr, false);
  require(reply.size() <= kMostFrameBytes && json.is_object() && json["ok"] == false && json["error"] == refused_name(outcome.why));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  nc::fuzz::Bytes in(data, size);
  const bool framed = in.byte() % 2 == 0;
  if (!framed) {  // one frame, so that the reader of requests sees many of them
    read_frame(in.rest());
    return 0;
  }
  FrameReader reader;
  std::string text;
  while (!in.empty()) {
    reader.add(in.text(1 + in.byte()));
    FrameReader::Next next;
    while ((next = reader.next(&text)) == FrameReader::Next::kFrame) read_frame(text);
    if (next == FrameReader::Next::kTooLong) break;
    reader.look_ahead([](std::string_view) { std::abort(); });  // what is whole was taken
  }
  return 0;
}
