// SPDX-License-Identifier: Apache-2.0
// The engine of a node in virtual time, with modules of a configuration that do nothing but take time.

#pragma once

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "config/check/check.h"
#include "config/xml/reader.h"
#include "node/run/setup.h"
#include "scheduler/engine.h"
#include "scheduler/simulated_kernel.h"
#include "tests/unit/scheduler/fixture.h"

namespace indurop::node {

inline constexpr std::int64_t kMillisecond = 1'000'000;
inline constexpr std::uint64_t kNever = ~std::uint64_t{0};

class EngineOfModules {
 public:
  explicit EngineOfModules(const std::string& xml) {
    const config::Config config = checked(xml);
    for (const config::Module& module : config.modules) {
      index_.emplace(module.name, static_cast<std::uint32_t>(index_.size()));
      names_.push_back(module.name);
    }
    const scheduler::RunBlockSetup setup = make_run_setup(config, check_, "test", {0, true});
    block_ = scheduler::make_block(setup);
    scheduler::EngineSettings settings;
    settings.basic_period_ns = setup.basic_period_ns;
    settings.order = scheduler::CoreOrder::Data;
    settings.spin.mode = scheduler::SpinMode::Off;
    scheduler::Hooks hooks;
    hooks.context = this;
    hooks.entering = [](void* context, std::uint32_t module, std::uint64_t tick, std::int64_t) noexcept {
      auto& self = *static_cast<EngineOfModules*>(context);
      self.ran_[tick].push_back(self.names_[module]);
    };
    engine_.emplace(*block_, tasks(config, setup), settings, hooks, kernel_);
    EXPECT_TRUE(engine_->start(0).ok());
  }

  void pass(std::int64_t ns) { kernel_.sleep_until(kernel_.now() + std::chrono::nanoseconds(ns)); }
  // Returns the first tick of the new schedule.
  std::uint64_t change(const std::string& xml) {
    const config::Config config = checked(xml);
    const scheduler::RunBlockSetup setup = make_run_setup(config, check_, "test", {0, true});
    const Status prepared = engine_->prepare_change(tasks(config, setup));
    EXPECT_TRUE(prepared.ok());
    while (engine_->follow_change() == scheduler::Engine::Change::Starting) {
      pass(1);
    }
    const std::uint64_t next = block_->tick.load();
    const std::uint64_t slots = block_->slot_count;
    const std::uint64_t tick = (next + slots - 1) / slots * slots;
    EXPECT_TRUE(engine_->change_at({tick, slots, tick + 10 * slots}));
    for (int i = 0; engine_->follow_change() != scheduler::Engine::Change::None; ++i) {
      if (engine_->follow_change() ==
          scheduler::Engine::Change::Prepared) {  // runs are in progress whenever a macro period begins
        EXPECT_TRUE(engine_->change_at({block_->tick + 1, 1, block_->tick + 1'000}));
      }
      if (i > 10'000) {
        ADD_FAILURE() << "the change does not end";
        return kNever;
      }
      pass(kMillisecond / 3);
    }
    block_->slot_count = static_cast<std::uint64_t>(setup.macro_period_ns / block_->basic_period_ns);
    return engine_->changed_at();
  }
  void end() {
    engine_->request_stop();
    engine_->join();
  }

  [[nodiscard]] std::uint64_t activity(const std::string& name) const {
    const std::array<std::uint32_t, 1> module{index_.at(name)};
    return engine_->activity_of(module);
  }
  [[nodiscard]] std::uint64_t tick() const { return block_->tick.load(); }
  [[nodiscard]] const std::vector<std::string>& ran(std::uint64_t tick) { return ran_[tick]; }
  [[nodiscard]] const scheduler::ModuleRecord& record(const std::string& name) const {
    return block_->modules()[index_.at(name)];
  }
  [[nodiscard]] std::uint64_t lost_ticks() const { return block_->lost_ticks.load(); }

 private:
  config::Config checked(const std::string& xml) {
    auto read = config::read_config_text(xml, "/module.xml");
    check_ = config::check_config(read.config, {.files = false, .machine = false});
    EXPECT_TRUE(read.ok() && check_.ok()) << xml;
    return std::move(read.config);
  }
  std::vector<scheduler::Task> tasks(const config::Config& config, const scheduler::RunBlockSetup& setup) const {
    auto all = make_tasks(config, check_, setup, 0);
    set_work_times(all, config, {});
    for (scheduler::Task& task : all) {
      task.index = index_.at(config.modules[task.index].name);
      task.run = [] {};
      task.condition = []() -> bool { return true; };
      task.after.clear();
    }
    return all;
  }

  config::CheckResult check_;
  std::map<std::string, std::uint32_t> index_;
  std::vector<std::string> names_;
  scheduler::BlockPointer block_;
  scheduler::SimulatedKernel kernel_{rt::mono_time(1), {}, {}};
  std::map<std::uint64_t, std::vector<std::string>> ran_;
  std::optional<scheduler::Engine> engine_;
};

}  // namespace indurop::node
