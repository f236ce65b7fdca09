// SPDX-License-Identifier: Apache-2.0
// <cores>: assigns a core to modules without a <core>, and if nothing else helps a new offset or place in the order.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "config/check/access_map.h"
#include "config/check/check_parts.h"
#include "config/check/report_times.h"
#include "core/base/text.h"
#include "scheduler/placement.h"

namespace indurop::config {
namespace {

using scheduler::Placeable;

constexpr base::Nanos kUnknownTime{std::chrono::microseconds(10)};

class Placer {
 public:
  explicit Placer(CheckContext& context) : context_(context), config_(context.config), result_(context.result) {}

  void run() {
    if (!find_cores()) {
      return;
    }
    read_times();
    order_ = execution_order(result_);
    order_.resize(result_.periodic.size());
    scheduler::PlacementProblem problem = make_problem();
    const scheduler::Placement placement = scheduler::place(problem);
    explain(problem, placement);
    apply(problem, placement);
  }

 private:
  // Finds the cores, the node's own first. Returns false if there are too few, which is reported.
  bool find_cores() {
    const std::vector<int> usable = usable_cores();
    const auto wanted = config_.cores->most > 0 ? static_cast<std::size_t>(config_.cores->most)
                                                : std::clamp<std::size_t>(usable.size(), 1, kMaxSpreadCores);
    const bool here = context_.options.machine;
    if (here && wanted > usable.size() && context_.options.files) {
      context_.report.error(config_.cores->place, fmt::format("<cores>: {} asked for, but this process may use {}; "
                                                              "write auto or a smaller number",
                                                              wanted, usable.size()));
      return false;
    }
    cores_.resize(wanted);
    std::iota(cores_.begin(), cores_.end(), 0);  // cores of another machine
    if (here && wanted <= usable.size()) {
      std::copy_n(usable.rbegin(), wanted, cores_.begin());
    }
    if (config_.core >= 0) {
      const auto own = std::find(cores_.begin(), cores_.end(), config_.core);
      own == cores_.end() ? void(cores_.front() = config_.core) : std::iter_swap(cores_.begin(), own);
    }
    config_.core = cores_.front();
    return true;
  }

  void read_times() {
    if (!config_.cores->times.empty()) {
      if (const std::string wrong = read_measured_times(config_.cores->times.string(), times_); !wrong.empty()) {
        context_.report.warning(config_.cores->place, "<cores>: " + wrong);
      }
    }
  }
  // Returns 0 if the time is not known.
  [[nodiscard]] base::Nanos time_of(const Module& module) const {
    const auto measured = times_.find(module.name);
    return module.wcet > base::Nanos::zero() || measured == times_.end() ? module.wcet : measured->second;
  }

  // Returns the time assumed for modules without one: the average of the others.
  [[nodiscard]] base::Nanos assumed_time() const {
    base::Nanos sum{};
    std::int64_t known = 0;
    for (const std::size_t i : order_) {
      const base::Nanos time = time_of(config_.modules[i]);
      sum += time;
      known += time > base::Nanos::zero() ? 1 : 0;
    }
    return known > 0 ? sum / known : kUnknownTime;
  }

  scheduler::PlacementProblem make_problem() {
    scheduler::PlacementProblem problem;
    problem.cores = static_cast<int>(cores_.size());
    problem.basic_period = result_.table.basic_period;
    problem.cost = dispatch_cost(config_, problem.basic_period);
    problem.split_sharing = config_.cores->split_sharing;
    const base::Nanos assumed = assumed_time();
    std::map<std::size_t, std::uint32_t> place;
    std::vector<std::string> without_wcet;
    for (const std::size_t i : order_) {
      const Module& module = config_.modules[i];
      place.emplace(i, static_cast<std::uint32_t>(problem.modules.size()));
      Placeable placed;
      placed.period = module.period;
      placed.offset = module.offset;
      const base::Nanos time = time_of(module);
      placed.execution = time > base::Nanos::zero() ? time : assumed;
      placed.deadline =
          module.deadline > base::Nanos::zero() ? std::min(module.deadline, module.period) : module.period;
      placed.keeps_offset = module.places.offset.line > 0;
      if (module.core >= 0) {
        const auto bound = std::find(cores_.begin(), cores_.end(), module.core);
        if (bound == cores_.end()) {
          cores_.push_back(module.core);
          problem.cores = static_cast<int>(cores_.size());
          placed.core = problem.cores - 1;
        } else {
          placed.core = static_cast<int>(bound - cores_.begin());
        }
      }
      if (time == base::Nanos::zero()) {
        without_wcet.push_back(module.name);
      }
      problem.modules.push_back(placed);
    }
    for (const Sharing& sharing : result_.sharing) {
      const auto first = place.find(sharing.first);
      const auto second = place.find(sharing.second);
      if (first != place.end() && second != place.end()) {
        problem.modules[second->second].shares.push_back(first->second);
      } else if (first != place.end() || second != place.end()) {
        // A pair with a sporadic module, which is on the node's core.
        Placeable& periodic = problem.modules[first != place.end() ? first->second : second->second];
        periodic.core = periodic.core < 0 ? 0 : periodic.core;
      }
    }
    if (!without_wcet.empty()) {
      context_.report.note(config_.cores->place,
                           fmt::format("<cores>: the execution time of {} is unknown, assumed is {}; give it with "
                                       "<wcet>, or use --times with a report",
                                       base::enumerate(without_wcet), base::format_duration(assumed)));
    }
    return problem;
  }

  [[nodiscard]] const Module& at(std::uint32_t place) const { return config_.modules[order_[place]]; }

  // Returns the modules on the same core with which it shares data.
  [[nodiscard]] std::string company(const scheduler::PlacementProblem& problem, const scheduler::Placement& placement,
                                    std::uint32_t place) const {
    std::vector<std::string> with;
    std::vector<std::string> waits;
    std::vector<std::string> awaited;
    for (const Sharing& sharing : result_.sharing) {
      const std::size_t self = order_[place];
      if (sharing.first != self && sharing.second != self) {
        continue;
      }
      const std::size_t other = sharing.first == self ? sharing.second : sharing.first;
      const auto found = std::find(order_.begin(), order_.end(), other);
      const std::string named = config_.modules[other].name + " (" + sharing.why + ")";
      if (found == order_.end()) {
        with.push_back(named);
        continue;
      }
      const auto there = static_cast<std::size_t>(found - order_.begin());
      if (placement.core[there] == placement.core[place]) {
        with.push_back(named);
      } else {
        (sharing.second == self ? waits : awaited).push_back(named);
      }
    }
    std::vector<std::string> parts;
    if (problem.modules[place].core >= 0 && at(place).core >= 0) {
      parts.emplace_back("its <core>");
    }
    constexpr std::size_t kMaxShown = 3;
    for (const auto& [words, names] : {std::pair{"with ", with}, {"waits for ", waits}, {"awaited by ", awaited}}) {
      if (!names.empty()) {
        parts.push_back(words + base::enumerate(names, kMaxShown));
      }
    }
    std::string text;
    for (const std::string& part : parts) {
      text += (text.empty() ? "" : "; ") + part;
    }
    return text.empty() ? "shares nothing" : text;
  }

  void explain(const scheduler::PlacementProblem& problem, const scheduler::Placement& placement) {
    Spreading& spreading = result_.spreading.emplace();
    spreading.cores = cores_;
    spreading.holds = placement.holds;
    spreading.busiest = placement.busiest;
    spreading.reordered = !std::is_sorted(placement.order.begin(), placement.order.end());
    for (const std::uint32_t place : placement.order) {
      const Placeable& module = problem.modules[place];
      const auto core = static_cast<std::size_t>(placement.core[place]);
      spreading.modules.push_back({order_[place], cores_[core], module.execution,
                                   placement.offset[place] - module.offset, company(problem, placement, place)});
    }
  }

  void apply(const scheduler::PlacementProblem& problem, const scheduler::Placement& placement) {
    bool table_changed = false;
    for (std::uint32_t i = 0; i < placement.order.size(); ++i) {
      const std::uint32_t place = placement.order[i];
      Module& module = config_.modules[order_[place]];
      module.core = cores_[static_cast<std::size_t>(placement.core[place])];
      if (result_.spreading->reordered) {
        module.priority = static_cast<int>(i) + 1;
      }
      table_changed =
          table_changed || result_.spreading->reordered || placement.offset[place] != problem.modules[place].offset;
      module.offset = placement.offset[place];
    }
    if (table_changed) {
      std::vector<scheduler::PeriodicItem> items;
      for (const std::size_t i : result_.periodic) {
        items.push_back({config_.modules[i].period, config_.modules[i].offset, config_.modules[i].priority});
      }
      if (auto table = scheduler::make_period_table(items)) {
        result_.table = std::move(table).value();
      }
    }
  }

  CheckContext& context_;
  Config& config_;
  CheckResult& result_;
  std::vector<int> cores_;
  CheckOptions::Times times_;
  std::vector<std::size_t> order_;  // periodic modules in order of execution
};

}  // namespace

void place_modules(CheckContext& context) {
  if (context.config.cores && !context.result.periodic.empty() && !context.result.table.order.empty()) {
    Placer(context).run();
  }
}

}  // namespace indurop::config
