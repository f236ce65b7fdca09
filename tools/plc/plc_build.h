// SPDX-License-Identifier: Apache-2.0
// indurop plc build and check: from the files of a PLC program to modules that a node loads.

#pragma once

#include <memory>

#include "tools/command/verb.h"

namespace indurop::tools {

// Adds the subcommands; once one was parsed, `chosen` is what to do.
void add_plc_build(base::Options& app, const std::shared_ptr<Action>& chosen);

}  // namespace indurop::tools
