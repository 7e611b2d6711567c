// SPDX-License-Identifier: Apache-2.0
// A subscriber of status and alarms: the part of ncmon that uses DDS.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "dds/identity_keeper.hpp"
#include "dds/monitor_link.hpp"
#include "dds/monitor_view.hpp"

namespace nc::dds {

class Monitor {
 public:
  // `machine`: the partition, "" = the first control that is received. `tell`: prints a sentence about the identity, when its files change or it ends.
  Monitor(Access access, std::string machine, std::function<void(const std::string&)> tell);
  Monitor(const Monitor&) = delete;
  Monitor& operator=(const Monitor&) = delete;
  bool open(std::string* error);
  // Switches the subscription to the table of signals and their values on or off.
  bool watch_signals(bool on, std::string* error);
  // Waits at most `timeout_ns` for new samples and takes them. True when there were some.
  bool wait(std::int64_t timeout_ns);

  const MonitorView& view() const { return view_; }
  bool heard() const { return heard_; }  // a status has come
  bool ended() const { return view_.ended; }  // the status was disposed after that: the control has ended
  std::uint64_t samples() const { return samples_; }
  std::uint64_t changes() const { return changes_; }     // counts changes of the view: a status or signals have come, or the status has ended
  // True when a gateway publishes this machine (any machine if none was named), whether or not its control is running.
  bool gateway_there() const;
  std::int64_t last_latency_ns() const { return latency_ns_; }  // time from the scan of the last status to its arrival here

 private:
  std::unique_ptr<SecuredPart> make(std::string* error) const;
  void change(const MonitorLink* from, const MonitorLink* to);
  const MonitorLink* link() const;
  void take(const MonitorLink& link);
  int take_status(dds_entity_t reader);
  int take_alarms(dds_entity_t reader);
  void take_signals(const MonitorLink& link);
  void show_signals(const nc_SignalImage& image);

  const Access access_;
  const std::string partition_;
  std::string machine_;
  const std::function<void(const std::string&)> tell_;
  bool signals_ = false;  // they are watched
  bool opened_ = false;
  std::unique_ptr<MonitorLink> open_link_;  // without DDS Security
  IdentityKeeper keeper_;                   // with it
  std::map<std::string, SignalView> signal_rows_;  // the rows of the table, keyed by the name of the signal
  std::map<std::string, std::map<unsigned, AlarmView>> alarms_of_;  // keyed by control and slot; only one control once that is known
  MonitorView view_;
  bool heard_ = false;
  std::uint64_t samples_ = 0, changes_ = 0;
  std::int64_t latency_ns_ = 0;
};

}  // namespace nc::dds
