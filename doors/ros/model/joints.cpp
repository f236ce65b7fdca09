// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/model/joints.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/base/xml.h"

namespace indurop::ros {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180;
constexpr double kMillimetre = 1e-3;

base::XmlRules urdf_rules() {
  constexpr std::size_t kMaxBytes = std::size_t{64} << 20U;
  constexpr std::size_t kMaxDepth = 64;
  base::XmlRules rules;
  rules.name = "URDF file";
  rules.form = "<robot> with <link> and <joint>";
  rules.purpose = "description of a robot";
  rules.max_bytes = kMaxBytes;
  rules.max_depth = kMaxDepth;
  rules.tolerant = true;
  return rules;
}

std::string attribute_of(const base::Element& element, const char* name) {
  const auto found = std::find_if(element.attributes.begin(), element.attributes.end(),
                                  [name](const base::Attribute& one) { return one.name == name; });
  return found == element.attributes.end() ? std::string() : found->value;
}

const base::Element* child_of(const base::Element& element, const char* name) {
  const auto found = std::find_if(element.children.begin(), element.children.end(),
                                  [name](const base::Element& one) { return one.name == name; });
  return found == element.children.end() ? nullptr : &*found;
}

std::string link_of(const base::Element& joint, const char* end) {
  const base::Element* const found = child_of(joint, end);
  return found == nullptr ? std::string() : attribute_of(*found, "link");
}

bool is_axis(const base::Element& joint) {
  const std::string type = attribute_of(joint, "type");
  return (type == "revolute" || type == "continuous" || type == "prismatic") && child_of(joint, "mimic") == nullptr;
}

using JointsByChild = std::map<std::string, const base::Element*>;

// From the root to this link. A loop ends it.
std::vector<const base::Element*> chain_to(const JointsByChild& joints, std::string link) {
  std::vector<const base::Element*> chain;
  for (auto joint = joints.find(link); joint != joints.end() && chain.size() < joints.size();
       joint = joints.find(link)) {
    chain.push_back(joint->second);
    link = link_of(*joint->second, "parent");
  }
  std::reverse(chain.begin(), chain.end());
  return chain;
}

std::vector<const base::Element*> axes_to(const JointsByChild& joints, const std::string& link) {
  auto chain = chain_to(joints, link);
  chain.erase(std::remove_if(chain.begin(), chain.end(), [](const base::Element* one) { return !is_axis(*one); }),
              chain.end());
  return chain;
}

std::vector<const base::Element*> axes_of(const JointsByChild& joints) {
  std::vector<const base::Element*> best;
  std::optional<std::string> tool;
  for (const char* const name : {"tcp", "tool0"}) {
    tool = joints.contains(name) ? name : tool;
  }
  for (const auto& [link, joint] : joints) {
    auto chain = axes_to(joints, link);
    if (tool ? link == *tool : chain.size() > best.size()) {
      best = std::move(chain);
    }
  }
  return best;
}

}  // namespace

Result<std::vector<Joint>, std::vector<base::Diagnostic>> read_joints(const std::filesystem::path& file,
                                                                      const std::string& text) {
  const auto wrong = [&file](base::SourcePlace place, std::string what) {
    return base::Diagnostic{base::Diagnostic::Severity::Error, file.string(), place, std::move(what)};
  };
  std::vector<base::XmlMistake> mistakes;
  const auto root = base::read_xml(text, urdf_rules(), mistakes);
  std::vector<base::Diagnostic> errors;
  for (const base::XmlMistake& mistake : mistakes) {
    errors.push_back(wrong(mistake.place, mistake.text));
  }
  if (!root) {
    return errors;
  }
  JointsByChild by_child;
  for (const base::Element& element : root->children) {
    if (element.name == "joint" && child_of(element, "child") != nullptr) {
      by_child[link_of(element, "child")] = &element;
    }
  }
  std::vector<const base::Element*> axes = axes_of(by_child);
  if (const base::Element* const workpiece = child_of(*root, "workpiece"); workpiece != nullptr) {
    const auto more = axes_to(by_child, attribute_of(*workpiece, "link"));
    axes.insert(axes.end(), more.begin(), more.end());
  }
  std::vector<Joint> joints;
  for (const base::Element* const joint : axes) {
    joints.push_back(
        {attribute_of(*joint, "name"), attribute_of(*joint, "type") == "prismatic" ? kMillimetre : kDegree});
    if (joints.back().name.empty()) {
      errors.push_back(wrong(joint->place, "<joint> has no name; ROS needs one"));
    }
  }
  if (joints.empty()) {
    errors.push_back(wrong(root->place, "no joint moves between the root and the tool; is this the file of an arm?"));
  }
  if (!errors.empty()) {
    return errors;
  }
  return joints;
}

}  // namespace indurop::ros
