// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/schedule_plan.h"

#include <gmock/gmock.h>

#include "config/xml/reader.h"
#include "node/run/setup.h"
#include "tests/unit/scheduler/fixture.h"

namespace indurop::node {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string module_xml(const std::string& name, const std::string& period, const std::string& more = "") {
  return "<module><filename>./" + name + ".so</filename><name>" + name +
         "</name><moduletype>thread</moduletype><operationtype>periodic</operationtype><period>" + period +
         "</period><priority>1</priority>" + more + "</module>";
}

class SchedulePlans : public testing::Test {
 protected:
  static config::Config read(const std::string& modules, const std::string& folder = "/old") {
    auto read = config::read_config_text("<root>" + modules + "</root>", folder + "/module.xml");
    EXPECT_TRUE(read.ok()) << modules;
    return std::move(read.config);
  }
  SchedulePlan plan(const std::string& before, const std::string& after) {
    config::Config running = read(before);
    auto check = config::check_config(running, {.files = false, .machine = false});
    block_ = scheduler::make_block(make_run_setup(running, check, "test", {0, true}));
    block_->virtual_ns.store(is_simulated_ ? 1 : 0);
    for (const std::uint32_t ended : ended_) {
      block_->modules()[ended].ended = true;
    }
    config::Config next = read(after, "/new");
    check = config::check_config(next, {.files = false, .machine = false});
    return plan_schedule(running, *block_, next, check);
  }
  static std::string kinds(const SchedulePlan& plan) {
    std::string text;
    for (const ModuleFate& fate : plan.modules) {
      text += fate.module + " " + to_text(fate.kind) + (fate.text.empty() ? "" : " (" + fate.text + ")") + "; ";
    }
    return text;
  }
  scheduler::BlockPointer block_;
  std::vector<std::uint32_t> ended_;
  bool is_simulated_ = false;
};

TEST_F(SchedulePlans, Say_what_becomes_of_each_module) {
  const auto sut =
      plan(module_xml("a", "1ms") + module_xml("b", "2ms") + module_xml("c", "2ms"),
           module_xml("d", "4ms") + module_xml("c", "2ms") +
               module_xml("a", "3ms", "<offset>1ms</offset><overrun>catch-up</overrun><budget>off</budget>"));
  EXPECT_EQ(kinds(sut),
            "d added; c kept; a rescheduled (period 1 ms -> 3 ms, offset 0 ns -> 1 ms, budget default -> off, overrun "
            "skip -> catch-up); b ended; ");
  EXPECT_THAT(sut.restarts, IsEmpty());
  EXPECT_THAT(sut.indices, ElementsAre(SchedulePlan::kNoModule, 2, 0));
  EXPECT_THAT(sut.added, ElementsAre(0));
  EXPECT_THAT(sut.ended, ElementsAre(1));
}

TEST_F(SchedulePlans, A_module_that_has_ended_is_added_again) {
  ended_ = {1};
  const auto sut =
      plan(module_xml("a", "1ms") + module_xml("b", "2ms"), module_xml("a", "1ms") + module_xml("b", "2ms"));
  EXPECT_EQ(kinds(sut), "a kept; b added; ");
  EXPECT_THAT(sut.added, ElementsAre(1));
  EXPECT_THAT(plan(module_xml("a", "1ms") + module_xml("b", "2ms"), module_xml("a", "1ms")).ended, IsEmpty());
}

TEST_F(SchedulePlans, Processes_and_modules_in_the_background_are_added_but_not_processes_to_a_simulation) {
  const std::string a = module_xml("a", "1ms");
  const std::string background =
      "<module><filename>./b.so</filename><moduletype>thread</moduletype><operationtype>non-real</operationtype>"
      "</module>";
  const std::string process =
      "<module><filename>./p.exe</filename><moduletype>process</moduletype><operationtype>non-real</operationtype>"
      "</module>";
  for (const bool is_simulated : {false, true}) {
    is_simulated_ = is_simulated;
    const auto sut = plan(a, a + background + process);
    EXPECT_EQ(kinds(sut), "a kept; b added; p added; ");
    EXPECT_THAT(sut.added, ElementsAre(1, 2));
    EXPECT_EQ(sut.restarts.empty(), !is_simulated);
  }
}

TEST_F(SchedulePlans, What_is_no_schedule_needs_a_restart_and_all_of_it_is_said) {
  const std::string a = module_xml("a", "1ms");
  const auto restarts = [&](const std::string& more) { return plan(a, module_xml("a", "1ms", more)).restarts; };
  EXPECT_THAT(restarts("<property><value name=\"x\">1</value></property>"),
              ElementsAre("module a differs in <property>"));
  EXPECT_THAT(restarts("<failsafe variable=\"n::x\">1</failsafe>"), ElementsAre("module a differs in <failsafe>"));
  EXPECT_THAT(restarts("<core>0</core>"), ElementsAre("module a differs in <core>"));
  EXPECT_THAT(restarts("<access><read>n::x</read></access>"), ElementsAre(HasSubstr("module a differs in what is")));
  EXPECT_THAT(restarts("<wcet>1us</wcet>"), IsEmpty());
  EXPECT_THAT(plan(a, a + "<order>total</order>").restarts, ElementsAre("it differs outside of its modules"));
  EXPECT_THAT(plan(a, module_xml("a", "1500us")).restarts,
              ElementsAre("its basic period is 1.5 ms, and the node ticks every 1 ms"));
  EXPECT_THAT(plan(a, module_xml("a", "3ms")).restarts, IsEmpty());
  std::string many = a;
  for (int i = 0; i < 9; ++i) {
    many += module_xml("n" + std::to_string(i), "1ms");
  }
  EXPECT_THAT(plan(a, many).restarts, ElementsAre("9 modules are new, and there is room for 8"));
}

}  // namespace
}  // namespace indurop::node
