// SPDX-License-Identifier: Apache-2.0
// The platform of a plant's boards is updated from the desk, and taken back; what must not be deployed is refused, and
// then nothing has changed.

#include <sys/mount.h>

#include "core/base/read_file.h"
#include "platform_fixture.h"

namespace indurop::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class Platform : public PlatformTest {
 protected:
  // What a refusal must not change.
  bool nothing_has_changed() {
    return boards_are([](const Json& a, const Json& b) {
      return runs_release(a, kInstalled) && runs_release(b, kInstalled) && a["deployment"] == "installed";
    });
  }
};

TEST_F(Platform, All_boards_switch_together_and_back) {
  const pid_t before = vars::running_node(board("a"));
  const pid_t agent_before = agent("a").pid();
  const Outcome done = update(packed("9.1"));
  ASSERT_EQ(done.code, 0) << done.err << agent("a").err();
  EXPECT_THAT(done.err, HasSubstr("its node stood for "));
  EXPECT_GT(done.json()["boards"][0]["fetched_bytes"], 100'000);
  EXPECT_TRUE(both_run("9.1"));
  EXPECT_TRUE(runs("a", deployment_)) << "the plant is the same";
  EXPECT_NE(vars::running_node(board("a")), before);
  EXPECT_THAT(node_program("a"), HasSubstr(platform_folder("a").string()));
  EXPECT_TRUE(agent("a").running());
  EXPECT_EQ(agent("a").pid(), agent_before) << "for the service manager it is the same process";
  EXPECT_EQ(indurop({"verify", "--plant"}).code, 0) << "the installed release, which it ran before, has no files here";
  EXPECT_THAT(update(path("9.1.release")).out, HasSubstr("already"));

  const Outcome back = indurop({"platform", "back", "--health", "500ms"});
  ASSERT_EQ(back.code, 0) << back.err;
  EXPECT_TRUE(both_run(kInstalled));
  EXPECT_THAT(node_program("a"), Not(HasSubstr(platform_folder("a").string())));
  ASSERT_EQ(indurop({"platform", "back", "--health", "500ms"}).code, 0);
  EXPECT_TRUE(both_run("9.1")) << "and forward again";
}

TEST_F(Platform, A_board_that_starts_again_runs_what_was_committed) {
  ASSERT_EQ(update(packed("9.1")).code, 0);
  restart("a", true);
  EXPECT_TRUE(both_run("9.1"));
  const pid_t node = vars::running_node(board("b"));
  restart("b");
  EXPECT_TRUE(both_run("9.1"));
  EXPECT_EQ(vars::running_node(board("b")), node) << "the next agent of the same release takes the node over";
}

TEST_F(Platform, An_older_release_needs_to_be_meant) {
  ASSERT_EQ(update(packed("9.10")).code, 0);
  const std::string older = packed("9.9");
  const Outcome refused = update(older);
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("release 9.9 is older than 9.10, which board "));
  EXPECT_TRUE(both_run("9.10"));
  EXPECT_EQ(update(older, {"--older"}).code, 0);
  EXPECT_TRUE(both_run("9.9"));
}

TEST_F(Platform, One_changed_byte_is_refused) {
  const std::string file = packed("9.1");
  std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
  bytes.seekp(static_cast<std::streamoff>(std::filesystem::file_size(file) / 2));
  const int old = bytes.peek();
  bytes.put(static_cast<char>(old ^ 1));
  bytes.close();
  const Outcome refused = update(file);
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("damaged"));
  EXPECT_TRUE(nothing_has_changed());
}

TEST_F(Platform, Another_architecture_is_refused_by_the_boards) {
  const std::string prefix = installation("other");
  for (const char* program : {"indurop", "indurop-agent", "indurop-node"}) {
    std::fstream bytes(prefix + "/bin/" + program, std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekp(18);
    bytes.put(std::string_view(OTHER_ARCHITECTURE) == "arm64" ? '\xb7' : '\x3e');
  }
  const Outcome refused = update(packed("9.1", prefix));
  EXPECT_EQ(refused.code, 4) << refused.err;
  EXPECT_THAT(refused.err, HasSubstr("release 9.1 has programs for " OTHER_ARCHITECTURE ", and this board is "));
  EXPECT_TRUE(nothing_has_changed());
}

TEST_F(Platform, A_plant_is_no_release_and_a_release_no_plant) {
  const Outcome as_plant = deploy(packed("9.1"));
  EXPECT_EQ(as_plant.code, 2);
  EXPECT_THAT(as_plant.err, HasSubstr("indurop platform deploy takes it"));
  ASSERT_EQ(indurop_here({"pack", file_, "-o", path("v1.bundle")}).code, 0);
  const Outcome as_release = update(path("v1.bundle"));
  EXPECT_EQ(as_release.code, 2);
  EXPECT_THAT(as_release.err, HasSubstr("indurop deploy takes it"));
}

TEST_F(Platform, A_release_that_cannot_run_here_is_refused_before_the_switch) {
  for (const std::string program : {"indurop-agent", "indurop-node"}) {
    const std::string prefix = installation("lacking-" + program);
    // It needs a library that no board has.
    std::filesystem::remove(prefix + "/bin/" + program);
    std::filesystem::copy_file(LACKING_PROGRAM, prefix + "/bin/" + program);
    const Outcome refused = update(packed("9.1", prefix));
    EXPECT_EQ(refused.code, 4) << refused.err;
    EXPECT_THAT(refused.err, HasSubstr("release 9.1 cannot run on this board"));
    EXPECT_TRUE(nothing_has_changed());
  }
}

TEST_F(Platform, The_second_of_two_desks_is_busy) {
  const std::string file = packed("9.1");
  Program& first = start_update(file, {"--health", "8s"});
  ASSERT_TRUE(in_phase("a", "trial"));
  const Outcome second = update(packed("9.2"));
  EXPECT_EQ(second.code, 1) << second.err;
  EXPECT_THAT(second.err, HasSubstr("busy with deployment"));
  const Outcome plant = deploy(manifest("v2.xml", {{"a", "other"}, {"b", "steady"}}));
  EXPECT_EQ(plant.code, 1) << plant.err;
  EXPECT_THAT(plant.err, HasSubstr("the platform of this board is being updated"));
  EXPECT_EQ(first.finish().code, 0);
  EXPECT_TRUE(both_run("9.1"));
}

TEST_F(Platform, A_board_that_was_off_catches_up) {
  stop_agent("b", SIGTERM);
  const std::string file = packed("9.1");
  EXPECT_EQ(update(file, {"--timeout", "1s"}).code, 6) << "it is missed";
  const Outcome done = update(file, {"--allow-missing"});
  ASSERT_EQ(done.code, 0) << done.err;
  start_agent("b");
  EXPECT_TRUE(both_run("9.1")) << agent("b").err();
}

TEST_F(Platform, A_board_from_another_plant_does_not_bring_its_release_along) {
  std::string text = base::read_file(manifest("q.xml", {{"b", "other"}})).value();
  text.replace(text.find("name=\"p"), 7, "name=\"q");
  std::ofstream(path("q.xml")) << text;
  ASSERT_EQ(deploy(path("q.xml")).code, 0);
  const Outcome done = update(packed("9.1"), {"--plant", "q" + std::to_string(::getpid())});
  ASSERT_EQ(done.code, 0) << done.err;
  ASSERT_EQ(deploy(file_, {"--comment", "again"}).code, 0) << "b is back in the plant of a";
  ASSERT_EQ(deploy(file_, {"--comment", "and again"}).code, 0) << "a has received several reports of b meanwhile";
  EXPECT_TRUE(boards_are([](const Json& a, const Json& b) {
    return runs_release(a, kInstalled) && runs_release(b, "9.1") && b["generation"] == 0;
  })) << platform()[board("a")]
      << platform()[board("b")];
}

TEST_F(Platform, A_full_disk_is_reported_and_changes_nothing) {
  std::filesystem::create_directories(folder() / "small");
  if (::mount("tmpfs", path("small").c_str(), "tmpfs", 0, "size=2m") != 0) {
    GTEST_SKIP() << "a small disk cannot be mounted here (root is needed)";
  }
  stop_agent("a", SIGTERM);
  std::filesystem::copy(path("state/" + board("a")), path("small/" + board("a")),
                        std::filesystem::copy_options::recursive);
  start_agent("a", {}, path("small"));
  const Outcome refused = update(packed("9.1"));
  EXPECT_EQ(refused.code, 1) << refused.err;
  EXPECT_THAT(refused.err, HasSubstr(board("a") + ": disk full"));
  EXPECT_TRUE(nothing_has_changed());
  stop_agent("a", SIGTERM);
  ::umount2(path("small").c_str(), MNT_DETACH);
}

// A loss of power may leave copies empty that had not reached the disk; files/ has what was synced.
TEST_F(Platform, A_release_whose_copies_are_damaged_is_restored) {
  ASSERT_EQ(update(packed("9.1")).code, 0);
  const auto damage = [&] {
    stop_agent("a", SIGTERM);
    for (const auto& entry : std::filesystem::recursive_directory_iterator(platform_folder("a") / "deployments")) {
      if (entry.is_regular_file()) {
        std::filesystem::resize_file(entry, 0);
      }
    }
  };
  damage();
  start_agent("a");
  EXPECT_TRUE(both_run("9.1")) << agent("a").err();
  EXPECT_THAT(agent("a").err(), HasSubstr("it is restored from files/"));
  damage();
  for (const auto& entry : std::filesystem::directory_iterator(platform_folder("a") / "files")) {
    std::filesystem::resize_file(entry, std::filesystem::file_size(entry) / 2);
  }
  start_agent("a");
  EXPECT_TRUE(wait_until([&] { return !platform()[board("a")].value("message", "").empty(); })) << agent("a").err();
  EXPECT_THAT(agent("a").err(), HasSubstr("cannot be run"));
  const Outcome again = update(path("9.1.release"));
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.out, Not(HasSubstr("already")));
  EXPECT_TRUE(both_run("9.1")) << agent("a").err();
  EXPECT_THAT(node_program("a"), HasSubstr(platform_folder("a").string()));
}

// Without a service manager: this test starts the agent again, as often as it ends.
TEST_F(Platform, A_release_whose_agent_ends_is_left_after_three_starts) {
  ::setenv("IRP_TEST_BAD_AGENT", path("starts").c_str(), 1);
  stop_agent("a", SIGTERM);
  start_agent("a");
  const std::string prefix = installation("bad");
  std::filesystem::copy_file(BAD_AGENT, prefix + "/bin/indurop-agent",
                             std::filesystem::copy_options::overwrite_existing);
  Program& desk = start_update(packed("9.1", prefix));
  for (int start = 0; start < 3; ++start) {
    ASSERT_NE(agent("a").wait(), -1) << start;
    start_agent("a");
  }
  ::unsetenv("IRP_TEST_BAD_AGENT");
  for (int start = 0; start < 3; ++start) {
    ASSERT_NE(agent("b").wait(), -1) << start;
    start_agent("b");
  }
  const Outcome outcome = desk.finish();
  EXPECT_EQ(outcome.code, 5) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("its agent was started 3 times"));
  EXPECT_TRUE(both_run(kInstalled)) << agent("a").err();
  std::ifstream starts(path("starts"));
  int seconds = 0;
  int count = 0;
  for (; starts >> seconds; ++count) {
    EXPECT_GT(seconds, 30) << "the kernel would have ended it later";
  }
  EXPECT_EQ(count, 3);
}

class SecuredPlatform : public PlatformTest {
 protected:
  void SetUp() override {
    file_ = manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}});
    bring_keys(file_, {"a", "b"});
    speak_with_keys(path("keys"));
    start_agent("a");
    start_agent("b");
    const Outcome done = deploy(file_);
    ASSERT_EQ(done.code, 0) << done.err;
  }
};

TEST_F(SecuredPlatform, Only_what_a_deployer_of_the_plant_has_signed_is_deployed) {
  const Outcome unsigned_one = update(packed("9.1"));
  EXPECT_EQ(unsigned_one.code, 1);
  EXPECT_THAT(unsigned_one.err, HasSubstr("not signed"));
  ASSERT_EQ(indurop_here({"keys", "init", file_, "--dir", path("other_keys")}).code, 0);
  const Outcome other = update(packed("9.2", RELEASE_FOLDER, {"--keys", path("other_keys")}));
  EXPECT_EQ(other.code, 1);
  EXPECT_THAT(other.err, HasSubstr("keys of another authority"));
  const Outcome done = update(packed("9.3", RELEASE_FOLDER, {"--keys", path("keys")}));
  ASSERT_EQ(done.code, 0) << done.err << agent("a").err();
  EXPECT_TRUE(both_run("9.3"));
  const Json seen = indurop({"platform", "status", "--keys", path("keys/viewer"), "-o", "json"}).json();
  EXPECT_EQ(seen["boards"].size(), 2U) << "a viewer sees it";
}

}  // namespace
}  // namespace indurop::test
