// SPDX-License-Identifier: Apache-2.0
#include "drive_faults.h"

#include <fmt/format.h>

namespace indurop::robot {

namespace {

constexpr std::array<double, 3> kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1}, kNone{};
constexpr double kQuarter = kPi / 2;

KDL::Vector vector(const std::array<double, 3>& v) {
  return {v[0], v[1], v[2]};
}

std::string numbers(const std::array<double, 3>& v) {
  return fmt::format("{} {} {}", v[0], v[1], v[2]);
}

// Six axes as those of the cell's arm: the elbow is stretched where the wrist is above the upper arm.
ArmSpec six_axes(const char* name, double height, double shoulder, double rise, double upper, double forward, double up,
                 double wrist, double flange, double sideways) {
  ArmSpec spec;
  spec.name = name;
  spec.parts = {{{0, 0, height}, kNone, kZ, -2.967, 2.967, 3.2}, {{shoulder, 0, rise}, kNone, kY, -1.57, 2.3, 3.1},
                {{0, 0, upper}, kNone, kY, -3.14, 1.2, 3.1},     {{forward, 0, up}, kNone, kX, -3.2, 3.2, 5.5},
                {{wrist, 0, 0}, kNone, kY, -2.09, 2.09, 5.5},    {{flange, sideways, 0}, kNone, kX, -6.2, 6.2, 7}};
  spec.end = {0.1, 0, 0};
  spec.end_turn = {0, kQuarter, 0};
  spec.stretched = -kQuarter - std::atan2(up, forward + wrist);
  spec.start = {0, 0.6, spec.stretched, 0, 0.8, 0};
  return spec;
}

}  // namespace

std::string ArmSpec::urdf() const {
  std::string text = "<robot name=\"" + name + "\"><link name=\"l0\"/>";
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Part& p = parts[i];
    text += fmt::format("<link name=\"l{}\"/>\n", i + 1);
    text += fmt::format("<joint name=\"j{}\" type=\"{}\"><parent link=\"l{}\"/><child link=\"l{}\"/>", i + 1,
                        p.slides ? "prismatic" : "revolute", i, i + 1);
    text += fmt::format("<origin xyz=\"{}\" rpy=\"{}\"/><axis xyz=\"{}\"/>", numbers(p.place), numbers(p.turn),
                        numbers(p.axis));
    text += fmt::format("<limit lower=\"{}\" upper=\"{}\" velocity=\"{}\" effort=\"0\"/></joint>\n", p.lower, p.upper,
                        p.velocity);
  }
  return text + fmt::format(
                    "<link name=\"tool0\"/><joint name=\"end\" type=\"fixed\"><parent link=\"l{}\"/><child "
                    "link=\"tool0\"/><origin xyz=\"{}\" rpy=\"{}\"/></joint></robot>\n",
                    parts.size(), numbers(end), numbers(end_turn));
}

std::string joints_text(const ArmSpec& spec, const std::vector<double>& q) {
  std::string text = "JOINT";
  for (std::size_t i = 0; i < q.size(); ++i) {
    text += fmt::format(" {}", q[i] * (spec.parts[i].slides ? 1000 : 180 / kPi));
  }
  return text;
}

ArmSpec cell_spec() {
  return six_axes("cell", 0.30, 0.07, 0.10, 0.47, 0.25, 0.05, 0.22, 0.09, 0);
}

ArmSpec irb4600_spec() {
  return six_axes("irb4600", 0.20, 0.175, 0.295, 0.9, 0.3, 0.175, 0.66, 0.035, 0);
}

ArmSpec random_spec(std::mt19937& random) {
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const double sideways = in(0, 1) < 0.3 ? in(0.03, 0.1) : 0;  // then its wrist has no one centre
  return six_axes("random", in(0.2, 0.6), in(0, 0.3), in(0, 0.3), in(0.3, 1.1), in(0.1, 0.5), in(-0.1, 0.2),
                  in(0.1, 0.7), in(0.03, 0.15), sideways);
}

ArmSpec scara_spec() {
  ArmSpec spec;
  spec.name = "scara";
  spec.parts = {{{0, 0, 0.387}, kNone, kZ, -2.3, 2.3, 6.5},
                {{0.325, 0, 0}, kNone, kZ, -2.5, 2.5, 10},
                {{0.275, 0, 0}, {kPi, 0, 0}, kZ, 0, 0.2, 1.1, true},
                {{0, 0, 0}, kNone, kZ, -6.2, 6.2, 20}};
  spec.end = {0, 0, 0.05};
  spec.elbow = 1;
  spec.start = {0, 0, 0.1, 0};
  return spec;
}

ArmSpec xarm6_spec() {
  ArmSpec spec;
  spec.name = "xarm6";
  spec.parts = {{{0, 0, 0.267}, kNone, kZ, -6.2, 6.2, 3.14},
                {{0, 0, 0}, {-kQuarter, 0, 0}, kZ, -2.05, 2.09, 3.14},
                {{0.053, -0.2845, 0}, kNone, kZ, -3.92, 0.19, 3.14},
                {{0.0775, 0.3425, 0}, {-kQuarter, 0, 0}, kZ, -6.2, 6.2, 3.14},
                {{0, 0, 0}, {kQuarter, 0, 0}, kZ, -1.69, 3.14, 3.14},
                {{0.076, 0.097, 0}, {-kQuarter, 0, 0}, kZ, -6.2, 6.2, 3.14}};
  spec.stretched = -2.735;
  spec.start = {0, 0.2, -2.735, 0, 0.7, 0};
  return spec;
}

ArmSpec panda_spec() {
  ArmSpec spec;
  spec.name = "panda";
  spec.parts = {{{0, 0, 0.333}, kNone, kZ, -2.89, 2.89, 2.175},
                {{0, 0, 0}, {-kQuarter, 0, 0}, kZ, -1.76, 1.76, 2.175},
                {{0, -0.316, 0}, {kQuarter, 0, 0}, kZ, -2.89, 2.89, 2.175},
                {{0.0825, 0, 0}, {kQuarter, 0, 0}, kZ, -3.07, -0.07, 2.175},
                {{-0.0825, 0.384, 0}, {-kQuarter, 0, 0}, kZ, -2.89, 2.89, 2.61},
                {{0, 0, 0}, {kQuarter, 0, 0}, kZ, -0.01, 3.75, 2.61},
                {{0.088, 0, 0}, {kQuarter, 0, 0}, kZ, -2.89, 2.89, 2.61}};
  spec.end = {0, 0, 0.107};
  spec.elbow = 3;
  spec.stretched = -0.466;
  spec.start = {0, 0.4, 0, -0.466, 0, 1.8, 0.7};
  return spec;
}

KdlPlaces::KdlPlaces(const ArmSpec& spec, const KDL::Frame& tool) : tool_(tool) {
  using KDL::Joint;
  for (const ArmSpec::Part& p : spec.parts) {
    const KDL::Frame before(KDL::Rotation::RPY(p.turn[0], p.turn[1], p.turn[2]), vector(p.place));
    chain_.addSegment(KDL::Segment(Joint(Joint::None), before));
    chain_.addSegment(
        KDL::Segment(Joint(KDL::Vector::Zero(), vector(p.axis), p.slides ? Joint::TransAxis : Joint::RotAxis)));
    slides_.push_back(p.slides);
  }
  const KDL::Frame end(KDL::Rotation::RPY(spec.end_turn[0], spec.end_turn[1], spec.end_turn[2]), vector(spec.end));
  chain_.addSegment(KDL::Segment(Joint(Joint::None), end));
}

KdlPlaces::Place KdlPlaces::at(const AxisNumbers& axes) {
  KDL::JntArray q(static_cast<unsigned>(slides_.size()));
  for (std::size_t i = 0; i < slides_.size(); ++i) {
    q(static_cast<unsigned>(i)) = axes[i] * (slides_[i] ? 0.001 : kPi / 180);
  }
  KDL::Frame end;
  KDL::ChainFkSolverPos_recursive(chain_).JntToCart(q, end);
  return {end.p, (end * tool_).p};
}

}  // namespace indurop::robot
