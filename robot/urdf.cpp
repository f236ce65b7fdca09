// SPDX-License-Identifier: Apache-2.0
#include "robot/urdf.h"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

// What urdfdom says while this lives; it would write to stderr otherwise.
class Listener : public console_bridge::OutputHandler {
 public:
  Listener() { console_bridge::useOutputHandler(this); }
  ~Listener() override { console_bridge::restorePreviousOutputHandler(); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  void log(const std::string& text, console_bridge::LogLevel level, const char* /*file*/, int /*line*/) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && said.find(text) == std::string::npos) {
      said += (said.empty() ? "" : "; ") + text;
    }
  }
  std::string said;
};

class Reader {
 public:
  Reader(const std::string& file, const std::string& text) : file_(file), text_(text) {}

  Result<ArmModel, std::vector<base::Diagnostic>> read();

 private:
  void error(std::size_t offset, const std::string& text);
  [[nodiscard]] std::size_t place_of(const std::string& joint) const;
  [[nodiscard]] static std::vector<urdf::JointConstSharedPtr> chain_to(const urdf::LinkConstSharedPtr& tip);
  [[nodiscard]] static urdf::LinkConstSharedPtr tip_of(const urdf::ModelInterface& model);
  void limits_of(const urdf::Joint& joint, Axis& axis, double& velocity);

  const std::string& file_;
  const std::string& text_;
  std::vector<base::Diagnostic> errors_;
};

bool turns(const urdf::Joint& joint) noexcept {
  return joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS;
}

Pose pose_of(const urdf::Pose& pose) noexcept {
  const auto& r = pose.rotation;
  return {{pose.position.x, pose.position.y, pose.position.z}, Quat(r.w, r.x, r.y, r.z).normalized()};
}

Pose after(const Pose& first, const Pose& second) noexcept {
  return {first.position + first.orientation * second.position, first.orientation * second.orientation};
}

void Reader::error(std::size_t offset, const std::string& text) {
  offset = std::min(offset, text_.size());
  const auto begin = text_.begin();
  const auto here = begin + static_cast<std::ptrdiff_t>(offset);
  const auto line = std::count(begin, here, '\n') + 1;
  const std::size_t start = offset == 0 ? std::string::npos : text_.rfind('\n', offset - 1);
  const std::size_t column = start == std::string::npos ? offset + 1 : offset - start;
  errors_.push_back(
      {base::Diagnostic::Severity::Error, file_, {static_cast<int>(line), static_cast<int>(column)}, text});
}

std::size_t Reader::place_of(const std::string& joint) const {
  for (const char* quote : {"\"", "'"}) {
    for (std::size_t at = text_.find("<joint"); at != std::string::npos; at = text_.find("<joint", at + 1)) {
      const std::size_t end = text_.find('>', at);
      const std::size_t name = text_.find(std::string("name=") + quote + joint + quote, at);
      if (name != std::string::npos && name < end) {
        return at;
      }
    }
  }
  return 0;
}

std::vector<urdf::JointConstSharedPtr> Reader::chain_to(const urdf::LinkConstSharedPtr& tip) {
  std::vector<urdf::JointConstSharedPtr> chain;
  for (auto link = tip; link != nullptr && link->parent_joint != nullptr; link = link->getParent()) {
    chain.push_back(link->parent_joint);
  }
  std::reverse(chain.begin(), chain.end());
  return chain;
}

// The named tool, else the link with the most turning joints before it, among these the farthest.
urdf::LinkConstSharedPtr Reader::tip_of(const urdf::ModelInterface& model) {
  for (const char* name : {"tool0", "tcp"}) {
    if (auto link = model.getLink(name)) {
      return link;
    }
  }
  urdf::LinkConstSharedPtr best = model.getRoot();
  std::pair<std::ptrdiff_t, std::size_t> most{0, 0};
  for (const auto& [name, link] : model.links_) {
    const auto chain = chain_to(link);
    const auto turning = std::count_if(chain.begin(), chain.end(), [](const auto& j) { return turns(*j); });
    if (std::pair(turning, chain.size()) > most) {
      most = {turning, chain.size()};
      best = link;
    }
  }
  return best;
}

void Reader::limits_of(const urdf::Joint& joint, Axis& axis, double& velocity) {
  axis.endless = joint.type == urdf::Joint::CONTINUOUS;
  if (joint.limits == nullptr || !(joint.limits->velocity > 0)) {
    error(place_of(joint.name), "joint '" + joint.name + "' has no <limit> with a velocity above 0 (rad/s)");
    return;
  }
  velocity = joint.limits->velocity;
  axis.lower = joint.limits->lower;
  axis.upper = joint.limits->upper;
  if (!axis.endless && !(axis.lower < axis.upper)) {
    error(place_of(joint.name), "joint '" + joint.name + "': the lower limit is not below the upper one");
  }
}

Result<ArmModel, std::vector<base::Diagnostic>> Reader::read() {
  std::string said;
  urdf::ModelInterfaceSharedPtr model;
  {
    Listener listener;
    model = urdf::parseURDF(text_);
    said = listener.said;
  }
  if (model == nullptr) {
    error(0, "this is not the URDF of a robot: " + (said.empty() ? "it cannot be read" : said));
    return std::move(errors_);
  }
  std::array<Axis, kAxes> axes;
  Joints velocity = Joints::Ones();
  Pose frame;
  std::size_t found = 0;
  for (const auto& joint : chain_to(tip_of(*model))) {
    frame = after(frame, pose_of(joint->parent_to_joint_origin_transform));
    if (joint->type == urdf::Joint::FIXED) {
      continue;
    }
    if (!turns(*joint) || joint->mimic != nullptr) {
      error(place_of(joint->name),
            "joint '" + joint->name + "' does not turn by itself; the arm has revolute joints only");
      continue;
    }
    if (++found > kAxes) {
      continue;
    }
    Axis& axis = axes[found - 1];
    axis.name = joint->name;
    const Vec3 direction(joint->axis.x, joint->axis.y, joint->axis.z);
    if (!(direction.norm() > 1e-6)) {
      error(place_of(joint->name), "joint '" + joint->name + "' has no direction; write <axis xyz=\"0 0 1\"/>");
    }
    axis.direction = frame.orientation * direction.normalized();
    axis.point = frame.position;
    limits_of(*joint, axis, velocity[static_cast<Eigen::Index>(found) - 1]);
  }
  if (found != kAxes) {
    error(0, "the arm has " + std::to_string(found) + " turning joints between root and tool, it needs six");
  }
  if (!errors_.empty()) {
    return std::move(errors_);
  }
  return ArmModel{Arm(std::move(axes), frame), velocity};
}

}  // namespace

Result<ArmModel, std::vector<base::Diagnostic>> arm_from_urdf(const std::string& file, const std::string& text) {
  return Reader(file, text).read();
}

}  // namespace indurop::robot
