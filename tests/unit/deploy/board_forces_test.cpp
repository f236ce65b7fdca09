// SPDX-License-Identifier: Apache-2.0
// Leases of clients of other hosts belong to who took them, whatever a command says.

#include "deploy/agent/board_forces.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <optional>

#include "store/vars/custody.h"
#include "store/vars/shm_file.h"

namespace indurop::deploy {
namespace {

class BoardForcesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string folder = (std::filesystem::temp_directory_path() / "forces_XXXXXX").string();
    ASSERT_NE(::mkdtemp(folder.data()), nullptr);
    folder_ = folder;
    ASSERT_EQ(::setenv("INDUROP_STATE_DIR", folder.c_str(), 1), 0);
    std::filesystem::create_directories(folder_ / node_);
    ASSERT_TRUE(vars::Custody::create(node_).ok());
    schema::Schema schema;
    schema::Variable gain;
    gain.name = "cell::gain";
    gain.type.base = schema::Base::Double;
    gain.type.element_size = sizeof(double);
    gain.type.align = alignof(double);
    gain.type_hash = schema::hash_of(gain.type);
    schema.variables = {gain};
    auto made = vars::Store::create(node_, schema);
    ASSERT_TRUE(made.ok());
    store_.emplace(std::move(made).value());
  }
  void TearDown() override {
    EXPECT_TRUE(vars::remove_shm_file(vars::block_file(node_)).ok());
    EXPECT_TRUE(vars::remove_shm_file(vars::custody_file(node_)).ok());
    std::filesystem::remove_all(folder_);
    ::unsetenv("INDUROP_STATE_DIR");
  }
  Command command(Action action, const std::string& target) const {
    Command made;
    made.commander = 7;
    made.board = node_;
    made.action = action;
    made.target = target;
    return made;
  }
  std::string carry_out(Action action, const std::string& target, const std::string& user) {
    const auto done = sut_.carry_out(command(action, target), user);
    return done ? "" : done.error().text;
  }

  const std::string node_ = "forces_test_" + std::to_string(::getpid());
  std::filesystem::path folder_;
  std::optional<vars::Store> store_;
  BoardForces sut_{node_};
};

TEST_F(BoardForcesTest, A_lease_is_renewed_and_ended_by_who_has_it_only) {
  constexpr const char* kForce = "5000000000 {\"lease\":true,\"who\":\"anna\"}\ncell::gain=1";
  constexpr const char* kRenew = "5000000000 {\"renew\":true,\"who\":\"anna\"}\n";
  constexpr const char* kEnd = "0 {\"renew\":true,\"end\":true,\"who\":\"anna\"}\n";
  ASSERT_EQ(carry_out(Action::Force, kForce, "anna"), "");
  EXPECT_EQ(carry_out(Action::Force, kRenew, "anna"), "");
  for (const char* other : {"ben", ""}) {
    EXPECT_EQ(carry_out(Action::Force, kRenew, other), "this lease is that of another user");
    EXPECT_EQ(carry_out(Action::Force, kEnd, other), "this lease is that of another user");
  }
  for (const Action action : {Action::Set, Action::Unforce}) {
    (void)carry_out(action, std::string(kEnd) + "cell::none", "anna");
    EXPECT_EQ(store_->forces().size(), 1U) << "another action, for which another role suffices, ends no lease";
  }
  EXPECT_EQ(carry_out(Action::Force, kEnd, "anna"), "");
  EXPECT_THAT(store_->forces(), ::testing::IsEmpty());
}

}  // namespace
}  // namespace indurop::deploy
