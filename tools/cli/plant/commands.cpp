// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/commands.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/cli/plant/board_roster.h"

namespace indurop::tools {

using scheduler::ModuleCommand;

const char* past_of(ModuleCommand command) {
  return command == ModuleCommand::Stop ? "stopped" : command == ModuleCommand::Start ? "started" : "restarted";
}

void add_command_options(base::Options& app, Context& context, CommandOptions& options) {
  app.add("targets", "TARGET", options.targets, "MODULE of the node here; MODULE@BOARD or @BOARD of a plant, anywhere")
      .completes(base::Completion::Module);
  add_reason_option(app, context);
  add_node_option(app, context);
  add_time_option(app, "--timeout", options.timeout_ns, "How long to wait (default 10 s)");
  deploy::add_link_options(app, options.link);
}

Action declare_command(base::Options& app, Context& context, ModuleCommand command, const char* nobody) {
  auto options = std::make_shared<CommandOptions>();
  add_command_options(app, context, *options);
  return [options, command, nobody](Context& c) {
    if (options->targets.empty()) {
      c.out.error(nobody);
      return kUsage;
    }
    return carry_out(c, command, *options);
  };
}

int carry_out(Context& context, ModuleCommand command, CommandOptions& options) {
  std::vector<CommandTarget> remote;
  std::vector<std::string> here;
  for (const std::string& text : options.targets) {
    const auto at = text.find('@');
    if (at == std::string::npos) {
      here.push_back(text);
    } else if (at + 1 < text.size()) {
      remote.push_back({text.substr(0, at), text.substr(at + 1)});
    } else {
      context.out.error(fmt::format("'{}' names no board; write MODULE@BOARD or @BOARD", text));
      return kUsage;
    }
  }
  for (const std::string& module : here) {
    if (const int code = command_here(context, command, module, options.timeout_ns).code; code != kOk) {
      return code;
    }
  }
  return remote.empty() ? kOk : command_remote(context, command, remote, options);
}

}  // namespace indurop::tools
