// SPDX-License-Identifier: Apache-2.0
// What a board does with lists of valid keys: deployments and commands of those who are revoked, the audit log, and the
// order in which boards that meet in any order get lists from each other.

#include "deploy/agent/trust_lists.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <memory>
#include <random>
#include <vector>

#include "core/keys/participant_keys.h"
#include "core/keys/plant_keys.h"
#include "deploy/agent/board_users.h"
#include "store/operate/audit.h"
#include "tests/unit/core/keys/keys_fixture.h"

namespace indurop::deploy {
namespace {

namespace fs = std::filesystem;
using keys::text_of;
using std::chrono::days;
using testing::HasSubstr;

// Boards of a plant with keys, each with its folder of keys and its state.
class TrustLists : public testing::Test {
 protected:
  TrustLists() : plant_(folder_ / "keys") {
    ::setenv("INDUROP_STATE_DIR", (folder_ / "state").c_str(), 1);
    ::setenv("INDUROP_KEYS_DIR", (folder_ / "etc").c_str(), 1);
    EXPECT_TRUE(plant_.make("cell", {"b0", "b1", "b2", "b3"}, now_ + days(100)));
    fs::create_directories(folder_ / "etc/cell");
    for (std::size_t i = 0; i < kBoards; ++i) {
      fs::copy(plant_.board(name(i)), folder_ / "etc/cell" / name(i));
      boards_.push_back(std::make_unique<DeployKeys>(name(i)));
    }
  }
  ~TrustLists() override {
    ::unsetenv("INDUROP_STATE_DIR");
    ::unsetenv("INDUROP_KEYS_DIR");
  }
  static std::string name(std::size_t board) { return "b" + std::to_string(board); }
  Result<std::string, base::Problem> take(std::size_t board, const std::string& list,
                                          const std::string& from = "desk") {
    return take_trust_list(name(board), *boards_[board], "cell", from, list);
  }
  keys::KeyListing listed(const std::string& whose) const {
    for (const keys::KeyListing& each : plant_.list(now_)) {
      if (each.name == whose) {
        return each;
      }
    }
    ADD_FAILURE() << "no keys of " << whose;
    return {};
  }
  // Why the board refuses a deployment that is signed with this key.
  std::string refusal(std::size_t board, const std::string& key) const {
    return boards_[board]->refusal("cell", "order", keys::signature_of("order", key));
  }

  static constexpr std::size_t kBoards = 4;
  config::ModuleFolder folder_;
  const keys::Instant now_ = keys::instant_now();
  keys::PlantKeys plant_;
  std::vector<std::unique_ptr<DeployKeys>> boards_;
};

TEST_F(TrustLists, A_stolen_deploy_key_is_replaced_by_one_that_the_board_did_not_know) {
  const std::string stolen = text_of(listed("deployer").folder / "deploy.key");
  ASSERT_TRUE(plant_.add_deployer("bob", now_ + days(10)));
  const std::string bob = text_of(listed("bob").folder / "deploy.key");
  EXPECT_EQ(refusal(0, stolen), "");
  EXPECT_NE(refusal(0, bob), "");
  const std::string with_both = *plant_.trust_list();
  ASSERT_TRUE(plant_.revoke(listed("deployer")));
  const OwnKeys before = boards_[0]->own("cell");
  const auto taken = take(0, *plant_.trust_list());
  ASSERT_TRUE(taken) << taken.error().text;
  EXPECT_THAT(*taken, HasSubstr("of the keys of plant cell is valid now"));
  EXPECT_THAT(refusal(0, stolen), HasSubstr("not signed with the key of plant cell"));
  EXPECT_EQ(refusal(0, bob), "");
  EXPECT_NE(boards_[0]->own("cell"), before) << "the agent joins the network again";
  EXPECT_THAT(take(0, with_both).error().text, HasSubstr("this board has list")) << "a thief sends an earlier list";
  EXPECT_NE(refusal(0, stolen), "");
  EXPECT_EQ(*take(0, *plant_.trust_list()), "") << "it has it already";
}

TEST_F(TrustLists, A_command_of_a_revoked_user_is_refused) {
  ASSERT_TRUE(plant_.add_user("anna", now_ + days(10)));
  const keys::ParticipantKeys anna(listed("anna").folder);
  const BoardUsers sut("b0", *boards_[0]);
  Command command;
  command.plant = "cell";
  command.board = "b0";
  command.action = Action::StopNode;
  command.signature =
      user_signature_text({keys::signature_of(command_text(command), text_of(anna.key)), text_of(anna.certificate)});
  EXPECT_THAT(sut.judge(command, "cell").refusal, HasSubstr("anna is not in this board's list of users"));
  ASSERT_TRUE(plant_.revoke(listed("anna")));
  ASSERT_TRUE(take(0, *plant_.trust_list()));
  EXPECT_EQ(sut.judge(command, "cell").refusal, "the keys of anna are revoked");
}

TEST_F(TrustLists, Are_in_the_audit_log_and_taken_without_it) {
  ASSERT_TRUE(plant_.revoke(listed("viewer")));
  const std::string list = *plant_.trust_list();
  const fs::path log = operate::usual_audit_file();
  fs::create_directories(log.parent_path());
  fs::create_symlink("/dev/full", log);
  EXPECT_THAT(*take(1, list), HasSubstr("it cannot be logged in")) << "a full disk does not keep keys valid";
  EXPECT_EQ(boards_[1]->trust("cell").current().document, list);
  fs::remove(log);
  ASSERT_TRUE(take(0, list, "another board"));
  const std::string logged = text_of(log);
  EXPECT_THAT(logged, HasSubstr("the authority of cell"));
  EXPECT_THAT(logged, HasSubstr("another board"));
  EXPECT_THAT(logged, HasSubstr("set valid keys"));
}

TEST_F(TrustLists, A_board_without_keys_takes_none) {
  const DeployKeys keyless("b9");
  EXPECT_EQ(take_trust_list("b9", keyless, "cell", "desk", *plant_.trust_list()).error().text,
            "this board has no keys");
}

TEST_F(TrustLists, Are_passed_on_until_all_boards_have_the_last_one) {
  std::mt19937 random(1);
  for (int round = 0; round < 5; ++round) {
    ASSERT_TRUE(plant_.add_deployer("d" + std::to_string(round), now_ + days(10)));
    const std::string last = *plant_.trust_list();
    // It reaches one board, then boards meet in pairs, one asking the other, until each may have heard of it.
    ASSERT_TRUE(take(random() % kBoards, last));
    for (std::size_t meeting = 0; meeting < kBoards; ++meeting) {
      for (std::size_t i = 0; i < kBoards; ++i) {
        const std::size_t other = random() % kBoards;
        const std::string newer = trust_list_after(*boards_[other], "cell", trust_id(*boards_[i], "cell"));
        EXPECT_TRUE(newer.empty() || take(i, newer, "another board"));
      }
    }
    for (std::size_t i = 0; i < kBoards; ++i) {
      for (std::size_t other = 0; other < kBoards; ++other) {
        const std::string newer = trust_list_after(*boards_[other], "cell", trust_id(*boards_[i], "cell"));
        EXPECT_TRUE(newer.empty() || take(i, newer, "another board"));
      }
      EXPECT_EQ(boards_[i]->trust("cell").current().document, last);
    }
  }
  EXPECT_EQ(trust_list_after(*boards_[0], "cell", trust_id(*boards_[0], "cell")), "");
  EXPECT_EQ(trust_list_after(*boards_[0], "press", ""), "");
  EXPECT_NE(trust_list_after(*boards_[0], "cell", "no number"), "");
}

}  // namespace
}  // namespace indurop::deploy
