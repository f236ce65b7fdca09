// SPDX-License-Identifier: Apache-2.0
#include "tests/support/plant_fixture.h"

#include <cstdlib>

namespace indurop::test {
namespace {

struct OnePlant : PlantTest {
  using PlantTest::start;
  void TestBody() override {}
};

TEST(PlantFixture, Ends_what_a_killed_program_has_started) {
  pid_t left = -1;
  {
    OnePlant sut;
    // As an agent that is killed just after it started its node, which has no store yet.
    Program& agent = sut.start({"/bin/sh", "-c", "sleep 1000 & echo $!; wait"});
    ASSERT_TRUE(agent.prints("\n"));
    left = std::atoi(agent.out().c_str());
    agent.kill();
    ASSERT_TRUE(alive(left));
  }
  EXPECT_FALSE(alive(left));
}

}  // namespace
}  // namespace indurop::test
