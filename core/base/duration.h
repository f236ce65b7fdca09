// SPDX-License-Identifier: Apache-2.0
// Durations as text, the one reader and writer for all programs: "100us", "0.5ms", "2 s", "1h", "10kHz".

#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace indurop::base {

using Nanos = std::chrono::nanoseconds;

// A duration or, in `problem`, what is wrong with the text and what to write instead.
struct DurationText {
  std::optional<Nanos> value;
  std::string problem;
};
// The unit of a number without one: nanoseconds in files, seconds on command lines.
enum class PlainNumber : bool { Nanoseconds, Seconds };
DurationText read_duration(std::string_view text, bool zero_allowed, PlainNumber plain = PlainNumber::Nanoseconds);

// Reads "500000" (ns), "100us", "1ms", "0.5ms", "2s", "1h", "10kHz". Empty if not a duration or not positive.
std::optional<Nanos> parse_duration(std::string_view text);
// Writes the shortest exact form: "100 us", "1 ms", "2.5 ms".
std::string format_duration(Nanos value);

}  // namespace indurop::base
