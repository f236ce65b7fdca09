// SPDX-License-Identifier: Apache-2.0
// Keys made by the openssl program.
#include "core/keys/private_key_in.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace indurop::keys {
namespace {

std::string printed(const std::string& command) {
  std::string text;
  FILE* const from = ::popen((command + " 2>/dev/null").c_str(), "r");
  for (int byte = 0; from != nullptr && (byte = std::fgetc(from)) != EOF;) {
    text += static_cast<char>(byte);
  }
  EXPECT_NE(from, nullptr);
  EXPECT_EQ(::pclose(from), 0) << command;
  EXPECT_NE(text, "") << command;
  return text;
}

TEST(PrivateKeyIn, Finds_keys_in_all_usual_forms) {
  const std::string ed = "openssl genpkey -algorithm ed25519";
  const std::string rsa = "openssl genpkey -algorithm rsa -pkeyopt rsa_keygen_bits:1024";
  EXPECT_TRUE(holds_private_key(printed(ed)));
  EXPECT_TRUE(holds_private_key("certificate first\n" + printed(ed)));
  EXPECT_TRUE(holds_private_key(printed(ed + " -outform DER")));
  EXPECT_TRUE(holds_private_key(printed(rsa + " | openssl rsa -traditional -outform DER")));
  EXPECT_TRUE(holds_private_key(printed("openssl ecparam -name prime256v1 -genkey -noout -outform DER")));
  EXPECT_TRUE(holds_private_key(printed(ed + " | openssl pkcs8 -topk8 -passout pass:x -outform DER")));
  EXPECT_TRUE(holds_private_key(printed(ed + " | openssl pkcs12 -export -nocerts -passout pass:x")));
  EXPECT_TRUE(holds_private_key("-----BEGIN PGP PRIVATE KEY BLOCK-----\n"));
  EXPECT_TRUE(holds_private_key("PuTTY-User-Key-File-2: ssh-rsa\nPrivate-MAC: 00\n"));
}

TEST(PrivateKeyIn, Public_keys_and_other_files_are_none) {
  const std::string ed = "openssl genpkey -algorithm ed25519";
  EXPECT_FALSE(holds_private_key(""));
  EXPECT_FALSE(holds_private_key("0"));
  EXPECT_FALSE(holds_private_key("0, 1, 2, 3\n"));
  EXPECT_FALSE(holds_private_key(printed(ed + " | openssl pkey -pubout")));
  EXPECT_FALSE(holds_private_key(printed(ed + " | openssl pkey -pubout -outform DER")));
}

}  // namespace
}  // namespace indurop::keys
