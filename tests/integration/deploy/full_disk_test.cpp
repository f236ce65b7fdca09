// SPDX-License-Identifier: Apache-2.0
// The disk of a board is full from some phase of a deployment on: all boards run the same, either what was committed or
// the new one, and once there is space again, the next deployment succeeds without a manual step.

#include <fcntl.h>
#include <sys/mount.h>
#include <unistd.h>

#include <array>

#include "phases_fixture.h"

namespace indurop::test {
namespace {

using testing::HasSubstr;

// Board a has a disk of its own.
class FullDisk : public Phases {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(disk_);
    mounted_ = ::mount("tmpfs", disk_.c_str(), "tmpfs", 0, "size=8m") == 0;
    if (!mounted_) {
      GTEST_SKIP() << "a small disk cannot be mounted here (root is needed)";
    }
    Phases::SetUp();
  }
  ~FullDisk() override {
    if (mounted_) {
      ::umount2(disk_.c_str(), MNT_DETACH);
    }
  }
  // Writes until nothing more fits, not even a byte.
  void fill() const {
    const int file = ::open(ballast().c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    ASSERT_GE(file, 0);
    const std::array<char, 4096> block{};
    while (::write(file, block.data(), block.size()) > 0) {
    }
    EXPECT_EQ(errno, ENOSPC);
    ::close(file);
  }
  void make_space() const { std::filesystem::remove(ballast()); }
  // Whatever the deployment came to, both boards run the same; then there is space, and `next` succeeds.
  void ends_alike(const Outcome& outcome, const std::string& next) {
    SCOPED_TRACE(outcome.err);
    if (outcome.code == 0) {
      EXPECT_NE(new_one(), "");
    } else {
      EXPECT_THAT(outcome.err, HasSubstr(board("a") + ": ")) << "the board is named";
      EXPECT_THAT(outcome.err, testing::ContainsRegex("disk full|No space left")) << "and the cause";
      EXPECT_TRUE(both_run_the_committed());
    }
    make_space();
    const Outcome again = deploy(next);
    ASSERT_EQ(again.code, 0) << again.err;
    EXPECT_TRUE(both_run(again.json()["deployment"]));
  }

 private:
  [[nodiscard]] std::string ballast() const { return disk_ / "ballast"; }
  std::filesystem::path disk_ = folder() / "state" / board("a");
  bool mounted_ = false;
};

TEST_F(FullDisk, Before_a_deployment_is_reported_and_changes_nothing) {
  fill();
  const Outcome refused = deploy(next_);
  EXPECT_EQ(refused.code, 1) << refused.err;
  EXPECT_THAT(refused.err, HasSubstr(board("a") + ": disk full"));
  ends_alike(refused, next_);
}

TEST_F(FullDisk, For_a_file_that_is_larger_than_the_disk_is_reported_before_it_is_fetched) {
  std::ofstream(folder() / "other.so", std::ios::app) << std::string(16U << 20U, 'x');
  const Outcome refused = deploy(next_);
  EXPECT_EQ(refused.code, 1) << refused.err;
  EXPECT_THAT(refused.err, HasSubstr(board("a") + ": disk full"));
  ends_alike(refused, plant("v3.xml", "steady"));
}

TEST_F(FullDisk, When_a_board_is_prepared) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the library that holds files cannot be loaded before that of the sanitizer";
#endif
  b_check_.hold();
  Program& deployer = deploy_until_checking();
  fill();
  b_check_.release();
  ends_alike(deployer.finish(), plant("v3.xml", "steady"));
}

TEST_F(FullDisk, When_a_board_is_healthy_in_its_trial) {
  Program& deployer = deploy_until_healthy();
  fill();
  let_b_start();
  ends_alike(deployer.finish(), next_);
}

// Its node goes on meanwhile, and the agent adopts it.
TEST_F(FullDisk, When_an_agent_is_killed) {
  fill();
  stop_agent("a", SIGKILL);
  start_agent("a");
  EXPECT_TRUE(both_run_the_committed());
  make_space();
  const Outcome again = deploy(next_);
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_TRUE(both_run(again.json()["deployment"]));
}

TEST_F(FullDisk, When_power_comes_back) {
  fill();
  lose("a");
  start_agent("a");
  EXPECT_TRUE(both_run_the_committed());
  make_space();
  const Outcome again = deploy(next_);
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_TRUE(both_run(again.json()["deployment"]));
}

TEST_F(FullDisk, When_all_go_back) {
  const Outcome done = deploy(next_);
  ASSERT_EQ(done.code, 0) << done.err;
  fill();
  const Outcome back = indurop({"rollback", "--health", "500ms", "--timeout", "10s"});
  if (back.code == 0) {
    EXPECT_TRUE(both_run_the_committed());
  } else {
    EXPECT_THAT(back.err, testing::ContainsRegex("disk full|No space left"));
    EXPECT_TRUE(both_run(done.json()["deployment"]));
  }
  make_space();
  const Outcome again = deploy(plant("v3.xml", "steady"));
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_TRUE(both_run(again.json()["deployment"]));
}

}  // namespace
}  // namespace indurop::test
