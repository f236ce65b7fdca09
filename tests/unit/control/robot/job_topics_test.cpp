// SPDX-License-Identifier: Apache-2.0
// Tasks that robot programmers have, written as jobs (topics/*.job): each of them is read without a finding,
// runs to its end with every set point within the limits, and gives what it has to give.
#include <gmock/gmock.h>

#include <ostream>

#include "limit_judge.h"
#include "topic_run.h"

namespace indurop::robot {

// The name of a test, instead of the bytes of its parameter.
void PrintTo(const Topic& topic, std::ostream* out) {
  *out << topic.name;
}

namespace {

class Job_topics : public testing::TestWithParam<Topic> {};

TEST_P(Job_topics, Run_to_their_end) {
  const Topic& topic = GetParam();
  ASSERT_NE(topic_text(topic.name), "");
  TopicRun run(topic);
  const Cell& cell = run.cell();
  Judge judge(TopicRun::kPeriod, topic_urdf(topic));
  ASSERT_TRUE(run.run([&] {
    EXPECT_EQ(judge.look(cell, 1), "") << topic.name << " in line " << cell.out.job.line;
    return !HasFailure();
  })) << "it is in line "
      << cell.out.job.line;
  EXPECT_EQ(cell.out.error, ErrorCode::Ok) << cell.out.job.message;
  EXPECT_EQ(cell.out.job.state, JobState::Ended) << cell.out.job.message;
  EXPECT_NEAR(run.value("OUT"), topic.wanted, topic.within);
}

INSTANTIATE_TEST_SUITE_P(Common, Job_topics, testing::ValuesIn(topics()),
                         [](const auto& topic) { return std::string(topic.param.name); });

}  // namespace
}  // namespace indurop::robot
