// SPDX-License-Identifier: Apache-2.0
// What certificates of a plant let do through the server, and that revoked ones count no more.
#include "tools/serve/client_certificates.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <fstream>

#include "core/base/read_file.h"
#include "core/keys/plant_keys.h"
#include "core/keys/revocation.h"

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

// An authority that is not of a plant: its certificates have the role `program`.
class OtherAuthority : public testing::Test {
 protected:
  OtherAuthority() {
    fs::create_directories(folder_);
    own_ = authority_named("office");
    std::ofstream(folder_ / "ca.pem") << own_.certificate;
  }
  ~OtherAuthority() override { fs::remove_all(folder_); }

  keys::Authority authority_named(const std::string& name) const {
    const std::string key = keys::make_key(keys::KeyKind::P256);
    return {keys::make_authority(key, {"office", "", name}, valid_), key};
  }
  static std::string certificate(const keys::Authority& by, const keys::Validity& validity) {
    return keys::make_certificate(by, keys::make_key(keys::KeyKind::P256), {"office", "", "anna"}, validity);
  }
  void write_list(const std::string& serial) const {
    std::ofstream(folder_ / "revoked.pem") << keys::make_revocation_list(own_, "", {serial}, valid_);
  }

  fs::path folder_ = fs::temp_directory_path() / ("other_authority" + std::to_string(::getpid()));
  keys::Instant now_ = keys::instant_now();
  keys::Validity valid_{now_ - std::chrono::hours(1), now_ + std::chrono::days(10)};
  keys::Authority own_;
};

// TLS checks the times of a certificate only when a connection begins (RFC 5280, 6.1.3: valid at the current time).
TEST_F(OtherAuthority, A_certificate_counts_only_within_its_time) {
  const auto authority = ClientCertificates::open(folder_ / "ca.pem", {});
  ASSERT_TRUE(authority) << authority.error().text;
  EXPECT_EQ(authority->identify(certificate(own_, valid_)).role, Role::Program);
  for (const keys::Validity& other : {keys::Validity{now_ - std::chrono::hours(2), now_ - std::chrono::seconds(1)},
                                      keys::Validity{now_ + std::chrono::hours(1), now_ + std::chrono::hours(2)}}) {
    const Client client = authority->identify(certificate(own_, other));
    EXPECT_EQ(client.role, Role::Unknown);
    EXPECT_NE(client.refusal, "");
  }
}

TEST_F(OtherAuthority, A_list_that_comes_later_counts_and_does_not_go_again) {
  const auto authority = ClientCertificates::open(folder_ / "ca.pem", {});
  ASSERT_TRUE(authority) << authority.error().text;
  const std::string anna = certificate(own_, valid_);
  EXPECT_EQ(authority->identify(anna).refusal, "");
  write_list(keys::read_certificate(anna)->serial);
  EXPECT_NE(authority->identify(anna).refusal, "");
  EXPECT_EQ(authority->identify(certificate(own_, valid_)).refusal, "");
  fs::remove(folder_ / "revoked.pem");
  EXPECT_NE(authority->identify(anna).refusal, "");
}

// The list of an authority says nothing about certificates that others below it have issued (RFC 5280, 6.3.3).
TEST_F(OtherAuthority, With_a_list_only_its_own_certificates_count) {
  const auto authority = ClientCertificates::open(folder_ / "ca.pem", {});
  ASSERT_TRUE(authority) << authority.error().text;
  const std::string below = certificate(authority_named("below"), valid_);
  EXPECT_EQ(authority->identify(below).refusal, "") << "TLS has checked the chain";
  write_list("01");
  EXPECT_NE(authority->identify(below).refusal, "");
}

}  // namespace
}  // namespace indurop::serve
