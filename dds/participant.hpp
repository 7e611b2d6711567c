// SPDX-License-Identifier: Apache-2.0
// The entry to DDS: the network that it may use, the topics and their QoS. docs/dds.md has the same table.
#pragma once

#include <string>

#include "dds/dds.h"
#include "nc_dds.h"

namespace nc::dds {

inline constexpr unsigned kDefaultDomain = 0;
inline constexpr double kDefaultRateHz = 50;

// A configuration of Cyclone DDS with which it communicates only on this computer: interface lo, no multicast, peer 127.0.0.1.
std::string loopback_config();

// A participant of a domain. If CYCLONEDDS_URI is set, it determines the network that is used; otherwise DDS stays on this computer.
class Participant {
 public:
  Participant() = default;
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;
  bool open(unsigned domain, std::string* error);
  dds_entity_t get() const { return participant_; }

 private:
  dds_entity_t domain_ = 0, participant_ = 0;
};

enum class Topic {
  kMachineInfo,
  kStatus,
  kAlarm,
  kAlarmHistory,
  kSignalTable,
  kSignalImage,
  kCommand,
  kCommandAck,
  kStatusCore,
  kAlarmCore,
};

const char* topic_name(Topic topic);
const dds_topic_descriptor_t* topic_type(Topic topic);

// Make a writer or a reader with the QoS of the topic, in the partition of a machine (for a reader "*" = all).
// `period_s`: period of the status. Zero or less = failed, and *error says why. A partner with an incompatible QoS is reported on
// standard error, with the topic and the policy.
dds_entity_t make_writer(dds_entity_t participant, Topic topic, const std::string& partition, double period_s,
                         std::string* error);
dds_entity_t make_reader(dds_entity_t participant, Topic topic, const std::string& partition, std::string* error);

}  // namespace nc::dds
