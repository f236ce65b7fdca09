// SPDX-License-Identifier: Apache-2.0
// indurop start: modules that were stopped or have faulted, and nodes of boards.
#include "tools/orders.h"
#include "tools/verbs.h"

namespace indurop::tools {
namespace {

Action declare(CLI::App& app, Context& context) {
  auto options = std::make_shared<OrderOptions>();
  add_order_options(app, context, *options);
  return [options](Context& c) {
    if (options->targets.empty()) {
      c.out.error("start what? MODULE, MODULE@BOARD or @BOARD; a node is started by: indurop run module.xml");
      return kUsage;
    }
    return carry_out(c, scheduler::ModuleOrder::Start, *options);
  };
}

}  // namespace

const Verb kStartVerb{
    "start", "Start and stop", "Start modules that were stopped or have faulted",
    "Calls the module's start() beside the schedule and puts it back into its place; a process module is launched.\n"
    "Of a module that has faulted stop() is called first. What the module keeps in its own memory is as it was left.\n"
    "MODULE@BOARD and @BOARD (its node) go through the agent of a board in the network, signed with --keys where it\n"
    "has keys. Exit code 1 if start() failed or the order was refused, 6 if board or node are not there in time.\n"
    "Examples:\n"
    "  indurop start gripper\n"
    "  indurop start gripper@control\n"
    "  indurop start @control\n",
    &declare};

}  // namespace indurop::tools
