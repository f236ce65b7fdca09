// SPDX-License-Identifier: Apache-2.0
// indurop plc export: a program as PLCopen XML.

#pragma once

#include <memory>

#include "tools/cli/command/verb.h"

namespace indurop::tools {

// Adds the subcommand; after it was parsed, `chosen` is the action to run.
void add_plc_export(base::Options& app, const std::shared_ptr<Action>& chosen);

}  // namespace indurop::tools
