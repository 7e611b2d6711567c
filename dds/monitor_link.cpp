// SPDX-License-Identifier: Apache-2.0
// See monitor_link.hpp.
#include "dds/monitor_link.hpp"

namespace nc::dds {

bool MonitorLink::open(const Access& access, bool signals, std::string* error) {
  if (!participant_.open(access, error)) return false;
  waitset_ = dds_create_waitset(participant_.get());
  return make(Topic::kStatus, &status_, error) && make(Topic::kAlarm, &alarm_, error) && watch_signals(signals, error);
}

// A reader that is waited for.
bool MonitorLink::make(Topic topic, dds_entity_t* reader, std::string* error) {
  *reader = make_reader(participant_.get(), topic, partition_, error);
  if (*reader <= 0) return false;
  const dds_entity_t condition = dds_create_readcondition(*reader, DDS_ANY_STATE);
  if (waitset_ > 0 && condition > 0 && dds_waitset_attach(waitset_, condition, 0) >= 0) return true;
  *error = std::string(topic_name(topic)) + " cannot be waited for";
  return false;
}

bool MonitorLink::watch_signals(bool on, std::string* error) {
  if (on == (signals_ > 0)) return true;
  if (on) return make(Topic::kSignalTable, &signal_table_, error) && make(Topic::kSignalImage, &signals_, error);
  for (const dds_entity_t reader : {signals_, signal_table_}) (void)dds_delete(dds_get_parent(reader));  // without a reader the gateway stops publishing signals
  signals_ = signal_table_ = 0;
  return true;
}

bool MonitorLink::wait(std::int64_t timeout_ns) const {
  dds_attach_t triggered[4];
  return dds_waitset_wait(waitset_, triggered, 4, timeout_ns) > 0;
}

unsigned MonitorLink::partners_of(dds_entity_t reader) {
  dds_subscription_matched_status_t matched{};
  return reader > 0 && dds_get_subscription_matched_status(reader, &matched) >= 0 ? matched.current_count : 0;
}

unsigned MonitorLink::partners() const {
  unsigned sum = 0;
  for (const dds_entity_t reader : {status_, alarm_, signals_, signal_table_}) sum += partners_of(reader);
  return sum;
}

}  // namespace nc::dds
