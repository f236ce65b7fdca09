// SPDX-License-Identifier: Apache-2.0
// Moving by hand: directions, where it ends, and random requests that break no limit, nor 250 mm/s of the tip (ISO
// 10218-1).
#include <random>
#include <vector>

#include "control/robot/group/enabling_switch.h"
#include "limit_judge.h"

namespace indurop::robot {
namespace {

Vec3 tip(const Cell& cell) {
  return {cell.out.position[0], cell.out.position[1], cell.out.position[2]};
}

bool stands(const Cell& cell) {
  return cell.out.state == GroupState::Standby;
}

TEST(Jog, Random_requests_break_no_limit_and_the_tip_is_never_faster_than_250_mm_per_second) {
  double fastest = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    std::mt19937 random(seed);
    const double period_ms = seed % 4 == 3 ? 0.1 : seed % 2 == 0 ? 4 : 10;
    const double lasts = period_ms < 1 ? 4000 : 30'000;  // ms
    Cell cell("TOOL long = POSE 0 100 300 RPY 0 0 0\n", period_ms);
    ASSERT_TRUE(cell.serve(Service::GroupEnable));
    cell.in.service.tool = seed % 3 == 0 ? 1 : 0;
    ASSERT_TRUE(cell.serve(Service::SelectTool));
    cell.in.service.point = 1;
    cell.ask(Service::MoveJoints);
    ASSERT_TRUE(cell.until([&] { return cell.out.done == cell.in.service.number; }, 100'000));
    ASSERT_EQ(cell.out.error, ErrorCode::Ok);
    Judge judge(period_ms / 1000);
    for (int k = 0; k < 4; ++k) {
      cell.step();
      static_cast<void>(judge.look(cell, 1));
    }
    const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    for (int i = 0; i < lasts / period_ms; ++i) {
      if (in(0, 1) < 1.5 * period_ms / 1000) {
        cell.in.jog = {};
        cell.in.jog.enabled = in(0, 1) < 0.9;
        cell.in.jog.frame = static_cast<JogFrame>(std::uniform_int_distribution<int>(0, 2)(random));
        cell.in.jog.speed[std::uniform_int_distribution<std::size_t>(0, 5)(random)] = in(0, 1) < 0.5 ? 100 : -100;
      }
      const Vec3 before = tip(cell);
      cell.step();
      ASSERT_EQ(judge.look(cell, 1), "") << "seed " << seed << ", period " << i;
      ASSERT_NE(cell.out.state, GroupState::ErrorStop) << to_string(cell.out.error);
      fastest = std::max(fastest, (tip(cell) - before).norm() / period_ms * 1000);
      ASSERT_LE(fastest, 250) << "seed " << seed << ", period " << i;
    }
  }
  fmt::print("at most {:.1f} mm/s\n", fastest);
  EXPECT_GT(fastest, 200);
}

TEST(Jog, Goes_straight_and_rests_when_the_switch_is_released) {
  Cell cell;
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.point = 2;
  ASSERT_TRUE(cell.serve(Service::MoveJoints));
  const Vec3 from = tip(cell);
  cell.in.jog.frame = JogFrame::Base;
  cell.in.jog.speed[2] = 50;
  for (int i = 0; i < 50; ++i) {
    cell.step();
  }
  EXPECT_LT((tip(cell) - from).norm(), 1e-9) << "the enabling switch is not pressed";
  cell.in.jog.enabled = true;
  ASSERT_TRUE(cell.until([&] { return cell.out.tool_speed > 120; }));
  cell.in.jog.enabled = false;
  ASSERT_TRUE(cell.until([&] { return stands(cell); }, 100));
  EXPECT_GT(tip(cell).z(), from.z() + 5);
  EXPECT_LT((tip(cell) - from).head<2>().norm(), 1e-6);
}

// Frames of any direction: the tip goes along their axes, and turns about them where it is.
TEST(Jog, In_a_work_frame_goes_along_its_axes) {
  std::mt19937 random(5);
  const auto angle = [&] { return std::uniform_real_distribution<double>(-180, 180)(random); };
  for (int k = 0; k < 12; ++k) {
    const Vec3 rpy(angle(), angle() / 2, angle());
    Cell cell(fmt::format("FRAME other = POSE 0 0 0 RPY 0 0 0\nFRAME pallet = POSE 900 0 100 RPY {} {} {}\n", rpy.x(),
                          rpy.y(), rpy.z()));
    ASSERT_TRUE(cell.serve(Service::GroupEnable));
    cell.in.service.point = 2;
    ASSERT_TRUE(cell.serve(Service::MoveJoints));
    const auto turned = [&] {
      return from_rpy(Vec3(cell.out.orientation[0], cell.out.orientation[1], cell.out.orientation[2]) * (kPi / 180));
    };
    const Vec3 from = tip(cell);
    const Quat before = turned();
    const auto direction = static_cast<std::size_t>(k % 6);
    cell.in.jog.enabled = true;
    cell.in.jog.frame = JogFrame::Work;
    cell.in.jog.speed[direction] = k < 6 ? 40 : -40;
    for (int i = 0; i < 60; ++i) {
      cell.step();
    }
    EXPECT_LT((tip(cell) - from).norm(), 1e-9) << "no frame of that name";
    cell.in.jog.work = "pallet";
    for (int i = 0; i < 60; ++i) {
      cell.step();
    }
    const Vec3 axis =
        from_rpy(rpy * (kPi / 180)) * Vec3::Unit(static_cast<Eigen::Index>(direction % 3)) * (k < 6 ? 1 : -1);
    const Vec3 moved = direction < 3 ? Vec3(tip(cell) - from) : Vec3(rotation_between(before, turned()));
    const Vec3 by = direction < 3 ? moved : Vec3(before * moved);
    ASSERT_GT(by.norm(), 0.01) << k;
    EXPECT_LT((by.normalized() - axis).norm(), 1e-4) << k;
    if (direction >= 3) {
      EXPECT_LT((tip(cell) - from).norm(), 1e-6);
    }
  }
}

// The motion starts as soon at 1 % as at 100 % after a button is pressed, and continues for as long as it is requested.
TEST(Jog, Begins_soon_at_any_speed_and_goes_on) {
  for (const double speed : {1.0, 5.0, 100.0}) {
    for (const std::size_t direction : {std::size_t{0}, std::size_t{2}, std::size_t{5}}) {
      Cell cell;
      ASSERT_TRUE(cell.serve(Service::GroupEnable));
      cell.in.service.point = 2;
      ASSERT_TRUE(cell.serve(Service::MoveJoints));
      double way = 0;  // deg, of all axes
      const auto go = [&] {
        const auto before = cell.out.joints;
        cell.step();
        for (std::size_t i = 0; i < before.size(); ++i) {
          way += std::abs(cell.out.joints[i] - before[i]);
        }
      };
      cell.in.jog.enabled = true;
      cell.in.jog.frame = JogFrame::Base;
      cell.in.jog.speed[direction] = speed;
      for (int i = 0; i < 50 && way < 1e-3; ++i) {
        go();
      }
      EXPECT_GE(way, 1e-3) << "half a second at " << speed << " % of direction " << direction;
      // For two times what is planned at once; faster ones come to the end of their reach.
      for (int i = 0; i < 1600 && speed < 100; ++i) {
        const double before = way;
        for (int k = 0; k < 100; ++k, ++i) {
          go();
        }
        EXPECT_GT(way, before) << "second " << i / 100 << " at " << speed << " % of direction " << direction;
      }
    }
  }
}

// A hand that is far away, at random: pressed or not, its beats lost for random times. What the switch says is compared
// with its rule, read off the whole history.
TEST(Jog, A_switch_whose_beat_stops_counts_as_released_until_it_was_released) {
  constexpr double kStep = 0.01;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    std::mt19937 random(seed);
    EnablingSwitch sut;
    std::vector<bool> pressed;
    std::vector<std::uint32_t> beats;
    std::uint32_t beat = 7;
    int silent = 0;
    bool hand = random() % 2 == 0;
    for (int i = 0; i < 2000; ++i) {
      hand = random() % 40 == 0 ? !hand : hand;
      silent = silent > 0 ? silent - 1 : random() % 60 == 0 ? static_cast<int>(random() % 60) : 0;
      beat += silent == 0 && i % 5 == 0 ? 1U : 0U;
      pressed.push_back(hand);
      beats.push_back(beat);
      // Since it was pressed last (a hand that was there from the beginning never counts), no 0.3 s without a beat.
      bool expected = hand;
      for (int k = i; expected && pressed[static_cast<std::size_t>(k)]; --k) {
        int same = k;
        while (same > 0 && beats[static_cast<std::size_t>(same - 1)] == beats[static_cast<std::size_t>(k)]) {
          --same;
        }
        expected = k > 0 && (k - same) * kStep <= EnablingSwitch::kPatience + 1e-9;
      }
      ASSERT_EQ(sut.holds(hand, beat, kStep), expected) << "seed " << seed << ", period " << i;
    }
  }
}

TEST(Jog, A_switch_that_is_pressed_from_the_beginning_has_to_be_released_first) {
  constexpr double kStep = 0.01;
  EnablingSwitch sut;
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(sut.holds(true, 0, kStep));
  }
  EXPECT_FALSE(sut.holds(false, 0, kStep));
  EXPECT_TRUE(sut.holds(true, 0, kStep));
  EXPECT_TRUE(sut.holds(true, 0, 10)) << "a local switch needs no beat";
}

TEST(Jog, Rests_when_the_beat_of_a_far_hand_stops) {
  Cell cell;
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.point = 2;
  ASSERT_TRUE(cell.serve(Service::MoveJoints));
  cell.in.jog.frame = JogFrame::Base;
  cell.in.jog.speed[2] = 50;
  cell.in.jog.enabled = true;
  cell.in.jog.beat = 1;
  ASSERT_TRUE(cell.until([&] {
    ++cell.in.jog.beat;
    return cell.out.tool_speed > 120;
  }));
  ASSERT_TRUE(cell.until([&] { return stands(cell); }, 130)) << "within 0.3 s and its braking time";
  for (int i = 0; i < 100; ++i) {
    ++cell.in.jog.beat;
    cell.step();
    ASSERT_TRUE(stands(cell)) << "it was not released";
  }
  cell.in.jog.enabled = false;
  cell.step();
  cell.in.jog.enabled = true;
  EXPECT_TRUE(cell.until([&] {
    ++cell.in.jog.beat;
    return cell.out.tool_speed > 120;
  }));
}

// Otherwise a stop would last only until the robot is at rest, and a reset would move it.
TEST(Jog, A_switch_counts_no_more_after_something_else_has_stopped_the_robot) {
  using Act = void (*)(Cell&);
  struct Stop {
    Act begin;
    Act end;
  };
  const auto no_act = [](Cell& /*cell*/) {};
  const Act enable = [](Cell& cell) { ASSERT_TRUE(cell.serve(Service::GroupEnable)); };
  const std::vector<Stop> stops{
      {[](Cell& cell) { cell.ask(Service::Stop); }, no_act},
      {[](Cell& cell) { cell.ask(Service::GroupDisable); }, enable},
      {[](Cell& cell) { cell.in.mode.mode = OperatingMode::Automatic; },
       [](Cell& cell) { cell.in.mode.mode = OperatingMode::Any; }},
      {[](Cell& cell) { cell.in.emergency = true; },
       [](Cell& cell) {
         cell.in.emergency = false;
         ASSERT_TRUE(cell.serve(Service::GroupReset));
         ASSERT_TRUE(cell.out.state == GroupState::Standby || cell.serve(Service::GroupEnable));
       }},
  };
  for (std::size_t i = 0; i < stops.size(); ++i) {
    Cell cell;
    ASSERT_TRUE(cell.serve(Service::GroupEnable));
    cell.in.jog.enabled = true;
    cell.in.jog.frame = JogFrame::Joint;
    cell.in.jog.speed[0] = 50;
    ASSERT_TRUE(cell.until([&] { return cell.out.speed[0] > 5; })) << i;
    stops[i].begin(cell);
    ASSERT_TRUE(cell.until([&] { return cell.out.speed[0] == 0; })) << i;
    stops[i].end(cell);
    ASSERT_TRUE(cell.until([&] { return stands(cell); })) << i;
    EXPECT_FALSE(cell.until([&] { return cell.out.speed[0] != 0; }, 300)) << i;
    cell.in.jog.enabled = false;
    cell.step();
    cell.in.jog.enabled = true;
    EXPECT_TRUE(cell.until([&] { return cell.out.speed[0] > 5; })) << i;
    cell.in.jog.enabled = false;
    cell.step();
    cell.in.jog.enabled = true;
    EXPECT_TRUE(cell.until([&] { return stands(cell); }) && cell.until([&] { return cell.out.speed[0] > 5; }))
        << i << ": pressed again while it comes to rest";
  }
}

TEST(Jog, An_axis_comes_to_its_limit_and_rests_there) {
  Cell cell;
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.jog.enabled = true;
  cell.in.jog.speed[4] = 100;
  const double limit = degrees(cell_arm().axis(4).upper);
  ASSERT_TRUE(cell.until([&] { return std::abs(cell.out.command[4] - limit) < 1e-6; }, 20'000));
  cell.in.jog.enabled = false;
  EXPECT_TRUE(cell.until([&] { return stands(cell); }, 100));
}

}  // namespace
}  // namespace indurop::robot
