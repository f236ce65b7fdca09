// SPDX-License-Identifier: Apache-2.0
// indurop-node: the scheduler node of one board.

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <vector>

#include "core/base/exit_code.h"
#include "core/base/program_folder.h"
#include "core/base/standard_files.h"
#include "node/exchange/module_trial.h"
#include "node/modules/trampoline.h"
#include "node/run/node.h"
#include "node/run/options.h"
#include "node/simulate/conductor.h"

namespace {

// Until releases before 0.2 are gone: `indurop-node --agent` was the former name of indurop-agent.
int become_agent(char** argv) {
  std::vector<char*> words;
  for (char** word = argv; *word != nullptr; ++word) {
    if (std::string_view(*word) != "--agent") {
      words.push_back(*word);
    }
  }
  words.push_back(nullptr);
  const auto program = indurop::base::program_folder() / "indurop-agent";
  ::execv(program.c_str(), words.data());
  std::fprintf(stderr, "indurop-node: error: cannot start %s: %s\n", program.c_str(), std::strerror(errno));
  return indurop::kFailed;
}

// Ends without the last of the output if nothing reads it: exit() would wait for ever.
int finish(int code) {
  if (!indurop::base::flush_standard_output(indurop::base::kPatienceAtEnd)) {
    std::_Exit(code);
  }
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == indurop::node::kTrampolineFlag) {
    return indurop::node::become_module(argc, argv);
  }
  if (argc > 1 && std::string_view(argv[1]) == indurop::node::kTrialFlag) {
    indurop::node::load_on_trial(argc, argv);
  }
  if (std::any_of(argv, argv + argc, [](const char* word) { return std::string_view(word) == "--agent"; })) {
    return become_agent(argv);
  }
  int exit_code = 0;
  const auto options = indurop::node::parse_options(argc, argv, exit_code);
  if (!options) {
    return exit_code;
  }
  if (indurop::node::simulates_plant(*options)) {
    return indurop::node::run_plant(*options);
  }
  // Modules that find their node by name, through a channel for example, must find this one.
  ::setenv("INDUROP_NODE", options->node.c_str(), 1);  // NOLINT(concurrency-mt-unsafe): before any thread
  return finish(indurop::node::run_node(*options));
}
