// SPDX-License-Identifier: Apache-2.0
// Writes one field of a struct in the bytes of its value.

#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "core/schema/schema.h"

namespace indurop::schema {

// Each returns false, with `bytes` unchanged: there is no such field, it has another type, or cannot hold the value.
// A number, also of an enumerator; true is 1.
[[nodiscard]] bool write_field(const Type& type, std::string_view field, double value, std::span<std::uint8_t> bytes);
// All numbers of an array of one dimension.
[[nodiscard]] bool write_field(const Type& type, std::string_view field, std::span<const double> values,
                               std::span<std::uint8_t> bytes);
// A text.
[[nodiscard]] bool write_field(const Type& type, std::string_view field, std::string_view text,
                               std::span<std::uint8_t> bytes);

}  // namespace indurop::schema
