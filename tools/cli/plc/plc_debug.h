// SPDX-License-Identifier: Apache-2.0
// indurop plc debug: a program in simulation with breakpoints and single steps.

#pragma once

#include <memory>

#include "tools/cli/command/verb.h"

namespace indurop::tools {

void add_plc_debug(base::Options& app, const std::shared_ptr<Action>& chosen);

}  // namespace indurop::tools
