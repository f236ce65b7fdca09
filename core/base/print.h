// SPDX-License-Identifier: Apache-2.0
// Text to a standard stream.

#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

namespace indurop::base {

// If the stream cannot be written (a full disk, a reader that has ended), the text is lost and nothing else happens;
// what {fmt} offers throws then, which would end a node. Thread-safe as stdio is, not real-time safe.
template <class... Arguments>
void print(std::FILE* to, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  const std::string text = fmt::format(format, std::forward<Arguments>(arguments)...);
  (void)std::fwrite(text.data(), 1, text.size(), to);
}

}  // namespace indurop::base
