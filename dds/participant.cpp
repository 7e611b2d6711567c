// SPDX-License-Identifier: Apache-2.0
// Topics and QoS. See participant.hpp.
#include "dds/participant.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <utility>

#include "dds/loopback_bind.hpp"
#include "runtime/share/text.hpp"

namespace nc::dds {
namespace {

constexpr dds_duration_t kBlocking = DDS_MSECS(100);  // longest time for which a writer waits for a slow reader
constexpr dds_duration_t kLiveliness = DDS_SECS(1);
constexpr dds_duration_t kAckLifespan = DDS_SECS(10);
constexpr dds_duration_t kRequestBlocking = DDS_SECS(5);
constexpr dds_duration_t kRequesterLiveliness = DDS_SECS(2);  // what a client has begun ends so long after its process stands still
constexpr dds_duration_t kRequestLifespan = DDS_SECS(5);
constexpr dds_duration_t kAckBlocking = DDS_MSECS(5);  // short, because an answer that is not taken is kept and tried again
constexpr dds_duration_t kNewestAckBlocking = DDS_MSECS(1);

struct Row {
  Topic topic;
  const char* name;
  const dds_topic_descriptor_t* type;
  bool durable;  // TRANSIENT_LOCAL: a reader that comes late gets the last value
  int depth;     // 0 = KEEP_ALL
};
const Row kTopics[] = {
    {Topic::kMachineInfo, "nc_MachineInfo", &nc_MachineInfo_desc, true, 1},
    {Topic::kStatus, "nc_Status", &nc_Status_desc, true, 1},
    {Topic::kAlarm, "nc_Alarm", &nc_Alarm_desc, true, 1},
    {Topic::kAlarmHistory, "nc_AlarmHistory", &nc_AlarmHistory_desc, true, 1},
    {Topic::kSignalTable, "nc_SignalTable", &nc_SignalTable_desc, true, 1},
    {Topic::kSignalImage, "nc_SignalImage", &nc_SignalImage_desc, false, 1},
    {Topic::kCommand, "nc_Command", &nc_Command_desc, false, 0},
    {Topic::kCommandAck, "nc_CommandAck", &nc_CommandAck_desc, false, 0},
    {Topic::kStatusCore, "nc_Status_v1", &nc_Status_v1_desc, true, 1},
    {Topic::kAlarmCore, "nc_Alarm_v1", &nc_Alarm_v1_desc, true, 1},
    {Topic::kServiceView, "nc_ServiceView", &nc_ServiceRequest_desc, false, 0},
    {Topic::kServiceOperate, "nc_ServiceOperate", &nc_ServiceRequest_desc, false, 0},
    {Topic::kServiceSetUp, "nc_ServiceSetUp", &nc_ServiceRequest_desc, false, 0},
    {Topic::kServiceMaintain, "nc_ServiceMaintain", &nc_ServiceRequest_desc, false, 0},
    {Topic::kServiceReply, "nc_ServiceReply", &nc_ServiceReply_desc, false, 0},
};

const Row& row_of(Topic topic) {
  for (const Row& row : kTopics)
    if (row.topic == topic) return row;
  return kTopics[0];
}

const char* policy_name(std::uint32_t id) {
  switch (id) {
    case DDS_DURABILITY_QOS_POLICY_ID: return "durability";
    case DDS_PRESENTATION_QOS_POLICY_ID: return "presentation";
    case DDS_DEADLINE_QOS_POLICY_ID: return "deadline";
    case DDS_LATENCYBUDGET_QOS_POLICY_ID: return "latency budget";
    case DDS_OWNERSHIP_QOS_POLICY_ID: return "ownership";
    case DDS_LIVELINESS_QOS_POLICY_ID: return "liveliness";
    case DDS_RELIABILITY_QOS_POLICY_ID: return "reliability";
    case DDS_DESTINATIONORDER_QOS_POLICY_ID: return "destination order";
    case DDS_TYPE_CONSISTENCY_ENFORCEMENT_QOS_POLICY_ID: return "type consistency";
    case DDS_DATA_REPRESENTATION_QOS_POLICY_ID: return "data representation";
    default: return "another policy";
  }
}

void warn(const char* whose, std::uint32_t policy, void* name) {
  std::fprintf(stderr, "warning: a %s of topic %s asks for another QoS than it is offered (%s): they do not talk\n",
               whose, static_cast<const char*>(name), policy_name(policy));
}
// Different partitions are not reported: there may be other controls and their monitors in the domain.
void on_offered(dds_entity_t, const dds_offered_incompatible_qos_status_t status, void* name) {
  if (status.last_policy_id == DDS_PARTITION_QOS_POLICY_ID) return;
  warn("reader", status.last_policy_id, name);
}
void on_requested(dds_entity_t, const dds_requested_incompatible_qos_status_t status, void* name) {
  if (status.last_policy_id == DDS_PARTITION_QOS_POLICY_ID) return;
  warn("reader here, of a writer elsewhere,", status.last_policy_id, name);
}

struct DeleteQos {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
struct DeleteListener {
  void operator()(dds_listener_t* listener) const { dds_delete_listener(listener); }
};
using Qos = std::unique_ptr<dds_qos_t, DeleteQos>;
using Listener = std::unique_ptr<dds_listener_t, DeleteListener>;

Qos common_qos(const Row& row) {
  Qos qos(dds_create_qos());
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, kBlocking);
  dds_qset_durability(qos.get(), row.durable ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  if (row.depth > 0) dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, row.depth);
  else dds_qset_history(qos.get(), DDS_HISTORY_KEEP_ALL, DDS_LENGTH_UNLIMITED);
  return qos;
}

// Creates the topic and the publisher or subscriber in the partition. False with a sentence in *error.
bool prepare(dds_entity_t participant, const Row& row, const std::string& partition, bool writer, dds_entity_t* topic,
             dds_entity_t* group, std::string* error) {
  *topic = dds_create_topic(participant, row.type, row.name, nullptr, nullptr);
  if (*topic < 0) {
    *error = std::string("topic ") + row.name + ": " + dds_strretcode(*topic);
    return false;
  }
  Qos qos(dds_create_qos());
  dds_qset_partition1(qos.get(), partition.c_str());
  *group = writer ? dds_create_publisher(participant, qos.get(), nullptr)
                  : dds_create_subscriber(participant, qos.get(), nullptr);
  if (*group >= 0) return true;
  *error = std::string("partition ") + partition + ": " + dds_strretcode(*group);
  return false;
}

}  // namespace

std::string loopback_config() {
  return "<CycloneDDS><Domain id=\"any\">"
         "<General><Interfaces><NetworkInterface name=\"lo\" multicast=\"false\"/></Interfaces>"
         "<AllowMulticast>false</AllowMulticast></General>"
         "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>32</MaxAutoParticipantIndex>"
         "<Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery>"
         "</Domain></CycloneDDS>";
}

std::string network_config(const std::string& interface) {
  std::string name;
  for (const char c : interface) {  // in an attribute of XML
    if (c == '&') name += "&amp;";
    else if (c == '<') name += "&lt;";
    else if (c == '"') name += "&quot;";
    else name += c;
  }
  return "<CycloneDDS><Domain id=\"any\">"
         "<General><Interfaces><NetworkInterface name=\"" + name + "\"/></Interfaces></General>"
         "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>32</MaxAutoParticipantIndex></Discovery>"
         "</Domain></CycloneDDS>";
}

// A program that imports nc_dds.py sets loopback_config() in its environment, and the programs that it starts inherit that; such a setting is not the user's.
bool user_configures() {
  const char* uri = std::getenv("CYCLONEDDS_URI");
  return uri != nullptr && uri[0] != 0 && uri != loopback_config();
}

bool may_access(const Access& access, bool commands, std::string* error) {
  if (!access.network.empty() && access.security.empty())
    *error = "--network needs --security FOLDER: without DDS Security everybody in the network would be heard";
  else if (!access.network.empty() && user_configures())
    *error = "--network and CYCLONEDDS_URI both say which network: one of them";
  else if (commands && access.security.empty() && user_configures())
    *error = "--commands with the network of CYCLONEDDS_URI needs --security FOLDER: without DDS Security commands stay on this computer";
  else
    return true;
  return false;
}

namespace {

// The domain with its configuration. The participants of this process share it, because a domain is made once and is deleted with all its participants.
std::shared_ptr<dds_entity_t> domain_of(const Access& access, std::string* error) {
  static std::map<unsigned, std::weak_ptr<dds_entity_t>> domains;
  std::shared_ptr<dds_entity_t> domain = domains[access.domain].lock();
  if (domain) return domain;
  if (access.network.empty()) bind_to_loopback_only();
  const std::string config = access.network.empty() ? loopback_config() : network_config(access.network);
  const dds_entity_t made = dds_create_domain(access.domain, config.c_str());
  if (made < 0) {
    *error = "DDS domain " + std::to_string(access.domain) + ": " + dds_strretcode(made);
    return nullptr;
  }
  domain = std::shared_ptr<dds_entity_t>(new dds_entity_t(made), [](dds_entity_t* entity) {
    dds_delete(*entity);
    delete entity;
  });
  domains[access.domain] = domain;
  return domain;
}

// Sets the identity in the QoS of a participant.
bool secure(const std::string& folder, dds_qos_t* qos, std::string* error) {
  Identity identity;
  SecurityPlugins plugins;
  if (!read_identity(folder, &identity, error) || !find_plugins(&plugins, error)) return false;
  const std::int64_t now_s = rt::share::wall_ns() / 1'000'000'000;
  if (std::string why = invalid_text(identity, now_s); !why.empty()) {
    *error = std::move(why);
    return false;
  }
  set_security(qos, identity, plugins);
  return true;
}

}  // namespace

Participant::~Participant() {
  if (participant_ > 0) dds_delete(participant_);
}

bool Participant::open(const Access& access, std::string* error) {
  if (!access.network.empty() || !user_configures()) {
    domain_ = domain_of(access, error);
    if (!domain_) return false;
  }
  const Qos qos(dds_create_qos());
  if (!access.security.empty() && !secure(access.security, qos.get(), error)) return false;
  participant_ = dds_create_participant(access.domain, qos.get(), nullptr);
  if (participant_ > 0) return true;
  *error = "no participant in DDS domain " + std::to_string(access.domain) + ": " + dds_strretcode(participant_);
  return false;
}

const char* topic_name(Topic topic) {
  return row_of(topic).name;
}

const dds_topic_descriptor_t* topic_type(Topic topic) {
  return row_of(topic).type;
}

dds_entity_t make_writer(dds_entity_t participant, Topic topic, const std::string& partition, double period_s,
                         std::string* error, int newest) {
  const Row& row = row_of(topic);
  dds_entity_t type = 0, group = 0;
  if (!prepare(participant, row, partition, true, &type, &group, error)) return std::min(type, group);
  const Qos qos = common_qos(row);
  if (newest > 0) dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, newest);
  if (topic == Topic::kStatus) {
    dds_qset_deadline(qos.get(), static_cast<dds_duration_t>(3e9 * period_s));
    dds_qset_liveliness(qos.get(), DDS_LIVELINESS_MANUAL_BY_TOPIC, kLiveliness);
  }
  if (topic == Topic::kCommandAck) {
    dds_qset_lifespan(qos.get(), kAckLifespan);
    dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, newest > 0 ? kNewestAckBlocking : kAckBlocking);
  }
  if (topic >= Topic::kServiceView && topic <= Topic::kServiceMaintain) {
    dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, kRequestBlocking);
    dds_qset_liveliness(qos.get(), DDS_LIVELINESS_AUTOMATIC, kRequesterLiveliness);
    if (topic != Topic::kServiceView) dds_qset_lifespan(qos.get(), kRequestLifespan);  // what is late is not to happen any more
  }
  // A disposed instance means that the control has removed it. When only the gateway ends, instances must not be disposed; they just lose their writer.
  dds_qset_writer_data_lifecycle(qos.get(), false);
  const Listener listener(dds_create_listener(const_cast<char*>(row.name)));
  dds_lset_offered_incompatible_qos(listener.get(), &on_offered);
  const dds_entity_t writer = dds_create_writer(group, type, qos.get(), listener.get());
  if (writer < 0) *error = std::string("writer of ") + row.name + ": " + dds_strretcode(writer);
  return writer;
}

dds_entity_t make_reader(dds_entity_t participant, Topic topic, const std::string& partition, std::string* error) {
  const Row& row = row_of(topic);
  dds_entity_t type = 0, group = 0;
  if (!prepare(participant, row, partition, false, &type, &group, error)) return std::min(type, group);
  const Qos qos = common_qos(row);
  if (topic == Topic::kStatus) dds_qset_liveliness(qos.get(), DDS_LIVELINESS_MANUAL_BY_TOPIC, kLiveliness);
  if (topic == Topic::kCommand) {
    dds_qset_resource_limits(qos.get(), 256, 64, 64);
    dds_qset_reader_data_lifecycle(qos.get(), DDS_SECS(10), DDS_SECS(10));
  }
  if (topic >= Topic::kServiceView && topic <= Topic::kServiceMaintain) {
    dds_qset_resource_limits(qos.get(), 64, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
    dds_qset_reader_data_lifecycle(qos.get(), DDS_SECS(10), DDS_SECS(10));
  }
  const Listener listener(dds_create_listener(const_cast<char*>(row.name)));
  dds_lset_requested_incompatible_qos(listener.get(), &on_requested);
  const dds_entity_t reader = dds_create_reader(group, type, qos.get(), listener.get());
  if (reader < 0) *error = std::string("reader of ") + row.name + ": " + dds_strretcode(reader);
  return reader;
}

}  // namespace nc::dds
