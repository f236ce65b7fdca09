// SPDX-License-Identifier: Apache-2.0
// C's format strings over arguments that know their type. Never reads what is not there: a conversion that does not
// fit its argument prints the argument as what it is.

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
