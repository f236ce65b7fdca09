// SPDX-License-Identifier: Apache-2.0
// The known name closest to a misspelled one. This library stands alone: it does not contain core/base/text.h.

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace indurop::robot {

// Returns "; did you mean 'pallet'?", or nothing if no known name is close.
std::string meant(std::string_view name, const std::vector<std::string>& known);

template <class List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  names.reserve(list.size());
  for (const auto& one : list) {
    names.push_back(one.name);
  }
  return names;
}

// Returns "there is no frame 'palet'; did you mean 'pallet'?", or, after the name, how to declare it.
std::string no_such(const char* what, const std::string& name, const std::vector<std::string>& known,
                    const char* keyword, const char* example);

}  // namespace indurop::robot
