// SPDX-License-Identifier: Apache-2.0
// Finds what has a name, and the known name closest to a misspelled one. This library stands alone: it does not contain
// core/base/text.h.

#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::robot {

// Returns "; did you mean 'pallet'?", or nothing if no known name is close.
std::string meant(std::string_view name, const std::vector<std::string>& known);

// Returns the one of that name; null if there is none.
template <class T>
const T* named(const std::vector<T>& all, std::string_view name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const T& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}

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
