// SPDX-License-Identifier: Apache-2.0
// Reads the attributes of one element as values. Attributes that are not read are unknown: finish() reports them.

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/base/duration.h"
#include "core/base/xml_element.h"

namespace indurop::config {

class Attributes {
 public:
  // Borrows both arguments.
  Attributes(const base::Element& element, base::Diagnostics& report) : element_(element), report_(report) {}

  // Each returns nothing if the attribute is absent or wrong; a wrong one is reported with a correction.
  std::optional<std::string> text(const char* name, base::SourcePlace* place = nullptr);
  std::optional<std::int64_t> integer(const char* name, std::int64_t low, std::int64_t high);
  std::optional<double> real(const char* name, double low, double high);
  std::optional<base::Nanos> duration(const char* name, base::Nanos least, base::Nanos most);
  std::optional<std::size_t> choose(const char* name, const std::vector<std::string>& words);
  // Like text(), but it is an error if the attribute is absent or empty.
  std::optional<std::string> need(const char* name, std::string_view example, base::SourcePlace* place = nullptr);

  // Reports attributes that were not read. `where` as in "of <device driver=\"csv\">"; empty: the element's name.
  void finish(const std::string& where = {});

  [[nodiscard]] base::Diagnostics& report() noexcept { return report_; }

 private:
  const base::Attribute* find(const char* name);

  const base::Element& element_;
  base::Diagnostics& report_;
  std::vector<std::string> asked_;
};

}  // namespace indurop::config
