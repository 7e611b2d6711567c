// SPDX-License-Identifier: Apache-2.0
// Keeps a gateway with DDS Security going while its keys change (identity_keeper.hpp). Nobody misses a status, and no command is lost or taken twice.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "dds/gateway.hpp"
#include "dds/identity_keeper.hpp"

namespace nc::dds {

class GatewayKeeper {
 public:
  explicit GatewayKeeper(const GatewayOptions& options);
  ~GatewayKeeper() { keeper_.end(); }
  // False with a sentence in *error when the files cannot be used, whatever the time; an identity that has expired, or has not begun, is waited for.
  bool open(std::string* error) { return keeper_.open(true, error); }
  // Until stop() is called.
  void run();
  // May also be called from a signal handler, as may look_now(), which looks for new files at once.
  void stop() { stop_ = true; }
  void look_now() { look_now_ = true; }

 private:
  std::unique_ptr<SecuredPart> make(bool stands_by, std::string* error) const;

  const GatewayOptions options_;
  std::atomic<bool> stop_{false}, look_now_{false};
  IdentityKeeper keeper_;
};

}  // namespace nc::dds
