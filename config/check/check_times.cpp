// SPDX-License-Identifier: Apache-2.0
// Does the schedule hold, as far as the configuration says how long its modules execute at most.

#include <fmt/format.h>

#include <algorithm>

#include "config/check/check_parts.h"
#include "scheduler/bands.h"
#include "scheduler/response_time.h"
#include "scheduler/spinner.h"

namespace indurop::config {
namespace {

using scheduler::Demand;
using scheduler::WorstResponses;

// Measured: 3.5 us for a further band on a quiet machine, 9 us in a guest that takes 1 ns for each instruction; the
// wake-up of the tick thread itself likewise (docs/benchmarks.md).
constexpr base::Nanos kTickCost{std::chrono::microseconds(5)};
constexpr base::Nanos kWakeCost{std::chrono::microseconds(10)};

scheduler::DispatchCost dispatch_cost(const Config& config, base::Nanos basic) {
  const SpinSetting spin = config.spin.value_or(SpinSetting{});
  const base::Nanos spun = spin.mode == SpinSetting::Mode::Auto ? std::min(basic / scheduler::Spinner::kMostMeanShare,
                                                                           base::Nanos{scheduler::Spinner::kMostMeanNs})
                                                                : spin.fixed;
  return {kTickCost + spun, kWakeCost};
}

// Modules of a board in the order of execution, and what each demands.
struct Order {
  std::vector<std::size_t> modules;  // indices into Config::modules
  std::vector<Demand> demands;
  std::size_t periodic = 0;  // so many of them are before the event handler
};

class Times {
 public:
  explicit Times(CheckContext& context) : context_(context), config_(context.config) {}

  void run() {
    CheckResult& result = context_.result;
    result.timings.assign(config_.modules.size(), {});
    take_measured();
    const base::Nanos basic = result.table.basic_period;
    const bool declared = std::any_of(config_.modules.begin(), config_.modules.end(), [](const Module& module) {
      return module.wcet > base::Nanos::zero() && module.operation != scheduler::Operation::NonReal;
    });
    if (!declared || basic <= base::Nanos::zero()) {
      return;
    }
    basic_ = basic;
    cost_ = dispatch_cost(config_, basic);
    result.dispatch_share = static_cast<double>(cost_.tick.count()) / static_cast<double>(basic.count());
    make_order();
    keep_known();
    find();
    for (std::size_t i = 0; i < order_.modules.size(); ++i) {
      judge(i);
    }
  }

 private:
  void take_measured() {
    if (context_.options.times == nullptr) {
      return;
    }
    for (Module& module : context_.config.modules) {
      const auto measured = context_.options.times->find(module.name);
      if (module.wcet == base::Nanos::zero() && module.operation != scheduler::Operation::NonReal &&
          measured != context_.options.times->end()) {
        module.wcet = measured->second;
        module.places.wcet = module.place;
      }
    }
  }

  void add(std::size_t index, bool own_thread) {
    const Module& module = config_.modules[index];
    const bool sporadic = module.operation == scheduler::Operation::Sporadic;
    // A sporadic module is taken to run once within its deadline at most.
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
    for (const scheduler::BandPlan& band : scheduler::make_bands(periodic_tasks(context_), basic_.count())) {
      if (band.kind != scheduler::BandKind::Inline) {
        add_after_base();
      }
      for (const std::uint32_t task : band.tasks) {
        add(result.periodic[task], band.kind != scheduler::BandKind::Inline && task == band.tasks.front());
      }
    }
    add_after_base();
    order_.periodic = order_.modules.size();
    for (const std::size_t i : result.sporadic) {
      if (!config_.modules[i].after_base) {
        add(i, true);
      }
    }
  }

  // Of what runs behind a module that does not say how long nothing can be said.
  void keep_known() {
    const auto unknown = std::find_if(order_.demands.begin(), order_.demands.end(),
                                      [](const Demand& demand) { return demand.execution == base::Nanos::zero(); });
    const auto known = static_cast<std::size_t>(unknown - order_.demands.begin());
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
    // When an event comes is not known: with anything, so no offset helps what it may delay, or itself.
    const auto periodic = scheduler::worst_responses(
        std::span(after_base ? together : order_.demands).first(order_.periodic), basic_, cost_);
    const auto all = order_.periodic < together.size() ? scheduler::worst_responses(together, basic_, cost_) : periodic;
    for (std::size_t i = 0; i < order_.modules.size(); ++i) {
      context_.result.timings[order_.modules[i]] = {true, i < order_.periodic ? periodic.worst[i] : all.worst[i]};
    }
  }

  // Share of the processor of the modules up to this one in the order, and of the platform.
  [[nodiscard]] double share_up_to(std::size_t last) const {
    double share = context_.result.dispatch_share;
    for (std::size_t i = 0; i <= last; ++i) {
      const Demand& demand = order_.demands[i];
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
      text = fmt::format("{} is not done before its next release: it and what runs before it need {:.0f} % of a core",
                         module.name, share_up_to(place) * 100);
    } else if (worst > deadline) {
      text = fmt::format(
          "{} ends up to {} after its release, and its deadline is {}: it executes for {}, the rest is "
          "what runs before it and what the platform takes",
          module.name, base::format_duration(worst), base::format_duration(deadline),
          base::format_duration(module.wcet));
    } else {
      return;
    }
    // Here all modules share one core. With several the real figure is better, so it is no error.
    const bool cores = std::any_of(order_.modules.begin(), order_.modules.end(), [&](std::size_t i) {
      return config_.modules[i].core != config_.modules[order_.modules.front()].core;
    });
    text += "; make what runs up to it shorter, its period longer, or take modules to another board";
    if (cores) {
      context_.report.warning(module.places.wcet, text + " (counted as if all modules were on one core)");
    } else {
      context_.report.error(module.places.wcet, std::move(text));
    }
  }

  CheckContext& context_;
  const Config& config_;
  base::Nanos basic_{};
  scheduler::DispatchCost cost_;
  Order order_;
};

}  // namespace

void check_times(CheckContext& context) {
  Times(context).run();
}

}  // namespace indurop::config
