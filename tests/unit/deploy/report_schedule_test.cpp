// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/report_schedule.h"

#include <gtest/gtest.h>

namespace indurop::deploy {
namespace {

using namespace std::chrono_literals;

// A board that runs and was reported at the beginning.
class ReportScheduleTest : public ::testing::Test {
 protected:
  ReportScheduleTest() { EXPECT_TRUE(due(0ms)); }

  bool due(std::chrono::milliseconds after) {
    return sut_.take_due(phase_, condition_, faults_, rt::mono_time(1'000'000'000'000) + after);
  }

  ReportSchedule sut_;
  Phase phase_ = Phase::Steady;
  NodeCondition condition_ = NodeCondition::Running;
  std::uint64_t faults_ = 0;
};

TEST(ReportSchedule, The_first_report_is_due_at_once) {
  ReportSchedule sut;
  EXPECT_TRUE(sut.take_due(Phase::Steady, NodeCondition::None, 0, rt::mono_time(0)));
  EXPECT_FALSE(sut.take_due(Phase::Steady, NodeCondition::None, 0, rt::mono_time(0)));
}

TEST_F(ReportScheduleTest, A_board_at_rest_is_reported_twice_a_second) {
  EXPECT_FALSE(due(499ms));
  EXPECT_TRUE(due(500ms));
  EXPECT_FALSE(due(999ms));
  EXPECT_TRUE(due(1000ms));
}

TEST_F(ReportScheduleTest, During_a_deployment_it_is_reported_every_50_ms) {
  phase_ = Phase::Fetching;
  EXPECT_FALSE(due(49ms));
  EXPECT_TRUE(due(50ms));
  EXPECT_FALSE(due(99ms));
  EXPECT_TRUE(due(100ms));
}

TEST_F(ReportScheduleTest, Another_condition_is_reported_soon_and_once) {
  condition_ = NodeCondition::Restarting;
  EXPECT_FALSE(due(49ms));
  EXPECT_TRUE(due(50ms));
  EXPECT_FALSE(due(549ms));
  EXPECT_TRUE(due(550ms));
}

TEST_F(ReportScheduleTest, A_fault_is_reported_soon_and_once) {
  faults_ = 1;
  EXPECT_TRUE(due(50ms));
  EXPECT_FALSE(due(150ms));
  faults_ = 2;
  EXPECT_TRUE(due(150ms));
}

TEST_F(ReportScheduleTest, What_was_reported_is_compared_with_the_last_report) {
  condition_ = NodeCondition::Stopping;
  EXPECT_FALSE(due(10ms));
  condition_ = NodeCondition::Running;
  EXPECT_FALSE(due(60ms)) << "it is as reported";
}

TEST_F(ReportScheduleTest, A_requested_report_is_due_at_once_and_once) {
  sut_.request();
  sut_.request();
  EXPECT_TRUE(due(1ms));
  EXPECT_FALSE(due(1ms));
  EXPECT_FALSE(due(500ms)) << "the interval begins with the report";
  EXPECT_TRUE(due(501ms));
}

}  // namespace
}  // namespace indurop::deploy
