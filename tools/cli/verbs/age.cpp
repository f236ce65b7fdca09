// SPDX-License-Identifier: Apache-2.0
// indurop age: the age of data from one variable to another, measured in the runs of a node.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include "core/rt/clock.h"
#include "store/vars/node_lock.h"
#include "tools/cli/explain/board_runs.h"
#include "tools/cli/explain/gather.h"
#include "tools/cli/plant/check_chain.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/mirror_view.h"
#include "tools/client/process/gentle.h"
#include "tools/client/process/interrupt.h"
#include "tools/console/diagnostics.h"

namespace indurop::tools {
namespace {

using base::Nanos;
using explain::ChainAges;
using explain::Keeping;

constexpr std::int64_t kAgePauseNs = 5'000'000;

struct AgeOptions {
  std::string from;
  std::string to;
  std::vector<std::string> files;
  std::string config;
  std::int64_t duration_ns = 0;  // 0: what is on the tape
  std::int64_t network_ns = 0;   // 0: not given
};

// The configuration's file, and the requested node; no node: recordings are used.
struct AgeAsked {
  std::string config;
  std::string node;
  std::string board;  // that node's
};

// Returns one of the local nodes if all are boards of one plant; else none: then the user has to choose.
std::string any_board() {
  std::string chosen;
  std::set<std::string> configs;
  for (const std::string& node : vars::list_nodes()) {
    const auto run = vars::running_node(node) != 0 ? RunView::open(node) : Result<RunView>(Error{Errc::NotFound});
    if (run) {
      configs.insert(fixed_text(run->block().config_file));
      chosen = view_mirror(node) ? node : chosen;
    }
  }
  return configs.size() == 1 ? chosen : "";
}

Result<AgeAsked, Failure> whom(const Context& context, const AgeOptions& options) {
  AgeAsked asked;
  if (!options.files.empty()) {
    const auto config = recorded_config(options.files.front());
    if (!config) {
      return Failure{kFailed, config.error().text};
    }
    asked.config = *config;
  } else {
    const auto run =
        open_run(context.node.empty() && std::getenv("INDUROP_NODE") == nullptr ? any_board() : context.node);
    if (!run) {
      return run.error();
    }
    asked.node = run->node;
    asked.config = fixed_text(run->run.block().config_file);
    const auto mirror = view_mirror(asked.node);
    asked.board = mirror ? mirror->board : "";
  }
  asked.config = options.config.empty() ? asked.config : options.config;
  std::error_code ignored;
  if (!std::filesystem::exists(asked.config, ignored)) {
    return Failure{kFailed, fmt::format("its configuration {} is not here: name it with --config", asked.config)};
  }
  return asked;
}

// Nodes of one plant differ only in the name of the board: "control-sim" and "sensor-sim".
std::string node_of(const AgeAsked& asked, const std::string& board) {
  std::string node = asked.node;
  const auto at = asked.board.empty() ? std::string::npos : node.find(asked.board);
  return at == std::string::npos ? node : node.replace(at, asked.board.size(), board);
}

using Runs = std::vector<BoardRuns>;

Result<Runs, Failure> follow_nodes(const AgeAsked& asked, const std::set<std::string>& boards,
                                   const std::vector<std::string>& wanted, std::int64_t duration_ns) {
  std::vector<FollowedBoard> followed;
  for (const std::string& board : boards) {
    auto one = FollowedBoard::open(node_of(asked, board), board, wanted);
    if (!one) {
      return Failure{one.error().code,
                     fmt::format("{}{}", one.error().text,
                                 board.empty() ? ""
                                               : "; of boards that run elsewhere make a recording on each (indurop "
                                                 "record), and name all of them with --from")};
    }
    followed.push_back(std::move(*one));
  }
  be_gentle(asked.node);
  const std::int64_t begin = rt::now_ns();
  for (FollowedBoard& one : followed) {
    if (duration_ns > 0) {
      one.skip();
    } else {
      one.take();
    }
  }
  while (duration_ns > 0 && rt::now_ns() - begin < duration_ns && !interrupted()) {
    wait_until(rt::now_ns() + kAgePauseNs);
    for (FollowedBoard& one : followed) {
      one.take();
    }
  }
  Runs runs;
  for (const FollowedBoard& one : followed) {
    runs.push_back(one.runs());
  }
  return runs;
}

Result<Runs, Failure> read_files(const AgeOptions& options, const std::vector<std::string>& wanted) {
  Runs runs;
  for (const std::string& file : options.files) {
    auto some = recorded_runs(file, wanted);
    if (!some) {
      return Failure{kFailed, some.error().text};
    }
    for (auto& one : *some) {
      const auto same = [&one](const auto& other) { return other.board() == one.board(); };
      if (std::any_of(runs.begin(), runs.end(), same)) {
        return Failure{kUsage, two_recordings(one.board(), file)};
      }
      runs.push_back(std::move(one));
    }
  }
  return runs;
}

// The measurement of one chain.
struct Measured {
  std::vector<std::int64_t> ages;  // sorted
  std::uint64_t disturbed = 0;     // left out of `ages`: something overran or was lost meanwhile
  std::int64_t disturbed_most = 0;
  std::uint64_t unclear = 0;
  std::uint64_t unread = 0;
};

class Measurement {
 public:
  Measurement(const ChainPlant& plant, const Runs& runs) : plant_(plant), runs_(runs), chains_(plant.chains()) {
    for (std::size_t board = 0; board < plant_.boards().size(); ++board) {
      keep(board);
    }
  }

  [[nodiscard]] const Chains& chains() const noexcept { return chains_; }

  // Returns nothing if the runs of one of its boards are not available.
  [[nodiscard]] std::optional<Measured> measure(const Chain& chain) const {
    std::vector<explain::ChainStage> stages;
    for (std::size_t i = 0; i < chain.modules.size(); ++i) {
      const auto& [board, module] = chain.modules[i];
      const BoardRuns* const runs = runs_of(board);
      if (runs == nullptr) {
        return std::nullopt;
      }
      stages.push_back(
          {runs->runs_of(plant_.boards()[board].config.modules[module].name, i == 0 ? "" : chain.variables[i - 1],
                         i < chain.variables.size() ? chain.variables[i] : ""),
           i + 1 < chain.modules.size() && chain.modules[i + 1].first != board});
    }
    const ChainAges ages = explain::follow_chain(stages);
    Measured measured;
    measured.unclear = ages.foreign + ages.repeated;
    measured.unread = ages.unread;
    for (const explain::ChainSample& sample : ages.samples) {
      const bool disturbed = std::any_of(chain.modules.begin(), chain.modules.end(), [&](const Chain::Node& one) {
        return explain::was_disturbed(keepings_[one.first], sample);
      });
      if (disturbed) {
        ++measured.disturbed;
        measured.disturbed_most = std::max(measured.disturbed_most, sample.age());
      } else {
        measured.ages.push_back(sample.age());
      }
    }
    std::sort(measured.ages.begin(), measured.ages.end());
    return measured;
  }

 private:
  [[nodiscard]] const BoardRuns* runs_of(std::size_t board) const {
    const std::string& name = plant_.boards()[board].name;
    const auto found =
        std::find_if(runs_.begin(), runs_.end(), [&](const BoardRuns& one) { return one.board() == name; });
    return found == runs_.end() ? nullptr : &*found;
  }

  // Adds how well the board kept its schedule, and the execution times of its modules.
  void keep(std::size_t board) {
    keepings_.emplace_back();
    const config::BoardView& view = plant_.boards()[board];
    const BoardRuns* const runs = runs_of(board);
    if (runs == nullptr) {
      return;
    }
    std::vector<explain::ModuleFact> modules;
    for (const std::size_t i : view.result.periodic) {
      explain::ModuleFact module;
      module.name = view.config.modules[i].name;
      module.period_ns = view.config.modules[i].period.count();
      module.core = view.config.modules[i].core;
      modules.push_back(std::move(module));
    }
    const explain::Facts facts = runs->facts(modules);
    keepings_.back() = explain::keeping_of(facts);
    for (const std::size_t i : view.result.periodic) {
      for (std::size_t known = 0; known < facts.modules.size(); ++known) {
        if (facts.modules[known].name == view.config.modules[i].name) {
          chains_.measured({board, i}, Nanos(keepings_.back().longest_ns[known]));
        }
      }
    }
    if (keepings_.back().late_ns > 0) {
      chains_.measured_start(board, view.result.table.basic_period, Nanos(keepings_.back().late_ns));
    }
  }

  const ChainPlant& plant_;
  const Runs& runs_;
  Chains chains_;
  std::vector<Keeping> keepings_;  // by board
};

Cell time_cell(const std::vector<std::int64_t>& ages, std::size_t index) {
  return ages.empty() ? Cell("-", nullptr, Style::None) : Cell(microseconds(Nanos(ages[index])), ages[index]);
}

// Adds a row; returns whether everything measured is as predicted.
bool add_row(Context& context, const Measurement& measurement, const Chain& chain, const Measured& measured,
             Nanos network, Table& table) {
  const config::ChainAge age = measurement.chains().age(chain, network);
  const std::vector<std::int64_t>& ages = measured.ages;
  const std::size_t count = ages.size();
  const bool within = count == 0 || (ages.front() >= age.least.count() && ages.back() <= age.most.count());
  const std::string way = measurement.chains().name(chain);
  table.add({Cell(way),
             {microseconds(age.least), age.least.count()},
             {microseconds(age.most), age.most.count()},
             time_cell(ages, 0),
             time_cell(ages, count / 2),
             time_cell(ages, count == 0 ? 0 : (count - 1) * 99 / 100),
             time_cell(ages, count == 0 ? 0 : count - 1),
             {std::to_string(count), count},
             {std::to_string(measured.unclear), measured.unclear},
             {std::to_string(measured.disturbed), measured.disturbed},
             {std::to_string(measured.unread), measured.unread}});
  if (context.format != Format::Table) {
    return within;
  }
  if (measured.disturbed > 0) {
    context.out.note(fmt::format("{}: {} more came when a run was lost or took longer than its period, up to {}", way,
                                 measured.disturbed, microseconds(Nanos(measured.disturbed_most))));
  }
  if (measured.unclear > 0) {
    context.out.note(
        fmt::format("{}: {} runs are unclear: their inputs are not what the previous module left, or do not "
                    "change in every run",
                    way, measured.unclear));
  }
  if (!within) {
    context.out.error(fmt::format("{}: older or younger than predicted; are <wcet> and --network right?", way));
  }
  return within;
}

// Prints the measurements of all chains. Returns the exit code.
int print_result(Context& context, const AgeOptions& options, const ChainPlant& plant, const std::vector<Chain>& found,
                 const Runs& runs) {
  // Current measurements of boards do not apply to a recording.
  const auto boards = options.files.empty() ? plant.boards() : std::span<const config::BoardView>{};
  const NetworkTime network =
      network_time(boards, options.network_ns > 0 ? std::optional(Nanos(options.network_ns)) : std::nullopt);
  const Measurement measurement(plant, runs);
  Table table({{"WAY", "way"},
               {"BEST", "best_ns", Align::Right},
               {"WORST", "worst_ns", Align::Right},
               {"LEAST", "least_ns", Align::Right},
               {"MEDIAN", "median_ns", Align::Right},
               {"99 %", "p99_ns", Align::Right},
               {"MOST", "most_ns", Align::Right},
               {"RUNS", "runs", Align::Right},
               {"UNCLEAR", "unclear", Align::Right},
               {"DISTURBED", "disturbed", Align::Right},
               {"UNREAD", "unread", Align::Right}});
  bool within = true;
  bool crosses = false;
  for (const Chain& chain : found) {
    const auto measured = measurement.measure(chain);
    if (!measured) {
      context.out.error(fmt::format("{}: not measured, a recording of one of its boards is missing",
                                    measurement.chains().name(chain)));
      within = false;
      continue;
    }
    within = add_row(context, measurement, chain, *measured, network.most, table) && within;
    crosses = crosses || measurement.chains().age(chain, network.most).crossings > 0;
  }
  print_table(context, table, {{"from", options.from}, {"to", options.to}, {"network_ns", network.most.count()}},
              "chains");
  if (crosses && context.format == Format::Table) {
    context.out.note("predicted with " + network_words(network));
  }
  return within ? kOk : kCheckFailed;
}

int age(Context& context, const AgeOptions& options) {
  const auto asked = whom(context, options);
  if (!asked) {
    return report(context.out, asked.error());
  }
  const ChainPlant plant(asked->config, {.files = true, .adjust = true});
  if (!plant.ok()) {
    print_diagnostics(context, plant.diagnostics(), false);
    return kCheckFailed;
  }
  const auto found = find_chains(context, plant, options.from, options.to);
  if (!found) {
    return kFailed;
  }
  std::set<std::string> boards;
  std::set<std::string> wanted;
  for (const Chain& chain : *found) {
    for (const Chain::Node& one : chain.modules) {
      boards.insert(plant.boards()[one.first].name);
    }
    wanted.insert(chain.variables.begin(), chain.variables.end());
  }
  const std::vector<std::string> names(wanted.begin(), wanted.end());
  const auto runs =
      options.files.empty() ? follow_nodes(*asked, boards, names, options.duration_ns) : read_files(options, names);
  return runs ? print_result(context, options, plant, *found, *runs) : report(context.out, runs.error());
}

Action declare_age(base::Options& app, Context& context) {
  auto options = std::make_shared<AgeOptions>();
  app.add("begin", "FROM", options->from, "Variable at which the chain begins, for example of a sensor")
      .required()
      .completes(base::Completion::Variable);
  app.add("end", "TO", options->to, "Variable at which the chain ends, for example of an actuator")
      .required()
      .completes(base::Completion::Variable);
  add_time_option(app, "--duration", options->duration_ns,
                  "Measure from now on for this time (default: use what is on the tape, two seconds or more)");
  app.add("--from", "FILE.mcap", options->files, "Use a recording; for a plant, one of each board or a joined one")
      .completes(base::Completion::File);
  app.add("--config", "FILE", options->config, "The configuration (default: what the node or the recording names)")
      .completes(base::Completion::File);
  add_time_option(app, "--network", options->network_ns,
                  "Maximum time from board to board, for the prediction (default: as measured by the boards of "
                  "this host, else 1 ms)");
  add_node_option(app, context);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return [options](Context& c) { return age(c, *options); };
}

}  // namespace

const Verb kAgeVerb{
    "age", "Timing", "Measure end-to-end data age between two variables, and compare it with the prediction",
    "Traces values from run to run, over modules and boards: from the release of the run that wrote FROM to the\n"
    "release of the run that wrote TO. BEST and WORST are what indurop check --chain predicts with the execution\n"
    "times measured in that time; the rest is measured. For boards that do not run on this machine, use\n"
    "recordings. Exit code 0 if everything is within the prediction, 4 if not.\n"
    "Examples:\n"
    "  indurop age cell::encoder cell::torque\n"
    "  indurop age cell::encoder cell::torque --duration 10s\n"
    "  indurop age cell::encoder cell::torque --from run.sensor.mcap --from run.control.mcap\n",
    &declare_age};

}  // namespace indurop::tools
