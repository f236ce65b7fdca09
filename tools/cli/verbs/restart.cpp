// SPDX-License-Identifier: Apache-2.0
// indurop restart: restarts modules, and nodes of boards.
#include "tools/cli/plant/commands.h"
#include "tools/cli/verbs/verbs.h"

namespace indurop::tools {
namespace {

Action declare_restart(base::Options& app, Context& context) {
  return declare_command(app, context, scheduler::ModuleCommand::Restart,
                         "restart what? MODULE, MODULE@BOARD or @BOARD");
}

}  // namespace

const Verb kRestartVerb{
    "restart", "Start and stop", "Stop and start modules, or the node of a board",
    "Calls stop() and start() of the module while the others keep their ticks; a process module ends and is\n"
    "launched again. A .so stays loaded. MODULE@BOARD and @BOARD are as in indurop start.\n"
    "Examples:\n"
    "  indurop restart vision\n"
    "  indurop restart vision@control --keys keys\n",
    &declare_restart};

}  // namespace indurop::tools
