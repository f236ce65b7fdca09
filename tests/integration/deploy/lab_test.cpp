// SPDX-License-Identifier: Apache-2.0
// Boards as network namespaces: three of them, a cable that is pulled in the middle, packets that are lost. Needs root.

#include <cstdlib>

#include "agents_fixture.h"

namespace indurop::test {
namespace {

class Network : public AgentsTest {
 protected:
  Network() : lab_("dt" + std::to_string(::getpid() % 100'000)) {}
  ~Network() override {
    if (up_) {
      (void)lab("down");
    }
  }
  void SetUp() override {
    up_ = ::geteuid() == 0 && lab("up a b c desk 2>/dev/null") == 0;
    if (!up_) {
      GTEST_SKIP() << "network namespaces cannot be made here (root and iproute2 are needed)";
    }
    for (const char* name : {"a", "b", "c"}) {
      start_agent(name, on(name));
    }
    v1_ = manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}, {"c", "steady"}});
    v2_ = manifest("v2.xml", {{"a", "other"}, {"b", "steady"}, {"c", "other"}});
  }
  int lab(const std::string& words) const {
    return std::system((std::string(LAB_PROGRAM) + " -l " + lab_ + " " + words).c_str());
  }
  std::vector<std::string> on(const std::string& name) const { return {LAB_PROGRAM, "-l", lab_, "exec", name}; }
  bool all_run(const std::string& deployment) {
    return wait_until([&] {
      return runs("a", deployment, on("desk")) && runs("b", deployment, on("desk")) &&
             runs("c", deployment, on("desk"));
    });
  }
  std::string lab_;
  bool up_ = false;
  std::string v1_;
  std::string v2_;
};

TEST_F(Network, Three_boards_are_deployed_to_across_the_network) {
  const Outcome done = deploy(v1_, {}, on("desk"));
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_TRUE(all_run(done.json()["deployment"]));
  ASSERT_EQ(lab("off b"), 0);
  stop_agent("b", SIGKILL);
  EXPECT_TRUE(wait_until([&] { return report("b", on("desk")).is_null(); })) << "it is missed";
  start_agent("b", on("b"));
  EXPECT_TRUE(all_run(done.json()["deployment"])) << "it resumes what it had";
}

TEST_F(Network, A_cable_pulled_in_the_trial_ends_in_one_state) {
  const Outcome first = deploy(v1_, {}, on("desk"));
  ASSERT_EQ(first.code, 0) << first.err;
  Program& deployer = start_indurop({"deploy", v2_, "--health", "8s"}, on("desk"));
  ASSERT_TRUE(wait_until([&] { return report("b", on("desk"))["phase"] == "trial"; }));
  ASSERT_EQ(lab("unplug b"), 0);
  EXPECT_EQ(deployer.finish().code, 5);
  ASSERT_EQ(lab("plug b"), 0);
  EXPECT_TRUE(all_run(first.json()["deployment"]));
}

// It has shared memory of its own, as another host has.
TEST_F(Network, Boards_here_and_elsewhere_come_into_one_recording) {
  stop_agent("b", SIGKILL);
  auto elsewhere = on("b");
  elsewhere.insert(elsewhere.end(), {"unshare", "-m", "sh", "-c", "mount -t tmpfs none /dev/shm && exec \"$@\"", "sh"});
  start_agent("b", elsewhere);
  const Outcome done = deploy(v1_, {}, on("desk"));
  EXPECT_EQ(done.code, 0) << done.err;
  const auto nodes = [&](const std::string& file) {
    return indurop_here({"recording", "info", path(file), "-o", "json"}).json()["nodes"].size();
  };
  const auto record = [&](const std::string& file) -> Program& {
    std::filesystem::remove_all(path("state/" + board("b") + "/recordings"));
    Program& desk = start_indurop({"record", "--plant", v1_, "-o", path(file)}, on("desk"));
    EXPECT_TRUE(wait_until([&] { return std::filesystem::exists(path(file + ".parts/this.host.mcap")); }));
    return desk;
  };
  Program& whole = record("whole.mcap");
  EXPECT_EQ(lab("unplug b"), 0);
  EXPECT_TRUE(wait_until([&] { return report("b", on("desk")).is_null(); }));
  EXPECT_EQ(lab("plug b"), 0);
  EXPECT_TRUE(wait_until([&] { return !report("b", on("desk")).is_null(); }));
  whole.signal(SIGINT);
  const Outcome all = whole.finish();
  EXPECT_EQ(all.code, 130) << all.err;
  EXPECT_EQ(nodes("whole.mcap"), 3U);

  Program& part = record("part.mcap");
  EXPECT_EQ(lab("unplug b"), 0);
  part.signal(SIGINT);
  const Outcome some = part.finish();
  EXPECT_EQ(some.code, 1);
  EXPECT_THAT(some.err, testing::HasSubstr("board " + board("b") + " is not in the recording: it does not answer"));
  EXPECT_EQ(nodes("part.mcap"), 2U);
  EXPECT_EQ(lab("plug b"), 0);
  stop_agent("b", SIGTERM);
}

TEST_F(Network, Lost_packets_cost_time_only) {
  for (const char* name : {"a", "b", "c", "desk"}) {
    if (lab(std::string("loss ") + name + " 30 2>/dev/null") != 0) {
      GTEST_SKIP() << "iptables cannot lose packets here";
    }
  }
  std::ofstream(folder() / "steady.so", std::ios::app) << std::string(1U << 20U, 'x');
  const Outcome done = deploy(v1_, {"--timeout", "20s"}, on("desk"));
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_TRUE(all_run(done.json()["deployment"]));
}

TEST_F(Network, A_flood_of_garbage_at_the_ports_disturbs_no_board_and_no_deployer) {
  std::vector<Program*> floods;
  for (const int host : {1, 2, 4}) {  // a, b, desk
    std::vector<std::string> words = on("c");
    words.insert(words.end(),
                 {"python3", GARBAGE_PROGRAM, "10.77.0." + std::to_string(host), std::to_string(link_domain())});
    floods.push_back(&start(words));
  }
  std::ofstream(folder() / "steady.so", std::ios::app) << std::string(1U << 20U, 'x');
  const Outcome done = deploy(v1_, {}, on("desk"));
  ASSERT_EQ(done.code, 0) << done.err;
  const Outcome next = deploy(v2_, {}, on("desk"));
  ASSERT_EQ(next.code, 0) << next.err;
  EXPECT_TRUE(all_run(next.json()["deployment"]));
  for (Program* flood : floods) {
    flood->signal(SIGKILL);
    EXPECT_EQ(flood->finish().code, 128 + SIGKILL) << "it was there all the time";
  }
}

}  // namespace
}  // namespace indurop::test
