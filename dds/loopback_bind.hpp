// SPDX-License-Identifier: Apache-2.0
// Binds the sockets of this process to 127.0.0.1 only. Cyclone DDS 0.10 binds its receiving sockets to all addresses of the
// computer, whatever interface is configured, so any computer in the network can reach them. There is no setting for that. Therefore the
// programs that link nc_dds have a bind() of their own, which the library calls in place of that of the C library.
#pragma once

namespace nc::dds {

// From now on, until the process ends, a socket that is to be bound to all addresses is bound to the loopback address instead.
// For IPv4 and IPv6; a socket that is to be bound to a single address is not changed.
void bind_to_loopback_only();

}  // namespace nc::dds
