// SPDX-License-Identifier: Apache-2.0
// What pushes against the arm is noticed, and nothing else is. The plant is orocos-kdl: what the drives measure is the
// torque that it computes for how the arm has moved, and for what it really holds, rounded as drives do.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <array>

#include "group_cell.h"
#include "heavy_jobs.h"

namespace indurop::robot {
namespace {

using testing::HasSubstr;

constexpr double kPeriod = 0.004;

const std::vector<double> kRated{400, 400, 200, 60, 50, 30};
const std::vector<double> kLimit{25, 25, 20, 8, 8, 5};

Settings watching() {
  Settings settings;
  settings.rated_torque = kRated;
  settings.collision_limit = kLimit;
  return settings;
}

class Plant {
 public:
  Plant(HeavyArm heavy, const std::string& job, const Body& held)
      : cell(job, 1000 * kPeriod, 0, true, watching(), heavy.urdf), arm_(std::move(heavy)), held_(held) {}

  void step() {
    cell.step();
    seen_ = {seen_[1], seen_[2], Joints::Zero()};
    for (int i = 0; i < 6; ++i) {
      seen_[2][i] = 2 * kPi * cell.in.drives[static_cast<std::size_t>(i)].position / 1'320'000;
    }
    const Joints velocity = (seen_[2] - seen_[1]) / kPeriod;
    const Joints acceleration = (seen_[2] - 2 * seen_[1] + seen_[0]) / (kPeriod * kPeriod);
    const Joints torque = kdl_torques(arm_, held_, seen_[2], velocity, acceleration) + push;
    for (int i = 0; i < 6; ++i) {
      const auto k = static_cast<std::size_t>(i);
      cell.in.drives[k].torque = static_cast<std::int16_t>(std::clamp(1000 * torque[i] / kRated[k], -3000.0, 3000.0));
    }
  }
  [[nodiscard]] bool enable() {
    cell.ask(Service::GroupEnable);
    for (int i = 0; i < 200; ++i) {
      step();
    }
    return cell.out.state == GroupState::Standby;
  }
  void start() {
    cell.in.service.job = 1;
    cell.ask(Service::JobStart);
    step();
    step();
  }

  Cell cell;
  Joints push = Joints::Zero();

 private:
  HeavyArm arm_;
  Body held_;
  std::array<Joints, 3> seen_{Joints::Zero(), Joints::Zero(), Joints::Zero()};
};

// Nothing is held until the job says it; at the beginning the arm holds nothing.
TEST(Contact, Random_jobs_are_not_stopped_and_pushes_are_noticed) {
  const HeavyArm heavy = heavy_cell_arm(efforts());
  const Arm arm = arm_from_urdf("", heavy.urdf)->arm;
  std::mt19937 random(9);
  int noticed = 0;
  int slowest = 0;
  int ended = 0;
  for (int i = 0; i < 12; ++i) {
    std::string job = random_job(random, arm);
    job.erase(job.find(kLoad), std::string(kLoad).size());
    Plant plant(heavy, job, {});
    ASSERT_TRUE(plant.enable());
    plant.start();
    const bool pushes = i % 2 == 1;
    const int when = 100 + static_cast<int>(random() % 200);
    const int axis = static_cast<int>(random() % 6);
    int since = -1;
    for (int k = 0; k < 20000 && plant.cell.out.job.state == JobState::Runs; ++k) {
      if (pushes && k == when) {
        plant.push[axis] = (random() % 2 == 0 ? 2.5 : -2.5) * kLimit[static_cast<std::size_t>(axis)];
        since = k;
      }
      plant.step();
      if (plant.cell.out.error == ErrorCode::Contact) {
        ASSERT_GE(since, 0) << "nothing pushed: " << plant.cell.out.job.message << "\n" << job;
        EXPECT_EQ(plant.cell.out.error_axis, static_cast<std::uint32_t>(axis) + 1);
        slowest = std::max(slowest, k - since);
        ++noticed;
        break;
      }
    }
    ended += !pushes && plant.cell.out.error != ErrorCode::Contact ? 1 : 0;
  }
  fmt::print("{} of 6 pushes noticed, within {} ms; {} of 6 without one not stopped\n", noticed,
             1000 * kPeriod * slowest, ended);
  EXPECT_EQ(noticed, 6);
  EXPECT_EQ(ended, 6);
  EXPECT_LE(1000 * kPeriod * slowest, 60);
}

TEST(Contact, It_stops_on_the_path_and_is_reset_as_others) {
  const HeavyArm heavy = heavy_cell_arm(efforts());
  const std::string job = point("A", joints_of({0, 0.3, -0.5, 0, 0.9, 0})) +
                          point("B", joints_of({1.5, 0.3, -0.5, 0, 0.9, 0})) + "SPEED 30%\nLOOP\nMOVJ A\nMOVJ B\nEND\n";
  Plant plant(heavy, job, {});
  ASSERT_TRUE(plant.enable());
  plant.start();
  for (int i = 0; i < 300; ++i) {
    plant.step();
  }
  plant.push[1] = -60;
  for (int i = 0; i < 300 && plant.cell.out.state != GroupState::ErrorStop; ++i) {
    plant.step();
  }
  ASSERT_EQ(plant.cell.out.state, GroupState::ErrorStop);
  EXPECT_EQ(plant.cell.out.error, ErrorCode::Contact);
  EXPECT_EQ(plant.cell.out.error_axis, 2U);
  EXPECT_THAT(plant.cell.out.job.message, HasSubstr("pushes against axis 2 with at least "));
  plant.push.setZero();
  for (int i = 0; i < 100; ++i) {
    plant.step();
  }
  plant.cell.ask(Service::GroupReset);
  for (int i = 0; i < 300; ++i) {
    plant.step();
  }
  EXPECT_EQ(plant.cell.out.error, ErrorCode::Ok);
  EXPECT_EQ(plant.cell.out.state, GroupState::Standby);
}

// A push that stays is known after a reset: the arm may be moved away from it. A harder one stops it again.
TEST(Contact, After_a_reset_only_more_than_what_pushes_then_counts) {
  Plant plant(heavy_cell_arm(efforts()), point("A", joints_of({0, 0.3, -0.5, 0, 0.9, 0})) + "MOVJ A\n", {});
  ASSERT_TRUE(plant.enable());
  const auto run = [&](double push, Service service) {
    plant.push[1] = push;
    plant.cell.ask(service);
    for (int i = 0; i < 300; ++i) {
      plant.step();
    }
    return plant.cell.out.error;
  };
  EXPECT_EQ(run(-40, Service::None), ErrorCode::Contact);
  EXPECT_EQ(run(-40, Service::GroupReset), ErrorCode::Ok);
  EXPECT_EQ(run(-60, Service::None), ErrorCode::Ok);  // not beyond 40 and the limit
  EXPECT_EQ(run(-70, Service::None), ErrorCode::Contact);
  EXPECT_EQ(run(-70, Service::GroupReset), ErrorCode::Ok);
  EXPECT_EQ(run(0, Service::None), ErrorCode::Ok);  // gone: the limit counts again
  EXPECT_EQ(run(-40, Service::None), ErrorCode::Contact);
}

// What is laid down or taken comes without a step of torque.
TEST(Contact, Another_load_is_applied_gradually) {
  const std::string job = point("A", joints_of({0, 0.9, -0.9, 0, 0.9, 0})) + "MOVJ A\n" + kLoad + "WAIT 0.5s\n";
  Plant plant(heavy_cell_arm(efforts()), job, {});
  ASSERT_TRUE(plant.enable());
  plant.start();
  double most = 0;
  int before = plant.cell.out.drives[1].torque_offset;
  const int first = before;
  for (int i = 0; i < 600; ++i) {
    plant.step();
    const int now = plant.cell.out.drives[1].torque_offset;
    most = std::max(most, std::abs(now - before) * kRated[1] / 1000);
    before = now;
  }
  EXPECT_GT(std::abs(before - first) * kRated[1] / 1000, 20);
  EXPECT_LT(most, 5);
}

TEST(Contact, A_load_that_was_not_declared_is_noticed) {
  const HeavyArm heavy = heavy_cell_arm(efforts());
  const std::string points = point("A", joints_of({0, 0.9, -0.9, 0, 0.9, 0}));
  for (const bool declared : {true, false}) {
    Plant plant(heavy, points + (declared ? kLoad : "") + "MOVJ A\n", kHeld);
    plant.cell.in.service.job = 1;
    plant.cell.ask(Service::GroupEnable);
    for (int i = 0; i < 20; ++i) {
      plant.step();
    }
    plant.start();
    for (int i = 0; i < 1500; ++i) {
      plant.step();
    }
    EXPECT_EQ(plant.cell.out.error, declared ? ErrorCode::Ok : ErrorCode::Contact) << plant.cell.out.job.message;
  }
}

// The feed-forward is what the arm needs, by KDL, of the rated torque.
TEST(Contact, Drives_get_the_torque_that_the_motion_needs) {
  const HeavyArm heavy = heavy_cell_arm(efforts());
  const std::string job = point("A", joints_of({1, 0.9, -0.9, 1, 0.9, 2})) + "MOVJ A\n";
  Plant plant(heavy, job, {});
  EXPECT_EQ(plant.cell.out.drives[1].torque_offset, 0);
  ASSERT_TRUE(plant.enable());
  plant.start();
  std::array<Joints, 3> seen{Joints::Zero(), Joints::Zero(), Joints::Zero()};
  Joints commanded = Joints::Zero();
  double worst = 0;
  for (int i = 0; i < 400; ++i) {
    plant.step();
    seen = {seen[1], seen[2], Joints::Zero()};
    for (int k = 0; k < 6; ++k) {
      seen[2][k] = radians(plant.cell.out.command[static_cast<std::size_t>(k)]);
    }
    if (i > 3) {  // what was commanded for the previous instant
      const Joints needed = kdl_torques(heavy, {}, seen[1], (seen[2] - seen[0]) / (2 * kPeriod),
                                        (seen[2] - 2 * seen[1] + seen[0]) / (kPeriod * kPeriod));
      for (int k = 0; k < 6; ++k) {
        worst = std::max(worst, std::abs(commanded[k] - needed[k]) / kRated[static_cast<std::size_t>(k)]);
      }
    }
    for (int k = 0; k < 6; ++k) {
      const auto j = static_cast<std::size_t>(k);
      commanded[k] = plant.cell.out.drives[j].torque_offset * kRated[j] / 1000;
    }
  }
  EXPECT_LT(worst, 0.03);
}

TEST(Contact, Wrong_properties_are_errors) {
  const auto said = [](const Settings& settings, const std::string& urdf) {
    try {
      controller_of(urdf, "", settings);
      return std::string();
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
  };
  const HeavyArm heavy = heavy_cell_arm(efforts());
  EXPECT_EQ(said(watching(), heavy.urdf), "");
  EXPECT_THAT(said(watching(), cell_urdf()),
              HasSubstr("collision_limit: error: the URDF does not say what the arm weighs"));
  Settings settings = watching();
  settings.rated_torque.clear();
  EXPECT_THAT(said(settings, heavy.urdf), HasSubstr("collision_limit: error: what drives measure counts in parts of"));
  settings = watching();
  settings.collision_limit.pop_back();
  EXPECT_THAT(said(settings, heavy.urdf), HasSubstr("collision_limit: error: it has to be 6 numbers above 0"));
}

}  // namespace
}  // namespace indurop::robot
