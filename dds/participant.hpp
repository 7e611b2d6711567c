// SPDX-License-Identifier: Apache-2.0
// The entry to DDS: the network that it may use, the topics and their QoS. docs/dds.md has the same table.
#pragma once

#include <memory>
#include <string>

#include "dds/dds.h"
#include "dds/security.hpp"
#include "nc_dds.h"

namespace nc::dds {

inline constexpr unsigned kDefaultDomain = 0;
inline constexpr double kDefaultRateHz = 50;

// A configuration of Cyclone DDS with which it communicates only on this computer: interface lo, no multicast, peer 127.0.0.1.
std::string loopback_config();

// A configuration of Cyclone DDS with which it communicates over one interface of the network.
std::string network_config(const std::string& interface);

// True when CYCLONEDDS_URI has a configuration of the user, and not the one with which DDS stays on this computer.
bool user_configures();

struct Access {
  unsigned domain = kDefaultDomain;
  std::string network;   // interface ("eth0"); "" = that of CYCLONEDDS_URI, and where there is none, this computer only
  std::string security;  // folder of the identity; "" = without DDS Security
};

// False with a sentence in *error when the access is not one that may be had: over a network there are no commands without DDS Security, and an interface
// is used with it only.
bool may_access(const Access& access, bool commands, std::string* error);

// A participant of a domain. All participants of a domain of this process must have the same network.
class Participant {
 public:
  Participant() = default;
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;
  // The identity is that of access.security. False with a sentence in *error.
  bool open(const Access& access, std::string* error);
  dds_entity_t get() const { return participant_; }

 private:
  std::shared_ptr<dds_entity_t> domain_;
  dds_entity_t participant_ = 0;
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
  kServiceView,  // the four of the requests in the order of the rights
  kServiceOperate,
  kServiceSetUp,
  kServiceMaintain,
  kServiceReply,
};

const char* topic_name(Topic topic);
const dds_topic_descriptor_t* topic_type(Topic topic);

// Make a writer or a reader with the QoS of the topic, in the partition of a machine (for a reader "*" = all).
// `period_s`: period of the status. `newest`: so many samples of each instance are kept for readers that do not take them, 0 = as the topic has it. Zero or less = failed, and *error says why. A partner with an incompatible QoS is reported on
// standard error, with the topic and the policy.
dds_entity_t make_writer(dds_entity_t participant, Topic topic, const std::string& partition, double period_s,
                         std::string* error, int newest = 0);
dds_entity_t make_reader(dds_entity_t participant, Topic topic, const std::string& partition, std::string* error);

}  // namespace nc::dds
