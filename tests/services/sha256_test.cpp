// SPDX-License-Identifier: Apache-2.0
// SHA-256 against the examples of FIPS 180-4, whole and in pieces.
#include "runtime/services/sha256.hpp"

#include <gtest/gtest.h>

namespace nc::rt::services {
namespace {

std::string hash(const std::string& bytes, std::size_t piece) {
  Sha256 sum;
  for (std::size_t at = 0; at < bytes.size(); at += piece) sum.add(std::string_view(bytes).substr(at, piece));
  return sum.finish();
}

TEST(ServiceSha256, GivesTheHashesOfTheStandard) {
  EXPECT_EQ(hash("", 1), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(hash("abc", 3), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  const std::string two_blocks = "abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq";
  EXPECT_EQ(hash(two_blocks, two_blocks.size()), "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(hash(std::string(1'000'000, 'a'), 65536), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(ServiceSha256, DoesNotDependOnThePieces) {
  for (std::size_t length = 0; length < 200; ++length) {
    const std::string bytes(length, 'x');
    EXPECT_EQ(hash(bytes, 1), hash(bytes, 64)) << length;
    EXPECT_EQ(hash(bytes, 7), hash(bytes, length + 1)) << length;
  }
}

}  // namespace
}  // namespace nc::rt::services
