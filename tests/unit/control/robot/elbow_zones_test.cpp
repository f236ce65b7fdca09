// SPDX-License-Identifier: Apache-2.0
// An arm with seven axes whose elbow moves next to a zone: a second opinion on what touches what sees it clear in every
// period. INDUROP_ROBOT_POSES says how many zones.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "group_cell.h"
#include "solid_reference.h"

namespace indurop::robot {
namespace {

ReferenceArm arm_of_seven() {
  using Kind = ReferenceSolid::Kind;
  ReferenceArm arm;
  const Vec3 along = Vec3::UnitZ();
  const Vec3 across = Vec3::UnitY();
  arm.joints = {{{0, 0, 0.36}, {}, along, false, -2.9, 2.9}, {{0, 0, 0}, {}, across, false, -2, 2},
                {{0, 0, 0.21}, {}, along, false, -2.9, 2.9}, {{0, 0, 0.21}, {}, -across, false, -2, 2},
                {{0, 0, 0.2}, {}, along, false, -2.9, 2.9},  {{0, 0, 0.2}, {}, across, false, -2, 2},
                {{0, 0, 0.08}, {}, along, false, -3, 3}};
  for (ReferenceArm::Joint& joint : arm.joints) {
    joint.rpy = Vec3::Zero();
  }
  arm.solids = {{Kind::Cylinder, {0.1, 0.2, 0}, {0, 0, 0.1}, {0, 0, 0}},
                {Kind::Ball, {0.08, 0, 0}, {0, 0, 0}, {0, 0, 0}},
                {Kind::Cylinder, {0.06, 0.16, 0}, {0, 0, 0.12}, {0, 0, 0}},
                {Kind::Cylinder, {0.06, 0.16, 0}, {0, 0, 0.1}, {0, 0, 0}},
                {Kind::Cylinder, {0.05, 0.16, 0}, {0, 0, 0.1}, {0, 0, 0}},
                {Kind::Cylinder, {0.05, 0.16, 0}, {0, 0, 0.1}, {0, 0, 0}},
                {Kind::Ball, {0.05, 0, 0}, {0, 0, 0}, {0, 0, 0}},
                {Kind::Cylinder, {0.03, 0.04, 0}, {0, 0, 0.02}, {0, 0, 0}}};
  arm.tool = {0, 0, 0.05};
  return arm;
}

TEST(ElbowZones, Are_kept_clear_of) {
  constexpr double kClear = 0.004;  // m, of the 5 that are kept
  std::mt19937 random(11);
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const ReferenceArm reference = arm_of_seven();
  const Arm arm = arm_from_urdf("arm.urdf", reference.urdf()).value().arm;
  const ReferenceSolid box{ReferenceSolid::Kind::Box, {0.1, 0.1, 0.1}, {0, 0, 0}, {0, 0, 0}};
  int moved = 0;
  int refused = 0;
  double least = HUGE_VAL;
  for (int i = 0; i < poses(60); ++i) {
    Joints q = Joints::Zero();
    q.head<7>() << in(-1, 1), in(0.2, 0.8), in(-1.5, 1.5), in(-1.6, -0.8), in(-1, 1), in(0.5, 1.2), in(-1, 1);
    const Vec3 elbow = reference.places(q)[4].frame.translation();
    std::vector<ReferencePlace> zones;
    Vec3 zone;
    do {
      zone = elbow + in(0.15, 0.4) * Vec3(in(-1, 1), in(-1, 1), in(-1, 1)).normalized();
      zones = {{&box, Eigen::Isometry3d(Eigen::Translation3d(zone))}};
    } while (reference.clearance(Joints::Zero(), zones) < 0.02);  // where it begins
    std::string job = "KEEPOUT zone = BOX";
    for (const double half : {-50.0, 50.0}) {
      job += fmt::format(" {} {} {}", 1000 * zone[0] + half, 1000 * zone[1] + half, 1000 * zone[2] + half);
    }
    job += "\nPOINT A = JOINT";
    for (int k = 0; k < 7; ++k) {
      job += fmt::format(" {}", degrees(q[k]));
    }
    job += fmt::format("\nMOVJ A\nMOVL HERE AXIS 3 {0}\nZONE 30 mm\nMOVL HERE OFFSET 0, {2}, 60 AXIS 3 {1}\nMOVL A\n",
                       degrees(q[2] + in(-1.2, 1.2)), degrees(q[2] + in(-1.2, 1.2)), in(-80, 80));
    Cell cell(job, 4, 0, true, Settings{}, reference.urdf());
    ASSERT_TRUE(cell.serve(Service::GroupEnable));
    cell.in.service.job = 1;
    cell.ask(Service::JobStart);
    double before = 0;
    bool moves = false;
    ASSERT_TRUE(cell.until(
        [&] {
          Joints now = Joints::Zero();
          for (int k = 0; k < 7; ++k) {
            now[k] = radians(cell.out.command[static_cast<std::size_t>(k)]);
          }
          moves = moves || (cell.out.job.line > 3 && std::abs(now[2] - before) > 0.1 * 0.004);
          before = now[2];
          least = cell.periods % 4 == 0 ? std::min(least, reference.clearance(now, zones)) : least;
          return cell.periods > 20 &&
                 (cell.out.job.state == JobState::Ended || cell.out.state == GroupState::ErrorStop);
        },
        20000));
    ASSERT_GT(least, kClear) << i << "\n" << job;
    moved += moves ? 1 : 0;
    refused += cell.out.error == ErrorCode::Collision ? 1 : 0;
  }
  fmt::print("the elbow moved next to {} of {} zones, and {} jobs ended with a collision ahead; {:.1f} mm at least\n",
             moved, poses(60), refused, 1000 * least);
  EXPECT_GT(moved, poses(60) / 4);
  EXPECT_GT(refused, poses(60) / 12);
}

}  // namespace
}  // namespace indurop::robot
