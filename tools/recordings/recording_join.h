// SPDX-License-Identifier: Apache-2.0
// indurop recording join: the recordings of a plant's boards become one.

#pragma once

#include <memory>

#include "tools/command/verb.h"

namespace indurop::tools {

// Adds the subcommand; once it was parsed, `chosen` is what to do.
void add_recording_join(base::Options& app, const std::shared_ptr<Action>& chosen);

}  // namespace indurop::tools
