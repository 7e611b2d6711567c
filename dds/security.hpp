// SPDX-License-Identifier: Apache-2.0
// DDS Security: an identity as nc-keys makes one, and the plug-ins of Cyclone DDS that use it. docs/security.md.
//
// An identity is a folder with seven files: identity-ca.pem, permissions-ca.pem, governance.p7s, permissions.p7s, identity.pem, key.pem and, not
// necessarily, revoked.pem. The plug-ins say little of what is wrong with one of them, so all of it is checked here first.
#pragma once

#include <cstdint>
#include <string>

#include "dds/dds.h"

namespace nc::dds {

struct Identity {
  std::string folder;
  std::string subject;         // "CN=anna"; the certificate and the permissions may say more
  std::string rules;           // the permissions, the governance and their authority, as they are in the files
  bool has_revoked = false;    // there is a list of revoked certificates
  std::int64_t begins_s = 0;   // seconds since 1970; it is valid from here
  std::int64_t ends_s = 0;     // up to here, exclusive: the earliest end of certificate, authorities and permissions
};

enum class Validity { kNotYet, kValid, kEnded };
Validity validity_of(const Identity& identity, std::int64_t now_s);
// Why it cannot be used at this time, "" = it is valid.
std::string invalid_text(const Identity& identity, std::int64_t now_s);

// Reads and checks the identity in a folder, except for whether it is valid now. False with a sentence in *error that names the file.
bool read_identity(const std::string& folder, Identity* identity, std::string* error);

// Changes whenever a file of the folder is replaced, removed or written.
std::string stamp_of(const std::string& folder);

// "2027-06-30T12:00:00Z"
std::string utc_text(std::int64_t seconds);

// The plug-ins of Cyclone DDS, which the loader does not find by their names.
struct SecurityPlugins {
  std::string authentication, access_control, cryptography;  // absolute paths
};

// Looks for the plug-ins beside the library of Cyclone DDS that this program uses. False with a sentence in *error.
bool find_plugins(SecurityPlugins* plugins, std::string* error);

// Sets the properties of a participant's QoS that make it a secured one.
void set_security(dds_qos_t* qos, const Identity& identity, const SecurityPlugins& plugins);

}  // namespace nc::dds
