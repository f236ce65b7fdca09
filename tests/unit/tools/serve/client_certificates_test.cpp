// SPDX-License-Identifier: Apache-2.0
// What certificates of a plant let do through the server, and that revoked ones count no more.
#include "tools/serve/client_certificates.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <fstream>

#include "core/base/read_file.h"
#include "core/keys/plant_keys.h"

namespace indurop::serve {
namespace {

namespace fs = std::filesystem;

class Authority : public testing::Test {
 protected:
  Authority() { EXPECT_TRUE(plant_.make("cell", {"drive"}, until_)); }
  ~Authority() override { fs::remove_all(folder_); }

  Client client(const fs::path& participant) const {
    const auto authority = ClientCertificates::open(folder_ / "keys" / "ca.pem", {});
    EXPECT_TRUE(authority);
    return authority->identify(*base::read_file(participant / "identity.pem"));
  }
  void revoke(const std::string& name) const {
    for (const keys::KeyListing& each : plant_.list(keys::instant_now())) {
      if (each.name == name) {
        EXPECT_TRUE(plant_.revoke(each));
      }
    }
  }

  fs::path folder_ = fs::temp_directory_path() / ("authority" + std::to_string(::getpid()));
  keys::PlantKeys plant_{folder_ / "keys"};
  keys::Instant until_ = keys::instant_now() + std::chrono::days(10);
};

TEST_F(Authority, Only_deployers_write) {
  ASSERT_TRUE(plant_.add_tool("panel", {{"cell::*"}, {}}, until_));
  ASSERT_TRUE(plant_.add_tool("hand", {{}, {"cell::target"}}, until_));
  EXPECT_EQ(client(plant_.deployer()).role, Role::Program);
  EXPECT_EQ(client(plant_.deployer()).name, "deployer");
  for (const fs::path& folder : {plant_.viewer(), plant_.board("drive"), plant_.tool("panel"), plant_.tool("hand")}) {
    EXPECT_EQ(client(folder).role, Role::Look) << folder;
    EXPECT_EQ(client(folder).refusal, "") << folder;
  }
}

TEST_F(Authority, A_revoked_client_has_no_rights_at_once) {
  const auto authority = ClientCertificates::open(folder_ / "keys" / "ca.pem", {});
  ASSERT_TRUE(authority);
  const std::string certificate = *base::read_file(plant_.deployer() / "identity.pem");
  EXPECT_EQ(authority->identify(certificate).refusal, "");
  revoke("deployer");
  EXPECT_NE(authority->identify(certificate).refusal, "") << "without a restart";
  EXPECT_EQ(authority->identify(certificate).role, Role::Unknown);
}

TEST_F(Authority, Without_a_readable_list_no_client_has_rights) {
  const auto authority = ClientCertificates::open(folder_ / "keys" / "ca.pem", {});
  const std::string certificate = *base::read_file(plant_.deployer() / "identity.pem");
  for (const char* content : {"", "nonsense"}) {
    std::ofstream(folder_ / "keys" / "revoked.pem") << content;
    EXPECT_NE(authority->identify(certificate).refusal, "") << content;
    EXPECT_FALSE(ClientCertificates::open(folder_ / "keys" / "ca.pem", {})) << content;
  }
  const keys::PlantKeys other(folder_ / "other");
  ASSERT_TRUE(other.make("cell", {"drive"}, until_));
  EXPECT_FALSE(ClientCertificates::open(folder_ / "keys" / "ca.pem", folder_ / "other" / "revoked.pem"));
  fs::remove(folder_ / "keys" / "revoked.pem");
  EXPECT_NE(authority->identify(certificate).refusal, "");
  EXPECT_FALSE(ClientCertificates::open(folder_ / "keys" / "ca.pem", {}));
}

}  // namespace
}  // namespace indurop::serve
