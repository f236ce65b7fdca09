// SPDX-License-Identifier: Apache-2.0
// indurop run: executes indurop-node in its place, so exit code and signals are the node's own.
#include <fmt/format.h>

#include <filesystem>

#include "config/run_options.h"
#include "config/xml/plant_reader.h"
#include "tools/cli/command/config_file.h"
#include "tools/cli/command/node_program.h"
#include "tools/cli/plant/run_detached.h"
#include "tools/cli/plant/run_local.h"
#include "tools/cli/verbs/verbs.h"

namespace indurop::tools {
namespace {

struct RunRequest {
  config::RunOptions options;
  bool local = false;
  bool detach = false;
};

int run(Context& context, RunRequest& request) {
  const auto program = node_program(context);
  if (program.empty()) {
    return kFailed;
  }
  config::RunOptions& options = request.options;
  options.quiet = context.out.quiet();
  std::error_code ignored;
  if (options.config.empty() && std::filesystem::exists("module.xml", ignored)) {
    options.config = "module.xml";
  }
  if (!options.config.empty()) {
    if (const auto found = find_config(options.config.string()); !found) {
      return report(context.out, found.error());
    }
  }
  const bool plant = !options.config.empty() && config::is_plant_file(options.config);
  if (request.local) {
    if (!plant) {
      context.out.error("--local is for the manifest of a plant: indurop run plant.xml --local");
      return kUsage;
    }
    if (!options.board.empty()) {
      context.out.error("--local runs all boards, --board runs one of them: choose one");
      return kUsage;
    }
    if (!options.node.empty()) {
      context.out.error("--local: each node has the name of its board; leave out --node");
      return kUsage;
    }
    if (options.simulation.on) {
      context.out.error("--sim runs all boards of a plant on this host anyway: leave out --local");
      return kUsage;
    }
    if (request.detach) {
      context.out.error("--detach starts one node: start each board with --board NAME --one-host --detach");
      return kUsage;
    }
    return run_local(context, program, options);
  }
  if (plant && options.board.empty() && !options.simulation.on) {
    context.out.error(
        fmt::format("{} is the manifest of a plant; run all its boards on this host with --local, or be "
                    "one of them with --board NAME",
                    options.config.string()));
    return kUsage;
  }
  return request.detach ? run_detached(context, program, options) : become_node(context, program, options);
}

Action declare_run(base::Options& app, Context& /*context*/) {
  auto request = std::make_shared<RunRequest>();
  app.flag("--local", request->local, "Run all boards of a plant on this host");
  app.flag("--detach", request->detach, "Return when the node runs; indurop stop ends it");
  config::declare_run_options(app, request->options);
  return [request](Context& c) { return run(c, *request); };
}

}  // namespace

const Verb kRunVerb{
    "run", "Start and stop", "Run a configuration, or with --local all boards of a plant",
    "This command becomes indurop-node: the exit code and the signals are those of the node. Without FILE it runs\n"
    "module.xml. With --detach it continues in the background and prints where its messages are. With --local the\n"
    "exit code is that of the first board that failed.\n"
    "Examples:\n"
    "  indurop run module.xml --duration 10s\n"
    "  indurop run module.xml --detach\n"
    "  indurop run module.xml --sim --until 1min\n"
    "  indurop run plant.xml --local\n"
    "  indurop run plant.xml --sim --until 1min --network delay=200us,loss=0.001\n",
    &declare_run};

}  // namespace indurop::tools
