// SPDX-License-Identifier: Apache-2.0
// Prints values of a running program in the notation of its language.

#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "control/plc/check/type.h"

namespace indurop::plc {

// Returns T#100ms, Red, 'text', (x := 1, y := 2); for arrays the bounds and the first elements: [1..3] 5, 6, 7.
// `bytes`: the packed value (watch_layout.h), "?" if it is too short.
[[nodiscard]] std::string value_text(const Type& type, std::span<const std::uint8_t> bytes);

}  // namespace indurop::plc
