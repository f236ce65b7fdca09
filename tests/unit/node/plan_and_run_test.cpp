// SPDX-License-Identifier: Apache-2.0
// What `indurop plan` shows is what the node runs: random configurations go through the plan on one side and through
// the node's setup and the engine in virtual time on the other.

#include "config/plan/plan.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "config/check/check.h"
#include "node/run/setup.h"
#include "scheduler/engine.h"
#include "tests/unit/scheduler/fixture.h"

namespace indurop::node {
namespace {

using Names = std::vector<std::string>;
using scheduler::Operation;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  int below(int limit) { return static_cast<int>(engine_() % static_cast<unsigned>(limit)); }

 private:
  std::minstd_rand engine_;
};

// Thread modules on up to `cores` cores, many of equal priority and period; every third is sporadic.
config::Config random_config(Random& random, int cores) {
  constexpr std::array<int, 5> kPeriods{1, 2, 3, 4, 6};
  config::Config config;
  config.file = "m.xml";
  const int count = 1 + random.below(10);
  for (int i = 0; i < count; ++i) {
    config::Module module;
    module.name = "m" + std::to_string(i);
    module.priority = random.below(5);
    module.core = random.below(cores);
    if (i > 0 && random.below(3) == 0) {
      module.operation = Operation::Sporadic;
      module.core = -1;
      module.deadline = std::chrono::milliseconds(1);
      module.after_base = random.below(2) == 0;
    } else {
      const int period = kPeriods[static_cast<std::size_t>(random.below(5))];
      module.period = std::chrono::milliseconds(period);
      module.offset = std::chrono::milliseconds(random.below(period));
      module.overrun = random.below(4) == 0 ? scheduler::OverrunPolicy::CatchUp : scheduler::OverrunPolicy::Skip;
    }
    config.modules.push_back(std::move(module));
  }
  return config;
}

struct Runs {
  const config::Config& config;
  Names names;  // in the order in which they were entered
};

class PlanAndRun : public testing::TestWithParam<int> {
 protected:
  // The periodic ones of `names` on one core.
  Names on_core(const Names& names, int core) const {
    Names out;
    std::copy_if(names.begin(), names.end(), std::back_inserter(out),
                 [&](const std::string& name) { return at(name).core == core; });
    return out;
  }
  const config::Module& at(const std::string& name) const {
    return *std::find_if(config_.modules.begin(), config_.modules.end(), [&](const auto& m) { return m.name == name; });
  }
  Names sporadic(const config::CheckResult& check, bool after_base) const {
    Names out;
    for (const std::size_t i : check.sporadic) {
      if (config_.modules[i].after_base == after_base) {
        out.push_back(config_.modules[i].name);
      }
    }
    return out;
  }
  // Splits what ran into periodic modules and the sporadic ones before and behind.
  void compare(const Names& planned, const config::CheckResult& check, const Names& ran) const {
    Names periodic;
    Names early;
    Names late;
    for (const std::string& name : ran) {
      const config::Module& module = at(name);
      (module.operation == Operation::Periodic ? periodic : module.after_base ? early : late).push_back(name);
    }
    for (int core = 0; core < GetParam(); ++core) {
      EXPECT_EQ(on_core(periodic, core), on_core(planned, core));
    }
    EXPECT_EQ(periodic.size(), planned.size());
    EXPECT_TRUE(std::is_sorted(periodic.begin(), periodic.end(), [this](const auto& a, const auto& b) {
      return at(a).priority < at(b).priority;
    })) << "a lower priority ran first on another core";
    EXPECT_EQ(early, sporadic(check, true));
    EXPECT_EQ(late, sporadic(check, false));
    EXPECT_TRUE(std::equal(late.rbegin(), late.rend(), ran.rbegin())) << "event handling waits for everything periodic";
  }

  config::Config config_;
};

TEST_P(PlanAndRun, Every_basic_period_runs_what_its_slot_shows_in_that_order) {
  for (unsigned seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    config_ = random_config(random, GetParam());
    const config::CheckResult check = config::check_config(config_, {false, false, false});
    ASSERT_TRUE(check.ok()) << base::to_string(check.diagnostics.front());
    const auto plan = nlohmann::json::parse(config::plan_json(config_, check));

    const scheduler::RunBlockSetup setup = make_run_setup(config_, check, "test", {0, true});
    std::vector<scheduler::Task> tasks = make_tasks(config_, check, setup, 0);
    for (scheduler::Task& task : tasks) {
      task.run = [] {};
      task.condition = []() -> bool { return true; };
    }
    auto block = scheduler::make_block(setup);
    scheduler::EngineSettings settings;
    settings.basic_period_ns = setup.basic_period_ns;
    Runs runs{config_, {}};
    scheduler::Hooks hooks;
    hooks.context = &runs;
    hooks.entering = [](void* context, std::uint32_t module, std::uint64_t, std::int64_t) noexcept {
      auto& into = *static_cast<Runs*>(context);
      into.names.push_back(into.config.modules[module].name);
    };
    scheduler::VirtualClock clock;
    scheduler::Engine engine(*block, tasks, settings, hooks, clock);
    const std::uint64_t slots = plan["slots"].size();
    ASSERT_EQ(slots, setup.slot_count);
    for (std::uint64_t tick = 0; tick < 2 * slots; ++tick) {
      SCOPED_TRACE("tick " + std::to_string(tick));
      runs.names.clear();
      engine.step(tick, rt::MonoTime());
      compare(plan["slots"][tick % slots]["modules"].get<Names>(), check, runs.names);
    }
    if (HasFailure()) {
      return;  // one example is enough
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cores, PlanAndRun, testing::Values(1, 2));

}  // namespace
}  // namespace indurop::node
