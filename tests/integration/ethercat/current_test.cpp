// SPDX-License-Identifier: Apache-2.0
// The loop of a motor's torque, closed over the bus every 100 us (examples/ethercat_current), in virtual time: what a
// module of the test computes on its own is what the drive reports, in each of its ticks.
#include <cstdlib>

#include "core/base/read_file.h"
#include "tests/support/node_fixture.h"

namespace indurop::test {
namespace {

constexpr double kTicksPerSecond = 10'000;

class EthercatCurrent : public NodeTest {
 protected:
  // Returns how it ended; the variables stay.
  Outcome simulate(int seconds) {
    write("ioconfig.xml", base::read_file(std::string(CURRENT_FOLDER) + "/ioconfig.xml").value());
    const auto module = [](const std::string& file, int priority) {
      return Module{.file = file, .period = "100us", .priority = priority};
    };
    std::vector<Module> modules = {module(IO_MODULE, 1), module(std::string(CURRENT_FOLDER) + "/current.so", 2),
                                   module(CURRENT_ORACLE, 3)};
    modules[0].properties = {{"config", "ioconfig.xml"}};
    Program& node = start(modules, {"--sim", "--until", std::to_string(seconds) + "s"});
    const int code = node.wait(std::chrono::hours(2));
    return {code, node.out(), node.err()};
  }
  // Compares the whole run with the computation.
  void judge(const Outcome& outcome, int seconds) {
    ASSERT_EQ(outcome.code, 0) << outcome.out << outcome.err;
    EXPECT_THAT(outcome.out, testing::HasSubstr(": 0 came back late, 0 were lost"));
    const double compared = std::stod(indurop({"get", "ORACLE::judgement.compared"}).out);
    EXPECT_GT(compared, (seconds - 0.5) * kTicksPerSecond) << "the drive was enabled within half a second";
    EXPECT_EQ(std::stol(indurop({"get", "ORACLE::judgement.different"}).out), 0)
        << "first in run " << indurop({"get", "ORACLE::judgement.first"}).out;
    EXPECT_LT(std::stod(indurop({"get", "ORACLE::judgement.farthest"}).out), 20) << "counts of 1320000";
    EXPECT_EQ(std::stol(indurop({"get", "CURRENT::state.steps"}).out), static_cast<long>(compared - 1) / 100);
    // Alone, the winding takes 5 ms * ln(200 / 4) = 19.5 ms.
    EXPECT_LT(std::stod(indurop({"get", "CURRENT::state.slowest"}).out), 5000);
  }
};

TEST_F(EthercatCurrent, Loop_of_100_us_is_what_is_computed_and_the_same_twice) {
  const char* const long_time = std::getenv("INDUROP_CURRENT_SECONDS");
  const int seconds = long_time != nullptr ? std::atoi(long_time) : 10;
  judge(simulate(seconds), seconds);
  const std::string first = indurop({"vars", "-o", "json"}).out;
  EXPECT_THAT(first, testing::HasSubstr("ORACLE::judgement"));
  judge(simulate(seconds), seconds);
  EXPECT_EQ(first, indurop({"vars", "-o", "json"}).out);
}

}  // namespace
}  // namespace indurop::test
