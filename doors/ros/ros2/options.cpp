// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/ros2/options.h"

#include <charconv>
#include <cstdlib>
#include <string_view>

namespace indurop::ros {
namespace {

int domain_of_environment() noexcept {
  const char* const text = std::getenv("ROS_DOMAIN_ID");
  const std::string_view word = text == nullptr ? "" : text;
  int domain = 0;
  std::from_chars(word.data(), word.data() + word.size(), domain);
  return domain;
}

}  // namespace

void declare_options(base::Options& app, Ros2Options& options) {
  declare_arm_options(app, options.arm, "joint states are", "any program in the DDS domain may");
  const auto take = [&options](const std::string& name) {
    options.space = name.starts_with('/') ? name : "/" + name;
    return ros_name_problem(name);
  };
  app.add("--namespace", "NAME", base::Take(take), "Namespace of the node, before all names (default: none)");
  options.network.domain = domain_of_environment();
  app.add("--domain", "N", options.network.domain, "DDS domain (default: ROS_DOMAIN_ID, or 0)").range(0, 230);
  app.add("--interface", "IF", options.network.interface_name,
          "Network interface, lo for this machine only (default: the only one)");
}

}  // namespace indurop::ros
