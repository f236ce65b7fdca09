// SPDX-License-Identifier: Apache-2.0
#include "control/robot/files/urdf.h"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <sstream>
#include <utility>

#include "control/robot/files/urdf_reader.h"
#include "control/robot/files/urdf_shapes.h"
#include "control/robot/files/urdf_text.h"

namespace indurop::robot {

namespace {

// Collects the messages of urdfdom while this object exists; they would go to stderr otherwise.
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

Pose after(const Pose& first, const Pose& second) noexcept {
  return {first.position + first.orientation * second.position, first.orientation * second.orientation};
}

}  // namespace

std::vector<urdf::JointConstSharedPtr> UrdfReader::chain_to(const urdf::LinkConstSharedPtr& tip) {
  std::vector<urdf::JointConstSharedPtr> chain;
  for (auto link = tip; link != nullptr && link->parent_joint != nullptr; link = link->getParent()) {
    chain.push_back(link->parent_joint);
  }
  std::reverse(chain.begin(), chain.end());
  return chain;
}

// The named tool, else the link with the most moving joints before it, and of these the one farthest from the root.
urdf::LinkConstSharedPtr UrdfReader::tip_of(const urdf::ModelInterface& model) {
  for (const char* name : {"tool0", "tcp"}) {
    if (auto link = model.getLink(name)) {
      return link;
    }
  }
  urdf::LinkConstSharedPtr best = model.getRoot();
  std::pair<std::ptrdiff_t, std::size_t> most{0, 0};
  for (const auto& [name, link] : model.links_) {
    const auto chain = chain_to(link);
    const auto moving = std::count_if(chain.begin(), chain.end(), [](const auto& j) { return is_axis(*j); });
    if (std::pair(moving, chain.size()) > most) {
      most = {moving, chain.size()};
      best = link;
    }
  }
  return best;
}

void UrdfReader::limits_of(const urdf::Joint& joint, Axis& axis, double& velocity) {
  axis.endless = joint.type == urdf::Joint::CONTINUOUS;
  axis.kind = slides(joint) ? AxisKind::Sliding : AxisKind::Turning;
  if (joint.limits == nullptr || !(joint.limits->velocity > 0)) {
    error(place_of(joint.name),
          "joint '" + joint.name + "' has no <limit> with a velocity above 0 (" + (slides(joint) ? "m/s)" : "rad/s)"));
    return;
  }
  velocity = joint.limits->velocity;
  axis.lower = joint.limits->lower;
  axis.upper = joint.limits->upper;
  if (!axis.endless && !(axis.lower < axis.upper)) {
    error(place_of(joint.name), "joint '" + joint.name + "': the lower limit is not below the upper one");
  }
}

Result<ArmModel, std::vector<base::Diagnostic>> UrdfReader::read() {
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
  model_ = model;
  if (text_.find("<delta") != std::string::npos) {
    return read_delta(*model);
  }
  chain_.push_back({model->getRoot(), {}, -1});
  take_chain(chain_to(tip_of(*model)));
  if (count_ == 0 || count_ > kAxes) {
    error(0, "the arm has " + std::to_string(count_) + " axes between root and tool; 1 to " + std::to_string(kAxes) +
                 " are possible");
  }
  connect();
  Dynamics dynamics = masses();
  if (errors_.empty()) {
    begin_at_workpiece();
  }
  std::vector<LinkBody> bodies = shapes();
  take_singles();
  if (!errors_.empty()) {
    return std::move(errors_);
  }
  ArmModel read{Arm(std::move(axes_), frame_, count_, links_.data(), links_.size(), world_joint_), velocity_, dynamics,
                std::move(bodies)};
  for (const auto& [name, link] : model->links_) {
    read.links.push_back(name);
  }
  read.notes = std::move(notes_);
  read.singles = std::move(singles_);
  read.single_velocity = single_velocity_;
  return read;
}

std::vector<LinkBody> UrdfReader::shapes() {
  std::vector<base::Diagnostic> found;
  std::vector<LinkBody> bodies = shapes_of(*model_, chain_, file_, text_, found);
  for (base::Diagnostic& one : found) {
    (one.severity == base::Diagnostic::Severity::Error ? errors_ : notes_).push_back(std::move(one));
  }
  return bodies;
}

void UrdfReader::note(const std::string& text) {
  notes_.push_back({base::Diagnostic::Severity::Note, file_, {1, 1}, text});
}

// Unless all masses are given, torques are unknown.
Dynamics UrdfReader::masses() {
  UrdfBodies found = bodies_of(chain_, links_.size(), file_, text_);
  std::move(found.errors.begin(), found.errors.end(), std::back_inserter(errors_));
  if (!errors_.empty()) {
    return {};
  }
  if (!found.without.empty()) {
    std::string names;
    for (const std::string& name : found.without) {
      names += (names.empty() ? "'" : ", '") + name + "'";
    }
    note("torques are not known and have no limit: there is no <inertial> in " +
         std::string(found.without.size() > 1 ? "the links " : "the link ") + names);
    return {};
  }
  Friction friction;
  Joints effort = Joints::Zero();
  std::string free;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const urdf::Joint& joint = *joints_[i];
    const int axis = links_[i].axis;
    if (joint.dynamics != nullptr) {
      const double ratio = std::abs(links_[i].ratio);
      friction.damping[axis] += ratio * ratio * joint.dynamics->damping;
      friction.dry[axis] += ratio * joint.dynamics->friction;
      if (!(joint.dynamics->damping >= 0 && joint.dynamics->friction >= 0)) {
        error(place_of(joint.name), "joint '" + joint.name + "': damping and friction of <dynamics> cannot be below 0");
      }
    }
    if (driven_by_[i] == nullptr && joint.limits != nullptr && joint.limits->effort > 0) {
      effort[axis] = joint.limits->effort;
    } else if (driven_by_[i] == nullptr) {
      free += (free.empty() ? "'" : ", '") + joint.name + "'";
    }
  }
  if (!free.empty()) {
    note("the torque of " + free + " has no limit; give it <limit effort> above 0 (N m, sliding N)");
  }
  return {links_, found.bodies, frame_, friction, effort};
}

// Reads what URDF cannot express, since its chains have no loops: <delta arms="a1 a2 a3" turn="a4" base="0.2"
// upper="0.24" lower="0.8" platform="0.05" tool="0.03"/>, and the limits of the joints that it names.
Result<ArmModel, std::vector<base::Diagnostic>> UrdfReader::read_delta(const urdf::ModelInterface& model) {
  const std::size_t at = text_.find("<delta");
  Delta delta;
  for (const auto& [name, value] : {std::pair("base", &delta.base), std::pair("upper", &delta.upper),
                                    std::pair("lower", &delta.lower), std::pair("platform", &delta.platform)}) {
    *value = std::strtod(attribute(at, name).c_str(), nullptr);
    if (!(std::isfinite(*value) && *value > 0)) {
      error(at, std::string("<delta> needs ") + name + "=\"...\", a length above 0 (m)");
    }
  }
  delta.tool = std::strtod(attribute(at, "tool").c_str(), nullptr);
  std::istringstream names(attribute(at, "arms") + " " + attribute(at, "turn"));
  for (std::string name; names >> name; ++count_) {
    const auto joint = model.getJoint(name);
    if (joint == nullptr || !is_axis(*joint) || slides(*joint)) {
      error(at, "<delta> names the joint '" + name + "', which does not turn or is not there");
    } else if (count_ < 4) {
      joints_.push_back(joint);
      take_axis(*joint, {Vec3::UnitZ(), Vec3::Zero(), AxisKind::Turning, count_, 1});
    }
  }
  if (count_ != 3 && count_ != 4) {
    error(at, "<delta> needs arms=\"...\", the names of three joints, and may have turn=\"...\"");
  }
  if (const std::size_t workpiece = text_.find("<workpiece"); workpiece != std::string::npos) {
    error(workpiece, "<workpiece>: a delta cannot follow a workpiece that axes move");
  }
  take_singles();
  if (errors_.empty() && !delta.position(Vec3::Zero()).allFinite()) {
    error(at, "<delta>: with the arms level the rods do not meet; lower has to be longer");
  }
  if (!errors_.empty()) {
    return std::move(errors_);
  }
  note("torques are not known and have no limit: the arm is a delta");
  return ArmModel{Arm(std::move(axes_), delta, count_),
                  velocity_,
                  {},
                  {},
                  {},
                  std::move(notes_),
                  std::move(singles_),
                  single_velocity_};
}

// Returns an attribute of the element at `at`; empty if there is none of that name.
std::string UrdfReader::attribute(std::size_t at, const std::string& name) const {
  const std::string element = text_.substr(at, text_.find('>', at) - at);
  for (const char quote : {'"', '\''}) {
    const std::size_t begin = element.find(" " + name + "=" + quote);
    if (begin != std::string::npos) {
      const std::size_t value = begin + name.size() + 3;
      return element.substr(value, element.find(quote, value) - value);
    }
  }
  return "";
}

void UrdfReader::take_chain(const std::vector<urdf::JointConstSharedPtr>& chain) {
  for (const auto& joint : chain) {
    frame_ = after(frame_, pose_of(joint->parent_to_joint_origin_transform));
    if (joint->type == urdf::Joint::FIXED) {
      chain_.push_back({model_->getLink(joint->child_link_name), frame_, static_cast<int>(links_.size()) - 1});
      continue;
    }
    if (!is_axis(*joint)) {
      error(place_of(joint->name),
            "joint '" + joint->name + "' has to be revolute, continuous, prismatic or fixed between root and tool");
      continue;
    }
    const Vec3 direction(joint->axis.x, joint->axis.y, joint->axis.z);
    if (!(direction.norm() > 1e-6)) {
      error(place_of(joint->name), "joint '" + joint->name + "' has no direction; write <axis xyz=\"0 0 1\"/>");
      continue;
    }
    Link link{frame_.orientation * direction.normalized(), frame_.position,
              slides(*joint) ? AxisKind::Sliding : AxisKind::Turning, count_, 1};
    if (joint->mimic != nullptr) {
      link.ratio = joint->mimic->multiplier;
      follow(*joint->mimic, link);
    } else if (count_++ < kAxes) {
      take_axis(*joint, link);
    }
    links_.push_back(link);
    driven_by_.push_back(joint->mimic == nullptr ? nullptr : joint);
    joints_.push_back(joint);
    chain_.push_back({model_->getLink(joint->child_link_name), frame_, static_cast<int>(links_.size()) - 1});
  }
}

// The position of a linkage when all axes are at zero.
void UrdfReader::follow(const urdf::JointMimic& mimic, const Link& link) {
  const Vec3 local = frame_.orientation.conjugate() * link.direction;
  if (link.kind == AxisKind::Sliding) {
    frame_.position += mimic.offset * link.direction;
  } else {
    frame_.orientation = frame_.orientation * Quat(Eigen::AngleAxisd(mimic.offset, local));
  }
}

void UrdfReader::take_axis(const urdf::Joint& joint, const Link& link) {
  Axis& axis = axes_[static_cast<std::size_t>(link.axis)];
  axis.name = joint.name;
  axis.direction = link.direction;
  axis.point = link.point;
  limits_of(joint, axis, velocity_[link.axis]);
}

// Connects joints of linkages with the axis that moves them.
void UrdfReader::connect() {
  if (links_.size() > Arm::kMostLinks) {
    error(0, "the chain has more than " + std::to_string(Arm::kMostLinks) + " moving joints");
  }
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (driven_by_[i] == nullptr) {
      continue;
    }
    const std::string& wanted = driven_by_[i]->mimic->joint_name;
    const auto* const found = std::find_if(axes_.begin(), axes_.end(), [&](const Axis& a) { return a.name == wanted; });
    if (found == axes_.end()) {
      error(place_of(driven_by_[i]->name),
            "joint '" + driven_by_[i]->name + "' follows '" + wanted + "', which is no axis between root and tool");
    } else {
      links_[i].axis = static_cast<int>(found - axes_.begin());
    }
  }
}

Result<ArmModel, std::vector<base::Diagnostic>> arm_from_urdf(const std::string& file, const std::string& text) {
  return UrdfReader(file, text).read();
}

}  // namespace indurop::robot
