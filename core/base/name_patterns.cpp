// SPDX-License-Identifier: Apache-2.0
#include "core/base/name_patterns.h"

#include <fnmatch.h>

#include <algorithm>

namespace indurop::base {

bool matches_any(const std::vector<std::string>& patterns, const std::string& name) {
  return patterns.empty() || std::any_of(patterns.begin(), patterns.end(), [&name](const std::string& pattern) {
           return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
         });
}

bool matches_any_variable(const std::vector<std::string>& patterns, const std::string& name) {
  return matches_any(patterns, name.substr(0, name.find_first_of(".["))) || matches_any(patterns, name);
}

}  // namespace indurop::base
