// SPDX-License-Identifier: Apache-2.0
// What manifests and module.xml say about variables beyond modules: topics for tools of others, libraries of their
// types, rules for single variables.

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "base/xml_element.h"
#include "config/model/config.h"
#include "config/xml/element_rules.h"

namespace indurop::config {

// A number of a DDS domain; empty after an error, which ends with `more`.
std::optional<int> domain_of(const base::Element& element, const std::string& text, const char* more,
                             base::Diagnostics& report);
// The attribute's value; empty if it is not there, or after an error if `problem` has one.
std::string optional_attribute(const base::Element& element, const char* name,
                               const std::function<std::string(const std::string&)>& problem,
                               base::Diagnostics& report);
// Whether this attribute, which may be "on", "off" or missing, is "on".
bool is_on(const base::Element& element, const char* name, base::Diagnostics& report);
// One <types>.
void read_type_file(const base::Element& element, const std::filesystem::path& folder, TypeFiles& named,
                    base::Diagnostics& report);
// One <variable> that may have these attributes. Empty after an error, or a second one for the same variable.
std::optional<VariableRule> read_rule(const base::Element& element, const std::vector<std::string>& attributes,
                                      FirstPlaces& rules, base::Diagnostics& report);

// <external>, <types> and <variable> of a <root>.
class ExternalReader {
 public:
  ExternalReader(ExternalPlane& plane, const std::filesystem::path& folder, base::Diagnostics& report)
      : plane_(plane), folder_(folder), report_(report) {}

  // False: it is none of them.
  bool read(const base::Element& element);
  void end();

 private:
  void read_external(const base::Element& element);

  ExternalPlane& plane_;
  const std::filesystem::path& folder_;
  base::Diagnostics& report_;
  FirstPlaces given_;
  FirstPlaces rules_;
};

}  // namespace indurop::config
