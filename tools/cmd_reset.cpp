// SPDX-License-Identifier: Apache-2.0
// indurop reset: initial values again, with or without the retained ones.
#include <fmt/format.h>
#include <unistd.h>

#include <cstring>
#include <iostream>

#include "tools/node_choice.h"
#include "tools/verbs.h"
#include "vars/node_lock.h"
#include "vars/retain.h"

namespace indurop::tools {
namespace {

struct Options {
  bool warm = false;
  bool cold = false;
  bool yes = false;
};

// True if the user agrees. Without a terminal to ask on only --yes counts.
bool agreed(Context& context, const Options& options, const std::string& question, int& code) {
  if (options.yes) {
    return true;
  }
  if (isatty(STDIN_FILENO) != 1 || isatty(STDERR_FILENO) != 1) {
    context.out.error("this changes values for good and nobody can be asked here; add --yes");
    code = kUsage;
    return false;
  }
  context.out.flush();
  fmt::print(stderr, "{} [y/N] ", question);
  std::string answer;
  std::getline(std::cin, answer);
  if (answer == "y" || answer == "Y" || answer == "yes") {
    return true;
  }
  context.out.note("nothing was changed");
  code = kFailed;
  return false;
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

// The node, as far as this verb needs it: a name is enough, for retained values outlive `indurop clean`.
std::optional<std::string> node_or_name(Context& context, int& code) {
  if (!context.node.empty() && vars::valid_node_name(context.node) &&
      std::filesystem::exists(vars::state_directory(context.node))) {
    return context.node;
  }
  return choose_node(context, code);
}

int reset(Context& context, const Options& options) {
  if (options.warm == options.cold) {
    context.out.error("say --warm (retained variables keep their values) or --cold (all begin anew)");
    return kUsage;
  }
  int code = kOk;
  const auto node = node_or_name(context, code);
  if (!node) {
    return code;
  }
  const bool runs = vars::running_node(*node) != 0;
  const std::string question =
      fmt::format("Set {} variables of node '{}'{} to their initial values?",
                  options.warm ? "all but the retained" : "all", *node, runs ? ", which is running," : "");
  if (!agreed(context, options, question, code)) {
    return code;
  }
  auto store = vars::Store::attach(*node, vars::Mode::ReadWrite);
  if (!store.ok() && store.error().code != Errc::NotFound) {
    context.out.error(explain_open_error(store.error(), *node, true));
    return exit_code_of(store.error());
  }
  // Files first: should that fail, nothing has happened yet.
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

Action declare(CLI::App& app, Context& context) {
  auto options = std::make_shared<Options>();
  app.add_flag("--warm", options->warm, "Retained variables keep their values");
  app.add_flag("--cold", options->cold, "Retained variables too, and their files are removed");
  app.add_flag("-y,--yes", options->yes, "Do not ask");
  add_node_option(app, context);
  return [options](Context& c) { return reset(c, *options); };
}

}  // namespace

const Verb kResetVerb{
    "reset", "Start and stop", "Set variables back to their initial values",
    "Works on a running node (its modules see the new values in their next run) and on what a stopped\n"
    "one left behind.\n",
    &declare};

}  // namespace indurop::tools
