// SPDX-License-Identifier: Apache-2.0
// A process of its own loads a file before a node does: a damaged file, or static constructors that crash, throw, end
// the process or never return, would end the node.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "node/modules/module_library.h"

namespace indurop::node {

// Loads `file` in another process, which ends without destructors. Returns what went wrong there; empty: nothing that
// loading it in this process does not report. Waits for 10 s at most. Not real-time safe; only in indurop-node.
std::string try_module(const std::filesystem::path& file);

// Loads a private copy of `file` with nothing around it on the stack. What damaged code does to its surroundings it
// does in the process above as here, so that it does not come this far. `module`: see runtime::set_current_module().
Result<ModuleLibrary, base::Problem> load_apart(const std::filesystem::path& file, std::uint32_t module);

// What the status with which that process ended says about the file; empty: it was loaded.
std::string trial_failure(int status);

inline constexpr const char* kTrialFlag = "--try-module";
// main() of that process: argv = {self, kTrialFlag, file}.
[[noreturn]] void load_on_trial(int argc, char** argv);

}  // namespace indurop::node
