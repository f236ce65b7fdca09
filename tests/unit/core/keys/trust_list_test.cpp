// SPDX-License-Identifier: Apache-2.0
// Lists of valid keys: what the authority signs, what boards take, and which of several lists is valid. OpenSSL's
// command line verifies a list, too.

#include "core/keys/trust_list.h"

#include <cstdlib>
#include <random>

#include "core/keys/revocation.h"
#include "tests/support/damaged_text.h"
#include "tests/unit/core/keys/keys_fixture.h"

namespace indurop::keys {
namespace {

using testing::HasSubstr;

class Trust : public Keys {
 protected:
  // A board whose folder of keys is that of the plant now.
  ReceivedTrust board(const std::string& name) {
    const fs::path own = folder_ / ("etc-" + name);
    fs::copy(sut.board(name), own);
    return {ParticipantKeys(own), folder_ / ("state-" + name)};
  }
  std::string list() const {
    const auto text = sut.trust_list();
    EXPECT_TRUE(text) << text.error().text;
    return text ? *text : std::string();
  }
  TrustList read() const { return read_trust_list(list(), authority()).value_or(TrustList{}); }
  std::string authority() const { return text_of(sut.folder() / "ca.pem"); }
  std::string certificate(const KeyListing& whose) const { return text_of(ParticipantKeys(whose.folder).certificate); }
};

TEST_F(Trust, Says_what_the_other_files_say_after_each_change) {
  make();
  const auto matches = [&] {
    const TrustList list = read();
    for (const KeyListing& each : sut.list(now)) {
      EXPECT_EQ(text_of(each.folder / "trust.p7s"), text_of(sut.folder() / "trust.p7s")) << each.name;
    }
    return list.plant == "cell" && list.revoked == text_of(sut.folder() / "revoked.pem") &&
           list.deploy_keys == text_of(sut.folder() / "deploy.pub");
  };
  EXPECT_TRUE(matches());
  std::uint64_t serial = read().serial;
  EXPECT_GE(serial, static_cast<std::uint64_t>(now.time_since_epoch().count())) << "the time in seconds";
  const auto is_later = [&] { return serial < read().serial && (serial = read().serial) > 0; };
  ASSERT_TRUE(sut.add_deployer("bob", now + days(10)));
  EXPECT_TRUE(matches() && is_later());
  ASSERT_TRUE(sut.add_viewer("eve", now + days(10)));
  EXPECT_TRUE(matches());
  EXPECT_FALSE(is_later()) << "boards need to know nothing of a viewer";
  ASSERT_TRUE(sut.rotate(listed("bob")));
  EXPECT_TRUE(matches() && is_later());
  ASSERT_TRUE(sut.finish_rotation());
  EXPECT_TRUE(matches() && is_later());
  ASSERT_TRUE(sut.revoke(listed("eve")));
  EXPECT_TRUE(matches() && is_later());
  ASSERT_TRUE(sut.revoke(listed("bob")));
  EXPECT_TRUE(matches() && is_later());
}

// As after a kill between the files, and in a folder of an earlier release.
TEST_F(Trust, Is_made_when_it_is_needed_and_does_not_match_the_other_files) {
  make();
  const std::string before = list();
  EXPECT_EQ(list(), before);
  ASSERT_TRUE(sut.revoke(listed("viewer")));
  std::ofstream(sut.folder() / "trust.p7s") << before;
  EXPECT_EQ(read().revoked, text_of(sut.folder() / "revoked.pem"));
  fs::remove(sut.folder() / "trust.p7s");
  EXPECT_EQ(read().revoked, text_of(sut.folder() / "revoked.pem"));
  fs::remove(sut.folder() / "trust.p7s");
  fs::remove(sut.folder() / "revoked.pem");
  EXPECT_THAT(sut.trust_list().error().text, HasSubstr("revoked.pem is no list of revoked certificates"));
  fs::copy_file(sut.board("a") / "revoked.pem", sut.folder() / "revoked.pem");
  fs::rename(sut.folder() / "ca.key", folder_ / "stick");
  EXPECT_THAT(sut.trust_list().error().text, HasSubstr("ca.key"));
  EXPECT_THAT(sut.rotate(listed("deployer")).error().text, HasSubstr("ca.key")) << "before anything was changed";
  EXPECT_FALSE(fs::exists(sut.deployer() / "deploy.key.before"));
}

// RFC 5280, 5.3.1: what was revoked stays revoked. The files of a backup, or damaged ones, are copied to the folder.
TEST_F(Trust, Does_not_make_revoked_keys_valid_again) {
  make();
  ASSERT_TRUE(sut.add_deployer("bob", now + days(10)));
  fs::copy(sut.folder(), folder_ / "backup");
  const KeyListing viewer = listed("viewer");
  const KeyListing bob = listed("bob");
  ASSERT_TRUE(sut.revoke(viewer));
  ASSERT_TRUE(sut.revoke(bob));
  const ReceivedTrust board = this->board("a");
  const std::string key = text_of(bob.folder / "deploy.key");
  const auto revoked = [&] {
    const TrustList list = read();
    return is_revoked(certificate(viewer), list.revoked) && is_revoked(certificate(bob), list.revoked) &&
           !signed_by_any("order", signature_of("order", key), list.deploy_keys);
  };
  EXPECT_TRUE(revoked());
  for (const char* file : {"revoked.pem", "deploy.pub"}) {
    fs::copy_file(folder_ / "backup" / file, sut.folder() / file, fs::copy_options::overwrite_existing);
    EXPECT_TRUE(revoked()) << file;
  }
  for (const char* damage : {"", "garbage", "-----BEGIN X509 CRL-----"}) {
    std::ofstream(sut.folder() / "revoked.pem") << damage;
    EXPECT_TRUE(revoked()) << damage;
  }
  fs::remove(sut.folder() / "revoked.pem");
  ASSERT_TRUE(sut.add_viewer("eve", now + days(10)));
  ASSERT_TRUE(sut.revoke(listed("eve")));
  EXPECT_TRUE(revoked());
  // A desk that has only the backup signs a later list: boards do not take it.
  const PlantKeys stale(folder_ / "backup");
  for (const KeyListing& each : stale.list(now)) {
    if (each.role == Role::Viewer) {
      ASSERT_TRUE(stale.revoke(each));
      ASSERT_TRUE(stale.revoke(each));
    }
  }
  const Authority own{authority(), text_of(sut.folder() / "ca.key")};
  EXPECT_THAT(board.take(signed_trust_list({"cell", 1ULL << 40U, text_of(folder_ / "backup/revoked.pem"), ""}, own))
                  .error()
                  .text,
              HasSubstr("valid again"));
}

TEST_F(Trust, Is_not_signed_without_the_keys_of_deployers_whom_the_folder_has) {
  make();
  for (const char* damage : {"", "garbage"}) {
    std::ofstream(sut.folder() / "deploy.pub") << damage;
    EXPECT_THAT(sut.trust_list().error().text, HasSubstr("deploy.pub lacks the key of deployer")) << damage;
  }
  fs::copy_file(sut.board("a") / "deploy.pub", sut.folder() / "deploy.pub", fs::copy_options::overwrite_existing);
  EXPECT_TRUE(sut.trust_list());
}

// A kill at any step of a change of keys leaves a folder in which the command can be repeated.
TEST_F(Trust, A_change_of_keys_that_was_killed_is_repeated) {
  make();
  const fs::path folder = sut.deployer();
  const auto key = [&] { return text_of(folder / "deploy.key"); };
  const auto valid = [&](const std::string& text) {
    return signed_by_any("order", signature_of("order", text), read().deploy_keys);
  };
  const std::string first = key();
  // Before the new key is known, after that, and between the two moves of files.
  std::ofstream(folder / "deploy.key.next") << make_key(KeyKind::Ed25519);
  ASSERT_TRUE(sut.rotate(listed("deployer")));
  const std::string second = key();
  EXPECT_TRUE(second != first && valid(second) && valid(first));
  fs::rename(folder / "deploy.key", folder / "deploy.key.next");
  EXPECT_TRUE(sut.rotate(listed("deployer")));
  EXPECT_EQ(key(), second);
  EXPECT_EQ(text_of(folder / "deploy.key.before"), first);
  EXPECT_THAT(sut.rotate(listed("deployer")).error().text, HasSubstr("keys send"));
  const std::string before = text_of(folder / "deploy.key.before");
  ASSERT_EQ(*sut.finish_rotation(), 1U);
  EXPECT_TRUE(valid(second) && !valid(first));
  // --finish, after the key became invalid and before its file was deleted.
  std::ofstream(folder / "deploy.key.before") << before;
  EXPECT_EQ(*sut.finish_rotation(), 0U);
  EXPECT_FALSE(fs::exists(folder / "deploy.key.before"));
  std::ofstream(folder / "deploy.key.before") << before;
  ASSERT_TRUE(sut.rotate(listed("deployer")));
  EXPECT_TRUE(valid(key()) && valid(second) && key() != second);
  EXPECT_EQ(text_of(folder / "deploy.key.before"), second);
}

TEST_F(Trust, Is_signed_as_OpenSSL_verifies_it) {
  make();
  const fs::path out = folder_ / "out";
  const auto verified = [&](const fs::path& authority) {
    const std::string command = "openssl smime -verify -purpose any -nointern -text -in '" +
                                (sut.folder() / "trust.p7s").string() + "' -CAfile '" + authority.string() +
                                "' -certfile '" + authority.string() + "' -out '" + out.string() + "' 2>'" +
                                (folder_ / "said").string() + "'";
    return std::system(command.c_str());  // NOLINT(concurrency-mt-unsafe): the test has one thread
  };
  EXPECT_EQ(verified(sut.folder() / "ca.pem"), 0) << text_of(folder_ / "said");
  EXPECT_THAT(text_of(out), HasSubstr("indurop trust list"));
  const PlantKeys other(folder_ / "other");
  ASSERT_TRUE(other.make("cell", {"a"}, now + days(10)));
  EXPECT_NE(verified(other.folder() / "ca.pem"), 0);
}

TEST_F(Trust, Of_a_board_is_its_folder_until_it_receives_a_later_list) {
  make();
  const ReceivedTrust board = this->board("a");
  const std::string first = list();
  EXPECT_EQ(board.current().document, first);
  EXPECT_EQ(board.current().revoked.filename(), "revoked.pem");
  EXPECT_THAT(board.take(first).error().text, HasSubstr("this board has list"));
  const KeyListing deployer = listed("deployer");
  EXPECT_FALSE(board.revokes(certificate(deployer)));
  const std::string key = text_of(deployer.folder / "deploy.key");
  EXPECT_TRUE(signed_by_any("order", signature_of("order", key), board.current().deploy_keys));

  ASSERT_TRUE(sut.revoke(deployer));
  ASSERT_TRUE(board.take(list()));
  EXPECT_TRUE(board.revokes(certificate(deployer)));
  EXPECT_FALSE(signed_by_any("order", signature_of("order", key), board.current().deploy_keys));
  EXPECT_TRUE(is_revoked(certificate(deployer), text_of(board.current().revoked))) << "for DDS Security";
  EXPECT_THAT(board.take(first).error().text, HasSubstr("this board has list"))
      << "an earlier list makes no key valid again";
  EXPECT_TRUE(board.revokes(certificate(deployer)));

  // Copied by hand, with all files, a later list is valid, too.
  ASSERT_TRUE(sut.add_deployer("bob", now + days(10)));
  for (const char* file : {"trust.p7s", "deploy.pub", "revoked.pem"}) {
    fs::copy_file(sut.board("a") / file, folder_ / "etc-a" / file, fs::copy_options::overwrite_existing);
  }
  const std::string bob = text_of(sut.deployer("bob") / "deploy.key");
  EXPECT_EQ(board.current().document, list());
  EXPECT_TRUE(signed_by_any("order", signature_of("order", bob), board.current().deploy_keys));
}

TEST_F(Trust, A_revocation_that_is_copied_by_hand_counts_in_addition_to_a_received_list) {
  make();
  ASSERT_TRUE(sut.add_viewer("eve", now + days(10)));
  const ReceivedTrust board = this->board("a");
  ASSERT_TRUE(sut.revoke(listed("viewer")));
  ASSERT_TRUE(board.take(list()));
  ASSERT_TRUE(sut.revoke(listed("eve")));
  EXPECT_FALSE(board.revokes(certificate(listed("eve"))));
  fs::copy_file(sut.folder() / "revoked.pem", folder_ / "etc-a/revoked.pem", fs::copy_options::overwrite_existing);
  EXPECT_TRUE(board.revokes(certificate(listed("eve"))));
}

TEST_F(Trust, Of_an_earlier_release_is_what_its_files_say) {
  make();
  const ReceivedTrust board = this->board("a");
  fs::remove(folder_ / "etc-a/trust.p7s");
  EXPECT_EQ(board.current().serial, 0U);
  EXPECT_EQ(board.current().document, "");
  EXPECT_EQ(board.current().deploy_keys, text_of(sut.folder() / "deploy.pub"));
  EXPECT_TRUE(board.take(list()));
  EXPECT_EQ(board.current().document, list());
}

TEST_F(Trust, Of_a_board_whose_files_were_damaged) {
  make();
  const ReceivedTrust board = this->board("a");
  const std::string before = text_of(sut.folder() / "revoked.pem");
  const KeyListing viewer = listed("viewer");
  ASSERT_TRUE(sut.revoke(viewer));
  ASSERT_TRUE(board.take(list()));
  const fs::path revoked = board.current().revoked;
  const std::string whole = text_of(revoked);
  for (const std::string& damage : {std::string(), std::string("garbage"), before, whole.substr(0, 100)}) {
    std::ofstream(revoked) << damage;
    EXPECT_EQ(text_of(board.current().revoked), whole) << "restored from the signed list";
  }
  fs::remove(revoked);
  EXPECT_EQ(text_of(board.current().revoked), whole);
  EXPECT_EQ(board.current().problem, "");
  std::ofstream(board.file()) << list().substr(0, 100);
  EXPECT_THAT(board.current().problem, HasSubstr("trust.p7s: the list of valid keys that this board had received"));
  ASSERT_TRUE(board.take(list())) << "from another board";
  EXPECT_EQ(board.current().problem, "");
  EXPECT_TRUE(board.revokes(certificate(viewer)));
}

TEST_F(Trust, Of_another_authority_or_plant_is_not_taken) {
  make();
  const ReceivedTrust board = this->board("a");
  const PlantKeys other(folder_ / "other");
  ASSERT_TRUE(other.make("cell", {"a"}, now + days(10)));
  ASSERT_TRUE(other.add_deployer("mallory", now + days(10)));
  EXPECT_THAT(board.take(*other.trust_list()).error().text, HasSubstr("authority of this board's keys"));
  EXPECT_THAT(board.take(text_of(sut.folder() / "governance.p7s")).error().text, HasSubstr("no list"))
      << "signed by the authority, but something else";
  EXPECT_THAT(board.take("").error().text, HasSubstr("no list"));
  EXPECT_THAT(board.take(std::string(2U << 20U, 'x')).error().text, HasSubstr("too large"));
  const Authority own{authority(), text_of(sut.folder() / "ca.key")};
  EXPECT_THAT(board.take(signed_trust_list({"press", 1ULL << 40U, "", ""}, own)).error().text,
              HasSubstr("list of plant press"));
  EXPECT_THAT(board.take(signed_trust_list({"cell", 1ULL << 40U, "", ""}, own)).error().text,
              HasSubstr("no list of revoked certificates"))
      << "with which no node could connect";
  EXPECT_FALSE(fs::exists(folder_ / "state-a"));
}

// A list that was changed on its way is not accepted with another content.
TEST_F(Trust, With_any_byte_changed_is_none_or_the_same) {
  make();
  const std::string whole = list();
  const TrustList original = read();
  std::mt19937 random(1);
  for (int i = 0; i < 2'000; ++i) {
    const std::string damaged = test::damaged(whole, random);
    if (const auto read = read_trust_list(damaged, authority())) {
      EXPECT_EQ(read->plant, original.plant);
      EXPECT_EQ(read->serial, original.serial);
      EXPECT_EQ(read->revoked, original.revoked);
      EXPECT_EQ(read->deploy_keys, original.deploy_keys);
    }
  }
}

}  // namespace
}  // namespace indurop::keys
