// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/command/pattern_option.h"

#include <utility>

#include "core/keys/variable_rights.h"

namespace indurop::tools {

void add_pattern_option(base::Options& verb, const char* name, std::vector<std::string>& to, const char* help) {
  const auto take = [&to](const std::string& text) {
    std::string wrong;
    for (std::string& pattern : keys::pattern_list(text)) {
      wrong = wrong.empty() ? keys::pattern_problem(pattern) : wrong;
      to.push_back(std::move(pattern));
    }
    return wrong;
  };
  verb.add(name, "PATTERNS", take, help);
}

}  // namespace indurop::tools
