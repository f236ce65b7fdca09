// SPDX-License-Identifier: Apache-2.0
// Copies text into a field of fixed size, as the structures in shared memory have them.

#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace indurop::rt {

// Copies as much of `from` as fits, always terminated. Bytes after the terminator stay unchanged. Real-time safe.
template <std::size_t N>
void copy_text(char (&to)[N], std::string_view from) noexcept {
  const std::size_t length = std::min(from.size(), N - 1);
  from.copy(to, length);  // unlike memcpy, also of nothing
  to[length] = '\0';
}

}  // namespace indurop::rt
