// SPDX-License-Identifier: Apache-2.0
// The four rights, and which of them a process has that connects to the socket of the services.
//
// The kernel says who a peer is: the user, the group and the further groups that it had when it connected (SO_PEERCRED, SO_PEERGROUPS). The configuration names
// for each right the groups that have it. root and the user of ncrtd have all of them.
#pragma once

#include <sys/types.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/config.hpp"

namespace nc::rt::services {

enum class Right : std::uint8_t { kView, kOperate, kSetUp, kMaintain };
inline constexpr unsigned kRightCount = 4;

// "view", "operate", "set up", "maintain"
const char* right_name(Right right);
std::optional<Right> find_right(std::string_view name);

class RightSet {
 public:
  constexpr RightSet() = default;
  static constexpr RightSet all() { return RightSet((1u << kRightCount) - 1); }
  constexpr bool has(Right right) const { return (bits_ >> static_cast<unsigned>(right) & 1u) != 0; }
  constexpr bool none() const { return bits_ == 0; }
  // Every other right includes the right to view.
  constexpr void add(Right right) { bits_ |= 1u << static_cast<unsigned>(right) | 1u << static_cast<unsigned>(Right::kView); }
  // What both have.
  constexpr RightSet both(RightSet other) const { return RightSet(bits_ & other.bits_); }
  constexpr bool operator==(const RightSet&) const = default;

 private:
  constexpr explicit RightSet(unsigned bits) : bits_(bits) {}
  unsigned bits_ = 0;
};

// Who is at the other end of a socket.
struct Credentials {
  uid_t user = 0;
  gid_t group = 0;
  pid_t process = 0;
  std::vector<gid_t> groups;  // the further groups
};

// The credentials that the peer of a connected socket had when it connected. False when the kernel does not tell. Where it does not tell the further groups,
// there are none.
bool credentials_of(int socket, Credentials* peer);

// For each right the numbers of its groups.
using RightGroups = std::array<std::vector<gid_t>, kRightCount>;

// Looks up the groups of the configuration. A group that this computer does not have gives nobody a right; its name is added to *unknown unless it is one
// of the default names, which a package makes.
RightGroups find_groups(const ServicesConfig& config, std::vector<std::string>* unknown);

// `owner`: the user of ncrtd.
RightSet rights_of(const Credentials& peer, const RightGroups& groups, uid_t owner);

// Of a client, where there is not room for all: who may do more is above, and root and the user of ncrtd, who may ask for others, above all.
inline constexpr unsigned kRankOfOperating = 2, kHighestRank = 3;
unsigned rank_of(const RightSet& rights, bool may_speak);

}  // namespace nc::rt::services
