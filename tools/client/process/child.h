// SPDX-License-Identifier: Apache-2.0
// Runs another program and waits for it.

#pragma once

#include <indurop/result.h>

#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/base/spawn.h"

namespace indurop::tools {

// `arguments` begin with the program, which is searched for in PATH. Its output goes to the open file `output`, else to
// this program's stdout. Returns its exit code, 128 + number after a signal, or why it cannot be started.
Result<int, base::Problem> run_child(const std::vector<std::string>& arguments, int output = -1);
// The same for a program that needs more than that.
Result<int, base::Problem> run_child(const base::Launch& launch);

}  // namespace indurop::tools
