// SPDX-License-Identifier: Apache-2.0
// Checks that the schedule is met, as far as the configuration has maximum execution times.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "config/check/check_parts.h"
#include "scheduler/bands.h"
#include "scheduler/response_time.h"
#include "scheduler/tick_wait.h"

namespace indurop::config {
namespace {

using scheduler::Demand;
using scheduler::WorstResponses;

// Measured: 3.5 us for a further band on a quiet machine, 9 us in a guest that takes 1 ns for each instruction; the
// wake-up of the tick thread itself likewise (docs/benchmarks.md).
constexpr base::Nanos kTickCost{std::chrono::microseconds(5)};
constexpr base::Nanos kWakeCost{std::chrono::microseconds(10)};
constexpr base::Nanos kPollCost{std::chrono::microseconds(50)};  // polling interval of waits for a process

// Modules of a board in the order of execution, and the demand of each.
struct Order {
  std::vector<std::size_t> modules;  // indices into Config::modules
  std::vector<Demand> demands;
  std::vector<int> front;    // priority of the first module of its band
  std::size_t periodic = 0;  // number of modules before the event handler
};

class Times {
 public:
  explicit Times(CheckContext& context) : context_(context), config_(context.config) {}

  void run() {
    CheckResult& result = context_.result;
    result.timings.assign(config_.modules.size(), {});
    const base::Nanos basic = result.table.basic_period;
    const bool declared = std::any_of(config_.modules.begin(), config_.modules.end(), [](const Module& module) {
      return module.wcet > base::Nanos::zero() && module.operation != scheduler::Operation::NonReal;
    });
    if (!declared || basic <= base::Nanos::zero()) {
      return;
    }
    basic_ = basic;
    cost_ = dispatch_cost(config_, basic);
    make_order();
    place_on_cores();
    result.dispatch_share = static_cast<double>(cost_.tick.count()) / static_cast<double>(basic.count()) *
                            static_cast<double>(cores_.size());
    refuse_impossible();
    keep_known();
    find();
    for (std::size_t i = 0; i < order_.modules.size(); ++i) {
      judge(i);
    }
  }

 private:
  void add(std::size_t index, bool own_thread) {
    const Module& module = config_.modules[index];
    const bool sporadic = module.operation == scheduler::Operation::Sporadic;
    // A sporadic module is assumed to run at most once within its deadline.
    const base::Nanos period = sporadic ? std::max(module.deadline / basic_, std::int64_t{1}) * basic_ : module.period;
    order_.modules.push_back(index);
    order_.demands.push_back({period, module.offset, module.wcet, own_thread});
  }

  void make_order() {
    const CheckResult& result = context_.result;
    bool after_base_added = false;
    const auto add_after_base = [&] {
      for (const std::size_t i : result.sporadic) {
        if (config_.modules[i].after_base && !after_base_added) {
          add(i, false);
        }
      }
      after_base_added = true;
    };
    for (const scheduler::BandPlan& band :
         scheduler::make_bands(periodic_tasks(context_), basic_.count(), config_.order)) {
      if (band.kind != scheduler::BandKind::Inline && band.core == context_.config.core) {
        add_after_base();
      }
      for (const std::uint32_t task : band.tasks) {
        add(result.periodic[task], band.kind != scheduler::BandKind::Inline && task == band.tasks.front());
      }
      order_.front.resize(order_.modules.size(), config_.modules[result.periodic[band.tasks.front()]].priority);
    }
    add_after_base();
    order_.periodic = order_.modules.size();
    for (const std::size_t i : result.sporadic) {
      if (!config_.modules[i].after_base) {
        add(i, true);
      }
    }
    order_.front.resize(order_.modules.size());
  }

  [[nodiscard]] int core_of(const Module& module) const { return module.core >= 0 ? module.core : config_.core; }

  // Sets the core of each module, and the modules it waits for there. Without this, all count as on one core.
  void place_on_cores() {
    for (const std::size_t i : order_.modules) {
      cores_.insert(core_of(config_.modules[i]));
    }
    cores_known_ = cores_.size() == 1 || !cores_.contains(-1);
    if (cores_.size() == 1 || !cores_known_) {
      cores_ = {-1};
      return;
    }
    std::map<std::size_t, std::set<std::size_t>> earlier;
    for (const Sharing& sharing : context_.result.sharing) {
      earlier[sharing.second].insert(sharing.first);
    }
    for (std::size_t i = 0; i < order_.modules.size(); ++i) {
      const Module& module = config_.modules[order_.modules[i]];
      Demand& demand = order_.demands[i];
      demand.core = core_of(module);
      for (std::size_t k = 0; k < std::min(i, order_.periodic); ++k) {
        const Module& other = config_.modules[order_.modules[k]];
        // A module that waits for a band waits for all of it.
        const bool already_ordered = config_.order == scheduler::CoreOrder::Total
                                         ? order_.front[k] < order_.front[i]
                                         : earlier[order_.modules[i]].contains(order_.modules[k]);
        const bool waits = i >= order_.periodic || (already_ordered && !module.after_base && !other.after_base);
        if (core_of(other) != demand.core && waits) {
          demand.after.push_back(static_cast<std::uint32_t>(k));
          const bool process = module.type == scheduler::ModuleType::Process;
          demand.waiting = std::max(
              demand.waiting, kWakeCost + (process ? kWakeCost : base::Nanos::zero()) +
                                  (other.type == scheduler::ModuleType::Process ? kPollCost : base::Nanos::zero()));
        }
      }
    }
  }

  // An error whatever runs before the module.
  void refuse_impossible() {
    for (std::size_t i = 0; i < order_.modules.size(); ++i) {
      const Module& module = config_.modules[order_.modules[i]];
      const base::Nanos limit = module.deadline > base::Nanos::zero() ? module.deadline : order_.demands[i].period;
      const bool behind_unknown =
          std::any_of(order_.demands.begin(), order_.demands.begin() + static_cast<std::ptrdiff_t>(i),
                      [](const Demand& demand) { return demand.execution == base::Nanos::zero(); });
      if (behind_unknown && module.wcet > limit) {
        context_.report.error(
            module.places.wcet,
            fmt::format("{} executes for {} and has only {}; shorten it or raise its period", module.name,
                        base::format_duration(module.wcet), base::format_duration(limit)));
      }
    }
  }

  // Nothing is known of modules that run after one without an execution time.
  void keep_known() {
    const auto unknown = std::find_if(order_.demands.begin(), order_.demands.end(),
                                      [](const Demand& demand) { return demand.execution == base::Nanos::zero(); });
    const auto known = static_cast<std::size_t>(unknown - order_.demands.begin());
    complete_ = known >= order_.periodic;
    order_.demands.resize(known);
    order_.modules.resize(known);
    order_.periodic = std::min(order_.periodic, known);
  }

  void find() {
    const bool after_base = std::any_of(order_.modules.begin(), order_.modules.end(),
                                        [&](std::size_t i) { return config_.modules[i].after_base; });
    std::vector<Demand> together = order_.demands;
    for (Demand& demand : together) {
      demand.offset = {};
    }
    // The time of an event is unknown: it may coincide with any release, so no offset separates it from modules that it
    // delays.
    const auto periodic = scheduler::worst_responses(
        std::span(after_base ? together : order_.demands).first(order_.periodic), basic_, cost_);
    const auto all = order_.periodic < together.size() ? scheduler::worst_responses(together, basic_, cost_) : periodic;
    if (context_.result.spreading && complete_) {
      context_.result.spreading->busiest = periodic.busiest;  // with bands and all costs of waiting
    }
    for (std::size_t i = 0; i < order_.modules.size(); ++i) {
      context_.result.timings[order_.modules[i]] = {true, i < order_.periodic ? periodic.worst[i] : all.worst[i]};
    }
  }

  // Returns the processor share of the modules up to this one in the order, and of the platform.
  [[nodiscard]] double share_up_to(std::size_t last) const {
    double share = context_.result.dispatch_share / static_cast<double>(cores_.size());
    for (std::size_t i = 0; i <= last; ++i) {
      const Demand& demand = order_.demands[i];
      if (demand.core != order_.demands[last].core) {
        continue;
      }
      const base::Nanos taken = demand.execution + (demand.own_thread ? cost_.wake : base::Nanos::zero());
      share += static_cast<double>(taken.count()) / static_cast<double>(demand.period.count());
    }
    return share;
  }

  void judge(std::size_t place) {
    const Module& module = config_.modules[order_.modules[place]];
    const base::Nanos worst = context_.result.timings[order_.modules[place]].worst;
    const base::Nanos deadline = module.deadline > base::Nanos::zero() ? module.deadline : module.period;
    std::string text;
    if (worst == WorstResponses::kNotDone) {
      text = fmt::format(
          "{} does not end before its next release: with the modules that run before it, it needs {:.0f} % of a core",
          module.name, share_up_to(place) * 100);
    } else if (worst > deadline) {
      text = fmt::format(
          "{} ends up to {} after its release, and its deadline is {}: it executes for {}, the rest is modules that "
          "run before it and the platform's overhead",
          module.name, base::format_duration(worst), base::format_duration(deadline),
          base::format_duration(module.wcet));
    } else {
      return;
    }
    text += "; shorten the modules that run up to it, raise its period, or move modules to another board";
    if (!cores_known_) {
      context_.report.warning(
          module.places.wcet,
          text + " (counted as if all modules were on one core; with <core> for the node, too, it is exact)");
    } else {
      context_.report.error(module.places.wcet, std::move(text));
    }
  }

  CheckContext& context_;
  const Config& config_;
  base::Nanos basic_{};
  scheduler::DispatchCost cost_;
  Order order_;
  std::set<int> cores_;  // used cores; -1: chosen by the node
  bool cores_known_ = true;
  bool complete_ = false;  // all periodic modules have a known execution time
};

}  // namespace

scheduler::DispatchCost dispatch_cost(const Config& config, base::Nanos basic) {
  const SpinSetting spin = config.spin.value_or(SpinSetting{});
  const base::Nanos spun = spin.mode == SpinSetting::Mode::Auto ? std::min(basic / scheduler::TickWait::kMaxMeanShare,
                                                                           base::Nanos{scheduler::TickWait::kMaxMeanNs})
                                                                : spin.fixed;
  return {kTickCost + spun, kWakeCost};
}

void take_measured_times(CheckContext& context) {
  if (context.options.times == nullptr) {
    return;
  }
  for (Module& module : context.config.modules) {
    const auto measured = context.options.times->find(module.name);
    if (module.wcet == base::Nanos::zero() && module.operation != scheduler::Operation::NonReal &&
        measured != context.options.times->end()) {
      module.wcet = measured->second;
      module.places.wcet = module.place;
    }
  }
}

void check_times(CheckContext& context) {
  Times(context).run();
}

}  // namespace indurop::config
