// SPDX-License-Identifier: Apache-2.0
// Each board in a network namespace of its own, as real ones would be. Needs root and the ip command.

#include <csignal>
#include <cstdlib>

#include "turning_table_fixture.h"

namespace indurop::test {
namespace {

class OwnNamespaces : public TurningTable {
 protected:
  OwnNamespaces() : lab_(std::string(LAB_PROGRAM) + " -l pt" + std::to_string(::getpid()) + " ") {}
  ~OwnNamespaces() override { (void)std::system((lab_ + "down").c_str()); }
  bool up() { return ::geteuid() == 0 && run("up " + board("sensor") + " " + board("control") + " 2>/dev/null") == 0; }
  int run(const std::string& words) const { return std::system((lab_ + words).c_str()); }
  Program& start_board(const std::string& plant, const std::string& name) {
    return start({LAB_PROGRAM, "-l", "pt" + std::to_string(::getpid()), "exec", board(name), INDUROP_PROGRAM, "run",
                  plant, "--board", board(name), "-q"});
  }

 private:
  std::string lab_;
};

// NOLINTNEXTLINE(cppcoreguidelines-macro-usage,readability-identifier-naming): GTEST_SKIP() returns from the test
#define NEEDS_NAMESPACES()                                                                   \
  if (!up()) {                                                                               \
    GTEST_SKIP() << "network namespaces cannot be made here (root and iproute2 are needed)"; \
  }

TEST_F(OwnNamespaces, A_loop_across_the_network_survives_a_pulled_cable) {
  NEEDS_NAMESPACES();
  const std::string plant = two_boards();
  Program& sensor = start_board(plant, "sensor");
  start_board(plant, "control");
  ASSERT_TRUE(wait_until([&] { return controlled(); })) << sensor.err();
  ASSERT_EQ(run("unplug " + board("control")), 0);
  EXPECT_TRUE(wait_until([&] { return torque("sensor") == 0; })) << "the declared fallback";
  EXPECT_TRUE(wait_until([&] { return torque("control") == 0; })) << "the controller sees that the sensor is not valid";
  ASSERT_EQ(run("plug " + board("control")), 0);
  EXPECT_TRUE(wait_until([&] { return controlled(); }));
}

TEST_F(OwnNamespaces, A_board_may_start_long_before_the_other_one) {
  NEEDS_NAMESPACES();
  const std::string plant = two_boards();
  start_board(plant, "control");
  ASSERT_TRUE(wait_until([&] { return pid_of("control") > 0; }));
  Program& sensor = start_board(plant, "sensor");
  EXPECT_TRUE(wait_until([&] { return controlled(); })) << sensor.err();
}

}  // namespace
}  // namespace indurop::test
