// SPDX-License-Identifier: Apache-2.0
// Messages of a replay at its end: what differed, and what could not be compared and why.

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "node/replay/replay.h"

namespace indurop::node {
namespace {

constexpr std::size_t kShown = 10;

// Shortens the value of a struct or an array, so that a line holds two.
std::string shortened(const std::string& value) {
  constexpr std::size_t kMaxColumns = 40;
  return value.size() <= kMaxColumns ? value : value.substr(0, kMaxColumns - 3) + "...";
}

std::string ticks_to_compare(const config::Replay& replay) {
  const bool all = replay.from_tick == 0 && replay.to_tick == config::Replay::kLastTick;
  return all ? "" : " that can be repeated between the ticks asked for";
}

}  // namespace

// Reports each variable, in the order in which they began to differ.
void Replay::report_differences() {
  struct Line {
    const Known* known;
    std::string name;
    std::string module;
  };
  std::vector<Line> lines;
  for (std::size_t i = 0; i < modules_.size(); ++i) {
    for (const Known& known : modules_[i]->known) {
      if (known.differing > 0) {
        lines.push_back({&known, variable(known.variable).name, checked_.config.modules[i].name});
      }
    }
  }
  std::sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) {
    return std::tie(a.known->first_tick, a.name) < std::tie(b.known->first_tick, b.name);
  });
  for (std::size_t i = 0; i < std::min(lines.size(), kShown); ++i) {
    const auto& [known, name, module] = lines[i];
    fmt::print("  {} of {}: {} of {} runs, first at tick {}: {}{}, now {}\n", name, module, known->differing,
               known->compared, known->first_tick,
               known->first_place == name ? "" : known->first_place.substr(name.size()) + " ",
               shortened(known->first_was), shortened(known->first_is));
  }
  if (lines.size() > kShown) {
    fmt::print("  and {} other variables\n", lines.size() - kShown);
  }
}

// Returns false if something could not be compared that ran in the recording.
bool Replay::report_left_out() {
  bool whole = true;
  for (std::size_t i = 0; i < modules_.size(); ++i) {
    const Module& module = *modules_[i];
    const std::string& name = checked_.config.modules[i].name;
    const auto written = [](const Known& known) { return known.written; };
    const auto compared = [](const Known& known) { return known.written && known.ever_compared; };
    if (module.left_out > 0) {
      console_.error("{} runs of {} could not be repeated: the recording has no values of its inputs ({})",
                     module.left_out, name, module.unknown_inputs);
      whole = false;
    } else if (module.repeated > 0 && !module.apart && !module.faulted_alike &&
               std::any_of(module.known.begin(), module.known.end(), written) &&
               std::none_of(module.known.begin(), module.known.end(), compared)) {
      console_.error("{} runs of {} were repeated, but not compared: the recording has no values of its outputs",
                     module.repeated, name);
      whole = false;
    }
    if (module.too_early > 0) {
      fmt::print("{} of {} runs of {} were not repeated: not all of their inputs were recorded before them\n",
                 module.too_early, module.seen, name);
    }
    if (const std::uint64_t waited = module.kept.waited(); waited > 0) {
      fmt::print("{} of {} runs of {} were not repeated: they come before the first keyframe they could begin with\n",
                 waited, module.seen, name);
    }
  }
  if (runs_not_here_ > 0) {
    console_.error("{} runs of modules that are not in this configuration were not repeated", runs_not_here_);
    whole = false;
  }
  return whole;
}

Ending Replay::conclude() {
  std::uint64_t disturbed = 0;
  for (const auto& module : modules_) {
    disturbed += module->disturbed_runs;
  }
  if (disturbed > 0) {
    fmt::print("the inputs of {} runs changed while they ran: {} of their values differ, which proves nothing\n",
               disturbed, unclear_);
  }
  for (const auto& [name, values] : forced_) {
    fmt::print("{} values of {} were not compared: it was forced\n", values, name);
  }
  const bool whole = report_left_out() && !output_failed_ && !damaged_;
  if (runs_ == 0) {
    console_.error(
        "{} holds no run of these modules{}: nothing was compared{}", options_.replay.file.string(),
        ticks_to_compare(options_.replay),
        closed_ ? "" : "; its recorder ended before it had written the first runs, which it does once a second");
    return {kFailed, "the recording cannot be replayed"};
  }
  const std::uint64_t ticks = ticks_ - std::min(ticks_, options_.replay.from_tick);
  if (differences_ == 0) {
    fmt::print("{} ticks, {} runs, {} values: equal\n", ticks, runs_, values_);
    return whole ? Ending{kOk, "end of the recording"} : Ending{kFailed, "the recording was not replayed as a whole"};
  }
  fmt::print("{} ticks, {} runs, {} values: {} differ\n", ticks, runs_, values_, differences_);
  report_differences();
  return {kCheckFailed, "the replay differs from the recording"};
}

}  // namespace indurop::node
