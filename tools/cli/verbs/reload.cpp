// SPDX-License-Identifier: Apache-2.0
// indurop reload: exchanges the code of a module while the node runs.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "core/rt/clock.h"
#include "tools/cli/values/forcing.h"
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

constexpr std::int64_t kHealthPollNs = 10'000'000;

struct ReloadOptions {
  std::string module;
  std::string file;
  operate::ReloadRequest request;
  bool back = false;
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
}

void print_exchange(Context& context, const operate::ReloadReport& report) {
  context.out.line(fmt::format("  version {} runs since tick {}; {} ticks without new values", report.version,
                               report.tick, report.left_out));
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

int conclude(Context& context, const ReloadOptions& options, const Reloaded& done) {
  const operate::ReloadReport& report = done.report;
  for (const std::string& error : report.errors) {
    context.out.message_line(error);
  }
  if (context.format == Format::Json) {
    context.out.line(json_of(report).dump(2));
  } else if (report.errors.empty() && !report.to.empty()) {
    print_plan(context, report.plan);
  }
  const std::string text = fmt::format("module '{}': {}", report.module, report.text);
  switch (done.answer.result) {
    case CommandResult::Refused:
      context.out.error(text);
      return kCheckFailed;
    case CommandResult::Done:
    case CommandResult::Unchanged:
      context.out.note(text);
      break;
    default:
      context.out.error(text);
      return kFailed;
  }
  if (done.answer.result == CommandResult::Unchanged || options.request.dry_run) {
    return kOk;
  }
  if (context.format != Format::Json) {
    print_exchange(context, report);
  }
  return options.back ? kOk : await_health(context, done);
}

int reload(Context& context, ReloadOptions& options) {
  if (options.back && (!options.file.empty() || options.request.dry_run)) {
    context.out.error("--back takes a module only: the previous version is in memory");
    return kUsage;
  }
  const auto node = choose_node(context.node);
  if (!node) {
    return report(context.out, node.error());
  }
  if (!options.file.empty()) {
    options.request.file = std::filesystem::absolute(options.file).lexically_normal().string();
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
  return conclude(context, options, *done);
}

Action declare_reload(base::Options& app, Context& context) {
  auto options = std::make_shared<ReloadOptions>();
  options->request.health_ns = 5'000'000'000;
  app.add("module", "MODULE", options->module, "A thread module of the node")
      .required()
      .completes(base::Completion::Module);
  app.add("file", "FILE", options->file, "The file of its new version (default: that of the configuration)")
      .completes(base::Completion::File);
  app.flag("--dry-run", options->request.dry_run, "Load and compare it, and exchange nothing");
  app.flag("--back", options->back, "Exchange it with the previous version");
  app.flag("--lossy", options->request.lossy, "Exchange it although values that it keeps are lost");
  add_time_option(app, "--health", options->request.health_ns,
                  "How long the previous version is ready to run again (default 5 s, 0s: not at all)");
  app.add("--guard", "CONDITION", options->request.guard,
          "A number must be so in that time, else the previous version runs again: \"O0 == 0\"");
  add_time_option(app, "--timeout", options->timeout_ns, "How long to wait for the exchange (default 30 s)");
  add_reason_option(app, context);
  add_node_option(app, context);
  add_format_option(app, context, {Format::Table, Format::Json});
  return [options](Context& c) { return reload(c, *options); };
}

}  // namespace

const Verb kReloadVerb{
    "reload", "Start and stop", "Exchange the code of a module while the node runs",
    "The new version is checked, loaded and started next to the running one. Between two runs of the module it "
    "follows\n"
    "with what the module keeps (INDUROP_STATE; PLC programs on their own); no run is left out. If it then faults,\n"
    "overruns or breaks the guard within the health window, the previous version runs again in the next tick.\n"
    "Exit code 0 if it runs, or was the same version; 1 if it could not be started or exchanged; 4 if it was refused:\n"
    "it cannot run here, or values would be lost; 5 if it was exchanged and the previous version runs again; 6 if the\n"
    "node does not run or did not answer. Unless it is 0, the version that ran before runs.\n"
    "Examples:\n"
    "  indurop reload press --dry-run\n"
    "  indurop reload press --health 10s --guard \"pressure < 80\"\n"
    "  indurop reload press build/press.so --reason \"faster ramp\"\n"
    "  indurop reload press --back\n",
    &declare_reload};

}  // namespace indurop::tools
