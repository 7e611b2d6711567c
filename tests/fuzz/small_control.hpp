// SPDX-License-Identifier: Apache-2.0
// A small control for fuzz targets, and a puller of its items that checks what must always be true.
#pragma once

#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include "fuzz/input.hpp"
#include "nc/nc.h"
#include "runtime/programs/encoding.hpp"

namespace nc::fuzz {

inline nc_config small_config(unsigned systems) {
  nc_config config;
  nc_config_init(&config);
  config.look_ahead = 64;
  config.programs = 4;
  config.tool_offsets = 4;
  config.work_offsets = 4;
  config.window_bytes = 512;
  config.system_count = static_cast<std::uint8_t>(systems);
  for (unsigned s = 0; s < systems; ++s) {
    config.system[s].axis_count = 3;
    for (unsigned a = 0; a < 3; ++a) {
      nc_axis_config& axis = config.system[s].axis[a];
      axis.name = "XYZ"[a];
      axis.rapid = 200;
      axis.max_velocity = 150;
      axis.max_acceleration = 2000;
      axis.in_position = 0.01;
    }
  }
  return config;
}

class SmallControl {
 public:
  explicit SmallControl(unsigned systems = 1) : config_(small_config(systems)) {
    const std::size_t size = nc_memory_required(&config_);
    memory_.reset(std::aligned_alloc(64, (size + 63) / 64 * 64));
    require(size != 0 && memory_ != nullptr);
    control_ = nc_create(&config_, memory_.get(), size, nullptr);
    require(control_ != nullptr);
  }
  nc_control* get() { return control_; }
  const nc_config& config() const { return config_; }

 private:
  struct Release {
    void operator()(void* memory) const { std::free(memory); }
  };
  nc_config config_;
  std::unique_ptr<void, Release> memory_;
  nc_control* control_ = nullptr;
};

/// Requires that a text ends within its array, and is valid UTF-8.
template <std::size_t kSize>
void require_text(const char (&text)[kSize]) {
  const std::size_t length = strnlen(text, kSize);
  require(length < kSize);
  require(nc::rt::valid_utf8({text, length}) == std::string(text, length));
}

inline void require_finite(const nc_axes& axes) {
  for (const double v : axes.v) require(std::isfinite(v));
}

/// The parts of an item by which two runs of one program are compared.
struct Seen {
  std::uint8_t kind = 0;
  nc_axes machine{};
  bool operator==(const Seen& other) const {
    return kind == other.kind && std::equal(std::begin(machine.v), std::end(machine.v), std::begin(other.machine.v));
  }
};

/// The items of one part system, one at a time.
class Puller {
 public:
  Puller(nc_control* control, unsigned system) : control_(control), system_(system) {}
  /// False when no item came: at the end, when the budget is used up, or when another part system has to go on first.
  bool pull() {
    nc_item item;
    status_ = nc_pull(control_, system_, 16, &item);
    if (status_ == NC_BUDGET || status_ == NC_WAITING) return false;
    if (status_ != NC_OK) {
      require((status_ == NC_ENDED || status_ == NC_ALARMED) && ended_);  // the end is an item
      look_at_alarm();
      return false;
    }
    require(!ended_ && item.serial == serial_ + 1);
    serial_ = item.serial;
    take(item);
    return true;
  }
  void pull_all(unsigned most_items, unsigned most_idle) {
    for (unsigned idle = 0; idle < most_idle && seen.size() < most_items;) {
      if (pull()) continue;
      if (done()) return;
      ++idle;
    }
  }
  bool done() const { return status_ == NC_ENDED || status_ == NC_ALARMED; }
  bool alarmed() const { return status_ == NC_ALARMED; }
  nc_status status() const { return status_; }

  std::vector<Seen> seen;

 private:
  void take(const nc_item& item) {
    Seen& last = seen.emplace_back();
    last.kind = item.kind;
    if (item.kind == NC_ITEM_MOVE) {
      const nc_move& move = item.u.move;
      require_finite(move.work);
      require_finite(move.machine);
      require_finite(move.machine_start);
      require(std::isfinite(move.length) && move.length > 0);
      machine_ = last.machine = move.machine;
    } else if (item.kind == NC_ITEM_SYNC) {
      nc_world world{};
      world.machine = machine_;
      world.clock_ms = 1767225600000 + static_cast<std::int64_t>(serial_);
      require(nc_answer(control_, system_, &world) == NC_OK);
    } else if (item.kind == NC_ITEM_END) {
      require_finite(item.u.end.work);
      ended_ = true;
    }
  }
  void look_at_alarm() const {
    nc_alarm alarm;
    require((nc_alarm_get(control_, system_, &alarm) == NC_OK) == (status_ == NC_ALARMED));
    if (status_ != NC_ALARMED) return;
    require(alarm.code[0] != 0 && alarm.detail.s[0] != 0);
    require_text(alarm.code);
    require_text(alarm.detail.s);
  }

  nc_control* control_;
  unsigned system_;
  std::uint64_t serial_ = 0;
  nc_axes machine_{};
  nc_status status_ = NC_OK;
  bool ended_ = false;
};

}  // namespace nc::fuzz
