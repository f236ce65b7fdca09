// SPDX-License-Identifier: Apache-2.0
// Memory lent to a sample while it is written: C structures have no const members, but DDS only reads the sample and
// copies it before dds_write returns.

#pragma once

#include <string>

namespace indurop::dds {

template <class T>
T* lent(const T* memory) noexcept {
  return const_cast<T*>(memory);  // NOLINT(cppcoreguidelines-pro-type-const-cast): see above
}
inline char* lent(const std::string& text) noexcept {
  return lent(text.c_str());
}

}  // namespace indurop::dds
