// SPDX-License-Identifier: Apache-2.0
// Reads what copy_text() (copy_text.h) or another process left in a field of fixed size.

#pragma once

#include <cstddef>
#include <cstring>
#include <string>

namespace indurop::rt {

// Returns the text up to its terminator, all of the field if there is none. Not real-time safe.
template <std::size_t N>
std::string text_of(const char (&from)[N]) {
  return {from, ::strnlen(from, N)};
}

}  // namespace indurop::rt
