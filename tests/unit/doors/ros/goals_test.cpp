// SPDX-License-Identifier: Apache-2.0
// Goals of an action, by the comments of action_msgs/srv/CancelGoal and action_msgs/msg/GoalStatus.
#include "doors/ros/ros2/goals.h"

#include <gmock/gmock.h>

namespace indurop::ros {
namespace {

using Code = GoalBook::CancelCode;

GoalId id_of(int number) {
  GoalId id{};
  id.back() = static_cast<std::uint8_t>(number);
  return id;
}

// Goals 1 to 4, accepted at 10 to 40: the first has ended, the last is not accepted yet.
class GoalBookTest : public testing::Test {
 protected:
  GoalBookTest() {
    for (int number = 1; number <= 4; ++number) {
      Goal& goal = *sut_.add(id_of(number));
      goal.stamp_ns = number < 4 ? 10 * number : 0;
      goal.status = number < 4 ? GoalStatus::Executing : GoalStatus::Unknown;
    }
    sut_.find(1)->status = GoalStatus::Succeeded;
  }
  std::vector<int> cancelled(const GoalId& id, std::int64_t stamp_ns) {
    std::vector<int> numbers;
    for (const Goal* const goal : sut_.chosen_to_cancel(id, stamp_ns).goals) {
      numbers.push_back(goal->number);
    }
    return numbers;
  }

  GoalBook sut_;
};

TEST_F(GoalBookTest, A_request_to_cancel_chooses_by_identifier_and_time) {
  using testing::ElementsAre;
  using testing::IsEmpty;
  EXPECT_THAT(cancelled({}, 0), ElementsAre(2, 3, 4)) << "all, and what waits";
  EXPECT_THAT(cancelled({}, 20), ElementsAre(2)) << "accepted until then";
  EXPECT_THAT(cancelled({}, 5), IsEmpty());
  EXPECT_THAT(cancelled(id_of(3), 0), ElementsAre(3)) << "at any time";
  EXPECT_THAT(cancelled(id_of(3), 20), ElementsAre(2, 3)) << "this one and those accepted until then";
  EXPECT_THAT(cancelled(id_of(4), 0), ElementsAre(4)) << "not accepted yet";
}

TEST_F(GoalBookTest, Why_nothing_is_cancelled) {
  EXPECT_EQ(sut_.chosen_to_cancel(id_of(1), 0).code, Code::GoalHasEnded);
  EXPECT_EQ(sut_.chosen_to_cancel(id_of(9), 0).code, Code::UnknownGoal);
  EXPECT_EQ(sut_.chosen_to_cancel(id_of(2), 0).code, Code::None);
  EXPECT_EQ(sut_.chosen_to_cancel({}, 5).code, Code::None);
}

TEST_F(GoalBookTest, An_identifier_names_one_goal) {
  EXPECT_EQ(sut_.add(id_of(1)), nullptr) << "also after it has ended";
  EXPECT_EQ(sut_.find(id_of(3))->number, 3);
  sut_.remove(3);
  EXPECT_EQ(sut_.find(id_of(3)), nullptr);
  EXPECT_EQ(sut_.add(id_of(3))->number, 5);
}

TEST_F(GoalBookTest, States_are_those_of_accepted_goals) {
  const auto shown = sut_.shown();
  ASSERT_EQ(shown.size(), 3);
  EXPECT_EQ(shown.front()->number, 1);
}

TEST_F(GoalBookTest, The_results_of_the_last_goals_are_kept) {
  for (int number = 5; number < 60; ++number) {
    sut_.add(id_of(number))->status = GoalStatus::Aborted;
    sut_.tidy();
  }
  EXPECT_EQ(sut_.find(1), nullptr) << "the oldest has gone";
  EXPECT_NE(sut_.find(2), nullptr) << "it has not ended";
  EXPECT_NE(sut_.find(4), nullptr) << "it waits";
  EXPECT_EQ(sut_.find(59 - static_cast<int>(GoalBook::kKept)), nullptr);
  EXPECT_NE(sut_.find(60 - static_cast<int>(GoalBook::kKept)), nullptr);
}

}  // namespace
}  // namespace indurop::ros
