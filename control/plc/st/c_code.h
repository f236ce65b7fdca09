// SPDX-License-Identifier: Apache-2.0
// C code in the pragmas of Beremiz and OpenPLC, as far as it is supported: reading the time since the start.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace indurop::plc::st {

// x = __tick * common_ticktime__ / 1000000
struct TimeBase {
  std::string variable;      // the assigned variable "TX", in capitals
  std::int64_t unit_ns = 1;  // unit of the assigned number
};

// Returns the assignment of the time that the code, with its braces, makes; none if it does anything else.
[[nodiscard]] std::optional<TimeBase> time_base(std::string_view code);

}  // namespace indurop::plc::st
