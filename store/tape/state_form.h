// SPDX-License-Identifier: Apache-2.0
// The form of a keyframe: text that says what its bytes are, with a line for each variable, "name, tab, type, tab,
// bytes".

#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace indurop::tape {

// The type of the line for the bytes of a module's own functions. It has no name, and is the last one.
inline constexpr std::string_view kFormOfFunctions = "bytes of its save()";

struct FormLine {
  std::string_view name;
  std::string_view type;
  std::size_t size = 0;
};

// Takes the first line off a form; nullopt: it is none.
std::optional<FormLine> take_line(std::string_view& form);

}  // namespace indurop::tape
