// SPDX-License-Identifier: Apache-2.0
// Arms for tests of faults: each one as URDF text for the robot, and as a chain of orocos-kdl that is made of the same
// numbers without the robot's code.

#pragma once

#include <kdl/chainfksolverpos_recursive.hpp>
#include <random>
#include <string>
#include <vector>

#include "command_cell.h"

namespace indurop::robot {

struct ArmSpec {
  struct Part {
    std::array<double, 3> place{}, turn{};  // m, rad: roll pitch yaw
    std::array<double, 3> axis{};
    double lower = -kPi, upper = kPi, velocity = 3;
    bool slides = false;
  };
  std::string name;
  std::vector<Part> parts;
  std::array<double, 3> end{}, end_turn{};  // of tool0, behind the last part
  int elbow = 2;                            // the axis that stretches the arm, at this value
  double stretched = 0;
  std::vector<double> start;  // rad or m, a place to begin near

  [[nodiscard]] std::string urdf() const;
  friend void PrintTo(const ArmSpec& spec, std::ostream* out) { *out << spec.name; }
};

// As a job writes it, of radians and metres.
std::string joints_text(const ArmSpec& spec, const std::vector<double>& q);
ArmSpec cell_spec();
ArmSpec irb4600_spec();
ArmSpec scara_spec();
ArmSpec xarm6_spec();
ArmSpec panda_spec();
ArmSpec random_spec(std::mt19937& random);

// Where the arm's end and the tip of a tool are.
class KdlPlaces {
 public:
  KdlPlaces(const ArmSpec& spec, const KDL::Frame& tool);
  struct Place {
    KDL::Vector end, tip;
  };
  // Axes in degrees or mm.
  [[nodiscard]] Place at(const AxisNumbers& axes);
  [[nodiscard]] static double apart(const Place& one, const Place& other) {
    return std::max((one.end - other.end).Norm(), (one.tip - other.tip).Norm());
  }

 private:
  std::vector<bool> slides_;
  KDL::Chain chain_;
  KDL::Frame tool_;
};

}  // namespace indurop::robot
