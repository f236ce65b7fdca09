// SPDX-License-Identifier: Apache-2.0
// The examples of EtherCAT in a network of their own. ethercat_arm: a tour of the arm on simulated drives to its end,
// then a drive without power, which is named, stops all, and comes back, on one board and on two. ethercat_33: all of
// its axes move. ethercat_current: the torque follows.
#include <fcntl.h>
#include <sys/stat.h>
#include <terminal_wires.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "tests/support/program.h"
#include "tests/support/unprivileged.h"
#include "veth_fixture.h"

namespace indurop::io::ethercat {
namespace {

test::Environment environment(const std::string& folder) {
  test::Environment made;
  made.variables = {std::string("PATH=") + PROGRAMS + ":" + std::getenv("PATH"), "INDUROP_DEMO_DIR=" + folder,
                    "INDUROP_DEMO_NODE=ethercat_example_" + std::to_string(::getpid())};
  made.one_output = true;
  return made;
}

// A copy of the arm's folder. Two runs at a time need one each: the pipe to the simulated bus is in it.
class ArmFolder {
 public:
  ArmFolder() : path_(std::filesystem::temp_directory_path() / ("indurop_arm_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
    for (const auto& entry : std::filesystem::directory_iterator(ARM_FOLDER)) {
      if (entry.is_regular_file()) {
        std::filesystem::copy(entry.path(), path_ / entry.path().filename());
      }
    }
  }
  ArmFolder(const ArmFolder&) = delete;
  ArmFolder& operator=(const ArmFolder&) = delete;
  ~ArmFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

class EthercatExamples : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::own_network() || test::Program({kEnv, "ip", "link", "set", "lo", "up"}).wait() != 0) {
      GTEST_SKIP() << "no right to a network with a veth pair of its own";
    }
  }
};

TEST_F(EthercatExamples, Works_to_the_end_of_a_tour_and_stops_while_a_drive_is_away) {
  const ArmFolder folder;
  test::Program sut({ARM_DEMO}, environment(folder.path()));
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

TEST_F(EthercatExamples, Works_with_the_bus_on_one_of_two_boards) {
  const ArmFolder folder;
  test::Program sut({ARM_DEMO, "plant"}, environment(folder.path()));
  ASSERT_EQ(sut.wait(std::chrono::seconds(150)), 0) << sut.out();
  const std::string out = sut.out();
  const std::size_t pulled = out.find("Drive 3 loses its power");
  ASSERT_NE(pulled, std::string::npos) << out;
  EXPECT_THAT(out.substr(pulled), testing::HasSubstr("ROBOT_GROUP_ERRORSTOP"));
  EXPECT_THAT(out.substr(pulled), testing::HasSubstr("ROBOT_GROUP_MOVING"));
}

TEST(EthercatExample, Of_the_arm_in_virtual_time_replays_without_a_difference) {
  const ArmFolder folder;
  const std::string recording = folder.path() + "/arm.mcap";
  const std::string node = "ethercat_sim_" + std::to_string(::getpid());
  const auto indurop = [&folder](std::vector<std::string> words) {
    words.insert(words.begin(), std::string(PROGRAMS) + "/indurop");
    return test::Program(words, environment(folder.path())).finish();
  };
  const auto run =
      indurop({"run", folder.path() + "/module.xml", "--sim", "--until", "5s", "--node", node, "--record", recording});
  ASSERT_EQ(run.code, 0) << run.out;
  EXPECT_THAT(run.out, testing::HasSubstr("EtherCAT ecarm0: slave 7 (InduRoP simulated drive): operates"));
  const auto replay = indurop({"replay", recording, "--node", node});
  EXPECT_EQ(replay.code, 0) << replay.out;
  EXPECT_THAT(replay.out, testing::HasSubstr(" values: equal"));
  EXPECT_EQ(indurop({"clean", "--node", node}).code, 0);
}

TEST(EthercatExample, Of_two_worlds_only_the_first_is_wired_to_the_terminal) {
  const ArmFolder folder;
  const std::string fifo = folder.path() + "/bus.fifo";
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  const int terminal = open(fifo.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  const auto received = [terminal] {
    std::array<char, 4096> bytes{};
    const ssize_t size = read(terminal, bytes.data(), bytes.size());
    return std::string(bytes.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
  };
  std::optional<TerminalWires> first(fifo);
  TerminalWires second(fifo);
  first->send();
  EXPECT_THAT(received(), testing::HasSubstr("0s value slave=0 at=6030:1 to=0\n"));
  second.set(3, true);
  second.send();
  EXPECT_EQ(received(), "");
  first.reset();
  second.send();
  EXPECT_THAT(received(), testing::HasSubstr("0s value slave=0 at=6030:1 to=1\n"));
  close(terminal);
}

TEST_F(EthercatExamples, Thirty_three_axes_move) {
  test::Program sut({AXES_DEMO, "3"}, environment(AXES_FOLDER));
  ASSERT_EQ(sut.wait(std::chrono::seconds(100)), 0) << sut.out();
  EXPECT_THAT(sut.out(), testing::HasSubstr("enabled 33 axes, largest deviation 0"));
}

TEST_F(EthercatExamples, A_current_loop_is_closed_over_the_cable) {
  test::Program sut({CURRENT_DEMO, "2"}, environment(CURRENT_FOLDER));
  ASSERT_EQ(sut.wait(std::chrono::seconds(100)), 0) << sut.out();
  EXPECT_THAT(sut.out(), testing::ContainsRegex("[1-9][0-9]* steps, the slowest in [1-9][0-9]* us"));
  EXPECT_THAT(sut.out(), testing::ContainsRegex("[1-9][0-9]* frames sent: [0-9]+ came back late"));
}

TEST_F(EthercatExamples, Says_what_it_lacks) {
  test::Environment unprivileged = environment(ARM_FOLDER);
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
