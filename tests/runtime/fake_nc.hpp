// SPDX-License-Identifier: Apache-2.0
// An NC for the tests of the scan: a recorder with the run states of libnc and nothing else. It moves axis 0
// by `step` per cycle while it runs and ends after `cycles` of them.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "runtime/nc_port.hpp"

namespace nc::test {

class FakeNc : public rt::NcPort {
 public:
  std::vector<std::string>* log = nullptr;
  nc_inputs last_in{};
  nc_outputs out{};
  unsigned cycles_left = 0, cycles = 1000000;
  double step = 0.01;
  unsigned resets = 0, selects = 0;
  nc_status select_status = NC_OK, reset_status = NC_OK;
  std::uint32_t switches_seen = 0;
  std::string mdi;
  bool alarm_next = false;
  std::atomic<bool> end_event{false};  // from the scan to the feeder

  FakeNc() { out.distance_zero = true; }

  void cycle(const nc_inputs* in, nc_outputs* result) noexcept override {
    if (log != nullptr) log->push_back("nc");
    const bool start = in->cycle_start && !last_in.cycle_start;
    const bool reset = in->reset && !last_in.reset;
    if (reset) out.state = NC_STATE_IDLE;
    if (in->alarm && out.state != NC_STATE_IDLE) out.state = NC_STATE_ALARM;
    if (start && !in->alarm && !in->feed_hold) {
      if (out.state == NC_STATE_IDLE) cycles_left = cycles;
      out.state = NC_STATE_RUNNING;
    }
    if (in->feed_hold && out.state == NC_STATE_RUNNING) out.state = NC_STATE_HOLD;
    if (alarm_next && out.state == NC_STATE_RUNNING) out.state = NC_STATE_ALARM;
    out.distance_zero = true;
    out.velocity.v[0] = 0;
    if (out.state == NC_STATE_RUNNING) {
      out.command.v[0] += step;
      out.distance_zero = false;
      if (--cycles_left == 0) {
        out.state = NC_STATE_IDLE;
        end_event = true;
      }
    }
    if (in->manual[0].kind == NC_MANUAL_JOG) {
      out.command.v[0] += in->manual[0].velocity * 0.001;
      out.distance_zero = false;
    }
    out.manual_allowed = out.state == NC_STATE_IDLE || out.state == NC_STATE_STOPPED;
    last_in = *in;
    *result = out;
  }
  nc_status feed(std::uint32_t) override { return NC_WAITING; }
  nc_status poll_event(unsigned, nc_event* event, std::uint64_t* dropped) override {
    *dropped = 0;
    if (!end_event.exchange(false)) return NC_WAITING;
    *event = {};
    event->kind = NC_ITEM_END;
    return NC_OK;
  }
  nc_status select(unsigned, unsigned) override {
    ++selects;
    return select_status;
  }
  nc_status load_mdi(unsigned, const char* text, std::size_t length) override {
    mdi.assign(text, length);
    return NC_OK;
  }
  nc_status reset(unsigned) override {
    ++resets;
    return reset_status;
  }
  void switches(unsigned, std::uint32_t optional_skip) override { switches_seen = optional_skip; }
  nc_status alarm(unsigned, nc_alarm*) override { return NC_E_NOT_FOUND; }
  nc_status modal(unsigned, std::uint32_t, nc_modal*) override { return NC_E_NOT_FOUND; }
  nc_status text(unsigned, std::uint32_t, nc_text*) override { return NC_E_NOT_FOUND; }
};

}  // namespace nc::test
