// SPDX-License-Identifier: Apache-2.0
// Hashes of passwords against those that Python's hashlib.scrypt computes, and what is no hash.

#include "core/keys/password.h"

#include <gtest/gtest.h>

#include <string>

namespace indurop::keys {
namespace {

// hashlib.scrypt(b"correct horse", salt=bytes(range(16)), n=2**15, r=8, p=1, maxmem=2**27, dklen=32)
const std::string kForeign =
    "scrypt:15:8:1:000102030405060708090a0b0c0d0e0f:5c662628ac4eb1068a287e2aa2a202ae248e98db04d61d3327e7342db6ec7097";
// hashlib.scrypt("grün".encode(), salt=bytes(16), n=2**14, r=8, p=2, maxmem=2**27, dklen=32)
const std::string kOtherCosts =
    "scrypt:14:8:2:00000000000000000000000000000000:62038006e5a5655f14def8ebdb46a2732f32251b231dca66e3a2607450ba15c9";

TEST(Password, Is_the_one_that_another_implementation_hashed) {
  EXPECT_TRUE(is_password("correct horse", kForeign));
  EXPECT_FALSE(is_password("correct hors", kForeign));
  EXPECT_FALSE(is_password("", kForeign));
  EXPECT_TRUE(is_password("gr\u00fcn", kOtherCosts));
}

TEST(Password, Has_another_hash_each_time) {
  const std::string first = hash_of_password("tr0ub4dor");
  EXPECT_NE(first, hash_of_password("tr0ub4dor"));
  EXPECT_TRUE(is_password_hash(first));
  EXPECT_TRUE(is_password("tr0ub4dor", first));
  EXPECT_EQ(first.find("tr0ub4dor"), std::string::npos);
}

TEST(Password, Of_a_damaged_hash_is_none) {
  for (const std::size_t at : {std::size_t{8}, kForeign.find(':', 15) - 1, kForeign.size() - 1}) {
    std::string damaged = kForeign;
    damaged[at] = damaged[at] == '4' ? '5' : '4';
    EXPECT_FALSE(is_password("correct horse", damaged)) << damaged;
  }
  for (std::size_t i = 0; i < kForeign.size(); ++i) {
    EXPECT_FALSE(is_password_hash(kForeign.substr(0, i)));
  }
  for (const char* text :
       {"", "scrypt:", "scrypt:40:8:1:00:00", "sha256:00", "scrypt:15:8:1:000102030405060708090a0b0c0d0e0f:zz",
        "scrypt:31:8:1:000102030405060708090a0b0c0d0e0f:"
        "5c662628ac4eb1068a287e2aa2a202ae248e98db04d61d3327e7342db6ec7097",
        "scrypt:15:800:1:000102030405060708090a0b0c0d0e0f:"
        "5c662628ac4eb1068a287e2aa2a202ae248e98db04d61d3327e7342db6ec7097",
        "scrypt:15:8:99:000102030405060708090a0b0c0d0e0f:"
        "5c662628ac4eb1068a287e2aa2a202ae248e98db04d61d3327e7342db6ec7097"}) {
    EXPECT_FALSE(is_password_hash(text)) << text;
    EXPECT_FALSE(is_password("correct horse", text)) << text;
  }
}

TEST(Token, Is_kept_as_its_digest) {
  EXPECT_EQ(hash_of_token("abc"), "sha256:ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_TRUE(is_token_hash(hash_of_token("abc")));
  EXPECT_FALSE(is_token_hash("sha256:"));
  EXPECT_FALSE(is_token_hash("abc"));
}

}  // namespace
}  // namespace indurop::keys
