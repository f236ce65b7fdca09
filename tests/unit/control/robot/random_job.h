// SPDX-License-Identifier: Apache-2.0
// Jobs of random motions between random points of any arm.

#pragma once

#include <fmt/format.h>

#include <cmath>
#include <random>
#include <sstream>
#include <string>

#include "robot_fixture.h"

namespace indurop::robot {

struct RandomJob {
  std::string text;
  // Of all its points and of where the arm starts.
  Vec3 low = Vec3::Constant(HUGE_VAL), high = Vec3::Constant(-HUGE_VAL);
  void reach(const Vec3& place) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
};

inline std::string random_point(const Arm& arm, const Joints& q, int number, bool joints) {
  std::string text = fmt::format("POINT Q{} = ", number);
  if (joints) {
    text += "JOINT";
    for (int k = 0; k < arm.count(); ++k) {
      text += fmt::format(" {}", q[k] * (arm.axis(k).slides() ? 1000 : 180 / kPi));
    }
    return text + "\n";
  }
  const Pose pose = arm.forward(q);
  const Vec3 rpy = to_rpy(pose.orientation) * (180 / kPi);
  return text + fmt::format("POSE {} {} {} RPY {} {} {}\n", 1000 * pose.position[0], 1000 * pose.position[1],
                            1000 * pose.position[2], rpy[0], rpy[1], rpy[2]);
}

inline RandomJob random_job(const Arm& arm, std::mt19937& random) {
  constexpr double kSliding = 0.3;  // m per radian of the others
  RandomJob job;
  job.reach(arm.forward(Joints::Zero()).position);
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto one_of = [&](int many) { return std::uniform_int_distribution<int>(0, many - 1)(random); };
  std::string& text = job.text;
  Joints place = anywhere(arm, random, 0.1);
  // One in four has points so near to each other that lines become chains.
  const bool near = one_of(4) == 0;
  const double spread = near ? in(0.001, 0.02) : in(0.02, 1);
  const int points = near ? 20 + one_of(40) : 2 + one_of(5);
  for (int i = 0; i < points; ++i) {
    Joints q = place;
    for (int tries = 0; tries < 50; ++tries) {
      for (int k = 0; k < arm.count(); ++k) {
        q[k] = place[k] + (arm.axis(k).slides() ? kSliding : 1) * in(-spread, spread);
      }
      if (arm.beyond_limits(q) < 0) {
        break;
      }
      q = place;
    }
    job.reach(arm.forward(q).position);
    text += random_point(arm, q, i, one_of(2) == 0);
    place = q;
  }
  text += "MOVJ Q0\n";
  const int steps = near ? 60 : 8;
  for (int i = 0; i < steps; ++i) {
    const bool along = near && one_of(10) > 0;
    switch (along ? 5 : one_of(6)) {
      case 0:
        text += fmt::format("SPEED {}%\n", 1 + one_of(100));
        break;
      case 1:
        text += fmt::format("ZONE {} mm\n", one_of(3) * one_of(60));
        break;
      case 2:
        text += fmt::format("MOVJ Q{}\n", one_of(points));
        break;
      case 3:
        text += fmt::format("MOVC Q{} Q{}\n", one_of(points), one_of(points));
        break;
      default:
        text += fmt::format("MOVL Q{}\n", along ? i % points : one_of(points));
    }
  }
  return job;
}

// The same job with places that it computes, offsets that turn, settings on the lines of motions, and motions that end
// after a time.
inline RandomJob computing(RandomJob job, const Arm& arm, std::mt19937& random) {
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto small = [&] { return fmt::format("{:.3f}, {:.3f}, {:.3f}", in(-60, 60), in(-60, 60), in(-60, 60)); };
  const Joints somewhere = anywhere(arm, random, 0.1);
  job.reach(arm.forward(somewhere).position);
  std::string text = random_point(arm, somewhere, 1000, false) + "VAR a[3] = 10, -20, 30\nVAR i\n";
  std::istringstream lines(job.text);
  for (std::string line; std::getline(lines, line);) {
    const bool to_point = line.starts_with("MOVL Q") || line.starts_with("MOVJ Q");
    const std::string point = to_point ? line.substr(5) : "";
    switch (to_point ? std::uniform_int_distribution<int>(0, 9)(random) : -1) {
      case 0:
        line += fmt::format(" UNTIL TIME > {:.3f}", in(0, 4));
        break;
      case 1:
        text += fmt::format("MOVL {} UNTIL TIME > {:.3f} ACC {:.0f}%\nIF FOUND\n", point, in(0, 4), in(1, 100));
        line = "MOVL FOUND\nEND";
        break;
      case 2:
        text +=
            fmt::format("i = (i + 1) MOD 3\nQ1000 = {} : POSE {} RPY a[i], {:.3f}, 0\n", point, small(), in(-20, 20));
        line = "MOVL Q1000";
        break;
      case 3:
        line = fmt::format("MOVL HERE OFFSET TOOL {}", small());
        break;
      case 4:
        text += fmt::format("Q1000 = HERE : POSE {}\n", small());
        line = "MOVJ Q1000";
        break;
      case 5:
        line += fmt::format(" SPEED {:.0f}% ZONE {:.0f} mm", in(1, 100), in(0, 60));
        break;
      case 6:
        text += fmt::format("Q1000 = {}\n", point);
        line = fmt::format("MOVL Q1000 OFFSET {} RPY {:.3f}, 0, 0", small(), in(-20, 20));
        break;
      default:
        break;
    }
    text += line + "\n";
  }
  job.text = text;
  return job;
}

}  // namespace indurop::robot
