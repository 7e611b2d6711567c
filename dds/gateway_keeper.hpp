// SPDX-License-Identifier: Apache-2.0
// Keeps a gateway with DDS Security going while its keys change. A participant of DDS has its certificate for as long as it lives, so new files need a new
// participant: a second gateway with them stands by until those who talk with the first one talk with it, too, and then takes over. Nobody misses a status.
//
// Without new files the gateway is ended before its certificate is, and comes back with the next files that are valid.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "dds/gateway.hpp"
#include "dds/security.hpp"

namespace nc::dds {

class GatewayKeeper {
 public:
  explicit GatewayKeeper(const GatewayOptions& options) : options_(options) {}
  ~GatewayKeeper();
  // False with a sentence in *error when the files cannot be used, whatever the time; an identity that has expired, or has not begun, is waited for.
  bool open(std::string* error);
  // Until stop() is called.
  void run();
  // May also be called from a signal handler, as may look_now(), which looks for new files at once.
  void stop() { stop_ = true; }
  void look_now() { look_now_ = true; }

 private:
  struct Running {
    std::unique_ptr<Gateway> gateway;
    std::thread thread;
    Identity identity;
    ~Running();
  };
  void look_at_files(std::int64_t now_s);
  void use(const Identity& identity);
  std::unique_ptr<Running> begin(const Identity& identity, bool stands_by, std::string* error);
  void change_over(std::int64_t now_s);
  void end_in_time(std::int64_t now_s);
  void warn_in_time(std::int64_t now_s);
  void fault(const std::string& text);
  void say(const std::string& text);

  const GatewayOptions options_;
  std::atomic<bool> stop_{false}, look_now_{false};
  std::unique_ptr<Running> current_, next_;
  std::string stamp_;             // of the files that were looked at last
  std::int64_t retry_s_ = 0;      // they are looked at again at this time, although they have not changed; 0 = never
  std::int64_t next_since_ns_ = 0, settled_since_ns_ = 0;
  std::int64_t warn_s_ = 0;       // time of the next warning
  std::string said_;
};

}  // namespace nc::dds
