// SPDX-License-Identifier: Apache-2.0
// Runs another program and waits for it.

#pragma once

#include <string>
#include <vector>

namespace indurop::tools {

// `arguments` begin with the program, which is looked for in PATH. Its output goes where ours goes. Returns its exit
// code, 128 + number after a signal, or -1 with the reason in `problem` if it cannot be started.
int run_child(const std::vector<std::string>& arguments, std::string& problem);

}  // namespace indurop::tools
