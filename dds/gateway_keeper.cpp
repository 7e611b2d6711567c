// SPDX-License-Identifier: Apache-2.0
// See gateway_keeper.hpp.
#include "dds/gateway_keeper.hpp"

#include <chrono>
#include <cstdio>
#include <thread>

#include "dds/service_state.hpp"

namespace nc::dds {
namespace {

struct RunningGateway : SecuredPart {
  explicit RunningGateway(const GatewayOptions& options) : gateway(options) {}
  ~RunningGateway() override {
    gateway.stop();
    if (thread.joinable()) thread.join();
  }
  unsigned partners() const override { return gateway.partners(); }
  Gateway gateway;
  std::thread thread;
};

void change(SecuredPart* from, SecuredPart* to) {
  if (from != nullptr && to != nullptr) static_cast<RunningGateway*>(to)->gateway.take_over(&static_cast<RunningGateway*>(from)->gateway);
}

void tell(const std::string& text, bool lasts) {
  if (lasts) tell_state(text);
  std::fprintf(stderr, "ncdds: %s\n", text.c_str());
}

}  // namespace

GatewayKeeper::GatewayKeeper(const GatewayOptions& options)
    : options_(options),
      keeper_({options.access.security, "publishes nothing", [this](bool stands_by, std::string* error) { return make(stands_by, error); }, change, tell}) {}

std::unique_ptr<SecuredPart> GatewayKeeper::make(bool stands_by, std::string* error) const {
  auto running = std::make_unique<RunningGateway>(options_);
  if (stands_by) running->gateway.stand_by();
  if (!running->gateway.open(error)) return nullptr;
  running->thread = std::thread([gateway = &running->gateway] { gateway->run(); });
  return running;
}

void GatewayKeeper::run() {
  while (!stop_) {
    keeper_.look(look_now_.exchange(false));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

}  // namespace nc::dds
