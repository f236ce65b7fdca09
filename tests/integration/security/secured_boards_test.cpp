// SPDX-License-Identifier: Apache-2.0
// Boards of a secured plant on loopback, and strangers, viewers and boards with wrong keys.

#include <indurop/idl/wire.h>

#include <filesystem>

#include "core/keys/plant_keys.h"
#include "network/dds/setup.h"
#include "network/mirror/frames/plane_topics.h"
#include "tests/integration/mirror/boards.h"

namespace indurop::test {
namespace {

namespace fs = std::filesystem;
using keys::ParticipantKeys;
using keys::PlantKeys;
using mirror::PeerState;
using ::testing::HasSubstr;

class Secured : public Boards {
 protected:
  Secured() : folder_(fs::temp_directory_path() / ("indurop-keys-" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Secured() override { fs::remove_all(folder_); }

  PlantKeys make(const std::string& name, std::chrono::days valid = std::chrono::days(100)) {
    PlantKeys keys(folder_ / name);
    EXPECT_TRUE(keys.make("testplant", {"a", "b", "c"}, keys::instant_now() + valid));
    return keys;
  }
  void start_a(const fs::path& keys) { start({"a", "t::count", "t::reply@b", "plain", keys.string()}, {"b"}); }
  void start_b(const fs::path& keys) { start({"b", "t::reply", "t::count@a", "plain", keys.string()}, {"a"}); }
  void exchange(std::int64_t values) {
    for (std::int64_t i = 1; i <= values; ++i) {
      put("a", "t::count", i);
      put("b", "t::reply", -i);
      ASSERT_TRUE(wait_until([&] { return get<std::int64_t>("b", "t::count") == i; })) << why("b");
      ASSERT_TRUE(wait_until([&] { return get<std::int64_t>("a", "t::reply") == -i; })) << why("a");
    }
  }
  std::string why(const std::string& board) { return board + ": " + block(board).problem.get(); }
  std::string problem_of(const std::string& board) {
    EXPECT_TRUE(wait_until([&] { return !block(board).problem.get().empty(); })) << "no problem is shown";
    EXPECT_EQ(block(board).network.load(), mirror::Network::Connecting);
    return block(board).problem.get();
  }
  static void copy(const fs::path& from, const fs::path& to) {
    fs::copy_file(from, to, fs::copy_options::overwrite_existing);
  }
  // A participant of this process.
  static mirror::Settings participant(const fs::path& folder) {
    const ParticipantKeys keys(folder);
    mirror::Settings settings;
    settings.plant = "testplant";
    settings.network.domain = domain();
    settings.network.one_host = true;
    settings.network.security = {keys.authority.string(),  keys.certificate.string(), keys.key.string(),
                                 keys.governance.string(), keys.permissions.string(), keys.revoked.string()};
    return settings;
  }

 private:
  fs::path folder_;
};

TEST_F(Secured, Two_boards_of_a_plant_exchange_values) {
  const PlantKeys keys = make("keys");
  start_a(keys.board("a"));
  start_b(keys.board("b"));
  exchange(20);
  EXPECT_EQ(block("a").problem.get(), "");
}

TEST_F(Secured, Who_has_no_keys_hears_nothing) {
  const PlantKeys keys = make("keys");
  start({"c", "-", "t::count@a", "plain", ""}, {"a", "b"});
  start_a(keys.board("a"));
  start_b(keys.board("b"));
  exchange(20);
  EXPECT_TRUE(sees("c", "a", PeerState::Absent));
  EXPECT_EQ(get<std::int64_t>("c", "t::count"), 0);
}

TEST_F(Secured, Who_has_no_keys_is_not_heard) {
  const PlantKeys keys = make("keys");
  start({"a", "t::count", "-", "plain", ""}, {"b", "c"});
  put("a", "t::count", std::int64_t{666});
  start({"c", "t::reply", "-", "plain", keys.board("c").string()}, {"a", "b"});
  start({"b", "-", "t::count@a,t::reply@c", "plain", keys.board("b").string()}, {"a", "c"});
  for (std::int64_t i = 1; i <= 20; ++i) {
    put("c", "t::reply", i);
    ASSERT_TRUE(wait_until([&] { return get<std::int64_t>("b", "t::reply") == i; })) << why("b");
  }
  EXPECT_TRUE(sees("b", "a", PeerState::Absent));
  EXPECT_EQ(get<std::int64_t>("b", "t::count"), 0);
}

TEST_F(Secured, A_board_with_keys_of_another_authority_is_kept_out) {
  const PlantKeys keys = make("keys");
  const PlantKeys foreign = make("foreign");
  start({"c", "t::pair", "t::count@a", "plain", foreign.board("c").string()}, {"a", "b"});
  start_a(keys.board("a"));
  start_b(keys.board("b"));
  exchange(20);
  EXPECT_TRUE(sees("c", "a", PeerState::Absent));
  EXPECT_EQ(get<std::int64_t>("c", "t::count"), 0);
  EXPECT_TRUE(wait_until([&] { return block("c").problem.get().find("do not match") != std::string::npos; }));
  EXPECT_THAT(block("c").problem.get(), HasSubstr("unable to get local issuer certificate"));
}

TEST_F(Secured, A_viewer_reads_and_cannot_publish) {
  const PlantKeys keys = make("keys");
  start_a(keys.board("a"));
  start_b(keys.board("b"));
  exchange(1);
  const mirror::Settings settings = participant(keys.viewer());
  const auto viewer = dds::join_network(settings.network);
  ASSERT_TRUE(viewer.ok()) << viewer.error().text;
  const auto topic = mirror::catalogue_topic("testplant");
  const auto qos = mirror::plane_qos(mirror::Stream::Prompt);
  const auto reader = dds::make_reader(viewer->participant.get(), indurop_wire_Catalogue_desc, topic, qos);
  ASSERT_TRUE(reader.ok()) << reader.why();
  EXPECT_TRUE(wait_until([&] {
    bool heard = false;
    dds::take_one<indurop_wire_Catalogue>(reader.get(), [&](const auto&, const dds::SampleInfo&) { heard = true; });
    return heard;
  })) << "the viewer hears nothing";
  const auto writer = dds::make_writer(viewer->participant.get(), indurop_wire_Catalogue_desc, topic, qos);
  EXPECT_FALSE(writer.ok());
}

TEST_F(Secured, A_board_cannot_speak_for_another_one) {
  const PlantKeys keys = make("keys");
  const mirror::Settings settings = participant(keys.board("b"));
  const auto b = dds::join_network(settings.network);
  ASSERT_TRUE(b.ok()) << b.error().text;
  const auto writer = [&](const char* board) {
    return dds::make_writer(b->participant.get(), indurop_wire_Frame_desc,
                            mirror::frames_topic("testplant", board, mirror::Stream::Prompt),
                            mirror::plane_qos(mirror::Stream::Prompt));
  };
  EXPECT_TRUE(writer("b").ok());
  EXPECT_FALSE(writer("a").ok());
}

TEST_F(Secured, A_revoked_board_is_kept_out) {
  const PlantKeys keys = make("keys");
  const auto all = keys.list(keys::instant_now());
  ASSERT_EQ(all[2].name, "c");
  const fs::path old_list = keys.board("c") / "old.pem";  // the thief does not install the list against himself
  copy(ParticipantKeys(keys.board("c")).revoked, old_list);
  ASSERT_TRUE(keys.revoke(all[2]));
  copy(old_list, ParticipantKeys(keys.board("c")).revoked);
  start({"c", "t::pair", "t::count@a", "plain", keys.board("c").string()}, {"a", "b"});
  start_a(keys.board("a"));
  start_b(keys.board("b"));
  exchange(20);
  EXPECT_TRUE(sees("c", "a", PeerState::Absent));
  EXPECT_EQ(get<std::int64_t>("c", "t::count"), 0);
  EXPECT_TRUE(wait_until([&] { return block("a").problem.get().find("revoked") != std::string::npos; }));
}

TEST_F(Secured, A_killed_board_is_noticed_and_let_in_again) {
  const PlantKeys keys = make("keys");
  start_a(keys.board("a"));
  start_b(keys.board("b"));
  exchange(3);
  stop("a", SIGKILL);
  ASSERT_TRUE(wait_until([&] { return sees("b", "a", PeerState::Silent); }));
  start_a(keys.board("a"));
  exchange(5);
}

TEST_F(Secured, An_expired_certificate_is_named) {
  const PlantKeys keys = make("keys", std::chrono::days(-1));
  start_a(keys.board("a"));
  EXPECT_THAT(problem_of("a"), HasSubstr("expired"));
}

TEST_F(Secured, A_certificate_of_another_authority_is_named) {
  const PlantKeys keys = make("keys");
  const PlantKeys foreign = make("foreign");
  copy(ParticipantKeys(foreign.board("a")).authority, ParticipantKeys(keys.board("a")).authority);
  start_a(keys.board("a"));
  EXPECT_THAT(problem_of("a"), HasSubstr("keys refused"));
}

TEST_F(Secured, A_key_that_is_missing_is_named) {
  const PlantKeys keys = make("keys");
  fs::remove(ParticipantKeys(keys.board("a")).key);
  start_a(keys.board("a"));
  EXPECT_THAT(problem_of("a"), HasSubstr("identity.key cannot be read: No such file"));
}

}  // namespace
}  // namespace indurop::test
