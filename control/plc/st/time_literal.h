// SPDX-License-Identifier: Apache-2.0
// Durations and calendar times as literals of IEC 61131-3 write them, in nanoseconds.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "control/plc/model/elementary.h"

namespace indurop::plc::st {

struct TimeValue {
  std::optional<std::int64_t> ns;
  std::string why;  // no value: what is wrong and what to do
};

// Evaluates "1h2m3s4ms", "-1.5s", "25h_15m": units d h m s ms us ns, descending, a fraction only in the last one.
[[nodiscard]] TimeValue duration(std::string_view text);
// Evaluates DATE "2024-01-31", TIME_OF_DAY "12:30:15.5", DATE_AND_TIME "2024-01-31-12:30:15": since 1970, or since
// midnight.
[[nodiscard]] TimeValue date_or_time(Elementary type, std::string_view text);

}  // namespace indurop::plc::st
