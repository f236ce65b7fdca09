// SPDX-License-Identifier: Apache-2.0
// Two boards with a press each, whose versions are exchanged by deployments, and what is seen of it in their nodes.

#pragma once

#include <string_view>

#include "agents_fixture.h"
#include "scheduler/run_block.h"
#include "store/vars/run_file.h"

namespace indurop::test {

using testing::HasSubstr;

class ExchangeTest : public AgentsTest {
 protected:
  ExchangeTest() { ::setenv("IRP_TEST_SLOW_UNTIL", path("go").c_str(), 1); }
  ~ExchangeTest() override { ::unsetenv("IRP_TEST_SLOW_UNTIL"); }

  // The press of a board is this file from now on, for the next deployment.
  void bring(const std::string& name, const std::string& version) const {
    const std::filesystem::path to = folder() / ("press_" + name + ".so");
    std::filesystem::remove(to);
    const bool is_process = version.starts_with("process");
    std::filesystem::copy_file(std::filesystem::path(EXCHANGED_FOLDER) / (version + (is_process ? ".exe" : ".so")), to);
  }
  [[nodiscard]] const char* type_of(std::string_view name, std::string_view module) const {
    return press_b_is_process_ && name == "b" && module == "press" ? "process" : "thread";
  }
  // Both boards; `more`: elements of all modules besides.
  [[nodiscard]] std::string plant(const std::string& period = "10ms", const std::string& more = "") const {
    std::ofstream out(folder() / "plant.xml");
    out << "<plant name=\"p" << ::getpid() << "\"><domain>" << domain() << "</domain><external>off</external>\n";
    for (const char* name : {"a", "b"}) {
      out << "<board name=\"" << board(name) << "\">\n";
      for (const auto& [module, priority] : {std::pair{"press", 1}, std::pair{"ticks", 2}}) {
        out << "<module><name>" << module << "</name><filename>./" << module << "_" << name
            << ".so</filename><moduletype>" << type_of(name, module)
            << "</moduletype><operationtype>periodic</operationtype><period>" << period << "</period><priority>"
            << priority << "</priority><budget>1s</budget>" << more << "</module>\n";
      }
      out << "</board>\n";
    }
    out << "</plant>\n";
    return path("plant.xml");
  }
  // Both boards run the first versions, of which that of board b is `press_b`.
  void start_plant(const std::string& press_b = "press_b_first") {
    for (const char* name : {"a", "b"}) {
      std::filesystem::copy_file(std::filesystem::path(EXCHANGED_FOLDER) / ("ticks_" + std::string(name) + ".so"),
                                 folder() / ("ticks_" + std::string(name) + ".so"));
      start_agent(name);
    }
    bring("a", "press_a_first");
    bring("b", press_b);
    const Outcome done = deploy(plant());
    ASSERT_EQ(done.code, 0) << done.err;
    first_ = done.json()["deployment"];
    for (const char* name : {"a", "b"}) {
      pids_[name] = vars::running_node(board(name));
      ASSERT_TRUE(wait_until([&] { return number(name, "ticks") > 20; }));
    }
  }

  // The shared variable xt::BOARD_WHAT.
  std::int64_t number(const std::string& name, const std::string& what) {
    const auto store = vars::Store::attach(board(name), vars::Mode::ReadOnly);
    schema::Variable variable;
    variable.name = "xt::" + name + "_" + what;
    std::int64_t value = 0;
    const auto* const entry = store.ok() ? store.value().find(variable.name_hash()) : nullptr;
    if (entry == nullptr ||
        !store.value().read(*entry, 0, {reinterpret_cast<std::uint8_t*>(&value), sizeof value}).ok()) {
      return 0;
    }
    return value;
  }
  struct Press {
    std::uint64_t version = 0;
    std::uint64_t faults = 0;
    std::int64_t since_ns = 0;  // CLOCK_MONOTONIC of the first tick of this version
    std::int64_t period_ns = 0;
    std::uint64_t left_out = 0;  // runs of both modules, lost ticks of the node apart
    std::string deployment;
  };
  Press press(const std::string& name) {
    const auto file =
        vars::RunFile::open(board(name), vars::Mode::ReadOnly, scheduler::kRunMagic, sizeof(scheduler::RunBlock));
    if (!file) {
      return {};
    }
    const auto& block = *static_cast<const scheduler::RunBlock*>(file->data());
    const scheduler::ModuleRecord& module = block.modules()[0];
    return {module.version.load(),
            module.faults.load(),
            block.epoch_ns.load() + static_cast<std::int64_t>(module.version_tick.load()) * block.basic_period_ns,
            block.basic_period_ns,
            module.skipped.load() + block.modules()[1].skipped.load() - 2 * block.lost_ticks.load(),
            block.deployment};
  }
  // Nothing was started again, and nothing was left out.
  void expect_untouched(const std::string& name) {
    EXPECT_EQ(vars::running_node(board(name)), pids_[name]) << "the node of board " << name << " was started again";
    EXPECT_EQ(press(name).left_out, 0U) << name;
    EXPECT_EQ(number(name, "gaps"), 0) << name;
  }
  bool both_run(const std::string& deployment) {
    return wait_until([&] { return runs("a", deployment) && runs("b", deployment); });
  }
  bool shows(const std::string& name, int sign) {
    return wait_until([&] { return number(name, "shown") * sign > 0; });
  }
  // What the plan of a result says of a module: "exchanged with state".
  Json planned(const Json& result, const std::string& name, const std::string& module) {
    for (const Json& one : result["plan"]) {
      for (const Json& row : one["modules"]) {
        if (one["board"] == board(name) && row["module"] == module) {
          return row["plan"];
        }
      }
    }
    return {};
  }

  bool press_b_is_process_ = false;
  std::string first_;                  // id
  std::map<std::string, pid_t> pids_;  // of the nodes that run it
};

}  // namespace indurop::test
