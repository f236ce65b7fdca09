// SPDX-License-Identifier: Apache-2.0
#include "control/robot/files/urdf_bodies.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "control/robot/files/urdf_text.h"

namespace indurop::robot {

namespace {

// Offset of the <inertial> of a link, or of the link itself.
std::size_t inertial_of(const std::string& text, const std::string& link) {
  const std::size_t at = place_in_urdf(text, "link", link);
  const std::size_t inertial = text.find("<inertial", at);
  return inertial < text.find("</link", at) ? inertial : at;
}

class Gatherer {
 public:
  Gatherer(UrdfBodies& found, const std::string& file, const std::string& text)
      : found_(found), file_(file), text_(text) {}

  // Collects the masses of a link and of fixed or moving branches of it; `next`: link with which the chain continues.
  void gather(const urdf::Link& link, const Pose& frame, int body, const urdf::Link* next);

 private:
  [[nodiscard]] Body body_of(const urdf::Link& link);

  UrdfBodies& found_;
  const std::string& file_;
  const std::string& text_;
};

Body Gatherer::body_of(const urdf::Link& link) {
  const urdf::Inertial& given = *link.inertial;
  Body body;
  body.mass = given.mass;
  body.inertia << given.ixx, given.ixy, given.ixz, given.ixy, given.iyy, given.iyz, given.ixz, given.iyz, given.izz;
  std::string wrong;
  if (!(std::isfinite(body.mass) && body.mass > 0)) {
    std::ostringstream value;
    value << body.mass;
    wrong =
        "its mass is " + value.str() + " kg, and has to be above 0; leave <inertial> out of links that are no bodies";
  } else {
    wrong = wrong_inertia(body.inertia);
  }
  if (!wrong.empty()) {
    found_.errors.push_back(
        wrong_urdf(file_, text_, inertial_of(text_, link.name), "link '" + link.name + "': " + wrong));
    return {};
  }
  return seen_from(pose_of(given.origin), body);
}

void Gatherer::gather(const urdf::Link& link, const Pose& frame, int body, const urdf::Link* next) {
  if (link.inertial != nullptr) {
    const Body own = body_of(link);
    if (body >= 0) {
      Body& all = found_.bodies[static_cast<std::size_t>(body)];
      all = joined(all, seen_from(frame, own));
    }
  }
  for (const auto& joint : link.child_joints) {
    const auto child = std::find_if(link.child_links.begin(), link.child_links.end(),
                                    [&](const auto& each) { return each->name == joint->child_link_name; });
    if (child != link.child_links.end() && child->get() != next) {
      gather(**child, frame * pose_of(joint->parent_to_joint_origin_transform), body, nullptr);
    }
  }
}

}  // namespace

Pose pose_of(const urdf::Pose& pose) noexcept {
  const auto& r = pose.rotation;
  return {{pose.position.x, pose.position.y, pose.position.z}, Quat(r.w, r.x, r.y, r.z).normalized()};
}

UrdfBodies bodies_of(const std::vector<ChainLink>& chain, std::size_t count, const std::string& file,
                     const std::string& text) {
  UrdfBodies found;
  found.bodies.resize(count);
  Gatherer gatherer(found, file, text);
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const urdf::Link* next = i + 1 < chain.size() ? chain[i + 1].link.get() : nullptr;
    gatherer.gather(*chain[i].link, chain[i].frame, chain[i].body, next);
  }
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const int body = chain[i].body;
    const bool first = body >= 0 && (i == 0 || chain[i - 1].body != body);
    if (first && !(found.bodies[static_cast<std::size_t>(body)].mass > 0)) {
      found.without.push_back(chain[i].link->name);
    }
  }
  return found;
}

}  // namespace indurop::robot
