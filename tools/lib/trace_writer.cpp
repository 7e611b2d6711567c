// SPDX-License-Identifier: Apache-2.0
// Writes the lines of a trace; see trace_writer.hpp. A line is built directly in the output buffer. The longest one has 8 axes
// twice, two centres and two texts of NC_MAX_TEXT bytes (each byte takes at most \u00XX), which is far below
// OutputFile::kLargest. Only the variables in the end line can need more, so that line is written in pieces.
#include "tools/lib/trace_writer.hpp"

#include <cstring>
#include <iterator>

#include "runtime/programs/encoding.hpp"
#include "tools/lib/number_text.hpp"

namespace nc::tools {
namespace {

constexpr size_t kLine = 8192;
static_assert(kLine <= OutputFile::kLargest);

// The name of each nc_move_kind in a trace.
constexpr std::string_view kMoveKinds[] = {"rapid", "line", "arc", "helix", "skip", "thread",
                                             "tap",   "spiral", "exponential", "nurbs", "spline"};
constexpr std::string_view kPlanes[] = {"XY", "ZX", "YZ"};

struct SyncName {
  uint32_t bit;
  std::string_view name;
};
constexpr SyncName kSyncNames[] = {{NC_SYNC_POSITION, "position"}, {NC_SYNC_INPUT, "input"},
                                   {NC_SYNC_CLOCK, "clock"},       {NC_SYNC_SKIP, "skip"},
                                   {NC_SYNC_MODAL, "modal"},       {NC_SYNC_STOPPED, "stopped"},
                                   {NC_SYNC_SHARED, "shared"}};

bool circular(const nc_move& move) {
  return move.center_axes != 0;
}

}  // namespace

std::string json_escaped(std::string_view text) {
  static constexpr char kHex[] = "0123456789abcdef";
  std::string out;
  while (!text.empty()) {
    const unsigned char c = static_cast<unsigned char>(text[0]);
    size_t n = rt::utf8_length(text);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += text[0];
      n = 1;
    } else if (c < 0x20 || c == 0x7F || n == 0) {
      out += "\\u00";
      out += kHex[c >> 4];
      out += kHex[c & 15];
      n = 1;
    } else {
      out += text.substr(0, n);
    }
    text.remove_prefix(n);
  }
  return out;
}

TraceWriter::TraceWriter(OutputFile* out, const nc_system_config& system)
    : out_(out), axis_count_(system.axis_count) {
  for (unsigned i = 0; i < axis_count_; ++i) {
    const char key[] = {',', '"', system.axis[i].name, '"', ':', 0};
    std::memcpy(axis_key_[i], key, sizeof key);
  }
}

void TraceWriter::put(std::string_view text) {
  std::memcpy(at_, text.data(), text.size());
  at_ += text.size();
}
void TraceWriter::put_number(double value) {
  at_ += number_text(value, at_);
}
void TraceWriter::put_integer(uint64_t value) {
  at_ += integer_text(value, at_);
}
void TraceWriter::put_string(std::string_view text) {
  put("\"");
  put(json_escaped(text));
  put("\"");
}

void TraceWriter::begin(std::string_view type, const nc_source& source) {
  at_ = out_->reserve(kLine);
  put("{\"t\":\"");
  put(type);
  put("\",\"sys\":");
  put_integer(source.system + 1u);
  put(",\"line\":");
  put_integer(source.line);
  put(",\"prog\":");
  put_integer(source.program);
  put(",\"depth\":");
  put_integer(source.depth);
}

void TraceWriter::finish() {
  put("}\n");
  out_->advance(static_cast<size_t>(at_ - out_->reserve(0)));
}

void TraceWriter::put_axes(std::string_view key, const nc_axes& axes) {
  put(key);
  for (unsigned i = 0; i < axis_count_; ++i) {
    put({axis_key_[i] + (i == 0 ? 1 : 0), i == 0 ? size_t{4} : size_t{5}});
    put_number(axes.v[i]);
  }
  put("}");
}

void TraceWriter::put_pair(std::string_view key, const nc_move& move, const double (&center)[3]) {
  put(key);
  for (unsigned i = 0; i < move.center_axes; ++i) {
    put({axis_key_[move.plane_axis[i]] + (i == 0 ? 1 : 0), i == 0 ? size_t{4} : size_t{5}});
    put_number(center[i]);
  }
  put("}");
}

void TraceWriter::put_circular(const nc_move& move) {
  if (move.plane < NC_PLANE_NONE) {
    put(",\"plane\":\"");
    put(kPlanes[move.plane]);
    put("\"");
  }
  if (move.center_axes == 2) put(move.ccw ? ",\"dir\":\"ccw\"" : ",\"dir\":\"cw\"");  // an arc in space has no sense of rotation
  put_pair(",\"center\":{", move, move.center);
  put_pair(",\"machine_center\":{", move, move.machine_center);
  put(",\"turns\":");
  put_integer(move.turns);
  put(",\"radius\":");
  put_number(move.radius);
}

void TraceWriter::move(const nc_source& source, const nc_move& move, const bool* skipped) {
  begin("move", source);
  put(",\"kind\":\"");
  put(move.kind < std::size(kMoveKinds) ? kMoveKinds[move.kind] : std::string_view("unknown"));
  put_axes("\",\"work\":{", move.work);
  put_axes(",\"machine\":{", move.machine);
  // With G95 `feed` is null and `feed_rev` has the value; for a rapid `feed` is null and there is no `feed_rev`.
  if (move.kind == NC_MOVE_RAPID) {
    put(",\"feed\":null");
  } else if (move.feed_mm_rev > 0.0) {
    put(",\"feed\":null,\"feed_rev\":");
    put_number(move.feed_mm_rev);
  } else {
    put(",\"feed\":");
    put_number(move.feed_mm_min);
  }
  if (circular(move)) put_circular(move);
  if (skipped) put(*skipped ? ",\"skipped\":true" : ",\"skipped\":false");
  finish();
}

void TraceWriter::block(const nc_source& source, const nc_axes& work, const nc_axes& machine) {
  begin("block", source);
  put_axes(",\"work\":{", work);
  put_axes(",\"machine\":{", machine);
  finish();
}

void TraceWriter::aux(const nc_source& source, char code, double value) {
  begin("aux", source);
  put(",\"code\":");
  put_string({&code, 1});
  put(",\"value\":");
  put_number(value);
  finish();
}

void TraceWriter::dwell(const nc_source& source, bool turns, double value) {
  begin("dwell", source);
  put(turns ? ",\"revolutions\":" : ",\"seconds\":");
  put_number(value);
  finish();
}

void TraceWriter::sync(const nc_source& source, uint32_t what) {
  begin("sync", source);
  put(",\"what\":\"");
  bool first = true;
  for (const SyncName& entry : kSyncNames) {
    if (!(what & entry.bit)) continue;
    if (!first) put("+");
    put(entry.name);
    first = false;
  }
  put("\"");
  finish();
}

void TraceWriter::message(const nc_source& source, uint32_t port, const nc_text& text) {
  begin("message", source);
  put(",\"port\":");
  put_integer(port);
  put(",\"text\":");
  if (text.size == 0) {
    put_string({text.s, strnlen(text.s, sizeof text.s)});
  } else {  // bytes of BPRNT: each becomes the character with its number
    std::string characters;
    for (uint32_t i = 0; i < text.size; ++i) {
      const auto byte = static_cast<unsigned char>(text.s[i]);
      if (byte >= 0x80) characters += static_cast<char>(0xC0 | byte >> 6);
      characters += static_cast<char>(byte >= 0x80 ? 0x80 | (byte & 0x3F) : byte);
    }
    put_string(characters);
  }
  finish();
}

void TraceWriter::alarm(const nc_alarm& alarm) {
  begin("alarm", alarm.source);
  put(",\"code\":");
  put_string({alarm.code, strnlen(alarm.code, sizeof alarm.code)});
  put(",\"message\":");
  put_string({alarm.message, strnlen(alarm.message, sizeof alarm.message)});
  put(",\"detail\":");
  put_string({alarm.detail.s, strnlen(alarm.detail.s, sizeof alarm.detail.s)});
  finish();
}

void TraceWriter::end(const nc_source& source, bool ok, const nc_axes& work, const nc_axes& machine,
                      uint32_t modal, ItemSource* items) {
  begin("end", source);
  put(ok ? ",\"ok\":true" : ",\"ok\":false");
  put_axes(",\"work\":{", work);
  put_axes(",\"machine\":{", machine);
  put(",\"vars\":{");
  uint32_t number = 0;
  double value = 0;
  for (bool first = true; items->next_common(number, &number, &value); first = false, ++number) {
    out_->advance(static_cast<size_t>(at_ - out_->reserve(0)));
    at_ = out_->reserve(kLine);
    put(first ? "\"" : ",\"");
    put_integer(number);
    put("\":");
    at_ += value_text(value, at_);
  }
  put("},\"modal\":[");
  char codes[NC_GROUPS][8];
  const unsigned count = items->modal_codes(modal, codes, NC_GROUPS);
  for (unsigned i = 0; i < count && i < NC_GROUPS; ++i) {
    if (i) put(",");
    put_string({codes[i], strnlen(codes[i], sizeof codes[i])});
  }
  put("],\"seconds\":null");
  finish();
}

}  // namespace nc::tools
