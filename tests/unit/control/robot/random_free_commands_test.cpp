// SPDX-License-Identifier: Apache-2.0
// Free motions by commands in random scenes: the set points are those of a job's MOVE FREE, to the last bit, and
// whatever ends a search or a motion leaves the arm clear by FCL's judgement and within its limits.
// INDUROP_ROBOT_SCENES says how many scenes, INDUROP_ROBOT_SEED from which one on.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "free_command_cell.h"
#include "robot_fixture.h"
#include "scene.h"

namespace indurop::robot {
namespace {

using Eight = std::array<double, 8>;

// What the drives get from the start of the motion to its end.
using SetPoints = std::vector<std::pair<AxisNumbers, std::array<std::int32_t, 6>>>;

void note(const Outputs& out, SetPoints& seen) {
  std::array<std::int32_t, 6> counts{};
  for (std::size_t i = 0; i < counts.size(); ++i) {
    counts[i] = out.drives[i].position;
  }
  if (seen.empty() || seen.back().first != out.command) {
    seen.emplace_back(out.command, counts);
  }
}

class Free_command_scenes : public Free_command {
 protected:
  using Free_command::begin;
  void begin(const Scene& scene, const std::string& more = "") {
    begin(scene.job() + more, numbers_of(scene.job(), "S"));
  }
  // The pose of the tip at these angles.
  static Eight pose_of(const Scene& scene, const Joints& q) {
    const Pose pose = arm_from_urdf("arm.urdf", scene.arm().urdf()).value().arm.forward(q);
    const Vec3 rpy = to_rpy(pose.orientation);
    Eight numbers{};
    for (int i = 0; i < 3; ++i) {
      numbers[at(i)] = std::round(1e6 * pose.position[i]) / 1e3;
      numbers[at(i + 3)] = std::round(1e3 * degrees(rpy[i])) / 1e3;
    }
    return numbers;
  }
  // One period, whose set point is judged by FCL and by the limits.
  void step_in(const Scene& scene) {
    step();
    const double room = scene.room(commanded(), 0.02);
    least_ = std::min(least_, room);
    ASSERT_GT(room, Scene::kMargin - 1e-3) << "period " << sut->cell.periods;
  }
  double least_ = 1;
};

TEST_F(Free_command_scenes, Has_the_set_points_of_a_job_to_the_last_bit) {
  const int scenes = number_of("INDUROP_ROBOT_SCENES", 12);
  const int first = number_of("INDUROP_ROBOT_SEED", 1);
  int found = 0;
  int by_pose = 0;
  for (int each = first; each < first + scenes && !HasFailure(); ++each) {
    const Scene scene(static_cast<unsigned>(each));
    SCOPED_TRACE(fmt::format("scene {}:\n{}", each, scene.job()));
    const bool pose = each % 2 == 0;
    const Eight to = pose ? pose_of(scene, scene.goal) : numbers_of(scene.job(), "G");
    const int percent = each % 3 == 0 ? 100 : 40 + each % 3 * 20;
    const std::string target =
        pose ? fmt::format("POINT T = POSE {} {} {} RPY {} {} {}\n", to[0], to[1], to[2], to[3], to[4], to[5])
             : "POINT T = G\n";
    const std::string move = fmt::format("MOVE FREE TO {} SEED {} SPEED {}%\n", pose ? "T" : "G", each % 4, percent);
    begin(scene, (pose ? target : "") + move);
    SetPoints of_job;
    sut->cell.in.service.job = 1;
    sut->cell.ask(Service::JobStart);
    for (int i = 0; i < 20000 && out().done != sut->cell.in.service.number; ++i) {
      step_in(scene);
      note(out(), of_job);
    }
    const ErrorCode job_error = out().error;
    begin(scene);
    SetPoints of_command;
    const Given given =
        free(to, each % 4, percent, BufferMode::Aborting, pose ? CoordSystem::Machine : CoordSystem::Axes);
    for (int i = 0; i < 20000 && !sut->ended(given); ++i) {
      step_in(scene);
      note(out(), of_command);
    }
    ASSERT_TRUE(of_command == of_job) << of_command.size() << " set points, " << of_job.size() << " of the job";
    ASSERT_EQ(sut->error(given), job_error);
    const bool good = sut->state(given) == CommandState::Done;
    found += good ? 1 : 0;
    by_pose += good && pose ? 1 : 0;
  }
  fmt::print("{} of {} ways found, {} of them to a pose; nearest {:.2f} mm\n", found, scenes, by_pose, 1000 * least_);
  EXPECT_GE(found, scenes * 9 / 10);
}

// What may happen to a search or a motion; afterwards, it is commanded again.
class Free_command_disturbed : public Free_command_scenes {
 protected:
  enum What { Stop, Halt, Interrupt, Hold, Override, Emergency, Disable, Again, Direct, Line, Behind, Count };

  void disturb(int what, const Scene& scene, std::mt19937& random) {
    const Eight start = numbers_of(scene.job(), "S");
    Cell& cell = sut->cell;
    switch (what) {
      case Stop:
        other_ = sut->give(Service::Stop);
        break;
      case Halt:
        other_ = sut->give(Service::Halt);
        break;
      case Interrupt:
        other_ = sut->give(Service::Interrupt);
        break;
      case Hold:
        cell.in.hold = true;
        break;
      case Override:
        cell.in.speed_override = static_cast<double>(random() % 100);
        break;
      case Emergency:
        cell.in.emergency = true;
        break;
      case Disable:
        other_ = sut->give(Service::GroupDisable);
        break;
      case Again:
        other_ = free(start, 9);
        break;
      case Direct:
        other_ = sut->give(Service::DirectAbsolute, start);
        break;
      case Line:
        other_ = sut->give(Service::LinearAbsolute, pose_of(scene, scene.start), 100, BufferMode::Aborting,
                           CoordSystem::Machine);
        break;
      case Behind:
        other_ = sut->give(Service::DirectAbsolute, start, 0, BufferMode::BlendingLow, CoordSystem::Axes, 50);
        break;
      default:
        break;
    }
  }
  // Back to Standby, wherever the arm is.
  void recover(const Scene& scene) {
    Cell& cell = sut->cell;
    cell.in.emergency = cell.in.hold = false;
    cell.in.speed_override = 100;
    if (sut->state(other_) != CommandState::None) {
      sut->command(other_).execute = 0;
    }
    Given helper{};
    for (int i = 0; i < 20000 && !HasFatalFailure(); ++i) {
      const bool waits = helper.number != 0 && !sut->ended(helper);
      if (!waits && out().state == GroupState::Standby) {
        return;
      }
      if (!waits && out().state == GroupState::ErrorStop) {
        helper = sut->give(Service::GroupReset);
      } else if (!waits && out().state == GroupState::Disabled) {
        helper = sut->give(Service::GroupEnable);
      } else if (!waits && out().state == GroupState::Moving && i % 1000 == 999) {
        helper = sut->give(Service::Halt);  // an interrupted motion does not end
      }
      step_in(scene);
    }
    FAIL() << "the group does not come to Standby";
  }

  Given other_{};
};

TEST_F(Free_command_disturbed, Leaves_the_arm_clear_and_within_its_limits) {
  const int scenes = number_of("INDUROP_ROBOT_SCENES", 12);
  const int first = number_of("INDUROP_ROBOT_SEED", 1);
  int arrived = 0;
  int searching = 0;
  int tried = 0;
  for (int each = first; each < first + scenes && !HasFailure(); ++each) {
    const Scene scene(static_cast<unsigned>(each));
    std::mt19937 random(static_cast<unsigned>(each));
    SCOPED_TRACE(fmt::format("scene {}:\n{}", each, scene.job()));
    begin(scene);
    const Eight goal = numbers_of(scene.job(), "G");
    for (int round = 0; round < 4 && !HasFailure(); ++round) {
      const int what = static_cast<int>(random() % Count);
      SCOPED_TRACE(fmt::format("round {}: {}", round, what));
      plans_are_ready() = random() % 3 != 0;
      const Given given = free(goal, round);
      for (int wait = 1 + static_cast<int>(random() % 400); wait > 0 && !sut->ended(given); --wait) {
        step_in(scene);
      }
      const bool at_rest = stands() && !sut->ended(given);
      const AxisNumbers before = out().command;
      ++tried;
      searching += at_rest ? 1 : 0;
      disturb(what, scene, random);
      for (int wait = 0; wait < 300 && !HasFatalFailure(); ++wait) {
        step_in(scene);
        if (at_rest && !plans_are_ready() && what <= Disable) {
          for (std::size_t i = 0; i < 6; ++i) {
            ASSERT_NEAR(out().command[i], before[i], 1e-3);  // nothing moves without a path
          }
        }
      }
      plans_are_ready() = true;
      recover(scene);
    }
    ASSERT_FALSE(HasFailure());
    const Given last = free(goal, 5);
    while (!sut->ended(last) && !HasFatalFailure()) {
      step_in(scene);
    }
    arrived += sut->state(last) == CommandState::Done ? 1 : 0;
  }
  fmt::print("{} of {} arrived at last; {} of {} disturbed while nothing moved; nearest {:.2f} mm\n", arrived, scenes,
             searching, tried, 1000 * least_);
  EXPECT_GE(arrived, scenes * 9 / 10);
}

}  // namespace
}  // namespace indurop::robot
