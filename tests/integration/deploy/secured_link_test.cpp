// SPDX-License-Identifier: Apache-2.0
// Agents with keys, and who speaks with them by the right keys, by wrong ones and without any.

#include <arpa/inet.h>
#include <linux/if_ether.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <atomic>
#include <optional>
#include <thread>

#include "agents_fixture.h"

namespace indurop::test {
namespace {

using ::testing::HasSubstr;

// Keeps every packet of this machine from its making until heard().
class Eavesdropper {
 public:
  Eavesdropper() : socket_(::socket(AF_PACKET, SOCK_DGRAM, htons(ETH_P_ALL))) {
    const int room = 32 << 20;
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUFFORCE, &room, sizeof room);
    if (able()) {
      thread_ = std::thread([this] { listen(); });
    }
  }
  ~Eavesdropper() {
    (void)heard();
    ::close(socket_);
  }
  Eavesdropper(const Eavesdropper&) = delete;
  Eavesdropper& operator=(const Eavesdropper&) = delete;

  // False without the right to listen.
  [[nodiscard]] bool able() const { return socket_ >= 0; }
  const std::string& heard() {
    stop_ = true;
    if (thread_.joinable()) {
      thread_.join();
    }
    return heard_;
  }

 private:
  void listen() {
    std::array<char, 65536> packet{};
    pollfd ready{socket_, POLLIN, 0};
    while (!stop_) {
      if (::poll(&ready, 1, 20) == 1) {
        const ssize_t size = ::recv(socket_, packet.data(), packet.size(), 0);
        heard_.append(packet.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
      }
    }
  }

  int socket_;
  std::atomic<bool> stop_{false};
  std::string heard_;
  std::thread thread_;
};

class SecuredLink : public AgentsTest {
 protected:
  SecuredLink() : file_(manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}})) {}
  void start_with_keys() {
    bring_keys(file_, {"a", "b"});
    start_agent("a");
    start_agent("b");
    speak_with_keys(path("keys"));
  }
  const std::string& file() const { return file_; }

  // Deploys while the wire is recorded: which of the deployment's name and a text in a module's file it reads.
  // Null if recording is not permitted here.
  std::optional<std::pair<bool, bool>> overheard() {
    const std::string text = "a secret of " + std::to_string(::getpid());
    std::ofstream(folder() / "steady.so", std::ios::app) << text;
    Eavesdropper listener;
    if (!listener.able()) {
      return std::nullopt;
    }
    const Outcome done = deploy(file());
    EXPECT_EQ(done.code, 0) << done.err;
    const std::string name = done.json()["deployment"];
    const std::string& heard = listener.heard();
    EXPECT_FALSE(heard.empty());
    return std::pair(heard.find(name) != std::string::npos, heard.find(text) != std::string::npos);
  }

 private:
  std::string file_;
};

TEST_F(SecuredLink, A_plant_is_deployed_inspected_and_commanded_with_keys) {
  start_with_keys();
  const Outcome done = deploy(file());
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(done.json()["signed"], true);
  EXPECT_TRUE(runs("a", done.json()["deployment"]) && runs("b", done.json()["deployment"]));
  EXPECT_EQ(indurop({"history", "-o", "json"}).json()["deployments"].size(), 1U);
  EXPECT_EQ(indurop({"stop", "steady@" + board("a")}).code, 0);
  const Outcome status = indurop({"status", "--plant"});
  EXPECT_EQ(status.code, 0) << status.err;
  const Outcome next = deploy(manifest("v2.xml", {{"a", "other"}, {"b", "steady"}}));
  ASSERT_EQ(next.code, 0) << next.err << next.out;
  const Outcome back = indurop({"rollback", "--health", "500ms"});
  EXPECT_EQ(back.code, 0) << back.err;
}

TEST_F(SecuredLink, On_the_wire_a_deployment_is_open_without_keys) {
  start_agent("a");
  start_agent("b");
  const auto found = overheard();
  if (!found) {
    GTEST_SKIP() << "no right to listen to packets";
  }
  EXPECT_EQ(*found, std::pair(true, true));
}

TEST_F(SecuredLink, On_the_wire_a_deployment_is_secret_with_keys) {
  start_with_keys();
  const auto found = overheard();
  if (!found) {
    GTEST_SKIP() << "no right to listen to packets";
  }
  EXPECT_EQ(*found, std::pair(false, false));
}

TEST_F(SecuredLink, Without_keys_nothing_is_received_and_a_message_says_what_to_do) {
  start_with_keys();
  ASSERT_TRUE(wait_until([&] { return report("b").is_object(); }));
  speak_with_keys("");
  const Outcome boards = indurop({"boards", "-o", "json"});
  EXPECT_EQ(boards.code, 6);
  EXPECT_TRUE(boards.json()["boards"].empty());
  EXPECT_THAT(boards.err, HasSubstr("secured boards answer only clients with keys of their plant: --keys DIR"));
  const Outcome deployed = deploy(file(), {"--timeout", "1s"});
  EXPECT_EQ(deployed.code, 6);
  EXPECT_THAT(deployed.err, HasSubstr("--keys DIR"));
  EXPECT_THAT(indurop({"rollback"}).err, HasSubstr("--keys DIR"));
  EXPECT_EQ(indurop({"stop", "@" + board("a"), "--timeout", "1s"}).code, 6);
  EXPECT_EQ(indurop({"boards", "--keys", path("nowhere")}).code, 2);
}

TEST_F(SecuredLink, Keys_of_another_authority_are_not_accepted) {
  start_with_keys();
  ASSERT_EQ(indurop_here({"keys", "init", file(), "--dir", path("strange")}).code, 0);
  ASSERT_TRUE(wait_until([&] { return report("b").is_object(); }));
  const Outcome boards = indurop({"boards", "--keys", path("strange"), "--wait", "2s"});
  EXPECT_EQ(boards.code, 6);
  EXPECT_THAT(boards.err, HasSubstr("only boards with keys of the same plant are heard with --keys"));
  EXPECT_EQ(deploy(file(), {"--keys", path("strange"), "--timeout", "1s"}).code, 6);
}

TEST_F(SecuredLink, A_board_without_keys_is_open_and_not_heard_by_those_with_keys) {
  bring_keys(file(), {"a"});
  start_agent("a");
  start_agent("b");
  ASSERT_TRUE(wait_until([&] { return report("b").is_object(); }));
  EXPECT_FALSE(report("a").is_object());
  const Outcome done = deploy(file(), {"--keys", path("keys"), "--timeout", "2s"});
  EXPECT_EQ(done.code, 6);
  EXPECT_THAT(done.err, HasSubstr("missing: " + board("b")));
  EXPECT_THAT(done.err, HasSubstr("only boards with keys of the same plant are heard with --keys"));
}

TEST_F(SecuredLink, Keys_that_are_brought_to_a_running_agent_count) {
  std::filesystem::create_directories(folder() / "etc");
  ::setenv("INDUROP_KEYS_DIR", path("etc").c_str(), 1);
  start_agent("a");
  ASSERT_TRUE(wait_until([&] { return report("a").is_object(); }));
  bring_keys(file(), {"a"});
  ASSERT_TRUE(wait_until([&] { return !report("a").is_object(); }));
  speak_with_keys(path("keys"));
  EXPECT_TRUE(wait_until([&] { return report("a").is_object(); }));
}

TEST_F(SecuredLink, A_bundle_counts_only_if_a_deployer_of_the_plant_signed_it) {
  start_with_keys();
  std::ofstream(path("other.xml")) << R"(<plant name="other"><board name="a"/></plant>)";
  ASSERT_EQ(indurop_here({"keys", "init", path("other.xml"), "--dir", path("other")}).code, 0);
  const auto pack = [&](const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> words{"pack", file(), "-o", path(name)};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome done = indurop_here(words);
    EXPECT_EQ(done.code, 0) << done.err;
    return path(name);
  };
  const std::string good = pack("good.bundle", {"--keys", path("keys")});
  const std::string open = pack("open.bundle", {});
  const std::string foreign = pack("foreign.bundle", {"--keys", path("other")});
  const Outcome unsigned_one = deploy(open);
  EXPECT_EQ(unsigned_one.code, 1);
  EXPECT_THAT(unsigned_one.err, HasSubstr("the bundle is not signed; pack it with --keys"));
  const Outcome foreign_one = deploy(foreign);
  EXPECT_EQ(foreign_one.code, 1);
  EXPECT_THAT(foreign_one.err, HasSubstr("of plant other, with keys of another authority"));
  EXPECT_EQ(report("a")["state"], "empty");
  const Outcome done = deploy(good);
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_TRUE(runs("a", done.json()["deployment"]));
}

TEST_F(SecuredLink, A_viewer_looks_and_commands_nothing) {
  start_with_keys();
  ASSERT_EQ(deploy(file()).code, 0);
  speak_with_keys(path("keys/viewer"));
  EXPECT_TRUE(report("a").is_object());
  EXPECT_EQ(indurop({"history", "-o", "json"}).json()["deployments"].size(), 1U);
  const Outcome stop = indurop({"stop", "steady@" + board("a")});
  EXPECT_EQ(stop.code, 1);
  EXPECT_THAT(stop.err, HasSubstr("deploy.key is missing"));
}

// What a user copies to the boards after keys have changed.
TEST_F(SecuredLink, A_deployer_that_was_revoked_is_replaced) {
  start_with_keys();
  speak_with_keys(path("keys/deployer"));
  ASSERT_EQ(deploy(file()).code, 0);
  const auto keys_verb = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "keys");
    words.insert(words.end(), {"--dir", path("keys")});
    const Outcome done = indurop_here(words);
    EXPECT_EQ(done.code, 0) << done.err;
  };
  keys_verb({"add", "--deployer", "bob"});
  keys_verb({"revoke", "deployer"});
  const auto plant = folder() / "etc" / ("p" + std::to_string(::getpid()));
  for (const char* name : {"a", "b"}) {
    for (const char* shared : {"deploy.pub", "revoked.pem"}) {
      std::filesystem::copy_file(folder() / "keys" / shared, plant / board(name) / shared,
                                 std::filesystem::copy_options::overwrite_existing);
    }
  }
  const std::string next = manifest("v2.xml", {{"a", "other"}, {"b", "steady"}});
  speak_with_keys(path("keys/deployers/bob"));
  ASSERT_TRUE(wait_until([&] { return report("a").is_object() && report("b").is_object(); }));
  const Outcome done = deploy(next);
  EXPECT_EQ(done.code, 0) << done.err;
  // The key that signs is not enough any more, with any certificate.
  std::filesystem::copy_file(folder() / "keys/deployer/deploy.key", folder() / "keys/deployers/bob/deploy.key",
                             std::filesystem::copy_options::overwrite_existing);
  const Outcome refused = deploy(manifest("v3.xml", {{"a", "steady"}, {"b", "other"}}));
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("it is not signed with the key of plant"));
}

}  // namespace
}  // namespace indurop::test
