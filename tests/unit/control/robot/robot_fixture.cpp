// SPDX-License-Identifier: Apache-2.0
#include "robot_fixture.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <stdexcept>

namespace indurop::robot {

std::string solid_cell_urdf() {
  std::ifstream file(ROBOT_URDF);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string cell_urdf() {
  return std::regex_replace(solid_cell_urdf(), std::regex("<collision>.*?</collision>"), "");
}

Arm cell_arm() {
  auto model = arm_from_urdf("robot.urdf", cell_urdf());
  if (!model) {
    throw std::runtime_error(base::to_text(model.error()));
  }
  return model->arm;
}

Arm odd_arm() {
  const Arm arm = cell_arm();
  std::array<Axis, kAxes> axes;
  for (int i = 0; i < kAxes; ++i) {
    axes[static_cast<std::size_t>(i)] = arm.axis(i);
  }
  axes[5].point += Vec3(0, 0, 0.05);
  return {axes, arm.home()};
}

std::string urdf_of(const std::string& name) {
  std::ifstream file(std::string(ROBOT_ARMS) + "/" + name + ".urdf");
  return {std::istreambuf_iterator<char>(file), {}};
}

Arm arm_of(const std::string& name) {
  auto model = arm_from_urdf(name + ".urdf", urdf_of(name));
  if (!model) {
    throw std::runtime_error(base::to_text(model.error()));
  }
  return model->arm;
}

std::unique_ptr<Controller> controller_of(const std::string& urdf, const std::string& job, Settings settings,
                                          const JobTexts& others) {
  const auto folder = std::filesystem::temp_directory_path() / ("robot_test." + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  settings.plan_in_tick = true;  // time is what the test says it is
  settings.urdf = folder / "arm.urdf";
  std::ofstream(settings.urdf) << urdf;
  settings.jobs = {folder / "main.job"};
  std::ofstream(settings.jobs[0]) << job;
  for (const auto& [name, text] : others) {
    settings.jobs.push_back(folder / (name + ".job"));
    std::ofstream(settings.jobs.back()) << text;
  }
  std::vector<std::string> errors;
  auto controller = Controller::load(settings, errors);
  std::filesystem::remove_all(folder);
  if (!controller) {
    throw std::runtime_error(errors.at(0));
  }
  return controller;
}

JointLimits cell_limits() {
  JointLimits limits;
  limits.velocity.head<6>() << 3.49, 3.49, 3.49, 6.98, 6.98, 8.72;
  limits.acceleration = limits.velocity / 0.25;
  limits.jerk = limits.acceleration / 0.1;
  return limits;
}

Joints anywhere(const Arm& arm, std::mt19937& random, double margin) {
  Joints q = Joints::Zero();
  for (int i = 0; i < arm.count(); ++i) {
    const Axis& a = arm.axis(i);
    const double low = a.endless ? -kPi : a.lower + margin;
    const double high = a.endless ? kPi : a.upper - margin;
    q[i] = std::uniform_real_distribution<double>(low, high)(random);
  }
  return q;
}

Target pose_near(const Arm& arm, Joints q, double far, std::mt19937& random) {
  for (int i = 0; i < arm.count(); ++i) {
    q[i] += std::uniform_real_distribution<double>(-far, far)(random);
  }
  Target target;
  target.is_pose = true;
  target.pose = arm.forward(q);
  return target;
}

int number_of(const char* name, int otherwise) {
  const char* const text = std::getenv(name);
  return text == nullptr ? otherwise : std::atoi(text);
}

int poses(int usual) {
  return number_of("INDUROP_ROBOT_POSES", usual);
}

double distance(const Pose& a, const Pose& b) {
  return difference(a, b).norm();
}

}  // namespace indurop::robot
