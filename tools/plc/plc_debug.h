// SPDX-License-Identifier: Apache-2.0
// indurop plc debug: a program in simulation that stands at breakpoints and goes on line by line.

#pragma once

#include <memory>

#include "tools/command/verb.h"

namespace indurop::tools {

void add_plc_debug(base::Options& app, const std::shared_ptr<Action>& chosen);

}  // namespace indurop::tools
