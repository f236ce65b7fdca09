// SPDX-License-Identifier: Apache-2.0
// indurop recording cut: saves a part of a recording as a separate recording.

#pragma once

#include <memory>

#include "tools/cli/command/verb.h"

namespace indurop::tools {

// Adds the subcommand; after it was parsed, `chosen` is the action to run.
void add_recording_cut(base::Options& app, const std::shared_ptr<Action>& chosen);

}  // namespace indurop::tools
