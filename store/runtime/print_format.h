// SPDX-License-Identifier: Apache-2.0
// C's format strings for arguments that know their type. Never reads beyond the arguments: if a conversion does not
// match its argument, the argument is printed according to its own type.

#pragma once

#include <indurop/detail/print_argument.h>

#include <cstddef>
#include <span>

namespace indurop::runtime {

// Writes at most `size` - 1 bytes and a NUL into `to` (size >= kCutMark + 1); longer text is cut and ends with
// "[cut]\n". Returns the bytes written without the NUL. Real-time safe.
std::size_t format_message(char* to, std::size_t size, const char* format,
                           std::span<const detail::PrintArgument> arguments) noexcept;
inline constexpr std::size_t kCutMark = 6;

}  // namespace indurop::runtime
