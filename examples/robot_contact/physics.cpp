// SPDX-License-Identifier: Apache-2.0
// The arm behind its simulated drives: masses, gravity, a visitor who pushes against it, and the sheet under its tool.
#include <indurop/indurop.h>
#include <indurop/robot/arm_physics.h>

#include <indurop/files.h>
#include <indurop/generated.h>

#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "sheet.h"

namespace robot = indurop::robot;

namespace {

constexpr std::size_t kAxes = 6;
constexpr double kTremor = 0.05;  // part of its force by which a hand trembles
constexpr double kTremorHz = 9;
constexpr double kRadiansPerCount = 2 * std::numbers::pi / 1'320'000;

using Six = std::array<double, kAxes>;

struct Visit {
  double from = 0, to = 0;  // s since the start
  std::size_t axis = 1;
  double torque = 0;  // N m
};

std::unique_ptr<robot::ArmPhysics> arm;
std::array<robot::AxisPhysics, kAxes> axes;
Six rated{};
std::vector<Visit> visits;
Sheet sheet;
double period = 0;
std::int64_t began = -1;

Six six(const char* name) {
  std::istringstream text(irp::property(name, ""));
  Six numbers{};
  for (double& number : numbers) {
    text >> number;
  }
  if (!text) {
    throw std::runtime_error(std::string("property ") + name + ": it has to be six numbers, one of each axis");
  }
  return numbers;
}

void read_held() {
  std::istringstream text(irp::property("held", "0 0 0 0 0"));
  double mass = 0;
  double radius = 0;
  std::array<double, 3> centre{};
  if (!(text >> mass >> centre[0] >> centre[1] >> centre[2] >> radius) || mass < 0) {
    throw std::runtime_error("property held: it has to be five numbers: kg, x y z of its middle and its radius in m");
  }
  arm->hold(mass, centre[0], centre[1], centre[2], radius);
}

void read_visits() {
  std::istringstream text(irp::property("visitor", ""));
  for (Visit visit; text >> visit.from >> visit.to >> visit.axis >> visit.torque;) {
    if (visit.axis < 1 || visit.axis > kAxes) {
      throw std::runtime_error(
          "property visitor: it has to be groups of four numbers: from, to (s), axis (1 to 6), N m");
    }
    visits.push_back(visit);
  }
}

}  // namespace

void start() {
  std::vector<std::string> errors;
  arm = robot::ArmPhysics::load(irp::file_beside_config(irp::property("urdf", "arm.urdf")), errors);
  for (const std::string& error : errors) {
    irp::printf("%s\n", error.c_str());
  }
  if (arm == nullptr || arm->axis_count() != kAxes) {
    throw std::runtime_error("there is no arm of six axes with masses");
  }
  const Six inertia = six("inertia");
  const Six rotor = six("rotor_inertia");
  rated = six("rated_torque");
  for (std::size_t i = 0; i < kAxes; ++i) {
    axes[i].inertia = inertia[i];
    axes[i].rotor = rotor[i];
  }
  read_held();
  read_visits();
  sheet = Sheet(irp::property("sheet", ""));
  period = std::chrono::duration<double>(irp::period()).count();
}

void run() {
  using namespace PLC_ROBOT;
  const AXIS1_IN_t in[kAxes] = {AXIS1_IN, AXIS2_IN, AXIS3_IN, AXIS4_IN, AXIS5_IN, AXIS6_IN};
  began = began < 0 ? irp::release_ns() : began;
  const double now = 1e-9 * static_cast<double>(irp::release_ns() - began);
  Six load{};
  for (std::size_t i = 0; i < kAxes; ++i) {
    axes[i].position = in[i].position * kRadiansPerCount;
    axes[i].torque = in[i].torque / 1000.0 * rated[i];
  }
  Six wrench = CONTACT::hand;
  for (double& one : wrench) {
    one *= 1 + kTremor * std::sin(2 * std::numbers::pi * kTremorHz * now);
  }
  Six degrees{};
  for (std::size_t i = 0; i < kAxes; ++i) {
    degrees[i] = axes[i].position * 180 / std::numbers::pi;
  }
  const Six from_sheet = sheet.push(arm_tip(degrees), period);
  for (std::size_t i = 0; i < kAxes; ++i) {
    wrench[i] += from_sheet[i];
  }
  Six pushed{};
  arm->push_end(axes, wrench, pushed);
  for (std::size_t i = 0; i < kAxes; ++i) {
    pushed[i] += CONTACT::push[i];
  }
  for (const Visit& visit : visits) {
    if (now >= visit.from && now < visit.to) {
      pushed[visit.axis - 1] += visit.torque;
    }
  }
  for (std::size_t i = 0; i < kAxes; ++i) {
    axes[i].push = pushed[i];
  }
  arm->step(axes, period, load);
  for (std::size_t i = 0; i < kAxes; ++i) {
    CONTACT::load[i] = load[i];
    CONTACT::pushed[i] = pushed[i];
  }
  CONTACT::force = sheet.measured();
  CONTACT::measured = CONTACT::measured + 1;
}

INDUROP_MODULE(run = &::run, start = &::start, name = "physics", description = "the arm behind its drives")
