// SPDX-License-Identifier: Apache-2.0
// Converts names of a .glb file to ROS 2, which has stricter naming rules. Shared by the compiler that writes the
// messages and by the node that publishes them.

#pragma once

#include <string>
#include <string_view>

#include "core/schema/schema.h"

namespace indurop::schema {

// "knu::Robot" has the package "knu_robot_msgs"; types outside namespaces are in "indurop_msgs".
std::string ros_package(std::string_view scope);
// "joints_t" has the message "JointsT".
std::string ros_message(std::string_view type);
// "dCurJoint" has the field "d_cur_joint".
std::string ros_field(std::string_view field);
// "Moving" has the constant "MOVING".
std::string ros_constant(std::string_view enumerator);

// "station::state" has the topic "rt/station/state", which `ros2 topic list` shows as "/station/state".
std::string ros_topic(std::string_view variable);
// Returns the variable's type name as ROS 2 uses it on the wire: "station_msgs::msg::dds_::State_".
std::string ros_type_name(const Variable& variable);

}  // namespace indurop::schema
