// SPDX-License-Identifier: Apache-2.0
// A subscriber of status and alarms: the part of ncmon that knows DDS.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "dds/monitor_view.hpp"
#include "dds/participant.hpp"

namespace nc::dds {

class Monitor {
 public:
  // `machine`: the partition, "" = the first control that is heard.
  Monitor(unsigned domain, std::string machine) : domain_(domain), machine_(std::move(machine)) {}
  bool open(std::string* error);
  // The table of signals and their values, from now on (or never again).
  bool watch_signals(bool on, std::string* error);
  // Waits at most `timeout_ns` for news and takes them. True when there were some.
  bool wait(std::int64_t timeout_ns);

  const MonitorView& view() const { return view_; }
  bool heard() const { return heard_; }  // a status has come
  bool ended() const { return view_.ended; }  // ... and was taken back: the control has ended
  std::uint64_t samples() const { return samples_; }
  std::uint64_t changes() const { return changes_; }     // of the view: a status came, or none comes any more
  // A gateway publishes this machine (any machine where none was named), whether or not its control lives.
  bool gateway_there() const;
  std::int64_t last_latency_ns() const { return latency_ns_; }  // of the last status: scan to here

 private:
  void take_status();
  void take_alarms();
  void take_signals();
  void show_signals(const nc_SignalImage& image);
  bool wait_for(dds_entity_t reader);

  const unsigned domain_;
  std::string machine_;
  Participant participant_;
  dds_entity_t status_ = 0, alarm_ = 0, waitset_ = 0, signals_ = 0, signal_table_ = 0;
  std::map<std::string, SignalView> signal_rows_;  // what the table says of them, by name
  std::map<std::string, std::map<unsigned, AlarmView>> alarms_of_;  // by control and slot; of one control as soon as that is known
  MonitorView view_;
  bool heard_ = false;
  std::uint64_t samples_ = 0, changes_ = 0;
  std::int64_t latency_ns_ = 0;
};

}  // namespace nc::dds
