// SPDX-License-Identifier: Apache-2.0
// Words for people: who they are, and when something was.

#pragma once

#include <cstdint>
#include <string>

namespace indurop::tools {

// Of who runs this program.
std::string user_name();
// "2026-11-22 03:10:21", of CLOCK_REALTIME, in the time zone of this machine.
std::string local_time(std::int64_t wall_ns);

}  // namespace indurop::tools
