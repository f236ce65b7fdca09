// SPDX-License-Identifier: Apache-2.0
#include "config/xml/manifest_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <vector>

#include "config/xml/element_rules.h"

namespace indurop::config {
namespace {

using base::Attribute;
using base::Element;

constexpr const char* kFileNameElement = "filename";
constexpr const char* kModuleElement = "module";
constexpr const char* kPoolElement = "pool";
// What of a module another schedule may change.
constexpr std::array<std::string_view, 8> kScheduleElements{"period", "offset",   "deadline", "wcet",
                                                            "budget", "priority", "overrun",  "after"};

std::string text_of_child(const Element& element, const char* name) {
  const auto found = std::find_if(element.children.begin(), element.children.end(),
                                  [name](const Element& child) { return child.name == name; });
  return found == element.children.end() ? std::string() : found->text;
}

// Returns what people call the element: "module press", "<period>".
std::string manifest_title(const Element& element) {
  if (element.name == kModuleElement) {
    const std::string name = text_of_child(element, "name");
    return "module " +
           (name.empty() ? std::filesystem::path(text_of_child(element, kFileNameElement)).stem().string() : name);
  }
  const Attribute* const name = find_attribute(element, "name");
  return name == nullptr ? fmt::format("<{}>", element.name) : fmt::format("{} {}", element.name, name->value);
}

class ManifestComparison {
 public:
  explicit ManifestComparison(ComparedElements compared) : compared_(compared) {}

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

  using Children = std::vector<const Element*>;

  std::string compare_children(const Element& before, const Element& after, const std::string& where) {
    const Children old = children_of(before);
    const Children now = children_of(after);
    const std::size_t common = std::min(old.size(), now.size());
    const bool same_number = old.size() == now.size();
    for (std::size_t i = 0; i < common; ++i) {
      const bool shifted = !same_number && manifest_title(*old[i]) != manifest_title(*now[i]);
      if (shifted) {
        return described(old, now, i, where);
      }
      if (std::string difference = compare(*old[i], *now[i], where); !difference.empty()) {
        return difference;
      }
    }
    return same_number ? compare_modules(before, after, where) : described(old, now, common, where);
  }

  // Those that are compared in their order.
  [[nodiscard]] Children children_of(const Element& element) const {
    Children children;
    for (const Element& child : element.children) {
      const bool of_schedule =
          element.name == kModuleElement
              ? std::find(kScheduleElements.begin(), kScheduleElements.end(), child.name) != kScheduleElements.end()
              : child.name == kModuleElement || (element.name == "plant" && child.name == kPoolElement);
      if (compared_ == ComparedElements::All || !of_schedule) {
        children.push_back(&child);
      }
    }
    return children;
  }

  // Without a schedule they have no order.
  std::string compare_modules(const Element& before, const Element& after, const std::string& where) {
    for (const Element& module : compared_ == ComparedElements::All ? std::vector<Element>() : after.children) {
      const auto then = std::find_if(before.children.begin(), before.children.end(), [&module](const Element& one) {
        return one.name == kModuleElement && manifest_title(one) == manifest_title(module);
      });
      if (module.name == kModuleElement && then != before.children.end()) {
        if (std::string difference = compare(*then, module, where); !difference.empty()) {
          return difference;
        }
      }
    }
    return "";
  }

  // Of different numbers of children, the first that has no partner.
  static std::string described(const Children& before, const Children& after, std::size_t at,
                               const std::string& where) {
    const bool is_new = after.size() > before.size();
    return fmt::format("{}{} is {}", where, manifest_title(*(is_new ? after : before)[at]), is_new ? "new" : "gone");
  }

  ComparedElements compared_;
};

}  // namespace

std::string manifest_difference(const Element& before, const Element& after, ComparedElements compared) {
  return ManifestComparison(compared).compare(before, after, "");
}

}  // namespace indurop::config
