// SPDX-License-Identifier: Apache-2.0
// A client of the services over DDS (docs/dds.md, "Services"): asks, waits for the reply, and puts its parts together. To be used by one thread.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>

#include "dds/participant.hpp"
#include "dds/security.hpp"
#include "runtime/services/rights.hpp"

namespace nc::dds {

struct ServiceReplyText {
  std::string refusal;  // "" = none
  std::string body;     // JSON
};

class ServiceCaller {
 public:
  // kNotAllowed: the permissions of DDS Security do not let this identity ask; kNobody: there is no gateway, or it does not answer;
  // kExpired: the identity has ended, so nobody hears this client any more.
  enum class Result { kDone, kNotAllowed, kNobody, kExpired };

  // `control`: name of the control. `client`: that of this client, which no other one has. Otherwise *error has a sentence.
  Result open(const Access& access, const std::string& control, const std::string& client, std::string* error);
  // False when the permissions of DDS Security do not let this identity ask on the topic of the right, with a sentence in *error.
  bool may_ask(rt::services::Right right, std::string* error) { return made_writer(right, error) != DDS_RETCODE_NOT_ALLOWED_BY_SECURITY; }
  // Asks on the topic of the right, with the arguments as JSON, and waits for the reply. Without one *error has a sentence.
  Result call(rt::services::Right right, const std::string& service, const std::string& args, ServiceReplyText* reply, std::string* error);
  // Waits for the next update of a watch list.
  Result next_update(std::string* body, std::string* error);

 private:
  struct Parts {
    dds_instance_handle_t writer = 0;
    std::uint32_t count = 0;
    std::string text;
  };
  dds_entity_t made_writer(rt::services::Right right, std::string* error);
  Result writer_of(rt::services::Right right, dds_entity_t* writer, std::string* error);
  void take();
  void add_part(const nc_ServiceReply& sample, dds_instance_handle_t writer);
  bool wait(std::int64_t until_ns);
  bool has_expired(std::string* error) const;

  Access access_;
  std::string control_, client_;
  std::optional<Identity> identity_;  // none without DDS Security
  Participant participant_;
  dds_entity_t replies_ = 0, waitset_ = 0;
  std::array<dds_entity_t, rt::services::kRightCount> writers_{};
  std::uint64_t number_ = 0;                          // of the last request
  std::map<std::uint64_t, Parts> parts_;              // of replies that have not come to their end
  std::map<std::uint64_t, ServiceReplyText> whole_;   // replies that nobody has fetched yet
  std::deque<std::string> updates_;
};

}  // namespace nc::dds
