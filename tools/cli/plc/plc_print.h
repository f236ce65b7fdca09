// SPDX-License-Identifier: Apache-2.0
// indurop plc print: the networks of a PLC program as text or SVG.

#pragma once

#include <memory>

#include "tools/cli/command/verb.h"

namespace indurop::tools {

// Adds the subcommand; after it was parsed, `chosen` is the action to run.
void add_plc_print(base::Options& app, const std::shared_ptr<Action>& chosen);

}  // namespace indurop::tools
