// SPDX-License-Identifier: Apache-2.0
// A plant's keys: what is made, what is never replaced, what is found to be wrong, and what check says of a manifest.

#include <sys/stat.h>

#include "core/keys/revocation.h"
#include "tests/unit/core/keys/keys_fixture.h"

namespace indurop::keys {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST_F(Keys, Every_participant_gets_what_it_needs) {
  make();
  EXPECT_TRUE(sut.exist());
  EXPECT_EQ(sut.plant(), "cell");
  std::vector<std::string> names;
  for (const KeyListing& each : sut.list(now)) {
    names.push_back(each.name);
    EXPECT_EQ(each.problem, "");
    EXPECT_EQ(each.validity.until, now + days(100));
  }
  EXPECT_THAT(names, ElementsAre("a", "b", "viewer", "deployer"));
  EXPECT_EQ(check(sut.board("a")).problem, "");
  EXPECT_EQ(read_certificate(text_of(ParticipantKeys(sut.board("a")).certificate))->subject, "CN=a,O=cell");
}

TEST_F(Keys, Secrets_are_their_owners_alone) {
  make();
  int secrets = 0;
  for (const auto& entry : fs::recursive_directory_iterator(sut.folder())) {
    struct stat found {};
    ASSERT_EQ(::stat(entry.path().c_str(), &found), 0);
    if (entry.is_regular_file() && text_of(entry.path()).find("PRIVATE KEY") != std::string::npos) {
      ++secrets;
      EXPECT_EQ(found.st_mode & 0777U, 0600U) << entry.path();
    }
    if (entry.is_directory()) {
      EXPECT_EQ(found.st_mode & 0777U, 0700U) << entry.path();
    }
  }
  EXPECT_EQ(secrets, 6) << "the authority, two boards, viewer, deployer, deployments";
  EXPECT_EQ(text_of(sut.folder() / ".gitignore"), "*\n");
}

TEST_F(Keys, Are_never_made_over_others) {
  make();
  const std::string before = text_of(sut.folder() / "ca.key");
  EXPECT_THAT(sut.make("cell", {"a"}, now + days(1)).error().text, HasSubstr("nothing was written"));
  EXPECT_THAT(sut.add("a", now + days(1)).error().text, HasSubstr("has keys already"));
  EXPECT_EQ(text_of(sut.folder() / "ca.key"), before);
}

// What is written again without what was in it would lose certificates, revocations or deployers.
TEST_F(Keys, A_shared_file_that_cannot_be_read_is_named) {
  for (const std::string file : {"ca.pem", "governance.p7s", "revoked.pem", "issued.txt", "deploy.pub"}) {
    make();
    EXPECT_EQ(sut.unreadable(), "");
    fs::remove(sut.folder() / file);
    fs::create_directory(sut.folder() / file);
    EXPECT_THAT(sut.unreadable(), HasSubstr("cannot read " + (sut.folder() / file).string()));
    fs::remove_all(sut.folder());
  }
}

TEST_F(Keys, Without_the_key_of_the_authority_nothing_is_issued_and_revoked) {
  make();
  fs::remove(sut.folder() / "ca.key");
  const std::string why = "cannot read " + (sut.folder() / "ca.key").string();
  EXPECT_THAT(sut.add("c", now + days(1)).error().text, HasSubstr(why));
  EXPECT_THAT(sut.renew(listed("a"), now + days(1)).error().text, HasSubstr(why));
  EXPECT_THAT(sut.revoke(listed("a")).error().text, HasSubstr(why));
  EXPECT_FALSE(listed("a").revoked);
}

TEST_F(Keys, A_certificate_and_a_private_key_that_cannot_be_read_are_named) {
  make();
  const ParticipantKeys board(sut.board("a"));
  fs::remove(board.key);
  EXPECT_THAT(sut.renew(listed("a"), now + days(1)).error().text, HasSubstr("cannot read " + board.key.string()));
  fs::remove(board.certificate);
  EXPECT_THAT(listed("a").problem, HasSubstr("cannot read " + board.certificate.string()));
}

TEST_F(Keys, Nothing_is_left_behind_where_they_cannot_be_made) {
  std::ofstream(folder_ / "file") << "x";
  const PlantKeys below(folder_ / "file" / "keys");
  EXPECT_THAT(below.make("cell", {"a"}, now + days(1)).error().text, HasSubstr("cannot make"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / ""), {}), 1);
}

TEST_F(Keys, A_board_that_has_come_gets_its_own) {
  make();
  EXPECT_TRUE(sut.add("c", now + days(10)));
  EXPECT_EQ(check(sut.board("c"), "c").problem, "");
  EXPECT_EQ(listed("c").problem, "");
}

TEST_F(Keys, Renewed_ones_are_valid_longer_for_the_same_key) {
  make();
  const ParticipantKeys keys(sut.board("a"));
  const std::string key = text_of(keys.key);
  EXPECT_EQ(check(keys.folder, "a", days(200)).fault, KeyFault::NotNow);
  EXPECT_TRUE(sut.renew(listed("a"), now + days(300)));
  EXPECT_EQ(check(keys.folder, "a", days(200)).problem, "");
  EXPECT_EQ(text_of(keys.key), key);
}

TEST_F(Keys, Revoked_ones_count_no_more_nor_do_those_before_a_renewal) {
  make();
  const std::string before = text_of(ParticipantKeys(sut.board("a")).certificate);
  EXPECT_TRUE(sut.renew(listed("a"), now + days(300)));
  EXPECT_TRUE(sut.revoke(listed("a")));
  EXPECT_TRUE(sut.revoke(listed("viewer")));
  EXPECT_EQ(listed("a").problem, "revoked");
  EXPECT_EQ(listed("viewer").problem, "revoked");
  EXPECT_EQ(listed("b").problem, "");
  const std::string list = text_of(ParticipantKeys(sut.board("b")).revoked);
  EXPECT_TRUE(is_revoked(before, list));
  EXPECT_TRUE(is_revoked(text_of(ParticipantKeys(sut.board("a")).certificate), list));
  EXPECT_EQ(check(sut.board("a")).fault, KeyFault::Wrong);
}

TEST_F(Keys, Those_of_another_board_are_found_out) {
  make();
  EXPECT_THAT(check(sut.board("b")).problem, HasSubstr("is the certificate of b of plant cell"));
  fs::copy_file(ParticipantKeys(sut.board("b")).key, ParticipantKeys(sut.board("a")).key,
                fs::copy_options::overwrite_existing);
  EXPECT_THAT(check(sut.board("a")).problem, HasSubstr("is not the key of"));
}

TEST_F(Keys, Documents_that_were_changed_are_found_out) {
  make();
  const ParticipantKeys keys(sut.board("a"));
  std::string text = text_of(keys.permissions);
  const auto at = text.find("indurop/6/cell/a/");
  ASSERT_NE(at, std::string::npos) << "the text is readable in the document";
  text.replace(at, 17, "indurop/6/cell/b/");
  std::ofstream(keys.permissions) << text;
  EXPECT_THAT(check(keys.folder).problem, AllOf(HasSubstr("permissions.p7s is not signed by"), HasSubstr("ca.pem")));
}

TEST_F(Keys, A_boards_certificate_cannot_sign_documents) {
  make();
  const ParticipantKeys keys(sut.viewer());
  const Authority self{text_of(keys.certificate), text_of(keys.key)};
  EXPECT_EQ(signed_text(sign_document(self, governance_document()), text_of(keys.authority)), "");
}

TEST_F(Keys, Files_that_are_none_are_errors) {
  make();
  const ParticipantKeys keys(sut.board("a"));
  fs::remove(keys.permissions);
  EXPECT_EQ(check(keys.folder).fault, KeyFault::Missing);
  EXPECT_THAT(check(keys.folder).problem, HasSubstr("permissions.p7s: No such file"));
  fs::create_directory(keys.permissions);
  EXPECT_EQ(check(keys.folder).fault, KeyFault::Missing);
  std::ofstream(keys.certificate) << "nonsense";
  EXPECT_NE(listed("a").problem, "");
}

TEST_F(Keys, Another_authoritys_are_found_out) {
  make();
  const PlantKeys other(folder_ / "other");
  ASSERT_TRUE(other.make("cell", {"a"}, now + days(1)));
  fs::copy_file(ParticipantKeys(other.board("a")).authority, ParticipantKeys(sut.board("a")).authority,
                fs::copy_options::overwrite_existing);
  EXPECT_THAT(check(sut.board("a")).problem, HasSubstr("was not issued by"));
}

TEST_F(Keys, A_signature_holds_for_one_text_and_one_key) {
  const std::string key = make_key(KeyKind::Ed25519);
  const std::string signature = signature_of("deployment", key);
  EXPECT_EQ(signature.size(), 128U);
  EXPECT_TRUE(signature_holds("deployment", signature, public_half(key)));
  EXPECT_FALSE(signature_holds("Deployment", signature, public_half(key)));
  EXPECT_FALSE(signature_holds("deployment", signature, public_half(make_key(KeyKind::Ed25519))));
  EXPECT_FALSE(signature_holds("deployment", "", public_half(key)));
  EXPECT_FALSE(signature_holds("deployment", "zz", public_half(key)));
  EXPECT_FALSE(signature_holds("deployment", signature, "no key"));
}

TEST(Permissions, A_board_publishes_its_own_variables_only) {
  const Validity validity{valid_from(), valid_from() + days(1)};
  const std::string board = permissions_document({Role::Board, "cell", "a"}, "CN=a,O=cell", validity);
  EXPECT_THAT(board, HasSubstr("<subject_name>CN=a,O=cell</subject_name>"));
  EXPECT_THAT(board, HasSubstr("<topic>indurop/6/cell/a/*</topic>"));
  EXPECT_LT(board.find("<subscribe>"), board.find("<topic>indurop/6/cell/*</topic>"));
  EXPECT_THAT(board, HasSubstr("<default>DENY</default>"));
  const std::string viewer = permissions_document({Role::Viewer, "cell", "viewer"}, "x", validity);
  EXPECT_THAT(viewer.substr(viewer.find("<deny_rule>")), Not(HasSubstr("<publish><topics>\n          <topic>*")));
}

TEST(Permissions, Patterns_of_variables_never_reach_topics_of_the_platform) {
  const Validity validity{valid_from(), valid_from() + days(1)};
  const std::string tool =
      permissions_document({Role::Tool, "cell", "t", {{"a::*", "b.c"}, {"*"}}}, "CN=t,O=cell", validity);
  const auto deny = tool.find("<deny_rule>");
  ASSERT_NE(deny, std::string::npos);
  EXPECT_NE(tool.find("<topic>indurop/[0-9]*</topic>", deny), std::string::npos);
  for (const char* topic : {"<topic>*</topic>", "<topic>a/*</topic>", "<topic>rt/a/*</topic>", "<topic>b/c</topic>"}) {
    EXPECT_GT(tool.find(topic), deny) << topic;
    EXPECT_NE(tool.find(topic), std::string::npos) << topic;
  }
  EXPECT_THAT(tool, Not(HasSubstr("/cell/")));
}

TEST_F(Keys, A_tool_has_its_lists_and_keeps_them_when_it_is_renewed) {
  make();
  ASSERT_TRUE(sut.add_tool("panel", {{"cell::*"}, {"cell::target"}}, now + days(10)));
  EXPECT_EQ(listed("panel").problem, "");
  EXPECT_THAT(listed("panel").variables.read, ElementsAre("cell::*"));
  EXPECT_THAT(listed("panel").variables.write, ElementsAre("cell::target"));
  const fs::path folder = sut.tool("panel");
  std::ofstream(folder / "variables.txt") << "read cell::*\nread other::*\n";
  EXPECT_THAT(listed("panel").problem, HasSubstr("indurop keys renew panel"));
  EXPECT_TRUE(sut.renew(listed("panel"), now + days(20)));
  EXPECT_EQ(listed("panel").problem, "");
  EXPECT_THAT(text_of(folder / "permissions.p7s"), HasSubstr("<topic>other/*</topic>"));
  std::ofstream(folder / "variables.txt") << "read cell::*\nwrites other\n";
  EXPECT_THAT(listed("panel").problem, HasSubstr("variables.txt:2:1: error: 'writes other' is neither"));
  EXPECT_THAT(sut.renew(listed("panel"), now + days(30)).error().text, HasSubstr("variables.txt:2:1: error"));
}

TEST_F(Keys, A_name_has_keys_once) {
  make();
  EXPECT_THAT(sut.add_tool("a", {{"*"}, {}}, now + days(1)).error().text, HasSubstr("a has keys already"));
  ASSERT_TRUE(sut.add_tool("panel", {{"*"}, {}}, now + days(1)));
  EXPECT_THAT(sut.add("panel", now + days(1)).error().text, HasSubstr("panel has keys already"));
}

// Fast DDS begins to shake hands in a way that Cyclone DDS does not understand: boards have to begin.
TEST_F(Keys, Tools_are_numbered_above_boards) {
  make();
  ASSERT_TRUE(sut.add_tool("panel", {{"*"}, {}}, now + days(1)));
  const auto facts = read_certificate(text_of(ParticipantKeys(sut.tool("panel")).certificate));
  ASSERT_TRUE(facts);
  const auto unit = facts->subject.find("OU=") + 3;
  const std::string name = facts->subject.substr(unit, facts->subject.find(',', unit) - unit);
  EXPECT_EQ(subject_digest({"cell", name, "panel"}).substr(0, 3), "fff") << facts->subject;
  EXPECT_EQ(subject_digest({"cell", "", "a"}), subject_digest({"cell", "", "a"}));
}

TEST_F(Keys, Those_of_another_release_are_found_out) {
  make();
  const ParticipantKeys keys(sut.board("a"));
  const Authority authority{text_of(sut.folder() / "ca.pem"), text_of(sut.folder() / "ca.key")};
  std::string text = signed_text(text_of(keys.permissions), authority.certificate);
  std::erase(text, '\r');
  const auto at = text.find("reply</topic>");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 5, "other");
  std::ofstream(keys.permissions) << sign_document(authority, text);
  EXPECT_EQ(check(keys.folder).fault, KeyFault::Outdated);
  EXPECT_THAT(listed("a").problem, HasSubstr("indurop keys renew a"));
  EXPECT_THAT(checked("<security>keys</security>"), Contains(HasSubstr("warning: keys of board 'a'")));
}

TEST_F(Keys, Of_a_plant_or_a_participant_are_meant) {
  make();
  EXPECT_EQ(resolve_keys(sut.folder(), Role::Viewer)->folder, sut.viewer());
  EXPECT_EQ(resolve_keys(sut.folder(), Role::Deployer)->folder, sut.deployer());
  EXPECT_EQ(resolve_keys(sut.board("a"), Role::Viewer)->folder, sut.board("a"));
  EXPECT_THAT(resolve_keys(folder_ / "none", Role::Viewer).error().text, HasSubstr("there are no keys in"));
  fs::remove(ParticipantKeys(sut.viewer()).key);
  EXPECT_THAT(resolve_keys(sut.folder(), Role::Viewer).error().text, HasSubstr("identity.key: No such file"));
}

TEST(Patterns, Are_names_with_stars) {
  EXPECT_THAT(pattern_list("a::*, b.c"), ElementsAre("a::*", "b.c"));
  EXPECT_EQ(pattern_problem("knu::Robot::j[0-9]?"), "");
  EXPECT_NE(pattern_problem(""), "");
  EXPECT_THAT(pattern_list(""), ElementsAre("")) << "that is a mistake, and no list without limits";
  EXPECT_THAT(pattern_list(" "), ElementsAre(""));
  EXPECT_NE(pattern_problem("a<b"), "");
  EXPECT_NE(pattern_problem("a b"), "");
}

TEST_F(Keys, Check_says_that_a_plant_is_open) {
  EXPECT_THAT(checked(""), Contains(HasSubstr("note: the plant is open")));
}

TEST_F(Keys, Check_looks_for_those_of_every_board) {
  EXPECT_THAT(checked("<security>keys</security>"),
              Contains(AllOf(HasSubstr("error: keys of board 'a'"), HasSubstr("indurop keys init"))));
  make();
  EXPECT_THAT(checked("<security>keys</security>"), Not(Contains(HasSubstr("keys"))));
  fs::remove_all(sut.board("b"));
  EXPECT_THAT(checked("<security>keys</security>"), Contains(HasSubstr("error: keys of board 'b'")));
  EXPECT_THAT(checked("<security>keys</security>", {.machine = true, .board = "a"}), Not(Contains(HasSubstr("keys"))));
}

TEST_F(Keys, Check_finds_boards_that_would_not_let_each_other_in) {
  make();
  const PlantKeys other(folder_ / "other");
  ASSERT_TRUE(other.make("cell", {"b"}, now + days(100)));
  fs::remove_all(sut.board("b"));
  fs::rename(other.board("b"), sut.board("b"));
  EXPECT_THAT(checked("<security>keys</security>"),
              Contains(HasSubstr("error: the keys of board 'b' were issued by another authority")));
}

TEST_F(Keys, Check_warns_before_they_end) {
  make(days(5));
  EXPECT_THAT(checked("<security>keys</security>"),
              Contains(HasSubstr("warning: the keys of board 'a' are valid until")));
}

TEST_F(Keys, A_board_whose_keys_have_ended_runs_on_its_own) {
  make(days(-1));
  EXPECT_THAT(checked("<security>keys</security>"), Contains(HasSubstr("error: keys of board 'a'")));
  EXPECT_THAT(checked("<security>keys</security>", {.machine = true, .board = "a"}),
              AllOf(Contains(HasSubstr("warning: keys of board 'a'")), Not(Contains(HasSubstr("error")))));
}

}  // namespace
}  // namespace indurop::keys
