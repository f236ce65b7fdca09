// SPDX-License-Identifier: Apache-2.0
// Boards as network namespaces: three of them, a cable that is pulled in the middle, packets that are lost. Needs root.

#include <cstdlib>

#include "plant_fixture.h"

namespace indurop::test {
namespace {

class Network : public PlantTest {
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
}

TEST_F(Network, A_cable_pulled_in_the_trial_ends_in_one_state) {
  const Outcome first = deploy(v1_, {}, on("desk"));
  ASSERT_EQ(first.code, 0) << first.err;
  const pid_t deployer = start_indurop({"deploy", v2_, "--health", "8s"}, "cable.out", on("desk"));
  ASSERT_TRUE(wait_until([&] { return report("b", on("desk"))["phase"] == "trial"; }));
  ASSERT_EQ(lab("unplug b"), 0);
  EXPECT_EQ(finish(deployer, "cable.out").code, 5);
  ASSERT_EQ(lab("plug b"), 0);
  EXPECT_TRUE(all_run(first.json()["deployment"]));
}

TEST_F(Network, Lost_packets_cost_time_only) {
  if (lab("loss a 20 2>/dev/null") != 0 || lab("loss desk 20 2>/dev/null") != 0) {
    GTEST_SKIP() << "iptables cannot lose packets here";
  }
  std::ofstream(folder() / "steady.so", std::ios::app) << std::string(1U << 20U, 'x');
  const Outcome done = deploy(v1_, {"--timeout", "20s"}, on("desk"));
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_TRUE(all_run(done.json()["deployment"]));
}

}  // namespace
}  // namespace indurop::test
