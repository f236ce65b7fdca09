// SPDX-License-Identifier: Apache-2.0
// indurop recording play: recorded values are written into a running node, in time.

#pragma once

#include <memory>

#include "tools/command/verb.h"

namespace indurop::tools {

// Adds the subcommand; once it was parsed, `chosen` is what to do.
void add_recording_play(base::Options& app, Context& context, const std::shared_ptr<Action>& chosen);

}  // namespace indurop::tools
