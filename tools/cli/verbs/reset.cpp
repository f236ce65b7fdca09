// SPDX-License-Identifier: Apache-2.0
// indurop reset: restores initial values, with or without the retained ones.
#include <fmt/format.h>
#include <unistd.h>

#include <cstring>
#include <iostream>

#include "core/base/print.h"
#include "store/vars/node_lock.h"
#include "store/vars/retain.h"
#include "tools/cli/values/forcing.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/node_choice.h"

namespace indurop::tools {
namespace {

struct ResetOptions {
  bool warm = false;
  bool cold = false;
  bool yes = false;
};

// Fails unless the user agrees. Without a terminal only --yes counts.
Result<void, Failure> agreed(Context& context, const ResetOptions& options, const std::string& question) {
  if (options.yes) {
    return {};
  }
  if (isatty(STDIN_FILENO) != 1 || isatty(STDERR_FILENO) != 1) {
    return Failure{kUsage, "this cannot be undone, and there is no terminal to ask on; add --yes"};
  }
  context.out.flush();
  base::print(stderr, "{} [y/N] ", question);
  std::string answer;
  std::getline(std::cin, answer);
  if (answer == "y" || answer == "Y" || answer == "yes") {
    return {};
  }
  context.out.note("nothing was changed");
  return Failure{kFailed, {}};
}

std::string error_text(const Error& error) {
  return error.sys_errno != 0 ? fmt::format("{}: {}", error.where, std::strerror(error.sys_errno))
                              : fmt::format("{} ({})", error.where, to_string(error.code));
}

bool erase_retained(Context& context, const std::string& node) {
  const auto folder = vars::state_directory(node);
  const Status erased = vars::RetainFile(folder).erase();
  if (!erased.ok()) {
    context.out.error(fmt::format("retained values in {}: {}", folder.string(), error_text(erased.error())));
  }
  return erased.ok();
}

// Returns the node, or only its name: that is enough, because retained values remain after `indurop clean`.
Result<std::string, Failure> node_or_name(const Context& context) {
  if (!context.node.empty() && vars::valid_node_name(context.node) &&
      std::filesystem::exists(vars::state_directory(context.node))) {
    return context.node;
  }
  return choose_node(context.node);
}

int reset(Context& context, const ResetOptions& options) {
  if (options.warm == options.cold) {
    context.out.error("choose --warm (retained variables keep their values) or --cold (all get their initial values)");
    return kUsage;
  }
  const auto node = node_or_name(context);
  if (!node) {
    return report(context.out, node.error());
  }
  const bool runs = vars::running_node(*node) != 0;
  if (!may(context, *node, vars::Act::Set)) {
    return kFailed;
  }
  const std::string question =
      fmt::format("Set {} variables of node '{}'{} to their initial values?",
                  options.warm ? "all but the retained" : "all", *node, runs ? ", which is running," : "");
  if (const auto may = agreed(context, options, question); !may) {
    return report(context.out, may.error());
  }
  auto store = vars::Store::attach(*node, vars::Mode::ReadWrite);
  if (!store.ok() && store.error().code != Errc::NotFound) {
    context.out.error(explain_open_error(store.error(), *node, true));
    return exit_code_of(store.error());
  }
  // Files first: if that fails, nothing has been changed yet.
  if (options.cold && !erase_retained(context, *node)) {
    return kFailed;
  }
  if (store.ok()) {
    store.value().reset(options.warm);
  }
  context.out.note(fmt::format("node '{}': {} variables have their initial values", *node,
                               options.warm ? "all but the retained" : "all"));
  return kOk;
}

Action declare_reset(base::Options& app, Context& context) {
  auto options = std::make_shared<ResetOptions>();
  app.flag("--warm", options->warm, "Retained variables keep their values");
  app.flag("--cold", options->cold, "Also reset retained variables, and remove their files");
  app.flag("-y,--yes", options->yes, "Do not ask for confirmation");
  add_node_option(app, context);
  return [options](Context& c) { return reset(c, *options); };
}

}  // namespace

const Verb kResetVerb{
    "reset", "Start and stop", "Set variables back to their initial values",
    "Works on a running node, whose modules see the new values in their next run, and on the memory that a\n"
    "stopped node left behind.\n"
    "Examples:\n"
    "  indurop reset\n"
    "  indurop reset --cold --yes\n",
    &declare_reset};

}  // namespace indurop::tools
