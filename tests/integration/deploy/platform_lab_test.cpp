// SPDX-License-Identifier: Apache-2.0
// The platform is updated across a network, between boards as network namespaces. Needs root.

#include <cstdlib>

#include "platform_fixture.h"

namespace indurop::test {
namespace {

class PlatformNetwork : public PlatformTest {
 protected:
  PlatformNetwork() : lab_("pl" + std::to_string(::getpid() % 100'000)) {}
  ~PlatformNetwork() override {
    if (up_) {
      (void)lab("down");
    }
  }
  void SetUp() override {
    up_ = ::geteuid() == 0 && lab("up a b desk 2>/dev/null") == 0;
    if (!up_) {
      GTEST_SKIP() << "network namespaces cannot be made here (root and iproute2 are needed)";
    }
    start_agent("a", on("a"));
    start_agent("b", on("b"));
    const Outcome done = deploy(manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}}), {}, on("desk"));
    ASSERT_EQ(done.code, 0) << done.err;
  }
  int lab(const std::string& words) const {
    return std::system((std::string(LAB_PROGRAM) + " -l " + lab_ + " " + words).c_str());
  }
  [[nodiscard]] std::vector<std::string> on(const std::string& name) const {
    return {LAB_PROGRAM, "-l", lab_, "exec", name};
  }
  std::string lab_;
  bool up_ = false;
};

TEST_F(PlatformNetwork, Boards_are_updated_and_a_pulled_cable_takes_all_back) {
  const Outcome done = update(packed("9.1"), {}, on("desk"));
  ASSERT_EQ(done.code, 0) << done.err;
  ASSERT_TRUE(both_run("9.1", on("desk")));
  Program& desk = start_update(packed("9.2"), {"--health", "60s"}, on("desk"));
  ASSERT_TRUE(in_phase("b", "trial", on("desk")));
  ASSERT_EQ(lab("unplug b"), 0);
  EXPECT_EQ(desk.finish().code, 5) << "b is lost";
  ASSERT_EQ(lab("plug b"), 0);
  EXPECT_TRUE(both_run("9.1", on("desk")));
}

}  // namespace
}  // namespace indurop::test
