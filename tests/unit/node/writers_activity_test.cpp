// SPDX-License-Identifier: Apache-2.0
// What the mirror asks before and after it copies what a module writes.

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "engine_of_modules.h"

namespace indurop::node {
namespace {

TEST(WritersActivity, Is_odd_during_a_run_and_counts_the_runs_whichever_schedule_counts) {
  const auto xml = [](const std::string& period) {
    const auto module = [](const std::string& name, const std::string& every, const std::string& wcet) {
      return "<module><filename>./" + name + ".so</filename><name>" + name +
             "</name><moduletype>thread</moduletype><operationtype>periodic</operationtype><period>" + every +
             "</period><priority>1</priority><wcet>" + wcet + "</wcet></module>";
    };
    return "<root>" + module("quick", "1ms", "10us") + module("slow", period, "700us") + "</root>";
  };
  EngineOfModules sut(xml("2ms"));
  sut.pass(500 * kMillisecond);  // no module runs before tick 0
  for (const char* period : {"4ms", "1ms", "3ms"}) {
    int odd = 0;
    std::optional<std::uint64_t> before;  // half the activity, minus the runs
    for (int i = 0; i < 1'000; ++i) {
      sut.pass(kMillisecond / 50);
      const std::uint64_t activity = sut.activity("slow");
      odd += activity % 2 != 0 ? 1 : 0;
      if (activity % 2 == 0) {
        const std::uint64_t now = activity / 2 - sut.record("slow").runs.load();
        EXPECT_EQ(before.value_or(now), now) << period;
        before = now;
      }
    }
    EXPECT_GT(odd, 50) << period;
    EXPECT_TRUE(before) << period;
    EXPECT_NE(sut.change(xml(period)), kNever);
  }
  sut.end();
}

}  // namespace
}  // namespace indurop::node
