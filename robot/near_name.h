// SPDX-License-Identifier: Apache-2.0
// Which name of those that are known was meant by one that is not. This library stands alone: base/text.h is not in it.

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace indurop::robot {

// "; did you mean 'pallet'?", or nothing if none is near.
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

// "there is no frame 'palet'; did you mean 'pallet'?", or how to declare it, behind its name.
template <class List>
std::string no_such(const char* what, const std::string& name, const List& list, const char* keyword,
                    const char* example) {
  const std::string near = meant(name, names_of(list));
  return std::string("there is no ") + what + " '" + name + "'" +
         (near.empty() ? std::string("; declare it, ") + keyword + " " + name + " = " + example : near);
}

}  // namespace indurop::robot
