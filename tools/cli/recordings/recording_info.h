// SPDX-License-Identifier: Apache-2.0
// indurop recording info: the contents of a recording.

#pragma once

#include <filesystem>
#include <memory>

#include "tools/cli/command/verb.h"

namespace indurop::tools {

// Prints the contents of the recording in context.format. Returns the exit code.
int show_recording(Context& context, const std::filesystem::path& file);

// Adds the subcommand; after it was parsed, `chosen` is the action to run.
void add_recording_info(base::Options& app, Context& context, const std::shared_ptr<Action>& chosen);

}  // namespace indurop::tools
