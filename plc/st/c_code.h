// SPDX-License-Identifier: Apache-2.0
// C code in the pragmas of Beremiz and OpenPLC, as far as it has a meaning here: the time since the start.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace indurop::plc::st {

// x = __tick * common_ticktime__ / 1000000
struct TimeBase {
  std::string variable;      // "TX", as C has it, in capitals
  std::int64_t unit_ns = 1;  // of what it becomes a number of
};

// What the code, with its braces, gives to a variable; none if it does anything else.
[[nodiscard]] std::optional<TimeBase> time_base(std::string_view code);

}  // namespace indurop::plc::st
