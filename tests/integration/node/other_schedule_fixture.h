// SPDX-License-Identifier: Apache-2.0
// indurop reload --config of a node with modules that count their runs.

#pragma once

#include <string>
#include <vector>

#include "node_fixture.h"
#include "tests/support/wait_until.h"

namespace indurop::test {

class OtherSchedule : public NodeTest {
 protected:
  const Module kCounter{.file = "counter.so", .name = "counter", .priority = 1};
  const Module kWalker{.file = "walker.so", .name = "walker", .period = "2ms", .priority = 2};
  const Module kAdder{.file = "adder.so", .name = "adder", .period = "2ms", .priority = 3};

  Module every(Module module, const std::string& period) const {
    module.period = period;
    return module;
  }
  std::vector<std::string> words(const std::vector<Module>& modules, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = {"reload", "--config", write("next.xml", xml(modules)), "--node", node()};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Outcome change(const std::vector<Module>& modules, const std::vector<std::string>& more = {}) const {
    return indurop(words(modules, more));
  }
  // A command whose new module takes 2 s to start.
  std::vector<std::string> adds_slowly() const {
    std::vector<std::string> all =
        words({kCounter, kWalker, {.file = "reload_slow_start.so", .name = "slow", .priority = 3}});
    all.insert(all.begin(), INDUROP_PROGRAM);
    return all;
  }
  // All runs of counter, which has the basic period, are there.
  void expect_no_tick_of_counter_is_lost() {
    const auto& record = module("counter");
    EXPECT_EQ(record.skipped.load(), run()->lost_ticks.load());
    EXPECT_TRUE(wait_until([&] {
      const auto before = record.runs.load();
      const auto counted = value<std::uint32_t>("nt::counted");
      return counted == before && record.runs.load() == before;
    })) << value<std::uint32_t>("nt::counted")
        << " of " << record.runs.load();
  }
  bool goes_on(const std::string& name) { return runs_reach(name, module(name).runs.load() + 20); }
};

}  // namespace indurop::test
