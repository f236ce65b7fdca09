// SPDX-License-Identifier: Apache-2.0
// Axes of the robot task that belong to no group: feeders, pumps, clamps.
#include <algorithm>
#include <sstream>
#include <utility>

#include "control/robot/files/urdf_reader.h"

namespace indurop::robot {

// Reads what URDF does not know: <single_axes joints="feeder winder"/>, in the order of their numbers.
void UrdfReader::take_singles() {
  const std::size_t at = text_.find("<single_axes");
  if (at == std::string::npos) {
    return;
  }
  if (const std::size_t more = text_.find("<single_axes", at + 1); more != std::string::npos) {
    error(more, "there is one <single_axes> already; write all joints into it");
  }
  std::vector<urdf::JointConstSharedPtr> taken = joints_;
  std::istringstream names(attribute(at, "joints"));
  for (std::string name; names >> name;) {
    const auto joint = model_->getJoint(name);
    if (joint == nullptr || !is_axis(*joint)) {
      error(at, "<single_axes> names '" + name + "', which is no revolute, continuous or prismatic joint");
    } else if (std::find(taken.begin(), taken.end(), joint) != taken.end()) {
      error(at,
            "<single_axes>: joint '" + name + "' is an axis already; name joints that are not between root and tool");
    } else if (joint->mimic != nullptr) {
      error(place_of(name), "joint '" + name + "' is a single axis, and cannot follow another joint");
    } else if (count_ + static_cast<int>(singles_.size()) == kAxes) {
      error(at, "<single_axes>: up to " + std::to_string(kAxes) + " axes are possible, those of the arm included");
      return;
    } else {
      Axis axis;
      axis.name = name;
      limits_of(*joint, axis, single_velocity_[static_cast<Eigen::Index>(singles_.size())]);
      singles_.push_back(std::move(axis));
      taken.push_back(joint);
    }
  }
  if (taken.size() == joints_.size() && errors_.empty()) {
    error(at, R"(<single_axes> names no joint; write <single_axes joints="..."/>)");
  }
}

}  // namespace indurop::robot
