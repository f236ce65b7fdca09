// SPDX-License-Identifier: Apache-2.0
// Functions that no program can name: they implement C code of other editors and built-in blocks.

#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "control/plc/library/standard.h"

namespace indurop::plc {

inline constexpr std::string_view kLogMessage = "@LOG";  // (LEVEL INT, MSG STRING): BOOL
// The time since the start in nanoseconds, microseconds or milliseconds, as a number of the required type.
inline constexpr std::string_view kTicksNs = "@TICKS_NS";
inline constexpr std::string_view kTicksUs = "@TICKS_US";
inline constexpr std::string_view kTicksMs = "@TICKS_MS";

// Returns the function for a name that contains the type: ADD_INT, GT_REAL; none if there is no such function.
[[nodiscard]] std::vector<const LibraryFunction*> find_typed(std::string_view name);

// `wanted`: the required type of the result, if the function has several. Returns null if there is none.
[[nodiscard]] const LibraryFunction* find_hidden(std::string_view name, std::optional<Elementary> wanted);

}  // namespace indurop::plc
