// SPDX-License-Identifier: Apache-2.0
// indurop recording cut: a part of a recording as a recording of its own.

#pragma once

#include <memory>

#include "tools/command/verb.h"

namespace indurop::tools {

// Adds the subcommand; once it was parsed, `chosen` is what to do.
void add_recording_cut(base::Options& app, const std::shared_ptr<Action>& chosen);

}  // namespace indurop::tools
