// SPDX-License-Identifier: Apache-2.0
// Sockets of this process on 127.0.0.1 only. Cyclone DDS 0.10 binds the sockets that it receives on to every address of the
// computer, whatever interface it is configured for: who reaches the computer reaches them. There is no setting for it, so the
// programs that link nc_dds bring a bind() of their own, which the library calls in the place of the C library's.
#pragma once

namespace nc::dds {

// From now on a socket that is to be bound to every address is bound to the loopback address instead, for the rest of the
// process. IPv4 and IPv6; a socket that is bound to one address is left alone.
void bind_to_loopback_only();

}  // namespace nc::dds
