// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/explain/board_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "history/recorder/run_words.h"
#include "history/recorder/sources.h"
#include "history/recording/cdr.h"
#include "history/recording/mcap_reader.h"

namespace indurop::tools {

using base::Problem;

BoardRuns::BoardRuns(std::string board, std::vector<std::string> modules, std::vector<std::string> wanted)
    : board_(std::move(board)), wanted_(std::move(wanted)) {
  for (std::string& name : modules) {
    const std::vector<std::uint64_t> nothing(wanted_.size(), 0);
    modules_.push_back({std::move(name), nothing, nothing, std::nullopt, {}});
  }
}

void BoardRuns::add_value(std::uint32_t module, std::size_t variable, tape::EntryKind kind, std::uint64_t value) {
  if (module >= modules_.size()) {
    return;
  }
  modules_[module].known[variable] = value;
  if (kind == tape::EntryKind::Before || kind == tape::EntryKind::Run) {
    modules_[module].begin[variable] = value;
  }
}

void BoardRuns::end(std::uint32_t module, const tape::RunTail& tail, std::int64_t shift_ns) {
  if (module >= modules_.size()) {
    return;
  }
  Module& one = modules_[module];
  Run run{tail, one.begin, one.known};
  run.tail.release_ns += shift_ns;
  run.tail.start_ns += shift_ns;
  run.tail.end_ns += shift_ns;
  // Changes in runs that were not read are unknown.
  if (one.next && *one.next != tail.number) {
    std::fill(run.before.begin(), run.before.end(), 0);
    std::fill(run.behind.begin(), run.behind.end(), 0);
    std::fill(one.known.begin(), one.known.end(), 0);
  }
  one.next = tail.number + 1;
  one.begin = one.known;
  one.runs.push_back(std::move(run));
}

void BoardRuns::forget() {
  for (Module& one : modules_) {
    one.runs.clear();
  }
}

std::size_t BoardRuns::place_of(const std::string& variable) const {
  return static_cast<std::size_t>(std::find(wanted_.begin(), wanted_.end(), variable) - wanted_.begin());
}

std::vector<explain::ChainRun> BoardRuns::runs_of(const std::string& module, const std::string& before,
                                                  const std::string& behind) const {
  const std::size_t from = place_of(before);
  const std::size_t to = place_of(behind);
  std::vector<explain::ChainRun> runs;
  const auto found =
      std::find_if(modules_.begin(), modules_.end(), [&](const Module& one) { return one.name == module; });
  if (found == modules_.end()) {
    return runs;
  }
  for (const Run& run : found->runs) {
    runs.push_back({run.tail.number, run.tail.release_ns, run.tail.start_ns, run.tail.end_ns,
                    from < wanted_.size() ? run.before[from] : 0, to < wanted_.size() ? run.behind[to] : 0});
  }
  return runs;
}

explain::Facts BoardRuns::facts(const std::vector<explain::ModuleFact>& modules) const {
  explain::Facts facts;
  for (const Module& one : modules_) {
    const auto known = std::find_if(modules.begin(), modules.end(),
                                    [&](const explain::ModuleFact& module) { return module.name == one.name; });
    facts.modules.push_back(known == modules.end() ? explain::ModuleFact{} : *known);
    facts.modules.back().name = one.name;
    for (const Run& run : one.runs) {
      facts.runs.push_back({static_cast<std::uint32_t>(facts.modules.size() - 1), run.tail.tick, run.tail.release_ns,
                            run.tail.start_ns, run.tail.end_ns, false});
    }
  }
  std::stable_sort(facts.runs.begin(), facts.runs.end(),
                   [](const auto& a, const auto& b) { return a.start_ns < b.start_ns; });
  return facts;
}

std::uint64_t value_number(std::span<const std::uint8_t> cdr) {
  const std::uint64_t hash = abi::fnv1a64(reinterpret_cast<const char*>(cdr.data()), cdr.size());
  return hash == 0 ? 1 : hash;
}

Result<FollowedBoard, Failure> FollowedBoard::open(const std::string& node, const std::string& board,
                                                   std::vector<std::string> wanted) {
  auto run = open_run(node);
  if (!run) {
    return std::move(run).error();
  }
  auto store = vars::Store::attach(run->node, vars::Mode::ReadOnly);
  if (!store) {
    return Failure{exit_code_of(store.error()), explain_open_error(store.error(), run->node, false)};
  }
  auto follower = tape::Follower::open(run->node, true);
  if (!follower || follower->header().layout_hash != store->header().layout_hash) {
    return Failure{kFailed, fmt::format("node '{}' keeps no tape: start it without --tape 0", run->node)};
  }
  std::vector<std::string> modules;
  for (std::uint32_t i = 0; i < run->run.module_count(); ++i) {
    modules.push_back(fixed_text(run->run.module(i).name));
  }
  FollowedBoard followed(std::move(*store), std::move(*follower), {board, std::move(modules), std::move(wanted)});
  for (std::size_t i = 0; i < followed.runs_.wanted().size(); ++i) {
    const std::string& name = followed.runs_.wanted()[i];
    if (const auto* entry = followed.store_.find(abi::fnv1a64(name.data(), name.size())); entry != nullptr) {
      followed.places_[static_cast<std::uint32_t>(entry - followed.store_.directory().data())] = i;
    }
  }
  return followed;
}

void FollowedBoard::skip() {
  take();
  runs_.forget();
}

void FollowedBoard::take() {
  tape::Run run;
  std::vector<std::uint8_t> cdr;
  for (std::size_t track = 0; track < follower_.tracks(); ++track) {
    while (follower_.next(track, run)) {
      for (const tape::Value& value : run.values) {
        const auto place = places_.find(value.variable);
        if (place == places_.end()) {
          continue;
        }
        const auto& type = store_.schema().variables[store_.directory()[value.variable].schema_index].type;
        if (recording::to_cdr(type, value.bytes, cdr)) {
          runs_.add_value(run.module, place->second, value.kind, value_number(cdr));
        }
      }
      runs_.end(run.module, run.tail, 0);
    }
  }
}

Result<std::string, Problem> recorded_config(const std::filesystem::path& file) {
  const auto reader = recording::McapReader::open(file);
  if (!reader) {
    return reader.error();
  }
  for (const recorder::Source& source : recorder::find_sources(*reader).all) {
    if (std::string config = source.text("config"); !config.empty()) {
      return config;
    }
  }
  return Problem{fmt::format("{} is no recording of a node", file.string())};
}

Result<std::vector<BoardRuns>, Problem> recorded_runs(const std::filesystem::path& file,
                                                      const std::vector<std::string>& wanted) {
  auto reader = recording::McapReader::open(file);
  if (!reader) {
    return std::move(reader).error();
  }
  const recorder::Sources sources = recorder::find_sources(*reader);
  if (sources.all.empty()) {
    return Problem{fmt::format("{} is no recording of a node", file.string())};
  }
  std::vector<BoardRuns> boards;
  std::vector<std::int64_t> shifts;
  for (const recorder::Source& source : sources.all) {
    shifts.push_back(source.number("real_minus_node_ns"));
    boards.emplace_back(source.text("board"), source.modules, wanted);
  }
  (void)reader->each([&](const recording::McapMessage& message) {
    const auto channel = sources.channels.find(message.channel);
    if (channel == sources.channels.end()) {
      return;
    }
    const recorder::ChannelPlace& place = channel->second;
    if (place.kind == recorder::ChannelKind::Run) {
      if (const auto run = recorder::run_from_cdr(message.data.view)) {
        boards[place.source].end(run->module, run->tail, shifts[place.source]);
      }
    } else if (place.kind == recorder::ChannelKind::Value) {
      const auto variable = std::find(wanted.begin(), wanted.end(), place.name);
      const auto words = recorder::from_sequence(message.sequence);
      if (variable != wanted.end()) {
        boards[place.source].add_value(words.module, static_cast<std::size_t>(variable - wanted.begin()), words.kind,
                                       value_number(message.data.view));
      }
    }
  });
  return boards;
}

}  // namespace indurop::tools
