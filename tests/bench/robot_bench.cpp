// SPDX-License-Identifier: Apache-2.0
// What the robot task costs per period: kinematics both ways, one step along a blended path of lines and joint motions,
// and the whole controller. The target is 20 us for kinematics and profile of six axes.

#include <benchmark/benchmark.h>
#include <indurop/robot/controller.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <thread>
#include <vector>

#include "control/robot/files/urdf.h"
#include "control/robot/path/chain.h"
#include "control/robot/path/follower.h"
#include "control/robot/plan/planner.h"

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
  return joints_of({0.1, 0.2, 0.1, 0.3, 0.8, 0.2});
}

JointLimits limits() {
  JointLimits all;
  all.velocity.head<6>() << 3.49, 3.49, 3.49, 6.98, 6.98, 8.72;
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
  Follower follower(places, limits());
  follower.reset(somewhere());
  const Vec3 corners[] = {{0.5, -0.2, 0.3}, {0.5, -0.2, 0.5}, {0.5, 0.2, 0.5}};
  std::size_t next = 0;
  bool planning = false;
  Segment before;
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
      follower.add(planner.segment(), follower.idle() ? Blend{} : planner.blend(before, planner.segment()));
      before = planner.segment();
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
  Follower follower(places, limits());
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

// All of a path of many short lines: 200 chords of a spiral, 0.6 m in all.
void planning_of_200_lines(benchmark::State& state) {
  const Inverse inverse(arm());
  const Places places(arm(), inverse);
  const auto planner = std::make_unique<Planner>(places, limits(), ToolLimits{1, 4, 40, kPi, 4 * kPi, 40 * kPi});
  const auto chain = std::make_unique<Chain>();
  for (auto _ : state) {
    Pose pose = arm().forward(somewhere());
    const Vec3 center = pose.position - Vec3(0.1, 0, 0);
    chain->begin(pose, {1, 4, 40, kPi, 4 * kPi, 40 * kPi});
    for (int i = 1; i <= 200; ++i) {
      const double angle = 0.03 * i;
      pose.position = center + (0.1 - 1e-4 * i) * Vec3(std::cos(angle), std::sin(angle), 0);
      chain->add({pose, 0.005, 1, 0, i});
    }
    chain->finish();
    Fault fault = planner->begin(*chain, somewhere());
    while (fault.ok() && !planner->done()) {
      fault = planner->check(64);
    }
    if (!fault.ok()) {
      state.SkipWithError("the path cannot be planned");
    }
  }
}

class NoSignals final : public Signals {
 public:
  double read(std::size_t) noexcept override { return 0; }
  void write(std::size_t, double) noexcept override {}
};

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// A controller that runs a job of all kinds of motions in periods of 1 ms, planning in the background; the times of its
// steps by the clock of its thread.
void controller_steps(benchmark::State& state) {
  const auto job = std::filesystem::temp_directory_path() / "robot_bench.job";
  std::ofstream(job) << "POINT A = JOINT 20 10 -20 0 60 0\nPOINT B = POSE 500 100 400 RPY 180 0 180\n"
                        "POINT C = POSE 500 -100 500 RPY 180 0 180\nPOINT D = POSE 450 0 450 RPY 180 0 180\n"
                        "LOOP\nZONE 50\nMOVJ A\nMOVL B\nMOVL C\nZONE 0\nMOVL D\nMOVC B C\nEND\n";
  Settings settings;
  settings.urdf = ROBOT_URDF;
  settings.jobs = {job.string()};
  settings.period = std::chrono::milliseconds(1);
  std::vector<std::string> errors;
  const auto sut = Controller::load(settings, errors);
  NoSignals signals;
  Inputs in;
  Outputs out;
  std::vector<double> took;
  auto next = std::chrono::steady_clock::now();
  for (auto _ : state) {
    for (int i = 0; i < 12000; ++i) {
      const double before = thread_seconds();
      sut->step(in, signals, out);
      took.push_back(1e6 * (thread_seconds() - before));
      for (std::size_t k = 0; k < kJoints; ++k) {
        in.drives[k] = {0, 0x27, out.drives[k].mode, out.drives[k].position};
      }
      if (i == 2 || i == 10) {
        in.service.code = static_cast<std::int32_t>(i == 2 ? Service::GroupEnable : Service::JobStart);
        in.service.job = 1;
        ++in.service.number;
      }
      in.speed_override = i % 2000 < 300 ? 30 : 100;
      in.hold = i % 3000 > 2700;
      next += settings.period;
      std::this_thread::sleep_until(next);
    }
  }
  if (out.job.state == JobState::Failed) {
    state.SkipWithError(out.job.message);
  }
  std::sort(took.begin(), took.end());
  const auto part = [&](double p) { return took[static_cast<std::size_t>(p * static_cast<double>(took.size() - 1))]; };
  state.counters["us_median"] = part(0.5);
  state.counters["us_p99"] = part(0.99);
  state.counters["us_p999"] = part(0.999);
  state.counters["us_most"] = part(1);
  std::filesystem::remove(job);
}

BENCHMARK(forward);
BENCHMARK(inverse_all_solutions);
BENCHMARK(inverse_numeric);
BENCHMARK(profile_planned);
BENCHMARK(step_along_a_path);
BENCHMARK(emergency_stop_on_a_line);
BENCHMARK(planning_of_200_lines);
BENCHMARK(controller_steps)->Iterations(1);

}  // namespace

BENCHMARK_MAIN();
