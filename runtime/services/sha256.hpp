// SPDX-License-Identifier: Apache-2.0
// SHA-256 (FIPS 180-4) over bytes that come piece by piece, calculated by libcrypto.
#pragma once

#include <memory>
#include <string>
#include <string_view>

struct evp_md_ctx_st;  // EVP_MD_CTX of <openssl/evp.h>

namespace nc::rt::services {

// A copy goes on by itself from where the other one stands.
class Sha256 {
 public:
  Sha256();
  Sha256(const Sha256& other);
  Sha256& operator=(const Sha256& other);
  Sha256(Sha256&&) noexcept = default;
  Sha256& operator=(Sha256&&) noexcept = default;
  ~Sha256() = default;

  void add(std::string_view bytes);
  // The hash of all bytes as 64 hexadecimal digits. Nothing may be added afterwards.
  std::string finish();

 private:
  struct Free {
    void operator()(evp_md_ctx_st* sum) const;
  };
  std::unique_ptr<evp_md_ctx_st, Free> sum_;
};

}  // namespace nc::rt::services
