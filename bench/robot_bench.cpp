// SPDX-License-Identifier: Apache-2.0
// What the robot task costs per period: kinematics both ways, one step along a blended path of lines and joint motions,
// and the whole controller. The target is 20 us for kinematics and profile of six axes.

#include <benchmark/benchmark.h>

#include <fstream>
#include <iterator>

#include "robot/follower.h"
#include "robot/urdf.h"

namespace {

using namespace indurop::robot;

const Arm& arm() {
  static const Arm kArm = [] {
    std::ifstream file(ROBOT_URDF);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    return arm_from_urdf(ROBOT_URDF, text).value().arm;
  }();
  return kArm;
}

Joints somewhere() {
  Joints q;
  q << 0.1, 0.2, 0.1, 0.3, 0.8, 0.2;
  return q;
}

JointLimits limits() {
  JointLimits all;
  all.velocity << 3.49, 3.49, 3.49, 6.98, 6.98, 8.72;
  all.acceleration = all.velocity / 0.25;
  all.jerk = all.acceleration / 0.1;
  return all;
}

void forward(benchmark::State& state) {
  Joints q = somewhere();
  for (auto _ : state) {
    benchmark::DoNotOptimize(arm().forward(q));
    q[0] += 1e-9;
  }
}
void inverse_all_solutions(benchmark::State& state) {
  const Inverse inverse(arm());
  const Pose pose = arm().forward(somewhere());
  for (auto _ : state) {
    benchmark::DoNotOptimize(inverse.all(pose, somewhere()));
  }
}
void inverse_numeric(benchmark::State& state) {
  const Pose pose = arm().forward(somewhere());
  Joints near = somewhere();
  near.array() += 0.01;
  for (auto _ : state) {
    benchmark::DoNotOptimize(solve_numerically(arm(), pose, near));
  }
}
void profile_planned(benchmark::State& state) {
  double length = 0.3;
  for (auto _ : state) {
    benchmark::DoNotOptimize(Profile::to_position({0, 0.1, 0.5}, length, 0, {1, 4, 40}));
    length += 1e-9;
  }
}

// Line up, line across with a blend, joint motion back, over and over; planning of the paths included.
void step_along_a_path(benchmark::State& state) {
  const Inverse inverse(arm());
  const Places places(arm(), inverse);
  Planner planner(places, limits(), {1, 4, 40, kPi, 4 * kPi, 40 * kPi});
  Follower follower(places, planner);
  follower.reset(somewhere());
  const Vec3 corners[] = {{0.5, -0.2, 0.3}, {0.5, -0.2, 0.5}, {0.5, 0.2, 0.5}};
  std::size_t next = 0;
  bool planning = false;
  for (auto _ : state) {
    if (!planning && follower.has_room()) {
      MoveCommand command;
      command.move = next == 0 ? Move::Joint : Move::Line;
      command.target.is_pose = true;
      command.target.pose = {corners[next], from_rpy({kPi, 0, kPi})};
      command.zone = 0.05;
      planning = planner.begin(command, follower.end()).ok();
      next = (next + 1) % 3;
    }
    if (planning && planner.check(8).ok() && planner.done()) {
      follower.add(planner.segment());
      planning = false;
    }
    if (!follower.step(0.001).ok()) {
      state.SkipWithError("the path cannot be followed");
    }
    benchmark::DoNotOptimize(follower.joints());
  }
}

// All steps of emergency stops in the middle of a fast line.
void emergency_stop_on_a_line(benchmark::State& state) {
  const Inverse inverse(arm());
  const Places places(arm(), inverse);
  Planner planner(places, limits(), {1, 4, 40, kPi, 4 * kPi, 40 * kPi});
  Follower follower(places, planner);
  MoveCommand command;
  command.move = Move::Line;
  command.target.is_pose = true;
  command.target.pose = arm().forward(somewhere());
  command.target.pose.position += Vec3(-0.1, 0.5, -0.1);
  if (!planner.begin(command, somewhere()).ok() || !planner.check(10000).ok() || !planner.done()) {
    state.SkipWithError("the line cannot be planned");
  }
  for (auto _ : state) {
    if (follower.idle()) {
      state.PauseTiming();
      follower.reset(somewhere());
      follower.add(planner.segment());
      while (follower.speed() < 0.3 && follower.step(0.001).ok()) {
      }
      follower.stop_hard(1.5);
      state.ResumeTiming();
    }
    benchmark::DoNotOptimize(follower.step(0.001));
  }
}

BENCHMARK(forward);
BENCHMARK(inverse_all_solutions);
BENCHMARK(inverse_numeric);
BENCHMARK(profile_planned);
BENCHMARK(step_along_a_path);
BENCHMARK(emergency_stop_on_a_line);

}  // namespace

BENCHMARK_MAIN();
