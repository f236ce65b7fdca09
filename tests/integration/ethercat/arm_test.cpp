// SPDX-License-Identifier: Apache-2.0
// The example ethercat_arm in a network of its own: a tour of the arm on simulated drives to its end, then a drive
// without power, which is named, stops all, and comes back.
#include <string>

#include "tests/support/program.h"
#include "tests/support/unprivileged.h"
#include "veth_fixture.h"

namespace indurop::io::ethercat {
namespace {

test::Environment environment() {
  test::Environment made;
  made.variables = {std::string("PATH=") + ARM_PROGRAMS + ":" + std::getenv("PATH"),
                    std::string("INDUROP_DEMO_DIR=") + ARM_FOLDER, "INDUROP_DEMO_NODE=arm_test"};
  made.one_output = true;
  return made;
}

class EthercatArm : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::own_network() || test::Program({kEnv, "ip", "link", "set", "lo", "up"}).wait() != 0) {
      GTEST_SKIP() << "no right to a network with a veth pair of its own";
    }
  }
};

TEST_F(EthercatArm, Works_to_the_end_of_a_tour_and_stops_while_a_drive_is_away) {
  test::Program sut({ARM_DEMO}, environment());
  ASSERT_EQ(sut.wait(std::chrono::seconds(150)), 0) << sut.out();
  const std::string out = sut.out();
  EXPECT_THAT(out, testing::HasSubstr("visitor \"hits the emergency stop\""));
  const std::size_t pulled = out.find("Drive 3 loses its power");
  ASSERT_NE(pulled, std::string::npos) << out;
  EXPECT_THAT(out.substr(0, pulled), testing::Not(testing::HasSubstr("does not answer"))) << "during the tour";
  const std::string after = out.substr(pulled);
  EXPECT_THAT(after, testing::HasSubstr("slave 4 (InduRoP simulated drive): does not answer; check its power"));
  EXPECT_THAT(after, testing::HasSubstr("{drives: [1, 1, 2, 2, 2, 2], inputs: 1, outputs: 1}"));
  EXPECT_THAT(after, testing::HasSubstr("ROBOT_GROUP_ERRORSTOP"));
  EXPECT_THAT(after, testing::HasSubstr("slave 4 (InduRoP simulated drive): operates"));
  EXPECT_THAT(after, testing::HasSubstr("ROBOT_GROUP_MOVING"));
}

TEST_F(EthercatArm, Says_what_it_lacks) {
  test::Environment unprivileged = environment();
  unprivileged.user = test::kUnprivileged;
  const auto outcome = test::Program({ARM_DEMO}, unprivileged).finish();
  if (outcome.code == test::Program::kNotPrepared) {
    GTEST_SKIP() << "no right to become another user";
  }
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, testing::HasSubstr("run it as root, or with\nCAP_NET_ADMIN and CAP_NET_RAW"));
}

}  // namespace
}  // namespace indurop::io::ethercat
