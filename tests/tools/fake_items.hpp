// SPDX-License-Identifier: Apache-2.0
// A list of items instead of a control, and a file from which output can be read back.
#pragma once

#include <cstdio>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "nc/nc.h"
#include "tools/lib/item_source.hpp"
#include "tools/lib/output_file.hpp"

namespace nc::tools {

/** Hands out prepared items; after a sync it waits for the answer as a control does. */
class FakeItems final : public ItemSource {
 public:
  std::vector<nc_item> items;
  std::vector<nc_world> answers;
  std::map<uint32_t, double> common;
  std::vector<std::string> codes;
  std::string text_value;
  nc_alarm alarm_value = {};
  bool has_alarm = false, was_reset = false;
  uint32_t calling_line = 0;  // line of the main program that has called the sub programs

  nc_item& add(nc_item_kind kind, uint32_t line, uint8_t depth = 0) {
    nc_item item = {};
    item.serial = items.size() + 1;
    item.kind = static_cast<uint8_t>(kind);
    item.source = {line, depth ? 1000u : 0u, 1, depth, 0};
    items.push_back(item);
    return items.back();
  }
  nc_item& line(uint32_t at, nc_axes from, nc_axes to, double feed, nc_move_kind kind = NC_MOVE_LINE,
                uint8_t depth = 0) {
    nc_item& item = add(NC_ITEM_MOVE, at, depth);
    nc_move& m = item.u.move;
    m.kind = static_cast<uint8_t>(kind);
    m.plane = NC_PLANE_NONE;
    m.machine_start = from;
    m.machine = m.work = to;
    m.feed_mm_min = feed;
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += (to.v[i] - from.v[i]) * (to.v[i] - from.v[i]);
    m.length = __builtin_sqrt(sum);
    return item;
  }
  void mark(uint32_t at, nc_axes work, uint8_t depth = 0) {
    nc_item& item = add(NC_ITEM_MARK, at, depth);
    item.u.mark.work = work;
    item.u.mark.report = true;
    item.u.mark.stop = true;
  }
  void end(uint32_t at, nc_axes work, bool ok = true) {
    nc_item& item = add(NC_ITEM_END, at);
    item.u.end.ok = ok;
    item.u.end.work = work;
  }

  nc_status pull(uint32_t, nc_item* item) override {
    if (waiting_) return NC_WAITING;
    if (next_ == items.size()) return has_alarm ? NC_ALARMED : NC_ENDED;
    *item = items[next_++];
    waiting_ = item->kind == NC_ITEM_SYNC;
    return NC_OK;
  }
  nc_status answer(const nc_world& world) override {
    answers.push_back(world);
    waiting_ = false;
    return NC_OK;
  }
  nc_status reset() override {
    was_reset = true;
    return NC_OK;
  }
  uint32_t main_line(const nc_source& source) override { return source.depth == 0 ? source.line : calling_line; }
  bool alarm(nc_alarm* alarm) override {
    if (!has_alarm) return false;
    *alarm = alarm_value;
    return true;
  }
  bool text(uint32_t, nc_text* text) override {
    std::snprintf(text->s, sizeof text->s, "%s", text_value.c_str());
    return true;
  }
  unsigned modal_codes(uint32_t, char (*out)[8], unsigned capacity) override {
    unsigned n = 0;
    for (; n < codes.size() && n < capacity; ++n) std::snprintf(out[n], 8, "%s", codes[n].c_str());
    return n;
  }
  bool next_common(uint32_t from, uint32_t* number, double* value) override {
    const auto found = common.lower_bound(from);
    if (found == common.end()) return false;
    *number = found->first;
    *value = found->second;
    return true;
  }

 private:
  size_t next_ = 0;
  bool waiting_ = false;
};

/** A temporary file with a descriptor to write to. */
class ScratchFile {
 public:
  ScratchFile() : file_(std::tmpfile()) {}
  ~ScratchFile() { std::fclose(file_); }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  int descriptor() const { return fileno(file_); }
  std::string content() const {
    std::string text;
    std::rewind(file_);
    char buffer[4096];
    for (size_t n; (n = std::fread(buffer, 1, sizeof buffer, file_)) > 0;) text.append(buffer, n);
    return text;
  }

 private:
  std::FILE* file_;
};

inline nc_system_config xyz() {
  nc_config config;
  nc_config_init(&config);
  return config.system[0];
}

}  // namespace nc::tools
