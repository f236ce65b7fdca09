// SPDX-License-Identifier: Apache-2.0
// An XML document as nodes with places that name the file. It does not interpret the elements.

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "control/plc/model/diagnostics.h"
#include "control/plc/model/source_place.h"

namespace indurop::plc::plcopen {

inline constexpr std::size_t kMaxXmlSize = std::size_t{64} * 1024 * 1024;
inline constexpr std::size_t kMaxXmlDepth = 64;
inline constexpr std::size_t kMaxXmlAttributes = 64;  // of one element

struct Attribute {
  std::string name;  // without a namespace prefix, as all names here
  std::string value;
  base::SourcePlace value_at;  // place of its first character
};

struct Node {
  std::string name;
  Place at;          // of '<'
  std::string text;  // text of the node with its white space, without that of children
  Place text_at;     // place where the text begins; of the element if it has none
  std::vector<Attribute> attributes;
  std::vector<Node> children;

  // Returns the value of an attribute, "" if it is missing.
  [[nodiscard]] std::string_view attribute(std::string_view wanted) const noexcept;
  [[nodiscard]] bool has(std::string_view wanted) const noexcept;
  // Returns true if the attribute is there and says so, as XML Schema writes it: "true" or "1".
  [[nodiscard]] bool is_true(std::string_view wanted) const noexcept;
  // Returns the place where the value begins; that of the element if the attribute is missing.
  [[nodiscard]] Place value_at(std::string_view wanted) const;
  // Returns the first child of that name, or null.
  [[nodiscard]] const Node* child(std::string_view wanted) const noexcept;
};

// Returns the children of the node; empty if it is null.
[[nodiscard]] const std::vector<Node>& children_of(const Node* node) noexcept;

// Returns the root element, or empty after errors: too large, not UTF-8 or UTF-16, too deep, not well-formed.
[[nodiscard]] std::optional<Node> read_xml(std::string_view bytes, const std::shared_ptr<const std::string>& file,
                                           Diagnostics& diagnostics);

}  // namespace indurop::plc::plcopen
