// SPDX-License-Identifier: Apache-2.0
#include "node/replay/outcome.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "core/base/print.h"

namespace indurop::node {
namespace {

constexpr std::size_t kShown = 10;

// Shortens the value of a struct or an array, so that a line holds two.
std::string shortened(const std::string& value) {
  constexpr std::size_t kMaxColumns = 40;
  return value.size() <= kMaxColumns ? value : fmt::format("{}...", value.substr(0, kMaxColumns - 3));
}

std::string ticks_to_compare(const config::Replay& replay) {
  const bool all = replay.from_tick == 0 && replay.to_tick == config::Replay::kLastTick;
  return all ? "" : " that can be repeated between the ticks asked for";
}

// Reports each variable, in the order in which they began to differ.
void report_differences(const ReplayedModules& modules, const vars::Store& store) {
  struct Line {
    const KnownValue* known;
    std::string name;
    std::string module;
  };
  std::vector<Line> lines;
  for (const auto& module : modules.all()) {
    for (const KnownValue& known : module->known) {
      if (known.differing > 0) {
        lines.push_back({&known, variable_at(store, known.variable).name, module->name});
      }
    }
  }
  std::sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) {
    return std::tie(a.known->first_tick, a.name) < std::tie(b.known->first_tick, b.name);
  });
  for (std::size_t i = 0; i < std::min(lines.size(), kShown); ++i) {
    const auto& [known, name, module] = lines[i];
    base::print(stdout, "  {} of {}: {} of {} runs, first at tick {}: {}{}, now {}\n", name, module, known->differing,
                known->compared, known->first_tick,
                known->first_place == name ? "" : known->first_place.substr(name.size()) + " ",
                shortened(known->first_was), shortened(known->first_is));
  }
  if (lines.size() > kShown) {
    base::print(stdout, "  and {} other variables\n", lines.size() - kShown);
  }
}

// Returns false if something could not be compared that ran in the recording.
bool report_left_out(const ReplayedModules& modules, std::uint64_t runs_not_here, const Console& console) {
  bool whole = true;
  const auto written = [](const KnownValue& known) { return known.written && !known.only_viewed; };
  const auto compared = [](const KnownValue& known) { return known.written && known.ever_compared; };
  for (const auto& each : modules.all()) {
    const ReplayedModule& module = *each;
    const std::string& name = module.name;
    if (module.left_out > 0) {
      console.error("{} runs of {} could not be repeated: the recording has no values of its inputs ({})",
                    module.left_out, name, module.unknown_inputs);
      whole = false;
    } else if (module.repeated > 0 && !module.apart && !module.faulted_alike &&
               std::any_of(module.known.begin(), module.known.end(), written) &&
               std::none_of(module.known.begin(), module.known.end(), compared)) {
      console.error("{} runs of {} were repeated, but not compared: the recording has no values of its outputs",
                    module.repeated, name);
      whole = false;
    }
    if (module.lacking > 0) {
      console.error("{} runs of {} were not repeated: their version declares variables in another way", module.lacking,
                    name);
      whole = false;
    }
    if (module.too_early > 0) {
      base::print(stdout, "{} of {} runs of {} were not repeated: not all of their inputs were recorded before them\n",
                  module.too_early, module.seen, name);
    }
    if (const std::uint64_t waited = module.kept.waited(); waited > 0) {
      base::print(stdout,
                  "{} of {} runs of {} were not repeated: they come before the first keyframe they could begin with\n",
                  waited, module.seen, name);
    }
  }
  if (runs_not_here > 0) {
    console.error("{} runs of modules that are not in this configuration were not repeated", runs_not_here);
    whole = false;
  }
  return whole;
}

}  // namespace

Ending conclude(const config::Replay& replay, const ReplayedModules& modules, const Comparison& comparison,
                const Repeated& repeated, const vars::Store& store, const Console& console) {
  std::uint64_t disturbed = 0;
  for (const auto& module : modules.all()) {
    disturbed += module->disturbed_runs;
  }
  if (disturbed > 0) {
    base::print(stdout,
                "the inputs of {} runs changed while they ran: {} of their values differ, which proves nothing\n",
                disturbed, comparison.unclear());
  }
  for (const auto& [name, values] : comparison.forced()) {
    base::print(stdout, "{} values of {} were not compared: it was forced\n", values, name);
  }
  const bool whole =
      report_left_out(modules, repeated.runs_not_here, console) && !comparison.output_failed() && !repeated.damaged;
  if (repeated.runs == 0) {
    console.error(
        "{} holds no run of these modules{}: nothing was compared{}", replay.file.string(), ticks_to_compare(replay),
        repeated.closed ? ""
                        : "; its recorder ended before it had written the first runs, which it does once a second");
    return {kFailed, "the recording cannot be replayed"};
  }
  const std::uint64_t ticks = repeated.ticks - std::min(repeated.ticks, replay.from_tick);
  if (comparison.differences() == 0) {
    base::print(stdout, "{} ticks, {} runs, {} values: equal\n", ticks, repeated.runs, comparison.values());
    return whole ? Ending{kOk, "end of the recording"} : Ending{kFailed, "the recording was not replayed as a whole"};
  }
  base::print(stdout, "{} ticks, {} runs, {} values: {} differ\n", ticks, repeated.runs, comparison.values(),
              comparison.differences());
  report_differences(modules, store);
  return {kCheckFailed, "the replay differs from the recording"};
}

}  // namespace indurop::node
