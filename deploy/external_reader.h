// SPDX-License-Identifier: Apache-2.0
// What manifests and module.xml say about variables beyond modules: topics for tools of others, libraries of their
// types, rules for single variables.

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "deploy/config.h"
#include "deploy/element.h"
#include "deploy/element_rules.h"
#include "deploy/report.h"

namespace indurop::deploy {

// A number of a DDS domain; empty after an error, which ends with `more`.
std::optional<int> domain_of(const Element& element, const std::string& text, const char* more, Report& report);
// The attribute's value; empty if it is not there, or after an error if `problem` has one.
std::string optional_attribute(const Element& element, const char* name,
                               const std::function<std::string(const std::string&)>& problem, Report& report);
// What ros2="on" or "off" of an <external> says.
bool has_ros2_names(const Element& element, Report& report);
// One <types>.
void read_type_file(const Element& element, const std::filesystem::path& folder, TypeFiles& named, Report& report);
// One <variable> that may have these attributes. Empty after an error, or a second one for the same variable.
std::optional<VariableRule> read_rule(const Element& element, const std::vector<std::string>& attributes,
                                      FirstPlaces& rules, Report& report);

// <external>, <types> and <variable> of a <root>.
class ExternalReader {
 public:
  ExternalReader(ExternalPlane& plane, const std::filesystem::path& folder, Report& report)
      : plane_(plane), folder_(folder), report_(report) {}

  // False: it is none of them.
  bool read(const Element& element);
  void end();

 private:
  void read_external(const Element& element);

  ExternalPlane& plane_;
  const std::filesystem::path& folder_;
  Report& report_;
  FirstPlaces given_;
  FirstPlaces rules_;
};

}  // namespace indurop::deploy
