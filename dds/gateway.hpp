// SPDX-License-Identifier: Apache-2.0
// The gateway reads the segment of ncrtd, publishes it over DDS and passes on commands. It is a process of its own, so
// that nothing from the network can stop the machine. It waits for ncrtd, and finds it again after a restart.
//
// There are two threads: run() publishes and is woken by each update of the segment; the command thread is woken by DDS.
//
// A gateway with new keys takes the place of another one of this process (identity_keeper.hpp): it stands by first, which means that it publishes and
// takes no commands, and then takes over.
#pragma once

#include <atomic>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "dds/convert.hpp"
#include "dds/participant.hpp"
#include "dds/service_gateway.hpp"
#include "runtime/share/segment.hpp"

namespace nc::dds {

struct GatewayOptions {
  std::string share;    // name of the segment and of the DDS partition
  Access access;
  double rate_hz = kDefaultRateHz;
  bool commands = false;
  bool services = true;      // the services over DDS
  std::string socket;        // of the local services, "" = where they usually are
};

class Gateway {
 public:
  explicit Gateway(const GatewayOptions& options);
  ~Gateway();
  // False with a sentence in *error.
  bool open(std::string* error);
  // To be called before open().
  void stand_by() { stands_by_ = true; }
  // From here on this gateway takes the commands and the requests for services in place of another one, which stands by. None is lost or taken twice, and clients
  // keep control and all that they have begun.
  void take_over(Gateway* other);
  // Number of readers and writers of others that this gateway talks with.
  unsigned partners() const;
  // Publishes until stop() is called.
  void run();
  // May also be called from a signal handler.
  void stop() { stop_ = true; }

 private:
  struct Shown {  // an active alarm that is published
    share::Entry entry{};
    std::uint32_t slot = 0;
  };
  bool attach();
  bool claim_commands(std::string* error);
  ServiceGate service_gate();
  bool passes_services();
  void detach(const char* why);
  bool look();
  bool publish_status(std::int64_t now_ns);
  void publish_alarms();
  void clear_alarm(const Shown& shown);
  void publish_history();
  void publish_signals(std::int64_t now_ns);
  void publish_acks();
  void answer(const share::Ack& ack);
  bool answers_wait();
  bool write_answer(const share::Ack& ack);
  bool write_newest(const nc_CommandAck& sample);
  void take_commands();
  bool take_samples();
  void miss_inherited();
  void client_gone(const share::Text<32>& name, std::uint64_t writer);
  void command_thread();
  void put(const share::Request& request);
  void refuse(const share::Request& request, share::AckReason reason, const char* text);
  bool write(dds_entity_t writer, const void* sample);
  void say(const std::string& text);

  const GatewayOptions options_;
  const std::string partition_;
  const std::int64_t period_ns_;
  std::atomic<bool> stop_{false};

  Participant participant_;
  dds_entity_t machine_ = 0, status_ = 0, alarm_ = 0, history_ = 0, signals_ = 0, signal_table_ = 0, status_core_ = 0, alarm_core_ = 0;
  dds_entity_t command_ = 0, ack_ = 0, waitset_ = 0;
  dds_entity_t newest_acks_ = 0;  // writes answers while a reader does not take those of ack_

  std::mutex segment_mutex_;  // the command thread must not write commands while run() closes the segment
  share::SegmentReader segment_;
  std::atomic<bool> stands_by_{false};
  std::atomic<bool> may_command_{false};
  std::atomic<bool> another_commands_{false};  // another gateway passes the commands to this control
  std::int64_t next_claim_ns_ = 0;
  share::HeartbeatWatch heart_{300'000'000};
  std::string said_;

  share::StatusBlock block_{};
  std::uint64_t written_scan_ = 0;
  bool written_any_ = false;
  std::int64_t next_status_ns_ = 0, next_signals_ns_ = 0, forced_signals_ns_ = 0, next_attach_ns_ = 0;
  std::map<std::uint64_t, Shown> active_;  // keyed by the number of the occurrence
  std::uint64_t history_sequence_ = 0;
  std::unique_ptr<share::HistoryBlock> history_block_;  // the history that has been published
  std::unique_ptr<share::PointsBlock> points_, last_points_;
  std::unique_ptr<share::SignalsBlock> control_signals_, last_control_signals_;
  std::unique_ptr<SignalSample> signal_sample_;
  std::vector<nc_Command> received_;

  std::mutex passing_mutex_;  // held by who passes commands or answers between DDS and the segment
  std::mutex answers_mutex_;
  std::deque<share::Ack> answers_;  // answers that are not published yet, in their order
  std::int64_t untaken_since_ns_ = 0;  // since when ack_ has no room for the next answer, 0 = it has
  bool newest_only_ = false;           // answers are written by newest_acks_
  std::uint64_t lost_answers_ = 0;     // that it had no room for either, since it writes them

  struct Client {
    share::Text<32> name{};
    std::uint64_t writer = 0;
    std::int64_t last_ns = 0;  // source time stamp of the last command that was taken
  };
  std::map<dds_instance_handle_t, Client> clients_;  // of the commands that this gateway has received
  std::map<std::string, Client> inherited_;  // clients of the gateway before this one, from which nothing has come here yet; by their names
  std::int64_t next_miss_ns_ = 0;
  std::thread commands_;
  std::unique_ptr<ServiceGateway> services_;  // ends before the participant does
};

}  // namespace nc::dds
