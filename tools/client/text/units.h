// SPDX-License-Identifier: Apache-2.0
// Numbers and texts formatted for people.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace indurop::tools {

// Three significant digits with unit: "812 ns", "12.3 us", "1.24 ms", "3.02 s", "-12.3 us".
std::string human_ns(std::int64_t ns);
// Coarse, for ages and uptimes: "3.2 s", "4 min 12 s", "2 h 05 min", "3 d 4 h".
std::string human_age(std::int64_t ns);
// "512 B", "1.5 KiB", "206 MiB".
std::string human_bytes(std::uint64_t bytes);
// "2026-11-22 03:10:21", of CLOCK_REALTIME, in the time zone of this machine.
std::string local_time(std::int64_t wall_ns);
// Replaces control characters (terminal escapes in text of others) and invalid UTF-8 by '?'.
std::string printable(std::string_view text);
// Number of columns `text` takes on a terminal: code points, combining marks not considered.
std::size_t display_width(std::string_view text);

}  // namespace indurop::tools
