// SPDX-License-Identifier: Apache-2.0
#include "control/plc/plcopen/xml.h"

#include <algorithm>

#include "core/base/xml.h"

namespace indurop::plc::plcopen {
namespace {

std::string local_name(std::string_view whole) {
  const std::size_t colon = whole.find(':');
  return std::string(colon == std::string_view::npos ? whole : whole.substr(colon + 1));
}

constexpr base::XmlRules kRules{"PLCopen file",
                                "a <project> with types and instances",
                                "PLC program",
                                kMaxXmlSize,
                                kMaxXmlDepth,
                                kMaxXmlAttributes,
                                true};

// Adds the name of the file to every place, and removes prefixes from names.
Node node_of(base::Element&& from, const std::shared_ptr<const std::string>& file) {
  Node node;
  node.name = local_name(from.name);
  node.at = {from.place, file, nullptr};
  node.text = std::move(from.text);
  node.text_at = {from.text_place, file, nullptr};
  for (base::Attribute& attribute : from.attributes) {
    node.attributes.push_back({local_name(attribute.name), std::move(attribute.value), attribute.value_place});
  }
  for (base::Element& child : from.children) {
    node.children.push_back(node_of(std::move(child), file));
  }
  return node;
}

}  // namespace

std::string_view Node::attribute(std::string_view wanted) const noexcept {
  for (const Attribute& each : attributes) {
    if (each.name == wanted) {
      return each.value;
    }
  }
  return {};
}

Place Node::value_at(std::string_view wanted) const {
  Place out = at;
  for (const Attribute& each : attributes) {
    if (each.name == wanted) {
      out.line = each.value_at.line;
      out.column = each.value_at.column;
    }
  }
  return out;
}

bool Node::has(std::string_view wanted) const noexcept {
  return std::any_of(attributes.begin(), attributes.end(), [&](const Attribute& each) { return each.name == wanted; });
}

bool Node::is_true(std::string_view wanted) const noexcept {
  const std::string_view value = attribute(wanted);
  return value == "true" || value == "1";
}

const Node* Node::child(std::string_view wanted) const noexcept {
  for (const Node& each : children) {
    if (each.name == wanted) {
      return &each;
    }
  }
  return nullptr;
}

const std::vector<Node>& children_of(const Node* node) noexcept {
  static const std::vector<Node> kNone;
  return node == nullptr ? kNone : node->children;
}

std::optional<Node> read_xml(std::string_view bytes, const std::shared_ptr<const std::string>& file,
                             Diagnostics& diagnostics) {
  std::vector<base::XmlMistake> mistakes;
  auto root = base::read_xml(bytes, kRules, mistakes);
  for (base::XmlMistake& mistake : mistakes) {
    diagnostics.error({mistake.place, file, nullptr}, std::move(mistake.text));
  }
  return root ? std::optional(node_of(std::move(*root), file)) : std::nullopt;
}

}  // namespace indurop::plc::plcopen
