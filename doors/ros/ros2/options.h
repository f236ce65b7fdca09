// SPDX-License-Identifier: Apache-2.0
// The command line of indurop-ros2.

#pragma once

#include <string>

#include "core/base/options.h"
#include "doors/ros/arm/arm_options.h"
#include "network/dds/network_settings.h"

namespace indurop::ros {

struct Ros2Options {
  ArmOptions arm;
  std::string space;  // namespace of the node, such as "/cell"; empty: none
  dds::NetworkSettings network;
};
// The domain is that of $ROS_DOMAIN_ID, unless an option says otherwise.
void declare_options(base::Options& app, Ros2Options& options);

}  // namespace indurop::ros
