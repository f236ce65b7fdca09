// SPDX-License-Identifier: Apache-2.0
// Schedules that follow one another in virtual time, against an oracle that reads the text of the configurations alone:
// which module runs in which tick, and in which order. It shares no code with the tables of the scheduler.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <random>
#include <regex>
#include <string>
#include <vector>

#include "config/check/check.h"
#include "config/xml/reader.h"
#include "node/run/setup.h"
#include "scheduler/engine.h"
#include "scheduler/simulated_kernel.h"
#include "tests/unit/scheduler/fixture.h"

namespace indurop::node {
namespace {

using scheduler::Engine;

constexpr std::int64_t kMillisecond = 1'000'000;
constexpr std::uint64_t kNever = ~std::uint64_t{0};

class Chance {
 public:
  explicit Chance(unsigned seed) : engine_(seed) {}
  int below(int limit) { return static_cast<int>(engine_() % static_cast<unsigned>(limit)); }
  bool one_of(int n) { return below(n) == 0; }
  template <class T>
  void shuffle(std::vector<T>& all) {
    for (std::size_t i = all.size(); i > 1; --i) {
      std::swap(all[i - 1], all[static_cast<std::size_t>(below(static_cast<int>(i)))]);
    }
  }

 private:
  std::minstd_rand engine_;
};

// What the text says of a module, in microseconds.
struct Said {
  std::string name;
  int priority = 0;
  std::int64_t period = 0;  // 0: it handles events in every tick
  std::int64_t offset = 0;
  int core = 0;

  bool operator==(const Said&) const = default;
};

std::int64_t number_in(const std::string& text, const std::string& element) {
  std::smatch found;
  return std::regex_search(text, found, std::regex("<" + element + ">(\\d+)(us)?</")) ? std::stoll(found[1]) : 0;
}

std::vector<Said> said_in(const std::string& xml) {
  std::vector<Said> all;
  const std::regex module("<module>([^]*?)</module>");
  for (std::sregex_iterator it(xml.begin(), xml.end(), module), end; it != end; ++it) {
    const std::string text = (*it)[1];
    std::smatch name;
    std::regex_search(text, name, std::regex("<name>(\\w+)</"));
    all.push_back({name[1], static_cast<int>(number_in(text, "priority")), number_in(text, "period"),
                   number_in(text, "offset"), static_cast<int>(number_in(text, "core"))});
  }
  return all;
}

std::int64_t basic_period(const std::vector<Said>& all) {
  std::int64_t divisor = 0;
  for (const Said& one : all) {
    divisor = std::gcd(divisor, std::gcd(one.period, one.offset));
  }
  return divisor;
}

// The names of those that are due in a tick, in order of execution.
std::vector<std::string> due(const std::vector<Said>& all, std::int64_t basic, std::uint64_t tick, int core,
                             bool periodic) {
  const std::int64_t now = basic * static_cast<std::int64_t>(tick);
  std::vector<Said> found;
  for (const Said& one : all) {
    const bool is_due =
        one.period == 0 ? !periodic : periodic && now >= one.offset && (now - one.offset) % one.period == 0;
    if (is_due && one.core == core) {
      found.push_back(one);
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const Said& a, const Said& b) { return a.priority < b.priority; });
  std::vector<std::string> names;
  for (const Said& one : found) {
    names.push_back(one.name);
  }
  return names;
}

struct Written {
  std::string name;
  bool periodic = true;
  int core = 0;
};

// A configuration of some of the modules in any order.
std::string random_xml(Chance& random, std::vector<Written> modules, int work_us) {
  constexpr std::array<int, 8> kPeriods{1, 2, 3, 4, 5, 6, 8, 10};
  random.shuffle(modules);
  std::string xml = "<root>\n";
  for (const Written& module : modules) {
    xml += "<module><filename>./" + module.name + ".so</filename><name>" + module.name +
           "</name><moduletype>thread</moduletype><priority>" + std::to_string(random.below(6)) + "</priority>";
    if (!module.periodic) {
      xml += "<operationtype>sporadic</operationtype><deadline>100ms</deadline></module>\n";
      continue;
    }
    const int period = kPeriods[static_cast<std::size_t>(random.below(8))];
    const int offset = random.one_of(3) ? random.below(period) : 0;
    xml += "<operationtype>periodic</operationtype><period>" + std::to_string(period * 1000) + "us</period><offset>" +
           std::to_string(offset * 1000) + "us</offset><core>" + std::to_string(module.core) + "</core><wcet>" +
           std::to_string(1 + random.below(work_us * period)) + "us</wcet></module>\n";
  }
  return xml + "</root>\n";
}

// A node's engine without a node: modules that do nothing but take time.
class Changes {
 public:
  explicit Changes(const std::string& xml) {
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
      auto& self = *static_cast<Changes*>(context);
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
    while (engine_->follow_change() == Engine::Change::Starting) {
      pass(1);
    }
    const std::uint64_t next = block_->tick.load();
    const std::uint64_t slots = block_->slot_count;
    const std::uint64_t tick = (next + slots - 1) / slots * slots;
    EXPECT_TRUE(engine_->change_at({tick, slots, tick + 10 * slots}));
    for (int i = 0; engine_->follow_change() != Engine::Change::None; ++i) {
      if (engine_->follow_change() ==
          Engine::Change::Prepared) {  // runs are in progress whenever a macro period begins
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
  std::optional<Engine> engine_;
};

// Returns true if every module is done before its next release, as `indurop check` says.
bool is_feasible(const std::string& xml) {
  auto read = config::read_config_text(xml, "/module.xml");
  const auto check = config::check_config(read.config, {.files = false, .machine = false});
  return read.ok() && check.diagnostics.empty();
}

// A configuration whose grid fits that of `first`; any if that is empty.
std::string feasible_xml(Chance& random, const std::vector<Written>& modules, int work_us, const std::string& first) {
  for (;;) {
    const std::string xml = random_xml(random, modules, work_us);
    const bool fits = first.empty() || basic_period(said_in(xml)) % basic_period(said_in(first)) == 0;
    if (fits && is_feasible(xml)) {
      return xml;
    }
  }
}

// Some of them, and always the first.
std::vector<Written> some_of(Chance& random, const std::vector<Written>& modules) {
  std::vector<Written> some{modules.front()};
  for (std::size_t i = 1; i < modules.size(); ++i) {
    if (!random.one_of(5)) {
      some.push_back(modules[i]);
    }
  }
  return some;
}

// A sequence of schedules, and the first tick of each.
struct History {
  std::vector<std::vector<Said>> said;
  std::vector<std::uint64_t> since;
  std::int64_t basic = 0;

  [[nodiscard]] const std::vector<Said>& at(std::uint64_t tick) const {
    std::size_t i = since.size();
    while (since[--i] > tick) {
    }
    return said[i];
  }
};

class FollowingSchedules : public testing::TestWithParam<int> {
 protected:
  // Chance modules, and random schedules of them that follow one another at random times.
  void run(Chance& random, int work_us, bool sporadic) {
    std::vector<Written> modules;
    for (int i = 0, count = 1 + random.below(8); i < count; ++i) {
      modules.push_back({"m" + std::to_string(i), i == 0 || !sporadic || !random.one_of(4), random.below(GetParam())});
      modules.back().core = modules.back().periodic ? modules.back().core : 0;
    }
    std::string xml = feasible_xml(random, modules, work_us, "");
    const std::string first = xml;
    sut_.emplace(first);
    history_ = {{said_in(xml)}, {0}, basic_period(said_in(xml))};
    for (int change = 0; change < 4; ++change) {
      sut_->pass(random.below(40'000) * 1000);
      xml = random.one_of(4) ? first : feasible_xml(random, some_of(random, modules), work_us, first);
      history_.since.push_back(sut_->change(xml));
      history_.said.push_back(said_in(xml));
    }
    sut_->pass(50 * kMillisecond);
    // What is released while the engine ends may find its band stopped.
    counts_.clear();
    for (const Written& module : modules) {
      const scheduler::ModuleRecord& record = sut_->record(module.name);
      counts_[module.name] = {record.skipped.load(), record.overruns.load()};
    }
    sut_->end();
  }
  [[nodiscard]] std::uint64_t end() const { return sut_->tick() - 1; }

  // Those of `names` that are periodic or not, on one core.
  std::vector<std::string> of_core(const std::vector<std::string>& names, std::uint64_t tick, int core,
                                   bool periodic) const {
    std::vector<std::string> found;
    for (const Said& one : history_.at(tick)) {
      if (one.core == core && (one.period != 0) == periodic) {
        found.push_back(one.name);
      }
    }
    std::vector<std::string> out;
    std::copy_if(names.begin(), names.end(), std::back_inserter(out),
                 [&](const std::string& name) { return std::find(found.begin(), found.end(), name) != found.end(); });
    return out;
  }

  bool is_due(const std::string& name, std::uint64_t tick) const {
    for (int core = 0; core < GetParam(); ++core) {
      const auto all = due(history_.at(tick), history_.basic, tick, core, true);
      if (std::find(all.begin(), all.end(), name) != all.end()) {
        return true;
      }
    }
    return false;
  }

  std::optional<Changes> sut_;
  History history_;
  struct Counts {
    std::uint64_t skipped = 0;
    std::uint64_t overruns = 0;
  };
  std::map<std::string, Counts> counts_;  // by module, before the end
};

// Runs are so short that all of them are over in their ticks.
TEST_P(FollowingSchedules, Every_tick_runs_what_its_schedule_says_in_that_order) {
  for (unsigned seed = 1; seed <= 15 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance random(seed);
    run(random, 2, true);
    for (std::uint64_t tick = 0; tick < end() && !HasFailure(); ++tick) {
      SCOPED_TRACE("tick " + std::to_string(tick));
      std::size_t all = 0;
      for (int core = 0; core < GetParam(); ++core) {
        for (const bool periodic : {true, false}) {
          const auto expected = due(history_.at(tick), history_.basic, tick, core, periodic);
          EXPECT_EQ(of_core(sut_->ran(tick), tick, core, periodic), expected);
          all += expected.size();
        }
      }
      EXPECT_EQ(sut_->ran(tick).size(), all) << "another module ran";
    }
    EXPECT_EQ(sut_->lost_ticks(), 0U);
    for (const auto& [name, counts] : counts_) {
      EXPECT_EQ(counts.skipped, 0U) << name;
    }
  }
}

// Runs last for many ticks, and often over the end of a macro period.
TEST_P(FollowingSchedules, No_release_is_lost_although_runs_are_in_progress) {
  for (unsigned seed = 1; seed <= 20 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance random(seed);
    run(random, 250, false);
    std::map<std::string, std::uint64_t> left_out;
    for (std::uint64_t tick = 0; tick < end(); ++tick) {
      for (int core = 0; core < GetParam(); ++core) {
        for (const std::string& name : due(history_.at(tick), history_.basic, tick, core, true)) {
          const auto& ran = sut_->ran(tick);
          const auto times = std::count(ran.begin(), ran.end(), name);
          EXPECT_LE(times, 1) << name << " in tick " << tick;
          left_out[name] += times == 1 ? 0 : 1;
        }
      }
      for (const std::string& name : sut_->ran(tick)) {
        EXPECT_TRUE(is_due(name, tick)) << name << " in tick " << tick;
      }
    }
    for (const auto& [name, counts] : counts_) {
      EXPECT_LE(left_out[name], counts.skipped + 1) << name;  // the last ones may not have begun
      if (GetParam() == 1) {
        EXPECT_EQ(counts.skipped, 0U) << name;
        EXPECT_EQ(counts.overruns, 0U) << name;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cores, FollowingSchedules, testing::Values(1, 2));

// What the mirror asks before and after it copies what a module writes.
TEST(WritersActivity, Is_odd_during_a_run_and_counts_the_runs_whichever_schedule_counts) {
  const auto xml = [](const std::string& period) {
    const auto module = [](const std::string& name, const std::string& every, const std::string& wcet) {
      return "<module><filename>./" + name + ".so</filename><name>" + name +
             "</name><moduletype>thread</moduletype><operationtype>periodic</operationtype><period>" + every +
             "</period><priority>1</priority><wcet>" + wcet + "</wcet></module>";
    };
    return "<root>" + module("quick", "1ms", "10us") + module("slow", period, "700us") + "</root>";
  };
  Changes sut(xml("2ms"));
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
