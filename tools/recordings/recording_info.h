// SPDX-License-Identifier: Apache-2.0
// indurop recording info: what a recording holds.

#pragma once

#include <filesystem>
#include <memory>

#include "tools/command/verb.h"

namespace indurop::tools {

// What the recording holds, as context.format says. Returns the exit code.
int show_recording(Context& context, const std::filesystem::path& file);

// Adds the subcommand; once it was parsed, `chosen` is what to do.
void add_recording_info(base::Options& app, Context& context, const std::shared_ptr<Action>& chosen);

}  // namespace indurop::tools
