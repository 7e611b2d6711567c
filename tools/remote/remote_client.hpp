// SPDX-License-Identifier: Apache-2.0
// The client's side of the services over DDS, with DDS Security where an identity is given. Without Cyclone DDS (NC_WITH_DDS) there is none.
#pragma once

#include <memory>

#include "tools/lib/service_client.hpp"

namespace nc::tools {

/** A client of the control over DDS; null with the reason in *refusal. Of the type OpenRemote. */
#ifdef NC_WITH_DDS
std::unique_ptr<ServiceClient> open_remote_client(const RemoteAccess& access, ServiceRefusal* refusal);
#else
inline constexpr OpenRemote open_remote_client = nullptr;
#endif

}  // namespace nc::tools
