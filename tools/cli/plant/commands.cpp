// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/commands.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/cli/values/forcing.h"
#include "tools/client/node/node_choice.h"

namespace indurop::tools {

using scheduler::ModuleCommand;

namespace {

int command_local(Context& context, ModuleCommand command, const std::string& module, std::int64_t timeout_ns) {
  const auto node = choose_node(context.node);
  if (!node) {
    return report(context.out, node.error());
  }
  const auto done = command_module(*node, command, module, timeout_ns, who_orders(context));
  if (!done) {
    return report(context.out, done.error());
  }
  if (done->result == scheduler::CommandResult::OldCode) {
    context.out.message_line("indurop: warning: " + done->text);
  } else {
    context.out.note(done->text);
  }
  if (done->result != scheduler::CommandResult::Unchanged) {
    note_for_audit(context, *node, verb_of(command), module);
  }
  return kOk;
}

}  // namespace

void add_command_options(base::Options& app, Context& context, CommandOptions& options) {
  app.add("targets", "TARGET", options.targets,
          "MODULE of a node on this machine; MODULE@BOARD or @BOARD of a plant, from any machine")
      .completes(base::Completion::Module);
  add_reason_option(app, context);
  add_node_option(app, context);
  add_time_option(app, "--timeout", options.timeout_ns, "How long to wait (default 10 s)");
  deploy::add_link_options(app, options.link);
}

Action declare_command(base::Options& app, Context& context, ModuleCommand command, const char* no_target) {
  auto options = std::make_shared<CommandOptions>();
  add_command_options(app, context, *options);
  return [options, command, no_target](Context& c) {
    if (options->targets.empty()) {
      c.out.error(no_target);
      return kUsage;
    }
    return carry_out(c, command, *options);
  };
}

int carry_out(Context& context, ModuleCommand command, CommandOptions& options) {
  std::vector<CommandTarget> remote;
  std::vector<std::string> local;
  for (const std::string& text : options.targets) {
    const auto at = text.find('@');
    if (at == std::string::npos) {
      local.push_back(text);
    } else if (at + 1 < text.size()) {
      remote.push_back({text.substr(0, at), text.substr(at + 1)});
    } else {
      context.out.error(fmt::format("'{}' names no board; write MODULE@BOARD or @BOARD", text));
      return kUsage;
    }
  }
  for (const std::string& module : local) {
    if (const int code = command_local(context, command, module, options.timeout_ns); code != kOk) {
      return code;
    }
  }
  return remote.empty() ? kOk : command_remote(context, command, remote, options);
}

}  // namespace indurop::tools
