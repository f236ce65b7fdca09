// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/arm/arm_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/base/diagnostic.h"
#include "core/base/read_file.h"
#include "core/base/text.h"

namespace indurop::ros {
namespace {

bool is_letter(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_part(std::string_view part) noexcept {
  return !part.empty() && is_letter(part.front()) &&
         std::all_of(part.begin(), part.end(), [](char c) { return is_letter(c) || (c >= '0' && c <= '9'); });
}

}  // namespace

std::string ros_name_problem(const std::string& name) {
  std::string_view rest = name;
  do {
    rest.remove_prefix(!rest.empty() && rest.front() == '/' ? 1 : 0);
    const std::string_view part = rest.substr(0, rest.find('/'));
    if (!is_part(part)) {
      return "the parts of a name of ROS have letters, digits and _, and begin with no digit";
    }
    rest.remove_prefix(part.size());
  } while (!rest.empty());
  return {};
}

void declare_arm_options(base::Options& app, ArmOptions& options, const std::string& published,
                         const std::string& anyone) {
  constexpr double kLeastHz = 0.1;
  constexpr double kMostHz = 200;
  app.add("--node", "NAME", options.node, "The node of InduRoP (default: local, or the only one that runs)");
  app.add("--rate", "HZ", options.rate_hz, fmt::format("How often {} published (default 50)", published))
      .range(kLeastHz, kMostHz);
  app.add("--urdf", "FILE", options.urdf, "The arm of the node's robot: its joints, and robot_description")
      .completes(base::Completion::File);
  app.add("--robot", "NAMESPACE", options.robot, "Namespace of the robot's variables (default PLC_ROBOT)");
  app.add("--controller", "NAME", options.controller, "Name of the controller for clients (default arm_controller)")
      .check(ros_name_problem);
  app.flag("--move", options.move, "Let clients move the arm; " + anyone);
  app.flag("-q,--quiet", options.quiet, "Print warnings and errors only");
}

Result<ArmFile, std::string> read_arm(const ArmOptions& options, const std::string& program) {
  const auto wrong = [&program](const std::string& text) { return fmt::format("{}: error: {}\n", program, text); };
  if (options.urdf.empty()) {
    return options.move
               ? Result<ArmFile, std::string>(wrong("--move needs --urdf FILE, which has the joints of the arm"))
               : ArmFile{};
  }
  auto text = base::read_file(options.urdf);
  if (!text) {
    return wrong(base::cannot_read(options.urdf, text.error()));
  }
  auto joints = read_joints(options.urdf, *text);
  if (!joints) {
    return base::to_text(joints.error());
  }
  return ArmFile{std::move(*text), std::move(*joints)};
}

}  // namespace indurop::ros
