// SPDX-License-Identifier: Apache-2.0
#include "store/vars/unmatched_patterns.h"

#include <algorithm>

namespace indurop::vars {

std::vector<std::string> unmatched_patterns(const Store& store, const std::vector<std::string>& globs) {
  std::vector<std::string> none = globs;
  std::erase_if(none, [&](const std::string& glob) {
    const auto all = store.directory();
    return std::any_of(all.begin(), all.end(), [&](const DirectoryEntry& entry) {
      return schema::glob_match(glob, store.schema().variables[entry.schema_index].name);
    });
  });
  return none;
}

}  // namespace indurop::vars
