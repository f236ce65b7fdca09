// SPDX-License-Identifier: Apache-2.0
// Code that runs once, before the first scan: FB_Init of instances, and initial values known only at run time.

#pragma once

#include <string_view>

#include "control/plc/check/context.h"

namespace indurop::plc {

inline constexpr std::string_view kInit = "FB_Init";
// A method that the checker makes for POUs that have variables to start.
inline constexpr std::string_view kStart = "@start";

// Writes these methods, and calls of FB_Init for instances that last for one call only. Requires the variables of all
// POUs.
void declare_starts(Context& context);
// Records which POUs need the start of a global. Requires checked bodies.
void use_starts(Context& context);

}  // namespace indurop::plc
