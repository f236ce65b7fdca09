// SPDX-License-Identifier: Apache-2.0
// Gathers an arm from the joints of a URDF file, for arm_from_urdf() only.

#pragma once

#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <string>
#include <vector>

#include "control/robot/files/urdf.h"
#include "control/robot/files/urdf_bodies.h"
#include "control/robot/files/urdf_text.h"

namespace indurop::robot {

inline bool slides(const urdf::Joint& joint) noexcept {
  return joint.type == urdf::Joint::PRISMATIC;
}

inline bool is_axis(const urdf::Joint& joint) noexcept {
  return joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS || slides(joint);
}

class UrdfReader {
 public:
  UrdfReader(const std::string& file, const std::string& text) : file_(file), text_(text) {}

  Result<ArmModel, std::vector<base::Diagnostic>> read();

 private:
  void error(std::size_t offset, const std::string& text) { errors_.push_back(wrong_urdf(file_, text_, offset, text)); }
  [[nodiscard]] std::size_t place_of(const std::string& joint) const { return place_in_urdf(text_, "joint", joint); }
  [[nodiscard]] static std::vector<urdf::JointConstSharedPtr> chain_to(const urdf::LinkConstSharedPtr& tip);
  [[nodiscard]] static urdf::LinkConstSharedPtr tip_of(const urdf::ModelInterface& model);
  void limits_of(const urdf::Joint& joint, Axis& axis, double& velocity);
  Result<ArmModel, std::vector<base::Diagnostic>> read_delta(const urdf::ModelInterface& model);
  [[nodiscard]] std::string attribute(std::size_t at, const std::string& name) const;
  void take_chain(const std::vector<urdf::JointConstSharedPtr>& chain);
  void follow(const urdf::JointMimic& mimic, const Link& link);
  void take_axis(const urdf::Joint& joint, const Link& link);
  void connect();
  void begin_at_workpiece();
  void take_singles();
  void turn_workpiece(const urdf::LinkConstSharedPtr& workpiece);
  [[nodiscard]] Dynamics masses();
  [[nodiscard]] std::vector<LinkBody> shapes();
  void note(const std::string& text);

  const std::string& file_;
  const std::string& text_;
  urdf::ModelInterfaceSharedPtr model_;
  std::vector<base::Diagnostic> errors_;
  std::vector<base::Diagnostic> notes_;
  Arm::Axes axes_;
  Joints velocity_ = Joints::Ones();
  Pose frame_;  // after the joint that was read last
  int count_ = 0;
  std::vector<Link> links_;
  std::vector<urdf::JointConstSharedPtr> driven_by_;  // the joint that drives a linkage joint; else null
  std::vector<urdf::JointConstSharedPtr> joints_;     // of `links_`
  std::vector<ChainLink> chain_;
  int world_joint_ = 0;
  std::vector<Axis> singles_;
  Joints single_velocity_ = Joints::Ones();
};

}  // namespace indurop::robot
