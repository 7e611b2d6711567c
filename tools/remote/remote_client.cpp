// SPDX-License-Identifier: Apache-2.0
// See remote_client.hpp.
#include "tools/remote/remote_client.hpp"

#include <unistd.h>

#include "dds/security.hpp"
#include "dds/service_caller.hpp"
#include "dds/service_request.hpp"
#include "runtime/services/service_table.hpp"

namespace nc::tools {
namespace {

using dds::ServiceCaller;

class RemoteClient : public ServiceClient {
 public:
  bool open(const dds::Access& access, const std::string& control, const std::string& name, ServiceRefusal* refusal) {
    std::string error;
    secured_ = !access.security.empty();
    const auto opened = caller_.open(access, control, name, &error);
    if (opened == ServiceCaller::Result::kNotAllowed)
      *refusal = refusal_named("no right", "the permissions of this identity do not have control \"" + control + "\", or no client of the name \"" + name + "\"");
    else if (opened != ServiceCaller::Result::kDone) *refusal = {kControlFailed, "failed", error};
    return opened == ServiceCaller::Result::kDone;
  }
  bool call(const std::string& service, const Json& args, Json* reply, ServiceRefusal* refusal) override {
    const rt::services::ServiceRow* row = rt::services::find_service(service);
    const rt::services::Right right = row != nullptr ? row->right : rt::services::Right::kView;  // what there is not the control refuses
    dds::ServiceReplyText text;
    std::string error;
    const std::string words = args.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (secured_ && row != nullptr && row->service == rt::services::Service::kRights) be_heard(words);
    // A request shows one right, that of its topic. The second one is shown by any request on the topic of that.
    auto result = ServiceCaller::Result::kDone;
    if (row != nullptr && row->and_right) result = caller_.call(*row->and_right, rt::services::row_of(rt::services::Service::kRights).name, "{}", &text, &error);
    if (result == ServiceCaller::Result::kDone) result = caller_.call(right, service, words, &text, &error);
    if (result == ServiceCaller::Result::kNotAllowed)
      *refusal = refusal_named("no right", "the permissions of this identity do not have the right to " + (row != nullptr ? rt::services::rights_text(*row) : right_name(right)));
    else if (result != ServiceCaller::Result::kDone) *refusal = no_answer(result, error);
    else return read(text, reply, refusal);
    return false;
  }
  bool next_update(Json* update, ServiceRefusal* refusal) override {
    dds::ServiceReplyText text;
    std::string error;
    const auto result = caller_.next_update(&text.body, &error);
    if (result == ServiceCaller::Result::kDone) return read(text, update, refusal);
    *refusal = no_answer(result, error);
    return false;
  }
  bool may_use(const rt::services::ServiceRow& row) override {
    std::string error;
    return caller_.may_ask(row.right, &error) && (!row.and_right || caller_.may_ask(*row.and_right, &error));
  }

 private:
  static ServiceRefusal no_answer(ServiceCaller::Result result, const std::string& error) {
    return result == ServiceCaller::Result::kExpired ? ServiceRefusal{kControlFailed, "failed", error} : no_connection(error);
  }
  static bool read(const dds::ServiceReplyText& text, Json* reply, ServiceRefusal* refusal) {
    Json body = Json::parse(text.body, nullptr, false);
    if (!body.is_object()) {
      *refusal = no_connection("the control sends what is no reply");
      return false;
    }
    if (!text.refusal.empty()) {
      *refusal = refusal_named(text.refusal, body.value("text", ""));
      return false;
    }
    *reply = std::move(body);
    return true;
  }
  // The gateway names the rights on whose topics it hears this client. What has come on a topic was heard there; of a right that this identity has not, its own DDS
  // makes no writer.
  void be_heard(const std::string& args) {
    for (unsigned right = 0; right < rt::services::kRightCount; ++right) {
      dds::ServiceReplyText text;
      std::string error;
      if (right != static_cast<unsigned>(rt::services::Right::kView)) (void)caller_.call(static_cast<rt::services::Right>(right), "rights", args, &text, &error);
    }
  }
  ServiceCaller caller_;
  bool secured_ = false;
};

// The permissions let an identity be the client of its name, and with @ behind it several at once.
bool name_of_client(const RemoteAccess& access, std::string* name, std::string* error) {
  *name = access.client;
  if (!name->empty()) return true;
  const std::string process = std::to_string(getpid());
  *name = "ncctl-" + process;
  if (access.security.empty()) return true;
  dds::Identity identity;
  if (!dds::read_identity(access.security, &identity, error)) return false;
  const std::string own = identity.subject.substr(identity.subject.find('=') + 1), several = own + "@" + process;
  *name = several.size() <= rt::services::kMostRemoteClient ? several : own;
  return true;
}

}  // namespace

std::unique_ptr<ServiceClient> open_remote_client(const RemoteAccess& remote, ServiceRefusal* refusal) {
  dds::Access access;
  access.domain = remote.domain;
  access.network = remote.network;
  access.security = remote.security;
  std::string error, name;
  auto client = std::make_unique<RemoteClient>();
  if (!dds::may_access(access, true, &error)) *refusal = {kControlUsage, "usage", error};
  else if (!name_of_client(remote, &name, &error)) *refusal = {kControlFailed, "failed", error};
  else if (!dds::is_client_name(name)) *refusal = {kControlUsage, "usage", "the name of a client has letters, digits, '.', '-', '_' and '@', and at most " + std::to_string(rt::services::kMostRemoteClient) + " bytes: --client"};
  else if (client->open(access, remote.control, name, refusal)) return client;
  return nullptr;
}

}  // namespace nc::tools
