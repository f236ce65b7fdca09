// SPDX-License-Identifier: Apache-2.0
// What an agent makes of the end of its node, which is a script.
#include "deploy/agent/board_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

namespace indurop::deploy {
namespace {

class BoardProcesses : public testing::Test {
 protected:
  BoardProcesses() {
    std::string name = (std::filesystem::temp_directory_path() / "indurop-process-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    std::ofstream(folder_ / "node") << "#!/bin/sh\ntest \"$5\" = bad && exit 4\nexec sleep 100\n";
    std::filesystem::permissions(folder_ / "node", std::filesystem::perms::owner_all);
  }
  ~BoardProcesses() override { std::filesystem::remove_all(folder_); }

  // Begins the deployment `bad`, and waits until its node has ended, which was not noticed yet.
  void start_one_that_ends() {
    sut_.emplace(
        "b" + std::to_string(::getpid()), std::vector<std::string>{}, BlackBox(folder_, "b"),
        [](const std::string&) { return std::string(); }, log_, ::open((folder_ / "node").c_str(), O_PATH | O_CLOEXEC));
    sut_->want("plant.xml", "bad");
    sut_->step(now_);
    ASSERT_TRUE(sut_->has_node());
    siginfo_t info{};
    ASSERT_EQ(::waitid(P_ALL, 0, &info, WEXITED | WNOWAIT), 0);
    while (info.si_status != kExitCode) {  // a child of an earlier test in this process
      ASSERT_EQ(::waitpid(info.si_pid, nullptr, 0), info.si_pid);
      ASSERT_EQ(::waitid(P_ALL, 0, &info, WEXITED | WNOWAIT), 0);
    }
  }
  static constexpr int kExitCode = 4;

  std::filesystem::path folder_;
  base::Log log_{"test", "b", true};
  rt::MonoTime now_ = rt::MonoClock::now();
  std::optional<BoardProcess> sut_;
};

TEST_F(BoardProcesses, A_node_that_refuses_to_run_is_not_started_again) {
  start_one_that_ends();
  sut_->step(now_);
  EXPECT_EQ(sut_->condition(), NodeCondition::Failed);
  EXPECT_EQ(sut_->reason(), "the node ended with exit code 4");
  sut_->step(now_);
  EXPECT_FALSE(sut_->has_node());
}

// As when a deployment is rolled back while its node starts: its files are gone then.
TEST_F(BoardProcesses, The_end_of_a_node_that_was_to_end_anyway_does_not_count_for_the_next_one) {
  start_one_that_ends();
  sut_->want("plant.xml", "good");
  sut_->step(now_);
  EXPECT_TRUE(sut_->has_node()) << sut_->reason();
  EXPECT_EQ(sut_->condition(), NodeCondition::Starting);
  sut_->end();
}

}  // namespace
}  // namespace indurop::deploy
