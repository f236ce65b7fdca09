// SPDX-License-Identifier: Apache-2.0
// indurop record: writes what the runs of a node's modules read and write to a file that third-party programs can read
// too.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "config/xml/plant_reader.h"
#include "core/base/read_file.h"
#include "core/rt/clock.h"
#include "history/explain/facts_json.h"
#include "history/recorder/parts.h"
#include "store/vars/unmatched_patterns.h"
#include "tools/cli/command/amount.h"
#include "tools/cli/explain/gather.h"
#include "tools/cli/plant/record_with_agents.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/process/gentle.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/units.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kRecordPauseNs = 5'000'000;
constexpr std::int64_t kFlushNs = 1'000'000'000;

struct RecordOptions {
  std::vector<std::string> names;
  std::filesystem::path plant;  // empty: one node
  std::filesystem::path file;
  std::int64_t duration_ns = 0;  // 0: until the node or the user ends it
  bool past = false;
  recorder::Limits limits;
  bool remote = false;
  deploy::LinkSettings link;
};

// A node that is being recorded.
struct Recorded {
  ChosenRun chosen;
  vars::Store store;
  std::string board;  // in the plant; empty: none
};

recorder::About about(const ChosenRun& chosen, const vars::Store& store) {
  const scheduler::RunBlock& run = chosen.run.block();
  recorder::About about;
  about.node = chosen.node;
  const std::string config = fixed_text(run.config_file);
  about.board = fixed_text(run.board);
  about.config = about.board.empty() ? config : fixed_text(run.plant_file);
  about.deployment = fixed_text(run.deployment);
  about.basic_period_ns = run.basic_period_ns;
  about.real_minus_node_ns = rt::wall_ns() - rt::to_ns(store.now());
  for (std::uint32_t i = 0; i < chosen.run.module_count(); ++i) {
    about.modules.push_back(fixed_text(chosen.run.module(i).name));
  }
  if (auto text = base::read_file(config)) {
    about.files.emplace_back(std::filesystem::path(config).filename().string(), *std::move(text));
  }
  // Written at the begin already, which tells a reader that the end of this recording is not that of the node.
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

using Nodes = std::vector<std::unique_ptr<Recorded>>;

std::vector<std::string> facts_of(const Nodes& nodes) {
  std::vector<std::string> facts;
  std::transform(nodes.begin(), nodes.end(), std::back_inserter(facts),
                 [](const auto& node) { return facts_text_here(node->chosen.node, node->chosen.run); });
  return facts;
}

// Records until the end is requested. Errors: those of the disk.
Result<void, base::Problem> go_on(const RecordOptions& options, const Nodes& nodes, recorder::Parts& parts) {
  const std::int64_t begin = rt::now_ns();
  std::int64_t flushed = begin;
  for (;;) {
    const bool all_ended =
        std::all_of(nodes.begin(), nodes.end(), [](const auto& node) { return ended(node->chosen.run); });
    const bool last =
        interrupted() || all_ended || (options.duration_ns > 0 && rt::now_ns() - begin >= options.duration_ns);
    // Before the last runs are taken: explain would miss those of later ticks.
    const std::vector<std::string> facts = last ? facts_of(nodes) : std::vector<std::string>();
    if (auto taken = parts.take(); !taken) {
      return taken;
    }
    if (last) {
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (auto attached = parts.attach(i, explain::kFactsFile, facts[i]); !attached) {
          return attached;
        }
      }
      return parts.close();
    }
    if (rt::now_ns() - flushed >= kFlushNs) {
      if (auto done = parts.flush(); !done) {
        return done;
      }
      flushed = rt::now_ns();
    }
    wait_until(rt::now_ns() + kRecordPauseNs);
  }
}

// Returns false if something is missing in the recording.
bool report_missing(Context& context, const Recorded& node, const recorder::Recorder& recorder) {
  for (const std::string& name : recorder.too_large()) {
    context.out.error(
        fmt::format("{} is too large for the tape and was not recorded; start the node with a larger --tape", name));
  }
  for (const std::string& name : recorder.appeared()) {
    context.out.note(
        fmt::format("{} is not in the recording: it appeared while the node runs, and no module uses it yet", name));
  }
  for (const auto& [module, runs] : recorder.counts().lost) {
    context.out.error(
        fmt::format("{} runs of {} are not in the recording: they were overwritten before they were read; "
                    "start the node with a larger --tape",
                    runs, node.chosen.run.module_name(module)));
  }
  return recorder.counts().lost.empty();
}

// Returns false if the node did not end normally. If it did, its recording is complete.
bool report_death(Context& context, const Recorded& node) {
  const RunView& run = node.chosen.run;
  const auto state = run.block().state.load();
  if (run.node_alive() || state == scheduler::NodeState::Stopped || state == scheduler::NodeState::Failed) {
    return true;
  }
  context.out.error(fmt::format("{} {} crashed or was killed: of it the recording ends at about tick {}",
                                node.board.empty() ? "node" : "board",
                                node.board.empty() ? node.chosen.node : node.board, run.block().tick.load()));
  return false;
}

int report_result(Context& context, const Nodes& nodes, const recorder::Parts& parts) {
  bool whole = true;
  std::uint64_t runs = 0;
  std::uint64_t values = 0;
  std::size_t variables = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const recorder::Recorder& recorder = parts.recorders()[i];
    whole = report_missing(context, *nodes[i], recorder) && whole;
    whole = report_death(context, *nodes[i]) && whole;
    runs += recorder.counts().runs;
    values += recorder.counts().values;
    variables += recorder.variables();
  }
  const std::string boards = nodes.size() > 1 ? fmt::format(" of {} boards", nodes.size()) : "";
  const std::string removed = parts.removed() > 0 ? fmt::format("; {} older parts were removed", parts.removed()) : "";
  context.out.note(fmt::format("{}: {}, {} of {}{}, {}{}", parts.files(), counted(runs, "run"),
                               counted(values, "value"), counted(variables, "variable"), boards,
                               human_bytes(parts.bytes()), removed));
  return whole ? kOk : kFailed;
}

// Opens a node and adds it to both; returns what prevents that, else nothing.
std::optional<Failure> add_node(Context& context, const std::string& board, Nodes& nodes,
                                std::vector<recorder::Taped>& taped) {
  auto chosen = open_run(board.empty() ? context.node : board);
  if (!chosen) {
    return chosen.error();
  }
  if (!board.empty() && ended(chosen->run)) {
    return Failure{kUnreachable, {}};  // it may run on another host now
  }
  context.node = chosen->node;
  auto store = open_store(context, vars::Mode::ReadOnly);
  if (!store) {
    return store.error();
  }
  auto follower = tape::Follower::open(chosen->node, true);
  if (!follower) {
    return no_tape(chosen->node, follower.error());
  }
  if (follower->header().node_pid != chosen->run.block().node_pid.load()) {
    return no_tape(chosen->node, Error{Errc::NotFound, 0, "of another run"});
  }
  nodes.push_back(std::make_unique<Recorded>(Recorded{std::move(*chosen), std::move(*store), board}));
  recorder::About facts = about(nodes.back()->chosen, nodes.back()->store);
  taped.push_back({board.empty() ? "" : board + "/", std::move(facts), &nodes.back()->store, std::move(*follower)});
  return std::nullopt;
}

// Adds the boards of this host, unless agents are to record them too. Returns the others.
std::vector<BoardElsewhere> add_boards(Context& context, const RecordOptions& options, const config::Plant& plant,
                                       Nodes& nodes, std::vector<recorder::Taped>& taped) {
  std::vector<BoardElsewhere> elsewhere;
  for (const config::Board& board : plant.boards) {
    const auto failure = options.remote ? std::optional<Failure>(Failure{kUnreachable, {}})
                                        : add_node(context, board.name, nodes, taped);
    if (failure) {
      elsewhere.push_back({board.name, failure->code == kUnreachable ? "" : failure->text});
    }
  }
  return elsewhere;
}

// Records nodes of this host.
int record_here(Context& context, const RecordOptions& options, const std::filesystem::path& file, const Nodes& nodes,
                std::vector<recorder::Taped> taped, const std::vector<std::string>& names) {
  for (const auto& node : nodes) {
    be_gentle(node->chosen.node);
  }
  auto parts = recorder::Parts::create(file, options.limits, std::move(taped), names);
  if (!parts) {
    context.out.error(parts.error().text);
    return kFailed;
  }
  if (!options.past) {
    parts->learn();
  }
  const auto done = go_on(options, nodes, *parts);
  int code = report_result(context, nodes, *parts);
  if (!done) {
    context.out.error(done.error().text + "; the recording ends here");
    code = kFailed;
  }
  if (code != kOk) {
    take_interrupt();  // missing data determines the exit code, not the interrupt
  }
  return code;
}

int record_plant(Context& context, RecordOptions& options) {
  const config::ReadPlant read = config::read_plant(options.plant);
  if (!read.ok()) {
    print_diagnostics(context, read.diagnostics, false);
    return kCheckFailed;
  }
  Nodes nodes;
  std::vector<recorder::Taped> taped;
  std::vector<BoardElsewhere> elsewhere = add_boards(context, options, read.plant, nodes, taped);
  std::vector<std::string> names = options.names;
  if (elsewhere.empty()) {
    return record_here(context, options, options.file, nodes, std::move(taped), names);
  }
  if (options.limits.in_parts()) {
    context.out.error("--split and --keep are for boards of this host only, and " + elsewhere.front().name +
                      " does not run here");
    return kUsage;
  }
  std::vector<std::string> unmatched = names;
  for (const auto& node : nodes) {
    unmatched = vars::unmatched_patterns(node->store, unmatched);
  }
  std::erase_if(names, [&](const std::string& name) {
    return std::find(unmatched.begin(), unmatched.end(), name) != unmatched.end();
  });
  const RecordRequest request{read.plant.name, std::move(elsewhere), options.names,
                              options.past,    options.duration_ns,  options.file};
  std::function<int(const std::filesystem::path& file)> here;
  if (!nodes.empty() && names.empty() == options.names.empty()) {
    here = [&](const std::filesystem::path& file) {
      return record_here(context, options, file, nodes, std::move(taped), names);
    };
  }
  return record_with_agents(context, request, options.link, unmatched, here);
}

int record(Context& context, RecordOptions& options) {
  if (options.plant.empty() && options.remote) {
    context.out.error("say which plant: indurop record --remote --plant plant.xml");
    return kUsage;
  }
  if (!options.plant.empty()) {
    return record_plant(context, options);
  }
  Nodes nodes;
  std::vector<recorder::Taped> taped;
  if (const auto failure = add_node(context, "", nodes, taped)) {
    return report(context.out, *failure);
  }
  return record_here(context, options, options.file, nodes, std::move(taped), options.names);
}

Action declare_record(base::Options& app, Context& context) {
  auto options = std::make_shared<RecordOptions>();
  app.add("names", "GLOB", options->names, "Variables, or globs; none: all").completes(base::Completion::Variable);
  app.add("-o,--file", "FILE.mcap", options->file, "File to write; it must not exist yet").required();
  app.flag("--past", options->past, "Begin with the oldest run that is still on the node's tape");
  add_time_option(app, "--duration", options->duration_ns, "End after this time");
  add_amount_option(app, "--split", options->limits.split_ns, options->limits.split_bytes,
                    "Start a new file (run.0002.mcap, ...) after this time or size: 10min, 100MB");
  add_amount_option(app, "--keep", options->limits.keep_ns, options->limits.keep_bytes,
                    "Keep only the last 1h or 2GB; older files are deleted (default: split into 8 files)");
  app.add("--plant", "FILE", options->plant,
          "Record all boards of this plant in one file; agents record those that do not run on this host")
      .completes(base::Completion::File);
  app.flag("--remote", options->remote, "With --plant: let agents record the boards of this host, too");
  deploy::add_link_options(app, options->link);
  add_node_option(app, context);
  return [options](Context& c) { return record(c, *options); };
}

}  // namespace

const Verb kRecordVerb{
    "record", "Variables", "Record what modules read and write in every run",
    "For each run of a module, the node records what the run began with and what it wrote, in a ring of shared\n"
    "memory. This verb copies it from there to an MCAP file, which Foxglove and PlotJuggler can also open. The\n"
    "node is not affected. Even if the recorder is killed, the file is readable up to its last second. To record\n"
    "from the first run on, so that the recording can be replayed, use indurop run module.xml --record run.mcap.\n"
    "Examples:\n"
    "  indurop record -o run.mcap\n"
    "  indurop record 'PLC_ROBOT::*' 'knu::Robot::joints' -o arm.mcap --duration 60s\n"
    "  indurop record --plant plant.xml -o plant.mcap --duration 60s\n"
    "  indurop record -o last.mcap --keep 1h      # day and night, in a bounded part of the disk\n",
    &declare_record};

}  // namespace indurop::tools
