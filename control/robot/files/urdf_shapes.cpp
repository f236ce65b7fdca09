// SPDX-License-Identifier: Apache-2.0
#include "control/robot/files/urdf_shapes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "control/robot/files/urdf_text.h"

namespace indurop::robot {

namespace {

using Diagnostics = std::vector<base::Diagnostic>;

class BodyReader {
 public:
  BodyReader(const std::vector<ChainLink>& chain, const std::string& file, const std::string& text, Diagnostics& found)
      : chain_(chain), file_(file), text_(text), found_(found) {}

  // Returns nothing if the link has no body that can be checked.
  std::optional<LinkBody> read(const urdf::LinkConstSharedPtr& link);

 private:
  bool carried(const urdf::LinkConstSharedPtr& link, Pose& home, int& joint);
  std::optional<Solid> solid_of(const urdf::Geometry& geometry, const Pose& place, std::size_t at,
                                const std::string& link);
  void say(base::Diagnostic::Severity severity, std::size_t at, const std::string& what) {
    found_.push_back(wrong_urdf(file_, text_, at, what));
    found_.back().severity = severity;
  }

  const std::vector<ChainLink>& chain_;
  const std::string& file_;
  const std::string& text_;
  Diagnostics& found_;
};

// Finds the link of the chain that carries a link: itself, or one that it is fixed to. Returns false if there is none.
bool BodyReader::carried(const urdf::LinkConstSharedPtr& link, Pose& home, int& joint) {
  Pose behind;
  for (auto one = link; one != nullptr; one = one->getParent()) {
    const auto found =
        std::find_if(chain_.begin(), chain_.end(), [&](const ChainLink& each) { return each.link == one; });
    if (found != chain_.end()) {
      home = found->frame * behind;
      joint = found->body + 1;
      return true;
    }
    const auto& before = one->parent_joint;
    if (before == nullptr || before->type != urdf::Joint::FIXED) {
      say(base::Diagnostic::Severity::Warning, place_in_urdf(text_, "link", link->name),
          "link '" + link->name + "' is not checked for collisions: it is moved by joint '" +
              (before == nullptr ? std::string("?") : before->name) + "', which is not between root and tool");
      return false;
    }
    behind = pose_of(before->parent_to_joint_origin_transform) * behind;
  }
  return false;
}

std::optional<Solid> BodyReader::solid_of(const urdf::Geometry& geometry, const Pose& place, std::size_t at,
                                          const std::string& link) {
  std::optional<Solid> solid;
  if (geometry.type == urdf::Geometry::BOX) {
    const auto& box = dynamic_cast<const urdf::Box&>(geometry);
    solid = Solid::box({box.dim.x, box.dim.y, box.dim.z}, place);
  } else if (geometry.type == urdf::Geometry::CYLINDER) {
    const auto& cylinder = dynamic_cast<const urdf::Cylinder&>(geometry);
    solid = Solid::cylinder(cylinder.radius, cylinder.length, place);
  } else if (geometry.type == urdf::Geometry::SPHERE) {
    solid = Solid::ball(dynamic_cast<const urdf::Sphere&>(geometry).radius, place);
  } else {
    say(base::Diagnostic::Severity::Warning, at,
        "link '" + link + "': this mesh is not checked for collisions; 'indurop-solids " + file_ +
            " NEW.urdf' puts boxes, cylinders and balls around all of them");
    return {};
  }
  if (!(solid->half.allFinite() && solid->half.minCoeff() > 0)) {
    say(base::Diagnostic::Severity::Error, at, "link '" + link + "': all sizes of a body have to be above 0 (m)");
    return {};
  }
  return solid;
}

std::optional<LinkBody> BodyReader::read(const urdf::LinkConstSharedPtr& link) {
  if (link->collision_array.empty()) {
    return {};
  }
  Pose home;
  LinkBody body{link->name, 0, {}};
  if (!carried(link, home, body.joint)) {
    return {};
  }
  std::size_t at = place_in_urdf(text_, "link", link->name);
  for (const auto& collision : link->collision_array) {
    at = std::min(text_.find("<collision", at + 1), text_.size());
    if (collision == nullptr || collision->geometry == nullptr) {
      continue;
    }
    if (const auto solid = solid_of(*collision->geometry, home * pose_of(collision->origin), at, link->name)) {
      body.solids.push_back(*solid);
    }
  }
  return body.solids.empty() ? std::nullopt : std::optional(std::move(body));
}

}  // namespace

std::vector<LinkBody> shapes_of(const urdf::ModelInterface& model, const std::vector<ChainLink>& chain,
                                const std::string& file, const std::string& text, Diagnostics& found) {
  std::vector<LinkBody> bodies;
  BodyReader reader(chain, file, text, found);
  for (const auto& [name, link] : model.links_) {
    if (auto body = reader.read(link)) {
      bodies.push_back(std::move(*body));
    }
  }
  // In order from the base, regardless of names.
  std::stable_sort(bodies.begin(), bodies.end(),
                   [](const LinkBody& a, const LinkBody& b) { return a.joint < b.joint; });
  constexpr std::size_t kMaxSolids = 64;
  std::size_t solids = 0;
  for (const LinkBody& body : bodies) {
    solids += body.solids.size();
  }
  if (solids > kMaxSolids) {
    found.push_back(wrong_urdf(file, text, 0,
                               "the links have " + std::to_string(solids) + " bodies (<collision>), " +
                                   std::to_string(kMaxSolids) + " are possible; write fewer, larger ones"));
  }
  return bodies;
}

}  // namespace indurop::robot
