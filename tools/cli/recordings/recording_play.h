// SPDX-License-Identifier: Apache-2.0
// indurop recording play: writes recorded values into a running node at the recorded times.

#pragma once

#include <memory>

#include "tools/cli/command/verb.h"

namespace indurop::tools {

// Adds the subcommand; after it was parsed, `chosen` is the action to run.
void add_recording_play(base::Options& app, Context& context, const std::shared_ptr<Action>& chosen);

}  // namespace indurop::tools
