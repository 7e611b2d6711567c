// SPDX-License-Identifier: Apache-2.0
// The participant of a monitor with its readers. With DDS Security there is a second one while the keys change (identity_keeper.hpp).
#pragma once

#include <cstdint>
#include <string>

#include "dds/identity_keeper.hpp"
#include "dds/participant.hpp"

namespace nc::dds {

class MonitorLink : public SecuredPart {
 public:
  // `partition`: name of the control, "*" = of all.
  explicit MonitorLink(std::string partition) : partition_(std::move(partition)) {}
  // False with a sentence in *error.
  bool open(const Access& access, bool signals, std::string* error);
  // Makes or removes the readers of the table of signals and of their values.
  bool watch_signals(bool on, std::string* error);
  // Waits at most `timeout_ns` for new samples. True when there are some.
  bool wait(std::int64_t timeout_ns) const;
  // Of one of its readers, or of all of them.
  static unsigned partners_of(dds_entity_t reader);
  unsigned partners() const override;

  dds_entity_t status() const { return status_; }
  dds_entity_t alarm() const { return alarm_; }
  dds_entity_t signals() const { return signals_; }            // 0 = they are not watched
  dds_entity_t signal_table() const { return signal_table_; }

 private:
  bool make(Topic topic, dds_entity_t* reader, std::string* error);

  const std::string partition_;
  Participant participant_;
  dds_entity_t status_ = 0, alarm_ = 0, waitset_ = 0, signals_ = 0, signal_table_ = 0;
};

}  // namespace nc::dds
