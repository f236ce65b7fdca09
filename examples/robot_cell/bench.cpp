// SPDX-License-Identifier: Apache-2.0
// The bench with its parts and its stack, simulated: it moves with the drives, and answers as inputs of the robot. O8
// closes the gripper, O9 opens it; I4: it holds something, I5: it is open, I8: its sensor sees a piece below it.
#include <indurop/indurop.h>

#include <indurop/generated.h>

#include <array>
#include <chrono>

#include "bench_world.h"

using namespace PLC_ROBOT;

namespace {

constexpr double kDegreesPerCount = 360.0 / 1'320'000;

BenchWorld world;
BenchWorld::Scene scene{};
bool laid_out = false;
double period = 0;

bool same(const BenchWorld::Scene& a, const BenchWorld::Scene& b) {
  return a.seed == b.seed && a.parts == b.parts && a.others == b.others && a.pieces == b.pieces && a.snatch == b.snatch;
}

}  // namespace

void start() {
  period = std::chrono::duration<double>(irp::period()).count();
}

void run() {
  const BenchWorld::Scene wanted = BENCH::scene;
  if (!laid_out || !same(scene, wanted)) {
    scene = wanted;
    laid_out = true;
    world.lay_out(scene);
  }
  const std::array<double, 6> axes{AXIS1_IN.position * kDegreesPerCount, AXIS2_IN.position * kDegreesPerCount,
                                   AXIS3_IN.position * kDegreesPerCount, AXIS4_IN.position * kDegreesPerCount,
                                   AXIS5_IN.position * kDegreesPerCount, AXIS6_IN.position * kDegreesPerCount};
  world.step(period, {O8 != 0, O9 != 0}, arm_tip(axes));
  BENCH::part = world.parts();
  BENCH::piece = world.pieces();
  BENCH::truth = world.truth();
  I4 = world.holds() ? 1 : 0;
  I5 = world.is_open() ? 1 : 0;
  I8 = world.sees_piece() ? 1 : 0;
  I14 = 1;  // no person is near
  I15 = 1;
}

INDUROP_STATE(world, scene, laid_out)
INDUROP_MODULE(run = &::run, start = &::start, name = "bench", description = "parts, stack and gripper, simulated")
