// SPDX-License-Identifier: Apache-2.0
// indurop recording join: joins the recordings of a plant's boards in one.

#pragma once

#include <memory>

#include "tools/cli/command/verb.h"

namespace indurop::tools {

// Adds the subcommand; after it was parsed, `chosen` is the action to run.
void add_recording_join(base::Options& app, const std::shared_ptr<Action>& chosen);

}  // namespace indurop::tools
