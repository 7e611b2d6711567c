// SPDX-License-Identifier: Apache-2.0
// A subscriber with the DDS of another maker, eProsima Fast DDS, for the core topics nc_Status_v1 and nc_Alarm_v1: prints one line for each sample,
// for fastdds_test.py. It is built if Fast DDS is installed (Debian: libfastrtps-dev).
//
//   fastdds_peer DOMAIN SECONDS
//
// The types are decoded by hand, field by field in the order of dds/nc_dds.idl: for a final type the IDL is all that a partner with another DDS
// needs.
#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastrtps/utils/md5.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace eprosima::fastdds::dds;
using eprosima::fastcdr::Cdr;
using eprosima::fastrtps::rtps::SerializedPayload_t;
using eprosima::fastrtps::types::ReturnCode_t;

struct Status {
  std::uint32_t part_system = 0, mode = 0, run_state = 0, stop_cause = 0, program_number = 0, line = 0, percent = 0, tool = 0, axis_count = 0,
                alarm_count = 0;
  std::string machine, program, axis_names;
  std::uint64_t scan = 0;
  std::int64_t time_ns = 0;
  double feed_override = 0, rapid_override = 0, feed = 0, spindle = 0;
  std::array<double, 8> commanded{}, actual{}, work{}, distance_to_go{};

  void read(Cdr& from) {
    from >> part_system >> machine >> scan >> time_ns >> mode >> run_state >> stop_cause >> program >> program_number >> line >> percent >>
        feed_override >> rapid_override >> feed >> spindle >> tool >> axis_count >> axis_names >> commanded >> actual >> work >> distance_to_go >>
        alarm_count;
  }
  void print() const {
    std::printf("status %s system %u scan %llu state %u program \"%s\" line %u axes %s work %.3f %.3f alarms %u\n", machine.c_str(), part_system,
                static_cast<unsigned long long>(scan), run_state, program.c_str(), line, axis_names.c_str(), work[0], work[1], alarm_count);
  }
  static constexpr const char* kType = "nc::Status_v1";
  static constexpr std::uint32_t kLargest = 1024;
};

struct Alarm {
  std::uint32_t slot = 0, part_system = 0, line = 0;
  std::uint64_t id = 0;
  std::string machine, code, text, axis;
  std::int64_t raised_ns = 0;

  void read(Cdr& from) { from >> slot >> id >> machine >> part_system >> code >> text >> axis >> line >> raised_ns; }
  void print() const { std::printf("alarm %s %s \"%s\" line %u\n", machine.c_str(), code.c_str(), text.c_str(), line); }
  static constexpr const char* kType = "nc::Alarm_v1";
  static constexpr std::uint32_t kLargest = 1024;
};

// Both topics have two keys, an unsigned long and the name of the machine.
template <class T>
class CoreType final : public TopicDataType {
 public:
  CoreType() {
    setName(T::kType);
    m_typeSize = T::kLargest;
    m_isGetKeyDefined = true;
  }
  bool serialize(void*, SerializedPayload_t*) override { return false; }  // it only listens
  bool deserialize(SerializedPayload_t* payload, void* to) override {
    try {
      eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->length);
      Cdr from(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
      from.read_encapsulation();
      static_cast<T*>(to)->read(from);
      return true;
    } catch (const eprosima::fastcdr::exception::Exception& error) {
      std::printf("error: %s: %s\n", T::kType, error.what());
      return false;
    }
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void*) override {
    return [] { return T::kLargest; };
  }
  void* createData() override { return new T; }
  void deleteData(void* data) override { delete static_cast<T*>(data); }
  bool getKey(void* data, eprosima::fastrtps::rtps::InstanceHandle_t* handle, bool) override {
    // Longer than 16 bytes: MD5 of the key members, big-endian, in their order.
    const T& sample = *static_cast<T*>(data);
    std::vector<unsigned char> key;
    const auto put = [&key](std::uint32_t number) {
      for (unsigned i = 0; i < 4; ++i) key.push_back(static_cast<unsigned char>(number >> (24 - 8 * i) & 0xff));
    };
    put(number_of(sample));
    put(static_cast<std::uint32_t>(sample.machine.size()) + 1);
    key.insert(key.end(), sample.machine.begin(), sample.machine.end());
    key.push_back(0);
    MD5 digest;
    digest.init();
    digest.update(key.data(), static_cast<MD5::size_type>(key.size()));
    digest.finalize();
    for (unsigned i = 0; i < 16; ++i) handle->value[i] = digest.digest[i];
    return true;
  }

 private:
  static std::uint32_t number_of(const Status& status) { return status.part_system; }
  static std::uint32_t number_of(const Alarm& alarm) { return alarm.slot; }
};

// For this computer only, without multicast, like ncdds without its own configuration.
DomainParticipantQos on_this_computer() {
  DomainParticipantQos qos;
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList.push_back("127.0.0.1");
  udp->maxInitialPeersRange = 30;
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp);
  eprosima::fastrtps::rtps::Locator_t peer;
  peer.kind = LOCATOR_KIND_UDPv4;
  eprosima::fastrtps::rtps::IPLocator::setIPv4(peer, 127, 0, 0, 1);
  qos.wire_protocol().builtin.initialPeersList.push_back(peer);
  qos.wire_protocol().builtin.avoid_builtin_multicast = true;
  qos.name("another make");
  return qos;
}

template <class T>
DataReader* read(DomainParticipant* participant, Subscriber* subscriber, const char* topic_name) {
  TypeSupport type(new CoreType<T>);
  if (type.register_type(participant) != ReturnCode_t::RETCODE_OK) return nullptr;
  Topic* topic = participant->create_topic(topic_name, T::kType, TOPIC_QOS_DEFAULT);
  if (topic == nullptr) return nullptr;
  DataReaderQos qos;
  qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = TRANSIENT_LOCAL_DURABILITY_QOS;
  return subscriber->create_datareader(topic, qos);
}

template <class T>
void take(DataReader* reader) {
  T sample;
  SampleInfo info;
  while (reader->take_next_sample(&sample, &info) == ReturnCode_t::RETCODE_OK) {
    if (info.valid_data) sample.print();
    else std::printf("%s: an instance has ended\n", T::kType);
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "fastdds_peer DOMAIN SECONDS\n");
    return 1;
  }
  DomainParticipant* participant =
      DomainParticipantFactory::get_instance()->create_participant(static_cast<std::uint32_t>(std::atoi(argv[1])), on_this_computer());
  if (participant == nullptr) return 1;
  SubscriberQos every;
  every.partition().push_back("*");
  Subscriber* subscriber = participant->create_subscriber(every);
  DataReader* status = subscriber == nullptr ? nullptr : read<Status>(participant, subscriber, "nc_Status_v1");
  DataReader* alarm = subscriber == nullptr ? nullptr : read<Alarm>(participant, subscriber, "nc_Alarm_v1");
  if (status == nullptr || alarm == nullptr) return 1;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(std::atoi(argv[2]));
  while (std::chrono::steady_clock::now() < end) {
    take<Status>(status);
    take<Alarm>(alarm);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  participant->delete_contained_entities();
  DomainParticipantFactory::get_instance()->delete_participant(participant);
  return 0;
}
