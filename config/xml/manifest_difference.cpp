// SPDX-License-Identifier: Apache-2.0
#include "config/xml/manifest_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>

#include "config/xml/element_rules.h"

namespace indurop::config {
namespace {

using base::Attribute;
using base::Element;

constexpr const char* kFileNameElement = "filename";

std::string text_of_child(const Element& element, const char* name) {
  const auto found = std::find_if(element.children.begin(), element.children.end(),
                                  [name](const Element& child) { return child.name == name; });
  return found == element.children.end() ? std::string() : found->text;
}

// Returns what people call the element: "module press", "<period>".
std::string manifest_title(const Element& element) {
  if (element.name == "module") {
    const std::string name = text_of_child(element, "name");
    return "module " +
           (name.empty() ? std::filesystem::path(text_of_child(element, kFileNameElement)).stem().string() : name);
  }
  const Attribute* const name = find_attribute(element, "name");
  return name == nullptr ? fmt::format("<{}>", element.name) : fmt::format("{} {}", element.name, name->value);
}

class ManifestComparison {
 public:
  // `where`: what the elements are in, "board a, module press: ".
  std::string compare(const Element& before, const Element& after, const std::string& where) {
    if (manifest_title(before) != manifest_title(after)) {
      return fmt::format("{}{} is in place of {}", where, manifest_title(after), manifest_title(before));
    }
    for (const Attribute& attribute : after.attributes) {
      const Attribute* const then = find_attribute(before, attribute.name);
      if (then == nullptr || then->value != attribute.value) {
        return fmt::format("{}{}: {} was '{}' and is '{}'", where, manifest_title(after), attribute.name,
                           then == nullptr ? "" : then->value, attribute.value);
      }
    }
    if (before.attributes.size() > after.attributes.size()) {
      return fmt::format("{}{} has lost an attribute", where, manifest_title(after));
    }
    if (before.text != after.text && after.name != kFileNameElement) {
      return fmt::format("{}{} was {} and is {}", where, manifest_title(after), before.text, after.text);
    }
    return compare_children(before, after, inside(after, where));
  }

 private:
  static std::string inside(const Element& element, const std::string& where) {
    return element.name == "plant" ? std::string()
           : where.empty()         ? manifest_title(element) + ": "
                                   : where.substr(0, where.size() - 2) + ", " + manifest_title(element) + ": ";
  }

  std::string compare_children(const Element& before, const Element& after, const std::string& where) {
    const std::size_t common = std::min(before.children.size(), after.children.size());
    const bool same_number = before.children.size() == after.children.size();
    for (std::size_t i = 0; i < common; ++i) {
      const bool shifted = !same_number && manifest_title(before.children[i]) != manifest_title(after.children[i]);
      if (shifted) {
        return described(before, after, i, where);
      }
      if (std::string difference = compare(before.children[i], after.children[i], where); !difference.empty()) {
        return difference;
      }
    }
    return same_number ? "" : described(before, after, common, where);
  }

  // Of different numbers of children, the first that has no partner.
  static std::string described(const Element& before, const Element& after, std::size_t at, const std::string& where) {
    const bool is_new = after.children.size() > before.children.size();
    return fmt::format("{}{} is {}", where, manifest_title((is_new ? after : before).children[at]),
                       is_new ? "new" : "gone");
  }
};

}  // namespace

std::string manifest_difference(const Element& before, const Element& after) {
  return ManifestComparison().compare(before, after, "");
}

}  // namespace indurop::config
