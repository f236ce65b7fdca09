// SPDX-License-Identifier: Apache-2.0
// Values of shared variables in IEC 61131-3 notation: T#100ms, D#2024-01-31, 16#FF, TRUE, INT#5, 'text'.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/schema/schema.h"

namespace indurop::plc {

// Returns false, and leaves `bytes` unchanged, if the text is not such a literal, or not of this type.
[[nodiscard]] bool read_value_literal(const schema::Type& type, std::string_view text, std::span<std::uint8_t> bytes);

}  // namespace indurop::plc
