// SPDX-License-Identifier: Apache-2.0
// Identities and plug-ins of DDS Security. See security.hpp.
#include "dds/security.hpp"

#include <dlfcn.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>

namespace nc::dds {
namespace {

constexpr char kIdentityCa[] = "identity-ca.pem", kPermissionsCa[] = "permissions-ca.pem", kGovernance[] = "governance.p7s",
               kPermissions[] = "permissions.p7s", kCertificate[] = "identity.pem", kKey[] = "key.pem", kRevoked[] = "revoked.pem";
constexpr const char* kFiles[] = {kIdentityCa, kPermissionsCa, kGovernance, kPermissions, kCertificate, kKey, kRevoked};
constexpr std::size_t kMostBytes = 1u << 20;

// Frees what OpenSSL gives.
struct Free {
  void operator()(BIO* p) const { BIO_free_all(p); }
  void operator()(X509* p) const { X509_free(p); }
  void operator()(X509_CRL* p) const { X509_CRL_free(p); }
  void operator()(X509_STORE* p) const { X509_STORE_free(p); }
  void operator()(EVP_PKEY* p) const { EVP_PKEY_free(p); }
  void operator()(PKCS7* p) const { PKCS7_free(p); }
};
template <typename T>
using Owned = std::unique_ptr<T, Free>;

bool read_file(const std::string& path, std::string* text, std::string* error) {
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  std::ostringstream all;
  if (!in || !(all << in.rdbuf())) {
    *error = path + ": " + (errno != 0 ? std::strerror(errno) : "is empty or cannot be read");
    return false;
  }
  *text = all.str();
  if (text->size() <= kMostBytes) return true;
  *error = path + ": is too long";
  return false;
}

Owned<BIO> memory(const std::string& text) {
  return Owned<BIO>(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

Owned<X509> read_certificate(const std::string& path, std::string* error) {
  std::string text;
  if (!read_file(path, &text, error)) return nullptr;
  Owned<X509> certificate(PEM_read_bio_X509(memory(text).get(), nullptr, nullptr, nullptr));
  if (!certificate) *error = path + ": is no certificate";
  return certificate;
}

// Nobody is asked for the password of a key.
int no_password(char*, int, int, void*) {
  return -1;
}

Owned<EVP_PKEY> read_key(const std::string& path, std::string* error) {
  struct stat status {};
  if (stat(path.c_str(), &status) == 0 && (status.st_mode & S_IRWXO) != 0) {
    *error = path + ": every user of this computer may read this key (chmod o= " + path + ")";
    return nullptr;
  }
  std::string text;
  if (!read_file(path, &text, error)) return nullptr;
  Owned<EVP_PKEY> key(PEM_read_bio_PrivateKey(memory(text).get(), nullptr, &no_password, nullptr));
  if (!key) *error = path + ": is no key, or one with a password";
  return key;
}

std::optional<std::int64_t> seconds_of(const ASN1_TIME* time) {
  std::tm parts{};
  if (ASN1_TIME_to_tm(time, &parts) != 1) return std::nullopt;
  return timegm(&parts);
}

// Narrows the validity of the identity to that of a certificate.
bool narrow(const X509* certificate, const std::string& path, Identity* identity, std::string* error) {
  const std::optional<std::int64_t> begins = seconds_of(X509_get0_notBefore(certificate)), ends = seconds_of(X509_get0_notAfter(certificate));
  if (!begins || !ends) {
    *error = path + ": its validity cannot be read";
    return false;
  }
  identity->begins_s = std::max(identity->begins_s, *begins);
  identity->ends_s = std::min(identity->ends_s, *ends);
  return true;
}

// The whole subject, "OU=2f8a,CN=anna".
std::string subject_of(const X509* certificate) {
  const Owned<BIO> out(BIO_new(BIO_s_mem()));
  X509_NAME_print_ex(out.get(), X509_get_subject_name(certificate), 0, XN_FLAG_RFC2253);
  char* text = nullptr;
  const long length = BIO_get_mem_data(out.get(), &text);
  return std::string(text, static_cast<std::size_t>(std::max(0L, length)));
}

// The text of a document in S/MIME, if the authority has signed it. Its time is checked apart from that.
bool signed_text(const std::string& path, X509* authority, std::string* content, std::string* error) {
  std::string text;
  if (!read_file(path, &text, error)) return false;
  BIO* body = nullptr;
  const Owned<PKCS7> document(SMIME_read_PKCS7(memory(text).get(), &body));
  const Owned<BIO> owned_body(body);
  if (!document) {
    *error = path + ": is no signed document (S/MIME)";
    return false;
  }
  const Owned<X509_STORE> store(X509_STORE_new());
  X509_STORE_add_cert(store.get(), authority);
  X509_STORE_set_flags(store.get(), X509_V_FLAG_NO_CHECK_TIME);
  const Owned<BIO> out(BIO_new(BIO_s_mem()));
  if (PKCS7_verify(document.get(), nullptr, store.get(), body, out.get(), PKCS7_TEXT) != 1) {
    *error = path + ": is not signed by " + kPermissionsCa + ", or was changed afterwards";
    return false;
  }
  char* bytes = nullptr;
  const long length = BIO_get_mem_data(out.get(), &bytes);
  content->assign(bytes, static_cast<std::size_t>(std::max(0L, length)));
  return true;
}

// The text of the first element with this name.
std::string element(const std::string& xml, const std::string& name) {
  const std::string begin = "<" + name + ">", end = "</" + name + ">";
  const std::size_t from = xml.find(begin);
  if (from == std::string::npos) return {};
  const std::size_t to = xml.find(end, from);
  return to == std::string::npos ? std::string() : xml.substr(from + begin.size(), to - from - begin.size());
}

// "CN=anna" of "OU=2f8a,CN=anna".
std::string name_of(const std::string& subject) {
  const std::size_t from = subject.rfind("CN=");
  return from == std::string::npos ? subject : subject.substr(from, subject.find(',', from) - from);
}

std::optional<std::int64_t> time_of(const std::string& text) {
  std::tm parts{};
  const char* rest = strptime(text.c_str(), "%Y-%m-%dT%H:%M:%S", &parts);
  if (rest == nullptr || (*rest != 0 && std::strcmp(rest, "Z") != 0)) return std::nullopt;
  return timegm(&parts);
}

bool check_permissions(const std::string& path, X509* authority, const std::string& subject, Identity* identity, std::string* error) {
  std::string xml;
  if (!signed_text(path, authority, &xml, error)) return false;
  if (xml.find("<subject_name>" + subject + "</subject_name>") == std::string::npos) {
    *error = path + ": is for " + element(xml, "subject_name") + ", but the certificate is that of " + subject;
    return false;
  }
  const std::optional<std::int64_t> begins = time_of(element(xml, "not_before")), ends = time_of(element(xml, "not_after"));
  if (!begins || !ends) {
    *error = path + ": its validity cannot be read";
    return false;
  }
  identity->begins_s = std::max(identity->begins_s, *begins);
  identity->ends_s = std::min(identity->ends_s, *ends);
  return true;
}

bool check_revoked(const std::string& path, X509* authority, X509* certificate, Identity* identity, std::string* error) {
  identity->has_revoked = access(path.c_str(), F_OK) == 0;
  if (!identity->has_revoked) return true;
  std::string text;
  if (!read_file(path, &text, error)) return false;
  const Owned<X509_CRL> list(PEM_read_bio_X509_CRL(memory(text).get(), nullptr, nullptr, nullptr));
  if (!list || X509_CRL_verify(list.get(), X509_get0_pubkey(authority)) != 1) {
    *error = path + ": is no list of revoked certificates that " + kIdentityCa + " has signed";
    return false;
  }
  X509_REVOKED* entry = nullptr;
  if (X509_CRL_get0_by_cert(list.get(), &entry, certificate) == 1) {
    *error = "the certificate of " + identity->subject + " is revoked (" + path + ")";
    return false;
  }
  if (const ASN1_TIME* next = X509_CRL_get0_nextUpdate(list.get()))
    if (const std::optional<std::int64_t> ends = seconds_of(next)) identity->ends_s = std::min(identity->ends_s, *ends);  // a list that has ended refuses everybody
  return true;
}

}  // namespace

Validity validity_of(const Identity& identity, std::int64_t now_s) {
  if (now_s < identity.begins_s) return Validity::kNotYet;
  return now_s < identity.ends_s ? Validity::kValid : Validity::kEnded;
}

std::string invalid_text(const Identity& identity, std::int64_t now_s) {
  const std::string whose = "the identity of " + identity.subject + " (" + identity.folder + ") ";
  switch (validity_of(identity, now_s)) {
    case Validity::kNotYet: return whose + "begins at " + utc_text(identity.begins_s);
    case Validity::kEnded: return whose + "has expired at " + utc_text(identity.ends_s);
    case Validity::kValid: break;
  }
  return "";
}

bool read_identity(const std::string& folder, Identity* identity, std::string* error) {
  *identity = {};
  identity->folder = folder;
  identity->ends_s = std::numeric_limits<std::int64_t>::max();
  const std::string base = folder + "/";
  const Owned<X509> authority = read_certificate(base + kIdentityCa, error);
  if (!authority || !narrow(authority.get(), base + kIdentityCa, identity, error)) return false;
  const Owned<X509> permissions_authority = read_certificate(base + kPermissionsCa, error);
  if (!permissions_authority || !narrow(permissions_authority.get(), base + kPermissionsCa, identity, error)) return false;
  const Owned<X509> certificate = read_certificate(base + kCertificate, error);
  if (!certificate || !narrow(certificate.get(), base + kCertificate, identity, error)) return false;
  const std::string subject = subject_of(certificate.get());
  identity->subject = name_of(subject);
  if (X509_verify(certificate.get(), X509_get0_pubkey(authority.get())) != 1) {
    *error = base + kCertificate + ": is not signed by " + kIdentityCa;
    return false;
  }
  const Owned<EVP_PKEY> key = read_key(base + kKey, error);
  if (!key) return false;
  if (X509_check_private_key(certificate.get(), key.get()) != 1) {
    *error = base + kKey + ": is not the key of " + kCertificate;
    return false;
  }
  std::string governance;
  for (const char* file : {kPermissions, kGovernance, kPermissionsCa}) {
    std::string text;
    if (!read_file(base + file, &text, error)) return false;
    identity->rules += text;
  }
  return check_revoked(base + kRevoked, authority.get(), certificate.get(), identity, error) &&
         signed_text(base + kGovernance, permissions_authority.get(), &governance, error) &&
         check_permissions(base + kPermissions, permissions_authority.get(), subject, identity, error);
}

std::string stamp_of(const std::string& folder) {
  std::ostringstream stamp;
  for (const char* file : kFiles) {
    struct stat status {};
    if (stat((folder + "/" + file).c_str(), &status) != 0) {
      stamp << "- ";
      continue;
    }
    stamp << status.st_ino << ':' << status.st_size << ':' << status.st_mtim.tv_sec << '.' << status.st_mtim.tv_nsec << ':' << status.st_mode << ' ';
  }
  return stamp.str();
}

std::string utc_text(std::int64_t seconds) {
  const std::time_t time = seconds;
  std::tm parts{};
  if (gmtime_r(&time, &parts) == nullptr) return "?";
  char text[64];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

bool find_plugins(SecurityPlugins* plugins, std::string* error) {
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&dds_create_participant), &library) == 0 || library.dli_fname == nullptr) {
    *error = "the library of Cyclone DDS cannot be found";
    return false;
  }
  const std::string path = library.dli_fname;
  const std::string folder = path.substr(0, path.rfind('/') == std::string::npos ? 0 : path.rfind('/'));
  std::string looked;
  // Debian has them in a folder that is named after its package (libddsc0debian); Cyclone DDS itself installs them beside its library.
  for (const std::string& place : {folder + "/libddsc0debian/", folder + "/"}) {
    *plugins = {place + "libdds_security_auth.so", place + "libdds_security_ac.so", place + "libdds_security_crypto.so"};
    looked += (looked.empty() ? "" : " and ") + place;
    if (access(plugins->authentication.c_str(), R_OK) == 0 && access(plugins->access_control.c_str(), R_OK) == 0 &&
        access(plugins->cryptography.c_str(), R_OK) == 0)
      return true;
  }
  *error = "the security plug-ins of Cyclone DDS (libdds_security_auth.so, _ac, _crypto) are not in " + looked;
  return false;
}

void set_security(dds_qos_t* qos, const Identity& identity, const SecurityPlugins& plugins) {
  const auto set = [&](const char* name, const std::string& value) { dds_qset_prop(qos, name, value.c_str()); };
  const auto file = [&](const char* name, const char* which) { set(name, "file:" + identity.folder + "/" + which); };
  set("dds.sec.auth.library.path", plugins.authentication);
  set("dds.sec.auth.library.init", "init_authentication");
  set("dds.sec.auth.library.finalize", "finalize_authentication");
  set("dds.sec.access.library.path", plugins.access_control);
  set("dds.sec.access.library.init", "init_access_control");
  set("dds.sec.access.library.finalize", "finalize_access_control");
  set("dds.sec.crypto.library.path", plugins.cryptography);
  set("dds.sec.crypto.library.init", "init_crypto");
  set("dds.sec.crypto.library.finalize", "finalize_crypto");
  file("dds.sec.auth.identity_ca", kIdentityCa);
  file("dds.sec.auth.identity_certificate", kCertificate);
  file("dds.sec.auth.private_key", kKey);
  file("dds.sec.access.permissions_ca", kPermissionsCa);
  file("dds.sec.access.governance", kGovernance);
  file("dds.sec.access.permissions", kPermissions);
  if (identity.has_revoked) file("org.eclipse.cyclonedds.sec.auth.crl", kRevoked);
}

}  // namespace nc::dds
