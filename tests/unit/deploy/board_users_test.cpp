// SPDX-License-Identifier: Apache-2.0
// Who may give which command to a board: certificates, names, roles, limits. The signatures are made by libcrypto.

#include "deploy/agent/board_users.h"

#include <gmock/gmock.h>

#include <array>
#include <string>
#include <utility>

namespace indurop::deploy {
namespace {

using config::UserRole;
using testing::HasSubstr;

// An authority and what it, or another one, issues.
class Signer : public testing::Test {
 protected:
  Signer() {
    authority_.key = keys::make_key(keys::KeyKind::P256);
    authority_.certificate = keys::make_authority(authority_.key, {"cell", "", "cell authority"}, valid_);
    command_.plant = "cell";
    command_.board = "a";
    command_.agent = 1;
    command_.action = Action::Set;
    command_.target = "0 {\"who\":\"the boss\"}\nx=1";
    command_.commander = 2;
    command_.nonce = 3;
  }
  struct Holder {
    std::string key;
    std::string certificate;
  };
  static Holder issue(const keys::Authority& authority, const std::string& unit, const std::string& name,
                      const keys::Validity& valid) {
    std::string key = keys::make_key(keys::KeyKind::P256);
    std::string certificate = keys::make_certificate(authority, key, {"cell", unit, name}, valid);
    return {std::move(key), std::move(certificate)};
  }
  Holder user(const std::string& name) const { return issue(authority_, "user", name, valid_); }
  // Returns the name that counts, else why none does.
  std::string signer(const Holder& certificate, const std::string& key) const {
    return signer_of_text(certificate.certificate, keys::signature_of(command_text(command_), key));
  }
  std::string signer(const Holder& holder) const { return signer(holder, holder.key); }
  std::string signer_of_text(const std::string& certificate, const std::string& signature) const {
    const auto sut =
        signer_of(command_text(command_), {signature, certificate}, {"cell", authority_.certificate}, now_);
    return sut ? *sut : sut.error().text;
  }

  const keys::Instant now_{std::chrono::seconds(1'800'000'000)};
  const keys::Validity valid_{now_ - std::chrono::days(10), now_ + std::chrono::days(10)};
  keys::Authority authority_;
  Command command_;
};

TEST_F(Signer, Is_the_name_in_the_certificate_whatever_the_command_says) {
  EXPECT_EQ(signer(user("anna")), "anna");
}

TEST_F(Signer, Needs_the_key_of_the_certificate) {
  EXPECT_EQ(signer(user("anna"), user("ben").key), "it is not signed with the key of anna");
  EXPECT_EQ(signer_of_text(user("anna").certificate, ""), "it is not signed with the key of anna");
}

TEST_F(Signer, Signs_every_field_of_the_command) {
  const Holder anna = user("anna");
  const std::string signature = keys::signature_of(command_text(command_), anna.key);
  const Command original = command_;
  const auto changed = [&](auto Command::*field, auto value) {
    command_ = original;
    command_.*field = value;
    return signer_of_text(anna.certificate, signature);
  };
  const std::string refused = "it is not signed with the key of anna";
  EXPECT_EQ(changed(&Command::plant, std::string("other")), refused);
  EXPECT_EQ(changed(&Command::board, std::string("b")), refused);
  EXPECT_EQ(changed(&Command::agent, std::uint64_t{9}), refused);
  EXPECT_EQ(changed(&Command::action, Action::Force), refused);
  EXPECT_EQ(changed(&Command::target, std::string("0 {}\nx=2")), refused);
  EXPECT_EQ(changed(&Command::commander, std::uint64_t{9}), refused);
  EXPECT_EQ(changed(&Command::nonce, std::uint64_t{9}), refused) << "a recorded command has an old number";
}

TEST_F(Signer, Has_a_certificate_of_this_authority_for_users) {
  keys::Authority other;
  other.key = keys::make_key(keys::KeyKind::P256);
  other.certificate = keys::make_authority(other.key, {"cell", "", "cell authority"}, valid_);
  EXPECT_EQ(signer(issue(other, "user", "anna", valid_)),
            "its certificate was not issued by the authority of plant cell");
  EXPECT_EQ(signer_of_text("no certificate", "00"), "its certificate was not issued by the authority of plant cell");
  EXPECT_THAT(signer(issue(authority_, "viewer", "eve", valid_)), HasSubstr("eve has no certificate of a user"));
  EXPECT_THAT(signer(issue(authority_, "", "drive", valid_)), HasSubstr("drive has no certificate of a user"));
  const keys::Validity past{now_ - std::chrono::days(10), now_ - std::chrono::days(1)};
  EXPECT_EQ(signer(issue(authority_, "user", "anna", past)), "the certificate of anna is not valid now");
}

TEST(UserSignature, Comes_back_and_is_none_of_a_deployer) {
  const auto sut = read_user_signature(user_signature_text({"0a1b", "line 1\nline 2\n"}));
  ASSERT_TRUE(sut);
  EXPECT_EQ(sut->signature, "0a1b");
  EXPECT_EQ(sut->certificate, "line 1\nline 2\n");
  EXPECT_FALSE(read_user_signature(""));
  EXPECT_FALSE(read_user_signature("0a1b"));
  EXPECT_TRUE(read_user_signature("user\n")) << "cut, but not a deployer's";
}

// As documented in docs/serve.md for the same acts over HTTP.
TEST(UserRoles, Of_each_command) {
  constexpr std::array kNeeded{std::pair(Action::Set, UserRole::Operate),
                               std::pair(Action::AckAlarms, UserRole::Operate),
                               std::pair(Action::KeepBox, UserRole::Operate),
                               std::pair(Action::Record, UserRole::Operate),
                               std::pair(Action::EndRecord, UserRole::Operate),
                               std::pair(Action::DropRecord, UserRole::Operate),
                               std::pair(Action::Force, UserRole::Tune),
                               std::pair(Action::Unforce, UserRole::Tune),
                               std::pair(Action::ShelveAlarms, UserRole::Tune),
                               std::pair(Action::UnshelveAlarms, UserRole::Tune),
                               std::pair(Action::StopModule, UserRole::Program),
                               std::pair(Action::StartModule, UserRole::Program),
                               std::pair(Action::RestartModule, UserRole::Program),
                               std::pair(Action::StopNode, UserRole::Program),
                               std::pair(Action::StartNode, UserRole::Program),
                               std::pair(Action::RestartNode, UserRole::Program),
                               std::pair(Action::SetLock, UserRole::Program),
                               std::pair(Action::SetUsers, UserRole::Administer)};
  for (const auto& [action, role] : kNeeded) {
    EXPECT_EQ(needed_role(action), role) << static_cast<int>(action);
    for (const UserRole own :
         {UserRole::Look, UserRole::Operate, UserRole::Tune, UserRole::Program, UserRole::Administer}) {
      config::PlantUsers users;
      users.users = {{"anna", own, {}, {}, {}, {}}};
      EXPECT_EQ(beyond_role(users, "anna", action, "a").empty(), own >= role);
    }
  }
  // The last two: to exchange code is not for users, and lists of valid keys are signed by the authority.
  EXPECT_EQ(static_cast<std::size_t>(Action::SetTrust), kNeeded.size() + 1) << "an action without a decision";
}

TEST(UserRoles, Do_not_bring_code) {
  config::PlantUsers users;
  users.users = {{"anna", UserRole::Administer, {}, {}, {}, {}}};
  EXPECT_THAT(beyond_role(users, "anna", Action::ReloadModule, "a"), HasSubstr("deployers do that"));
}

TEST(UserRoles, Are_those_of_the_list_and_of_no_other_name) {
  config::PlantUsers users;
  users.users = {{"anna", UserRole::Program, {"press*", "drive"}, {}, {}, {}}};
  EXPECT_EQ(beyond_role(users, "anna", Action::Set, "press2"), "");
  EXPECT_EQ(beyond_role(users, "anna", Action::Set, "drive"), "");
  EXPECT_EQ(beyond_role(users, "anna", Action::Set, "drive2"), "anna may change boards press*, drive only");
  EXPECT_THAT(beyond_role(users, "Anna", Action::Set, "drive"), HasSubstr("Anna is not in this board's list of users"));
  EXPECT_THAT(beyond_role({}, "anna", Action::Set, "drive"), HasSubstr("not in this board's list"));
}

TEST(UserRoles, Are_limited_to_variables_and_their_parts) {
  const config::PlantUser user{"ben", UserRole::Operate, {}, {"press::*", "drive::speed"}, {}, {}};
  for (const char* allowed : {"press::force", "press::force.x", "press::list[3]", "drive::speed", "drive::speed.x"}) {
    EXPECT_EQ(beyond_variables(user, allowed), "") << allowed;
  }
  for (const char* beyond : {"drive::speeds", "drive::gain", "xpress::force", "press"}) {
    EXPECT_THAT(beyond_variables(user, beyond), HasSubstr("ben may change press::*, drive::speed only")) << beyond;
  }
}

}  // namespace
}  // namespace indurop::deploy
