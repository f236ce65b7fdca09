// SPDX-License-Identifier: Apache-2.0
// Converts the device's number to the bytes of a variable and back: variable = number * scale + offset. Real-time safe.

#pragma once

#include <cstdint>

#include "control/io/sample.h"
#include "core/schema/schema.h"

namespace indurop::io {

struct Scaling {
  schema::Base base = schema::Base::Int32;  // of the variable; a number, bool, char or enum
  double scale = 1;
  double offset = 0;
};

// The first size_of(base) bytes of `bits` in memory are the variable's. A value that does not fit is replaced by the
// nearest one, and false is returned; NaN to an integer returns false and leaves `bits` unchanged.
bool to_variable(const Scaling& scaling, Number value, std::uint64_t& bits) noexcept;
// Converts a value in the variable's own units, without scale and offset.
bool to_variable(schema::Base base, Number value, std::uint64_t& bits) noexcept;
Number from_variable(const Scaling& scaling, std::uint64_t bits) noexcept;

}  // namespace indurop::io
