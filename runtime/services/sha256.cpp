// SPDX-License-Identifier: Apache-2.0
// See sha256.hpp.
#include "runtime/services/sha256.hpp"

#include <openssl/evp.h>

#include <array>
#include <new>
#include <stdexcept>

namespace nc::rt::services {
namespace {

// Both fail only for want of memory, or where a provider of the system forbids the algorithm.
void check(int done) {
  if (done != 1) throw std::runtime_error("libcrypto does not calculate SHA-256");
}

EVP_MD_CTX* made() {
  EVP_MD_CTX* const sum = EVP_MD_CTX_new();
  if (sum == nullptr) throw std::bad_alloc();
  return sum;
}

}  // namespace

void Sha256::Free::operator()(evp_md_ctx_st* sum) const { EVP_MD_CTX_free(sum); }

Sha256::Sha256() : sum_(made()) { check(EVP_DigestInit_ex(sum_.get(), EVP_sha256(), nullptr)); }

Sha256::Sha256(const Sha256& other) : sum_(made()) { check(EVP_MD_CTX_copy_ex(sum_.get(), other.sum_.get())); }

Sha256& Sha256::operator=(const Sha256& other) {
  check(EVP_MD_CTX_copy_ex(sum_.get(), other.sum_.get()));
  return *this;
}

void Sha256::add(std::string_view bytes) { check(EVP_DigestUpdate(sum_.get(), bytes.data(), bytes.size())); }

std::string Sha256::finish() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> hash{};
  unsigned size = 0;
  check(EVP_DigestFinal_ex(sum_.get(), hash.data(), &size));
  constexpr char kHexDigits[] = "0123456789abcdef";
  std::string text;
  for (unsigned i = 0; i < size; ++i) {
    text += kHexDigits[hash[i] >> 4];
    text += kHexDigits[hash[i] & 15];
  }
  return text;
}

}  // namespace nc::rt::services
