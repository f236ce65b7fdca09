// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/planning_desk.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>
#include <thread>

#include "robot_fixture.h"

namespace indurop::robot {
namespace {

class Desk {
 protected:
  static Settings settings(bool in_tick) {
    Settings s;
    s.period = std::chrono::milliseconds(1);
    s.plan_time = 0.02;
    s.plan_in_tick = in_tick;
    return s;
  }
  PlanRequest line(double x, int source) {
    PlanRequest request;
    request.from << 0.1, 0.2, 0.1, 0.3, 0.8, 0.2;
    request.command.move = Move::Line;
    request.command.source = source;
    request.command.target.is_pose = true;
    request.command.target.pose = arm.forward(request.from);
    request.command.target.pose.position[0] += x;
    return request;
  }
  static const Plan* wait(PlanningDesk& desk) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    const Plan* plan = desk.take();
    while (plan == nullptr && std::chrono::steady_clock::now() < deadline) {
      std::this_thread::yield();
      plan = desk.take();
    }
    return plan;
  }

  Arm arm = cell_arm();
  Inverse inverse{arm};
  Places places{arm, inverse};
};

class Planning_desk : public Desk, public testing::TestWithParam<bool> {
 protected:
  PlanningDesk sut{places, cell_limits(), ToolLimits{}, settings(GetParam())};
};
class Planning_desk_of_a_crash : public Desk, public testing::Test {};

// What the tick of a run learned of its thread, and a replay learns again, whichever thread it has.
std::vector<bool>& learned() {
  static std::vector<bool> all;
  return all;
}
std::size_t& repeated() {
  static std::size_t at = 0;
  return at;
}

TEST_P(Planning_desk, Gives_plans_in_the_same_period_again_however_late_they_were) {
  std::mt19937 random(3);
  for (int round = 0; round < 20; ++round) {
    learned().clear();
    const int lates = static_cast<int>(random() % 30);
    for (int i = 0; i < lates; ++i) {
      learned().push_back(false);
    }
    learned().push_back(true);
    repeated() = 0;
    Settings s = settings(GetParam());
    s.learned = [](bool) noexcept -> bool { return learned()[repeated()++]; };
    PlanningDesk desk(places, cell_limits(), ToolLimits{}, s);
    desk.ask(line(-0.1, 1));
    int periods = 0;
    while (desk.take() == nullptr) {
      ASSERT_LT(++periods, 100);
    }
    EXPECT_EQ(periods, 22 + lates);
    EXPECT_FALSE(desk.holds_forgotten()) << "nothing was, so nothing is asked";
    EXPECT_EQ(repeated(), learned().size());
    // A forgotten one: polled until it is released.
    learned().insert(learned().end(), {true, true, false});
    desk.ask(line(-0.1, 2));
    desk.forget();
    EXPECT_TRUE(desk.holds_forgotten());
    EXPECT_TRUE(desk.holds_forgotten());
    EXPECT_FALSE(desk.holds_forgotten());
    EXPECT_FALSE(desk.holds_forgotten());
    EXPECT_EQ(repeated(), learned().size());
  }
}

TEST_P(Planning_desk, Makes_the_same_plan_and_not_before_it_is_due) {
  PlanningDesk other(places, cell_limits(), ToolLimits{}, settings(true));
  other.ask(line(-0.1, 1));
  sut.ask(line(-0.1, 1));
  EXPECT_FALSE(sut.free());
  for (int i = 0; i < 22; ++i) {  // 20 ms and as much again per second of a line, this one takes 0.1 s
    EXPECT_EQ(other.take(), nullptr);
    EXPECT_EQ(sut.take(), nullptr);
  }
  const Plan* expected = other.take();
  const Plan* plan = wait(sut);
  ASSERT_NE(expected, nullptr);
  ASSERT_NE(plan, nullptr);
  EXPECT_TRUE(sut.free());
  ASSERT_TRUE(plan->fault.ok());
  EXPECT_EQ(plan->segment.source, 1);
  EXPECT_TRUE(plan->segment.timing.known());
  EXPECT_EQ(plan->segment.timing.duration(), expected->segment.timing.duration());
}

TEST_P(Planning_desk, Says_what_is_wrong) {
  sut.ask(line(3, 7));
  const Plan* plan = wait(sut);
  ASSERT_NE(plan, nullptr);
  EXPECT_EQ(plan->fault.code, ErrorCode::Unreachable);
  EXPECT_EQ(plan->segment.source, 7);
}

TEST_P(Planning_desk, Never_gives_a_plan_that_was_forgotten) {
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) {
    sut.ask(line(-0.01, -1));
    for (unsigned k = 0; k < random() % 30; ++k) {
      if (random() % 4 == 0) {
        std::this_thread::yield();
      }
      const Plan* early = sut.take();
      if (early != nullptr) {
        sut.ask(line(-0.01, -1));
      }
    }
    sut.forget();
    EXPECT_TRUE(sut.free());
    sut.ask(line(-0.02, i));
    const Plan* plan = wait(sut);
    ASSERT_NE(plan, nullptr);
    EXPECT_EQ(plan->segment.source, i);
  }
}

// The thread crashes once, then continues as before.
bool crashes_first(void (*work)(void*) noexcept, void* with, char* why, std::size_t size) noexcept {
  static thread_local bool crashed = false;
  if (!crashed) {
    crashed = true;
    std::snprintf(why, size, "SIGSEGV in a test");
    return false;
  }
  work(with);
  return true;
}

TEST_F(Planning_desk_of_a_crash, Says_so_of_all_that_is_asked_for) {
  Settings s = settings(false);
  s.guarded = &crashes_first;
  PlanningDesk desk(places, cell_limits(), ToolLimits{}, s);
  for (int i = 0; i < 3; ++i) {
    desk.ask(line(-0.1, 1));
    const Plan* plan = wait(desk);
    ASSERT_NE(plan, nullptr);
    EXPECT_EQ(plan->fault.code, ErrorCode::Planner);
    EXPECT_STREQ(desk.crash(), "SIGSEGV in a test");
  }
}

INSTANTIATE_TEST_SUITE_P(In_the_tick_and_in_the_background, Planning_desk, testing::Bool());

}  // namespace
}  // namespace indurop::robot
