// SPDX-License-Identifier: Apache-2.0
// indurop-node: the scheduler node of one board.

#include <cstdlib>
#include <string_view>

#include "node/agent.h"
#include "node/node.h"
#include "node/options.h"
#include "node/trampoline.h"

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == indurop::node::kTrampolineFlag) {
    return indurop::node::become_module(argc, argv);
  }
  int exit_code = 0;
  const auto options = indurop::node::parse_options(argc, argv, exit_code);
  if (!options) {
    return exit_code;
  }
  if (options->agent) {
    return indurop::node::run_agent(*options);
  }
  // Modules that look for their node by name, through a channel for example, are to find this one.
  ::setenv("INDUROP_NODE", options->node.c_str(), 1);  // NOLINT(concurrency-mt-unsafe): before any thread
  indurop::node::Node node(*options);
  return node.run();
}
