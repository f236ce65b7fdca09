// SPDX-License-Identifier: Apache-2.0
// Values on the command line in IEC 61131-3 notation: T#100ms, D#2024-01-31, 16#FF, TRUE, INT#5, 'text'.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/schema/schema.h"

namespace indurop::tools {

// Returns false, and leaves `bytes` unchanged, if the text is not such a literal, or not of this type.
[[nodiscard]] bool parse_plc_literal(const schema::Type& type, std::string_view text, std::span<std::uint8_t> bytes);

}  // namespace indurop::tools
