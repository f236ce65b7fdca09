// SPDX-License-Identifier: Apache-2.0
// Viewers and deployers that are replaced, keys that sign deployments and are changed, names that are not allowed.

#include "tests/unit/core/keys/keys_fixture.h"

namespace indurop::keys {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST_F(Keys, There_may_be_several_viewers_and_deployers) {
  make();
  ASSERT_TRUE(sut.add_viewer("eve", now + days(10)));
  ASSERT_TRUE(sut.add_deployer("bob", now + days(10)));
  std::vector<std::string> names;
  for (const KeyListing& each : sut.list(now)) {
    names.push_back(each.name);
    EXPECT_EQ(each.problem, "") << each.name;
    const auto facts = read_certificate(text_of(ParticipantKeys(each.folder).certificate));
    EXPECT_EQ(plant_role(*facts), each.role) << each.name;
    EXPECT_EQ(text_of(each.folder / "deploy.pub"), text_of(sut.folder() / "deploy.pub")) << "all have the new one";
  }
  EXPECT_THAT(names, ElementsAre("a", "b", "viewer", "eve", "deployer", "bob"));
  EXPECT_THAT(text_of(sut.viewer("eve") / "permissions.p7s"), Not(HasSubstr("deploy/order")));
  EXPECT_FALSE(fs::exists(sut.viewer("eve") / "deploy.key"));
  EXPECT_FALSE(is_plant_certificate(CertificateFacts{"", "cell", "x", "", {}, "deployer", {"cell", "", "cell"}}));
}

// What deploy.pub of `keys` says about what the deploy.key in `deployer` signs.
bool counts(const PlantKeys& keys, const std::string& key) {
  return signed_by_any("order", signature_of("order", key), text_of(keys.board("a") / "deploy.pub"));
}

TEST_F(Keys, A_deployer_that_was_revoked_is_replaced) {
  make();
  const std::string first = text_of(sut.deployer() / "deploy.key");
  EXPECT_TRUE(counts(sut, first));
  ASSERT_TRUE(sut.revoke(listed("deployer")));
  EXPECT_FALSE(counts(sut, first)) << "nor do its signatures count";
  EXPECT_THAT(resolve_keys(sut.folder(), Role::Deployer).error().text, HasSubstr("keys add --deployer"));
  EXPECT_THAT(sut.add_deployer("deployer", now + days(1)).error().text, HasSubstr("was revoked"));
  ASSERT_TRUE(sut.add_deployer("bob", now + days(10)));
  EXPECT_TRUE(counts(sut, text_of(sut.deployer("bob") / "deploy.key")));
  EXPECT_FALSE(counts(sut, first));
  EXPECT_EQ(resolve_keys(sut.folder(), Role::Deployer)->folder, sut.deployer("bob"));
  fs::rename(sut.deployer(), folder_ / "away");
  ASSERT_TRUE(sut.add_deployer("deployer", now + days(10)));
  EXPECT_EQ(listed("deployer").problem, "") << "under its old name, too";
  EXPECT_EQ(resolve_keys(sut.folder(), Role::Deployer)->folder, sut.deployer());
  EXPECT_FALSE(counts(sut, first));
  EXPECT_TRUE(counts(sut, text_of(sut.deployer() / "deploy.key")));
}

TEST_F(Keys, A_deploy_key_is_changed_while_both_count) {
  make();
  ASSERT_TRUE(sut.add_deployer("bob", now + days(10)));
  const std::string bob = text_of(sut.deployer("bob") / "deploy.key");
  const std::string before = text_of(sut.deployer() / "deploy.key");
  ASSERT_TRUE(sut.rotate(listed("deployer")));
  const std::string after = text_of(sut.deployer() / "deploy.key");
  EXPECT_NE(before, after);
  for (const std::string& key : {before, after, bob}) {
    EXPECT_TRUE(counts(sut, key));
  }
  EXPECT_THAT(sut.rotate(listed("deployer")).error().text, HasSubstr("rotate --finish"));
  EXPECT_EQ(read_deploy_list(text_of(sut.folder() / "deploy.pub")).front().pem, public_half(before))
      << "the first key is all that older releases read";
  EXPECT_EQ(*sut.finish_rotation(), 1U);
  EXPECT_FALSE(counts(sut, before));
  EXPECT_TRUE(counts(sut, after) && counts(sut, bob));
  EXPECT_FALSE(fs::exists(sut.deployer() / "deploy.key.before"));
  EXPECT_EQ(*sut.finish_rotation(), 0U);
}

TEST_F(Keys, A_deploy_pub_of_an_earlier_release_is_one_key) {
  const std::string key = make_key(KeyKind::Ed25519);
  const auto list = read_deploy_list(public_half(key));
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0].deployer, "deployer");
  EXPECT_TRUE(signed_by_any("order", signature_of("order", key), public_half(key)));
  for (const char* nonsense :
       {"", "# empty\n", "-----BEGIN PUBLIC KEY-----\n", "-----BEGIN PUBLIC KEY-----\nx\n-----END PUBLIC KEY-----\n"}) {
    EXPECT_FALSE(signed_by_any("order", signature_of("order", key), nonsense)) << nonsense;
  }
  EXPECT_FALSE(signed_by_any("order", "", public_half(key)));
}

TEST_F(Keys, No_board_is_made_of_a_word_that_means_a_role) {
  make();
  for (const char* name : {"deployer", "viewer", "deployers", "viewers", "tool", "board"}) {
    EXPECT_THAT(sut.add(name, now + days(1)).error().text, HasSubstr("is the name of a role")) << name;
    EXPECT_FALSE(sut.add_tool(name, {{"*"}, {}}, now + days(1))) << name;
    EXPECT_FALSE(PlantKeys(folder_ / "other").make("cell", {"a", name}, now + days(1))) << name;
    EXPECT_FALSE(fs::exists(sut.board(name)));
  }
  EXPECT_THAT(sut.add("deployer", now + days(1)).error().text, HasSubstr("indurop keys add --deployer NAME"));
  EXPECT_FALSE(sut.add_viewer("deployer", now + days(1)));
  config::ReadPlant read = config::read_plant_text(
      "<plant name=\"cell\"><security>keys</security><board name=\"viewer\"></board></plant>", folder_ / "plant.xml");
  EXPECT_THAT(config::lines(config::check_plant(read.plant, {}).diagnostics),
              Contains(AllOf(HasSubstr("error: "), HasSubstr("the name of a role"))));
  EXPECT_EQ(how_to_add(Role::Viewer, "eve"), "indurop keys add --viewer eve");
  EXPECT_EQ(how_to_add(Role::Board, "drive"), "indurop keys add drive");
}

TEST_F(Keys, A_private_key_that_others_can_read_is_said) {
  make();
  EXPECT_EQ(check(sut.board("a")).exposed, "");
  EXPECT_EQ(exposed_key(folder_ / "none"), "");
  EXPECT_THAT(checked("<security>keys</security>"), Not(Contains(HasSubstr("users other than its owner"))));
  fs::permissions(ParticipantKeys(sut.board("a")).key, fs::perms::group_read, fs::perm_options::add);
  fs::permissions(sut.deployer() / "deploy.key", fs::perms::others_read, fs::perm_options::add);
  EXPECT_THAT(check(sut.board("a")).exposed, HasSubstr("chmod 600"));
  EXPECT_EQ(check(sut.board("a")).problem, "") << "it can be used";
  EXPECT_THAT(listed("deployer").exposed, HasSubstr("deploy.key"));
  EXPECT_THAT(checked("<security>keys</security>"), Contains(AllOf(HasSubstr("warning: "), HasSubstr("identity.key"))));
}

}  // namespace
}  // namespace indurop::keys
