// SPDX-License-Identifier: Apache-2.0
// indurop plc build and check: compiles the files of a PLC program to modules that a node loads.

#pragma once

#include <filesystem>
#include <memory>

#include "control/plc/front/compiler.h"
#include "tools/cli/command/verb.h"

namespace indurop::tools {

// Writes <name>.glb and, for each task, .cpp and, unless only the sources are requested, .so. Returns false after an
// error message.
[[nodiscard]] bool write_modules(Context& context, const plc::CompileOptions& options, const plc::Compiled& compiled,
                                 const std::filesystem::path& folder, bool only_sources);

// Adds the subcommands; after one was parsed, `chosen` is the action to run.
void add_plc_build(base::Options& app, const std::shared_ptr<Action>& chosen);

}  // namespace indurop::tools
