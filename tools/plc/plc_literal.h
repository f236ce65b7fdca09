// SPDX-License-Identifier: Apache-2.0
// Values on the command line as a PLC programmer writes them: T#100ms, D#2024-01-31, 16#FF, TRUE, INT#5, 'text'.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "schema/schema.h"

namespace indurop::tools {

// False, and `bytes` as they were, if it is no such literal, or none of this type.
[[nodiscard]] bool parse_plc_literal(const schema::Type& type, std::string_view text, std::span<std::uint8_t> bytes);

}  // namespace indurop::tools
