// SPDX-License-Identifier: Apache-2.0
// Functions that no program can name: what C code of other editors and built-in blocks stand for.

#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "plc/library/standard.h"

namespace indurop::plc {

inline constexpr std::string_view kLogMessage = "@LOG";  // (LEVEL INT, MSG STRING): BOOL
// The time since the start as a number of nanoseconds, microseconds or milliseconds, of the type that is wanted.
inline constexpr std::string_view kTicksNs = "@TICKS_NS";
inline constexpr std::string_view kTicksUs = "@TICKS_US";
inline constexpr std::string_view kTicksMs = "@TICKS_MS";

// ADD_INT, GT_REAL: what a function with the type in its name means; none if there is no such function.
[[nodiscard]] std::vector<const LibraryFunction*> find_typed(std::string_view name);

// `wanted`: the type of the result, where the function has several. Null: there is none.
[[nodiscard]] const LibraryFunction* find_hidden(std::string_view name, std::optional<Elementary> wanted);

}  // namespace indurop::plc
