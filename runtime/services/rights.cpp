// SPDX-License-Identifier: Apache-2.0
// See rights.hpp.
#include "runtime/services/rights.hpp"

#include <grp.h>
#include <sys/socket.h>

#include <algorithm>

namespace nc::rt::services {
namespace {

constexpr std::size_t kMostGroups = 65536;  // NGROUPS_MAX of Linux

bool find_group(const std::string& name, gid_t* number) {
  std::vector<char> buffer(16384);
  group entry{};
  group* found = nullptr;
  if (getgrnam_r(name.c_str(), &entry, buffer.data(), buffer.size(), &found) != 0 || found == nullptr) return false;
  *number = found->gr_gid;
  return true;
}

}  // namespace

const char* right_name(Right right) {
  switch (right) {
    case Right::kView: return "view";
    case Right::kOperate: return "operate";
    case Right::kSetUp: return "set up";
    case Right::kMaintain: return "maintain";
  }
  return "?";
}

std::optional<Right> find_right(std::string_view name) {
  for (unsigned right = 0; right < kRightCount; ++right)
    if (name == right_name(static_cast<Right>(right))) return static_cast<Right>(right);
  return std::nullopt;
}

bool credentials_of(int socket, Credentials* peer) {
  ucred who{};
  socklen_t size = sizeof who;
  if (getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &who, &size) != 0) return false;
  peer->user = who.uid;
  peer->group = who.gid;
  peer->process = who.pid;
  peer->groups.assign(kMostGroups, 0);
  size = static_cast<socklen_t>(peer->groups.size() * sizeof(gid_t));
  if (getsockopt(socket, SOL_SOCKET, SO_PEERGROUPS, peer->groups.data(), &size) != 0) size = 0;
  peer->groups.resize(size / sizeof(gid_t));
  return true;
}

RightGroups find_groups(const ServicesConfig& config, std::vector<std::string>* unknown) {
  const ServicesConfig standard;
  RightGroups groups;
  for (unsigned right = 0; right < kRightCount; ++right) {
    for (const std::string& name : config.holders[right]) {
      gid_t number = 0;
      const auto& usual = standard.holders[right];
      if (find_group(name, &number)) groups[right].push_back(number);
      else if (std::find(usual.begin(), usual.end(), name) == usual.end()) unknown->push_back(name);
    }
  }
  return groups;
}

RightSet rights_of(const Credentials& peer, const RightGroups& groups, uid_t owner) {
  if (peer.user == 0 || peer.user == owner) return RightSet::all();
  RightSet rights;
  for (unsigned right = 0; right < kRightCount; ++right)
    for (const gid_t group : groups[right])
      if (group == peer.group || std::find(peer.groups.begin(), peer.groups.end(), group) != peer.groups.end()) rights.add(static_cast<Right>(right));
  return rights;
}

unsigned rank_of(const RightSet& rights, bool may_speak) {
  if (may_speak) return kHighestRank;
  if (rights.has(Right::kOperate)) return kRankOfOperating;
  return rights.has(Right::kSetUp) || rights.has(Right::kMaintain) ? 1 : 0;
}

}  // namespace nc::rt::services
