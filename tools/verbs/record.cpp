// SPDX-License-Identifier: Apache-2.0
// indurop record: what the runs of a node's modules see and write, as a file that others read too.
#include <fmt/format.h>

#include "base/read_file.h"
#include "explain/facts_json.h"
#include "recorder/parts.h"
#include "rt/clock.h"
#include "tools/command/amount.h"
#include "tools/command/gentle.h"
#include "tools/command/interrupt.h"
#include "tools/command/units.h"
#include "tools/explain/gather.h"
#include "tools/values/node_choice.h"
#include "tools/verbs/verbs.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kPauseNs = 5'000'000;
constexpr std::int64_t kFlushNs = 1'000'000'000;

struct Options {
  std::vector<std::string> names;
  std::filesystem::path file;
  std::int64_t duration_ns = 0;  // 0: until the node or the user ends it
  bool past = false;
  recorder::Limits limits;
};

recorder::About about(const ChosenRun& chosen, const vars::Store& store) {
  const scheduler::RunBlock& run = chosen.run.block();
  recorder::About about;
  about.node = chosen.node;
  about.config = fixed_text(run.config_file);
  about.deployment = fixed_text(run.deployment);
  about.basic_period_ns = run.basic_period_ns;
  about.real_minus_node_ns = rt::wall_ns() - rt::to_ns(store.now());
  for (std::uint32_t i = 0; i < chosen.run.module_count(); ++i) {
    about.modules.push_back(fixed_text(chosen.run.module(i).name));
  }
  if (auto text = base::read_file(about.config)) {
    about.files.emplace_back(std::filesystem::path(about.config).filename().string(), *std::move(text));
  }
  // Already at the begin: whoever reads it knows that the end of this recording is not that of the node.
  about.files.emplace_back(explain::kFactsFile, facts_text_here(chosen.node, chosen.run));
  return about;
}

Failure no_tape(const std::string& node, const Error& error) {
  if (error.code == Errc::NotFound) {
    return {kFailed, fmt::format("node '{}' keeps no tape: start it without --tape 0", node)};
  }
  return {exit_code_of(error), fmt::format("the tape of node '{}' cannot be read: {}", node, error.where)};
}

bool ended(const RunView& run) {
  const auto state = run.block().state.load();
  return state == scheduler::NodeState::Stopped || state == scheduler::NodeState::Failed || !run.node_alive();
}

// Until it is to end. Errors: those of the disk.
Result<void, base::Problem> go_on(const Options& options, const std::string& node, const RunView& run,
                                  recorder::Parts& recorder) {
  const std::int64_t begin = rt::now_ns();
  std::int64_t flushed = begin;
  for (;;) {
    const bool last =
        interrupted() || ended(run) || (options.duration_ns > 0 && rt::now_ns() - begin >= options.duration_ns);
    if (auto taken = recorder.take(); !taken) {
      return taken;
    }
    if (last) {
      const auto attached = recorder.attach(explain::kFactsFile, facts_text_here(node, run));
      return attached ? recorder.close() : attached;
    }
    if (rt::now_ns() - flushed >= kFlushNs) {
      if (auto done = recorder.flush(); !done) {
        return done;
      }
      flushed = rt::now_ns();
    }
    wait_until(rt::now_ns() + kPauseNs);
  }
}

int tell(Context& context, const RunView& run, const recorder::Parts& parts) {
  const recorder::Recorder& recorder = parts.recorder();
  const recorder::Counts& counts = recorder.counts();
  for (const std::string& name : recorder.too_large()) {
    context.out.error(
        fmt::format("{} is too large for the tape and was not recorded; start the node with a larger --tape", name));
  }
  for (const auto& [module, runs] : counts.lost) {
    context.out.error(
        fmt::format("{} runs of {} are not in the recording: they were overwritten before they were read; "
                    "start the node with a larger --tape",
                    runs, run.module_name(module)));
  }
  context.out.note(
      fmt::format("{}: {} runs, {} values of {} variables, {}{}", parts.files(), counts.runs, counts.values,
                  recorder.variables(), human_bytes(parts.bytes()),
                  parts.removed() > 0 ? fmt::format("; {} older parts were removed", parts.removed()) : ""));
  return counts.lost.empty() ? kOk : kFailed;
}

int record(Context& context, const Options& options) {
  auto chosen = open_run(context.node);
  if (!chosen) {
    return report(context.out, chosen.error());
  }
  context.node = chosen->node;
  auto store = open_store(context, vars::Mode::ReadOnly);
  if (!store) {
    return report(context.out, store.error());
  }
  auto follower = tape::Follower::open(chosen->node, true);
  if (!follower) {
    return report(context.out, no_tape(chosen->node, follower.error()));
  }
  if (follower->header().node_pid != chosen->run.block().node_pid.load()) {
    return report(context.out, no_tape(chosen->node, Error{Errc::NotFound, 0, "of another run"}));
  }
  be_gentle(chosen->node);
  auto recorder = recorder::Parts::create(options.file, options.limits, about(*chosen, *store), *store,
                                          std::move(follower).value(), options.names);
  if (!recorder) {
    context.out.error(recorder.error().text);
    return kFailed;
  }
  if (!options.past) {
    recorder->learn();
  }
  const auto done = go_on(options, chosen->node, chosen->run, *recorder);
  const int code = tell(context, chosen->run, *recorder);
  if (!done) {
    context.out.error(done.error().text + "; the recording ends here");
  }
  return done ? code : kFailed;
}

Action declare(base::Options& app, Context& context) {
  auto options = std::make_shared<Options>();
  app.add("names", "GLOB", options->names, "Variables, or globs; none: all").completes(base::Completion::Variable);
  app.add("-o,--file", "FILE.mcap", options->file, "The file; it must not be there yet").required();
  app.flag("--past", options->past, "Begin with the oldest run that the node still has on its tape");
  add_time_option(app, "--duration", options->duration_ns, "End after this time");
  add_amount_option(app, "--split", options->limits.split_ns, options->limits.split_bytes,
                    "Begin a new file, run.0002.mcap and so on, after so much: 10min, 100MB");
  add_amount_option(app, "--keep", options->limits.keep_ns, options->limits.keep_bytes,
                    "Keep the newest so much, 1h or 2GB, in files that --split says (default: 8); older ones go");
  add_node_option(app, context);
  return [options](Context& c) { return record(c, *options); };
}

}  // namespace

const Verb kRecordVerb{
    "record", "Variables", "Record what modules read and write, at every run",
    "The node notes for each run of a module what it began with and what it left, in a ring of shared memory; this\n"
    "takes it from there to an MCAP file, which Foxglove and PlotJuggler open too. The node does not notice. Whatever\n"
    "ends the recorder, the file is readable up to its last second. To record from the first run on, so that it can "
    "be\n"
    "replayed: indurop run module.xml --record run.mcap.\n"
    "Examples:\n"
    "  indurop record -o run.mcap\n"
    "  indurop record 'PLC_ROBOT::*' 'knu::Robot::joints' -o arm.mcap --duration 60s\n"
    "  indurop record -o last.mcap --keep 1h      # day and night, in a bounded part of the disk\n",
    &declare};

}  // namespace indurop::tools
