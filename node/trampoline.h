// SPDX-License-Identifier: Apache-2.0
// How process modules are started: this program again, as a short step in between that sets what must hold before the
// module's own code runs (it dies with the node, own process group, core, default signals) and then becomes the module.
// posix_spawn of it leaves the node's memory alone; a fork would make its real-time threads fault on every page.

#pragma once

#include <indurop/result.h>
#include <sys/types.h>

#include <string>
#include <vector>

namespace indurop::node {

struct Launch {
  std::string file;
  std::vector<std::string> arguments;
  std::string node;    // INDUROP_NODE
  std::string module;  // INDUROP_MODULE
  int core = -1;
};

// Starts it; the process exists when this returns, its program not necessarily. Errors: System.
Result<pid_t> launch(const Launch& what);

inline constexpr const char* kTrampolineFlag = "--become-module";
// main() of the step in between: argv = {self, kTrampolineFlag, node pid, core, file, arguments...}. Returns only on
// failure, with 127 and a message.
int become_module(int argc, char** argv);

}  // namespace indurop::node
