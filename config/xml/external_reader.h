// SPDX-License-Identifier: Apache-2.0
// Reads what manifests and module.xml set for variables beyond modules: topics for third-party tools, libraries of
// their types, rules for single variables.

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/model/config.h"
#include "config/xml/element_rules.h"
#include "core/base/diagnostics.h"
#include "core/base/xml_element.h"

namespace indurop::config {

// Returns the number of a DDS domain; nothing after an error, which ends with `more`.
std::optional<int> domain_of(const base::Element& element, const std::string& text, const char* more,
                             base::Diagnostics& report);
// Returns the attribute's value; empty if it is absent, or after an error reported because `problem` returned one.
std::string optional_attribute(const base::Element& element, const char* name,
                               const std::function<std::string(const std::string&)>& problem,
                               base::Diagnostics& report);
// Reads the value of an attribute `every`: a time up to one hour. Returns what is wrong with it; empty if nothing is.
std::string every_problem(const std::string& text, base::Nanos& every);
// Returns true if this attribute is "on"; it may be "on", "off" or absent.
bool is_on(const base::Element& element, const char* name, base::Diagnostics& report);
// Reads one <types>.
void read_type_file(const base::Element& element, const std::filesystem::path& folder, TypeFiles& named,
                    base::Diagnostics& report);
// Reads one <variable> that may have these attributes. Returns nothing after an error, or for a duplicate of a
// variable.
std::optional<VariableRule> read_rule(const base::Element& element, const std::vector<std::string>& attributes,
                                      FirstPlaces& rules, base::Diagnostics& report);

// Reads <external>, <types> and <variable> of a <root>.
class ExternalReader {
 public:
  ExternalReader(ExternalPlane& plane, const std::filesystem::path& folder, base::Diagnostics& report)
      : plane_(plane), folder_(folder), report_(report) {}

  // Returns false if the element is none of them.
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
