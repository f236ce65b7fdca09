// SPDX-License-Identifier: Apache-2.0
// indurop start: starts modules that were stopped or have faulted, and nodes of boards.
#include "tools/cli/plant/commands.h"
#include "tools/cli/verbs/verbs.h"

namespace indurop::tools {
namespace {

Action declare_start(base::Options& app, Context& context) {
  return declare_command(app, context, scheduler::ModuleCommand::Start,
                         "start what? MODULE, MODULE@BOARD or @BOARD; a node is started by: indurop run module.xml");
}

}  // namespace

const Verb kStartVerb{
    "start", "Start and stop", "Start modules that were stopped or have faulted",
    "Calls the module's start() in the background and puts the module back into its place in the schedule; a\n"
    "process module is launched. If the module has faulted, its stop() is called first. The module's own memory\n"
    "is as it left it. MODULE@BOARD and @BOARD (its node) use the agent of a board in the network; the command is\n"
    "signed with --keys if the board has keys. Exit code 1 if start() failed or the command was rejected, 6 if\n"
    "the board or node did not answer in time.\n"
    "Examples:\n"
    "  indurop start gripper\n"
    "  indurop start gripper@control\n"
    "  indurop start @control\n",
    &declare_start};

}  // namespace indurop::tools
