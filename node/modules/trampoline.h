// SPDX-License-Identifier: Apache-2.0
// How process modules are started: this program again, as a short intermediate step that sets what must hold before the
// module's own code runs (it dies with the node, own process group, core, default signals) and then becomes the module.
// posix_spawn leaves the node's memory alone; a fork would make its real-time threads fault on every page.

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
  int output = -1;  // an open file for what it prints; -1: where the node prints
};

// Starts the module; when this returns the process exists, but not necessarily its program. Errors: System.
Result<pid_t> launch(const Launch& what);

inline constexpr const char* kTrampolineFlag = "--become-module";
// main() of the intermediate step: argv = {self, kTrampolineFlag, node pid, core, file, arguments...}. Returns only on
// failure, with 127 and a message.
int become_module(int argc, char** argv);

}  // namespace indurop::node
