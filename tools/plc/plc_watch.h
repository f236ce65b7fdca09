// SPDX-License-Identifier: Apache-2.0
// indurop plc watch: a running ladder with its power flow.

#pragma once

#include <memory>

#include "tools/command/verb.h"

namespace indurop::tools {

// Adds the subcommand; once it was parsed, `chosen` is what to do.
void add_plc_watch(base::Options& app, Context& context, const std::shared_ptr<Action>& chosen);

}  // namespace indurop::tools
