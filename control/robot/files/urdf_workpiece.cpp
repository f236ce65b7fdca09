// SPDX-License-Identifier: Apache-2.0
// Axes that move the workpiece (a positioner).
#include <algorithm>
#include <utility>

#include "control/robot/files/urdf_reader.h"

namespace indurop::robot {

// Reads what URDF does not know, the link that carries the workpiece: <workpiece link="plate"/>.
void UrdfReader::begin_at_workpiece() {
  const std::size_t at = text_.find("<workpiece");
  if (at == std::string::npos) {
    return;
  }
  if (const std::size_t more = text_.find("<workpiece", at + 1); more != std::string::npos) {
    error(more, "there is one <workpiece> already; axes move one link only");
  }
  const std::string name = attribute(at, "link");
  const auto link = model_->getLink(name);
  if (link == nullptr) {
    error(at, "<workpiece> names the link '" + name + R"(', which is not there; write <workpiece link="..."/>)");
    return;
  }
  std::vector<urdf::JointConstSharedPtr> moving = chain_to(link);
  moving.erase(std::remove_if(moving.begin(), moving.end(), [](const auto& joint) { return !is_axis(*joint); }),
               moving.end());
  if (moving.empty()) {
    error(at, "<workpiece>: no joint moves the link '" + name + "'; a frame of a job (FRAME) describes such a place");
  }
  for (const auto& joint : moving) {
    if (std::find(joints_.begin(), joints_.end(), joint) != joints_.end()) {
      error(at, "<workpiece>: joint '" + joint->name + "' moves both the link '" + name + "' and the arm");
    } else if (joint->mimic != nullptr) {
      error(place_of(joint->name), "joint '" + joint->name + "' moves the workpiece, and cannot follow another one");
    }
  }
  if (count_ < 6) {
    error(at, "<workpiece>: the arm has " + std::to_string(count_) + " axes; following a workpiece takes six");
  }
  if (count_ + static_cast<int>(moving.size()) > kAxes) {
    error(at, "arm and workpiece have " + std::to_string(count_ + static_cast<int>(moving.size())) + " axes; up to " +
                  std::to_string(kAxes) + " are possible");
  }
  if (errors_.empty()) {
    turn_workpiece(link);
  }
}

// The joints of the workpiece come first, in reverse: seen from the workpiece, each moves the world the other way.
void UrdfReader::turn_workpiece(const urdf::LinkConstSharedPtr& workpiece) {
  const std::size_t arm_links = links_.size();
  const std::size_t arm_chain = chain_.size();
  const Pose end = std::exchange(frame_, {});
  take_chain(chain_to(workpiece));
  const Pose to_base = inverse_of(frame_);
  world_joint_ = static_cast<int>(links_.size() - arm_links);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    Link& link = links_[i];
    link.direction = to_base.orientation * (i < arm_links ? link.direction : Vec3(-link.direction));
    link.point = to_base.position + to_base.orientation * link.point;
    if (driven_by_[i] == nullptr) {
      axes_[at(link.axis)].direction = link.direction;
      axes_[at(link.axis)].point = link.point;
    }
  }
  for (std::size_t i = 0; i < chain_.size(); ++i) {
    ChainLink& one = chain_[i];
    const int moved_by = std::max(one.body - static_cast<int>(arm_links), -1);
    one.body = i < arm_chain ? one.body + world_joint_ : world_joint_ - 2 - moved_by;
    one.frame = to_base * one.frame;
  }
  frame_ = to_base * end;
  const auto to_front = [](auto& list, std::size_t first) {
    std::reverse(list.begin() + static_cast<std::ptrdiff_t>(first), list.end());
    std::rotate(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(first), list.end());
  };
  to_front(links_, arm_links);
  to_front(chain_, arm_chain);
}

}  // namespace indurop::robot
