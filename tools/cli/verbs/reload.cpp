// SPDX-License-Identifier: Apache-2.0
// indurop reload: exchanges the code of a module while the node runs.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <optional>
#include <utility>

#include "core/rt/clock.h"
#include "tools/cli/command/config_file.h"
#include "tools/cli/plant/reload_remote.h"
#include "tools/cli/plant/roll_back.h"
#include "tools/cli/shadow/shadow_run.h"
#include "tools/cli/values/forcing.h"
#include "tools/cli/verbs/reload_schedule.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/module_reload.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

using scheduler::CommandResult;
using scheduler::ModuleCommand;
using scheduler::VersionState;
using ReloadResult = operate::RemoteReloadReply::Result;

constexpr std::int64_t kHealthPollNs = 10'000'000;

struct ReloadOptions {
  std::string module;
  std::string file;
  std::string config;  // another schedule; empty: a module is exchanged
  operate::ReloadRequest request;
  std::string board;  // empty: a node of this machine
  std::string plant;  // whose boards all go back; empty: one module does
  deploy::LinkSettings link;
  bool back = false;
  std::int64_t shadow_ns = 0;  // 0: no shadow
  bool has_shadow = false;     // it was given
  AcceptedDifferences accepted;
  std::optional<ShadowReport> shadow;
  std::int64_t timeout_ns = 30'000'000'000;
};

void print_names(Context& context, const char* title, const std::vector<std::string>& names, const char* more) {
  if (!names.empty()) {
    context.out.line(fmt::format("  {:<9} {}{}", title, fmt::join(names, ", "), more));
  }
}

void print_plan(Context& context, const operate::ReloadPlan& plan) {
  if (!plan.why_not.empty()) {
    context.out.line("  lost      all that it keeps: " + plan.why_not);
  }
  print_names(context, "kept", plan.kept, "");
  print_names(context, "grown", plan.grown, " (more elements now)");
  print_names(context, "added", plan.added, " (initial values)");
  print_names(context, "removed", plan.removed, "");
  print_names(context, "changed", plan.changed, " (another type now: initial values)");
  print_names(context, "converted", plan.converted, " (shared, of another type now)");
  print_names(context, "new", plan.appeared, " (shared, initial values)");
  for (const std::string& one : plan.lost) {
    context.out.line("  lost      " + printable(one));
  }
}

void print_exchange(Context& context, const operate::ReloadReport& report) {
  context.out.line(fmt::format("  version {} runs since tick {}; {} ticks without new values", report.version,
                               report.tick, report.left_out));
  if (report.response_ns == 0) {
    return;  // a process
  }
  context.out.line(fmt::format("  {} bytes copied in {}; its first run ended {} after its release", report.plan.bytes,
                               human_ns(report.copying_ns), human_ns(report.response_ns)));
}

// Waits until the health window is over. Returns the exit code.
int await_health(Context& context, const Reloaded& done) {
  const scheduler::ModuleRecord& record = *done.answer.record;
  const auto state = [&record] { return record.version_state.load(); };
  while (state() == VersionState::Watched && done.answer.run.node_alive() && !interrupted()) {
    wait_until(rt::now_ns() + kHealthPollNs);
  }
  if (interrupted()) {
    context.out.note("the node continues to watch it");
    return interrupt_code();
  }
  if (state() == VersionState::Watched) {
    context.out.error("the node has ended in the health window");
    return kUnreachable;
  }
  if (state() == VersionState::Returned) {
    const auto report = operate::read_report(done.node);
    context.out.error(fmt::format("module '{}': {}", done.report.module,
                                  report ? printable(report->text) : "the previous version runs again"));
    return kRolledBack;
  }
  return kOk;
}

void print_json(Context& context, const ReloadOptions& options, const operate::ReloadReport& report) {
  JsonValue json = json_of(report);
  if (options.shadow) {
    json["shadow"] = options.shadow->json;
  }
  context.out.line(json.dump(2));
}

// Compares the new version with the running one. Returns nothing if it may be exchanged, else the exit code.
std::optional<int> compare_as_shadow(Context& context, ReloadOptions& options, const std::string& node) {
  auto found = run_shadow(context, {node, options.module, options.request.file, options.shadow_ns});
  if (!found) {
    return report(context.out, found.error());
  }
  options.shadow = std::move(found).value();
  if (context.format != Format::Json) {
    print_shadow(context, *options.shadow);
  }
  const auto why_not = objection(*options.shadow, options.accepted, options.request.lossy);
  if (!why_not) {
    return std::nullopt;
  }
  operate::ReloadReport refused;
  refused.module = options.module;
  refused.text = "not exchanged: " + *why_not;
  if (context.format == Format::Json) {
    print_json(context, options, refused);
  }
  context.out.error(fmt::format("module '{}': {}", refused.module, refused.text));
  return kCheckFailed;
}

ReloadResult result_of(CommandResult result) {
  switch (result) {
    case CommandResult::Done:
      return ReloadResult::Done;
    case CommandResult::Unchanged:
      return ReloadResult::Unchanged;
    case CommandResult::Refused:
      return ReloadResult::Refused;
    case CommandResult::None:
    case CommandResult::OldCode:
    case CommandResult::Failed:
    case CommandResult::Ending:
      break;
  }
  return ReloadResult::Failed;
}

// Prints the report of a node. Returns the exit code.
int print_result(Context& context, const ReloadOptions& options, const operate::ReloadReport& report,
                 ReloadResult result) {
  for (const std::string& error : report.errors) {
    context.out.message_line(printable(error));
  }
  if (context.format == Format::Json) {
    print_json(context, options, report);
  } else if (report.errors.empty() && !report.to.empty()) {
    print_plan(context, report.plan);
  }
  const std::string text = fmt::format("module '{}': {}", options.module, printable(report.text));
  if (result != ReloadResult::Done && result != ReloadResult::Unchanged) {
    context.out.error(text);
    return result == ReloadResult::Refused ? kCheckFailed : result == ReloadResult::Returned ? kRolledBack : kFailed;
  }
  context.out.note(text);
  if (result == ReloadResult::Done && !options.request.dry_run && context.format != Format::Json) {
    print_exchange(context, report);
  }
  return kOk;
}

int reload_here(Context& context, ReloadOptions& options) {
  const auto node = choose_node(context.node);
  if (!node) {
    return report(context.out, node.error());
  }
  if (!options.file.empty()) {
    auto file = absolute_name(options.file);
    if (!file) {
      return report(context.out, file.error());
    }
    options.request.file = std::move(file).value();
  }
  if (options.shadow_ns > 0) {
    if (const auto code = compare_as_shadow(context, options, *node)) {
      return *code;
    }
  }
  const ModuleCommand command = options.back ? ModuleCommand::Back : ModuleCommand::Reload;
  const auto done =
      reload_module(*node, command, options.module, options.request, options.timeout_ns, who_orders(context));
  if (!done) {
    return report(context.out, done.error());
  }
  if (done->answer.result == CommandResult::Done && !options.request.dry_run) {
    note_for_audit(context, *node, verb_of(command), options.module + " sha256:" + done->report.to);
  }
  const int code = print_result(context, options, done->report, result_of(done->answer.result));
  const bool exchanged = done->answer.result == CommandResult::Done && !options.request.dry_run && !options.back;
  return code == kOk && exchanged ? await_health(context, *done) : code;
}

int reload_there(Context& context, ReloadOptions& options) {
  if (options.shadow_ns > 0) {
    context.out.error("--shadow is for a node of this machine: its runs are taken from its memory");
    return kUsage;
  }
  if (!options.back && options.file.empty()) {
    context.out.error("name the file that the board is to get: indurop reload MODULE FILE --board NAME");
    return kUsage;
  }
  RemoteReloadOrder order{options.board,   options.module,     options.file,
                          options.request, options.timeout_ns, options.link};
  const auto done = reload_on_board(context, order);
  return done ? print_result(context, options, done->report, done->result) : report(context.out, done.error());
}

// All modules that the last deployment has exchanged, on all boards.
int reload_plant(Context& context, const ReloadOptions& options) {
  if (!options.back || !options.module.empty() || !options.board.empty()) {
    context.out.error("--plant is for --back alone: indurop reload --back --plant NAME takes all boards back");
    return kUsage;
  }
  RollbackOptions all;
  all.plant = options.plant;
  all.link = options.link;
  all.health_ns = options.request.health_ns;
  return roll_back(context, all);
}

int reload_other_schedule(Context& context, const ReloadOptions& options) {
  const bool both = !options.config.empty() && options.back;
  if (both || !options.module.empty() || !options.board.empty() || options.shadow_ns > 0) {
    context.out.error("--config FILE and --back are alone: indurop reload --config FILE [--dry-run]");
    return kUsage;
  }
  return reload_schedule(context, {options.config, options.request.dry_run, options.timeout_ns});
}

int reload(Context& context, ReloadOptions& options) {
  if (options.has_shadow && options.shadow_ns == 0) {
    context.out.error("--shadow 0s compares nothing; give a time such as 5s, or leave it out");
    return kUsage;
  }
  if (!options.plant.empty()) {
    return reload_plant(context, options);
  }
  if (!options.config.empty() || (options.back && options.module.empty())) {
    return reload_other_schedule(context, options);
  }
  if (options.module.empty()) {
    context.out.error("name the module, indurop reload MODULE [FILE], or a schedule, indurop reload --config FILE");
    return kUsage;
  }
  if (options.back && (!options.file.empty() || options.request.dry_run || options.shadow_ns > 0)) {
    context.out.error("--back takes a module only: the previous version is in memory");
    return kUsage;
  }
  return options.board.empty() ? reload_here(context, options) : reload_there(context, options);
}

Action declare_reload(base::Options& app, Context& context) {
  auto options = std::make_shared<ReloadOptions>();
  options->request.health_ns = 5'000'000'000;
  app.add("module", "MODULE", options->module, "A thread module of the node").completes(base::Completion::Module);
  app.add("file", "FILE", options->file, "The file of its new version (default: that of the configuration)")
      .completes(base::Completion::File);
  app.flag("--dry-run", options->request.dry_run, "Load and compare the new version, but exchange nothing");
  app.flag("--back", options->back, "Return to the previous version; without MODULE: to the previous schedule");
  app.add("--config", "FILE", options->config,
          "Change to the schedule of this configuration at the beginning of a macro period")
      .completes(base::Completion::File);
  base::Option shadow = add_time_option(app, "--shadow", options->shadow_ns,
                                        "First compare it with the running version: repeat its runs for this "
                                        "time, and exchange it only if nothing differs");
  shadow.implies(options->has_shadow);
  const auto accept = [&accepted = options->accepted](const std::string& text) {
    auto rules = AcceptedDifferences::parse(text);
    if (!rules) {
      return rules.error().text;
    }
    accepted = std::move(rules).value();
    return std::string();
  };
  app.add("--accept", "RULES", accept, "With --shadow: accepted differences: \"O* == 0, joint < 0.01\"").needs(shadow);
  app.flag("--lossy", options->request.lossy, "Exchange it even if values that it keeps are lost");
  add_time_option(app, "--health", options->request.health_ns,
                  "How long the previous version stands by (default 5 s; 0s: not at all)");
  app.add("--guard", "CONDITION", options->request.guard,
          "Condition that must hold in that time, else the previous version runs again: \"O0 == 0\"")
      .check([](const std::string& text) {
        return std::string(text.empty() ? "it is empty, so nothing would be guarded; leave it out for that" : "");
      });
  add_time_option(app, "--timeout", options->timeout_ns, "How long to wait for the exchange (default 30 s)");
  app.add("--board", "NAME", options->board, "Exchange it on this board, through its agent; FILE is sent there")
      .completes(base::Completion::Node);
  app.add("--plant", "NAME", options->plant,
          "With --back: take all boards of this plant back to the previous deployment, as indurop rollback does");
  deploy::add_link_options(app, options->link);
  add_reason_option(app, context);
  add_node_option(app, context);
  add_format_option(app, context, {Format::Table, Format::Json});
  return [options](Context& c) { return reload(c, *options); };
}

}  // namespace

const Verb kReloadVerb{
    "reload", "Start and stop", "Exchange the code of a module while the node runs",
    "The new version is checked, loaded and started next to the running one. It replaces the running version\n"
    "between two runs and continues with what the module keeps (INDUROP_STATE; automatic for PLC programs); no\n"
    "run is skipped. If it then faults, overruns or violates the guard within the health window, the previous\n"
    "version runs again in the next tick. A process is followed by another one, which takes over what it keeps.\n"
    "With --config, the schedule of the whole node changes: the verb reports what happens to each module, modules\n"
    "that stay lose no tick, and a change that requires a restart is rejected.\n"
    "With --shadow, the new version first repeats the runs of the running one, in another process and with the\n"
    "same inputs, and its outputs are compared.\n"
    "Exit code 0 if the new version runs, or was the same version; 1 if it could not be started or exchanged; 4\n"
    "if it was rejected, because it cannot run here, values would be lost, or it differs as a shadow; 5 if it was\n"
    "exchanged and the previous version runs again; 6 if the node does not run or did not answer. Unless the exit\n"
    "code is 0, the version that ran before runs.\n"
    "Examples:\n"
    "  indurop reload press --dry-run\n"
    "  indurop reload press --shadow 5s\n"
    "  indurop reload press --shadow 5s --accept \"heat <= 0.5\"\n"
    "  indurop reload press --health 10s --guard \"pressure < 80\"\n"
    "  indurop reload press build/press.so --reason \"faster ramp\"\n"
    "  indurop reload press --back\n"
    "  indurop reload --config module.xml --dry-run\n"
    "  indurop reload --back\n"
    "  indurop reload press build/press.so --board cell\n"
    "  indurop reload --back --plant cell\n",
    &declare_reload};

}  // namespace indurop::tools
