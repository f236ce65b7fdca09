// SPDX-License-Identifier: Apache-2.0
// Values of shared variables as CDR, the encoding of DDS: XCDR1 without member headers, little endian, alignment up to
// 8, as described by the IDL of history/recording/omg_idl.h. Enums are int32, text is a string, bool a byte of 0 or 1.

#pragma once

#include <indurop/result.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/schema/schema.h"

namespace indurop::recording {

// Writes `value`, the bytes of a variable of this type in memory, to `cdr`, whose capacity is reused. Errors:
// InvalidArgument if `value` has not type.size() bytes.
Status to_cdr(const schema::Type& type, std::span<const std::uint8_t> value, std::vector<std::uint8_t>& cdr);

// Returns true if to_cdr() of any value of this type is kCdrHead and the value's bytes in memory: numbers without gaps.
bool lies_as_cdr(const schema::Type& type);
// The header: CDR in little endian, no options. Alignment counts from its end.
inline constexpr std::array<std::uint8_t, 4> kCdrHead{0, 1, 0, 0};

// The reverse. Padding and the bytes after a text's NUL become 0. After an error `value` is undefined. Errors:
// InvalidArgument as above, Unsupported if another encoding is announced, Corrupt if `cdr` is no value of this type
// (too short, too long, text that does not fit, a bool other than 0 or 1).
Status from_cdr(const schema::Type& type, std::span<const std::uint8_t> cdr, std::span<std::uint8_t> value);

}  // namespace indurop::recording
