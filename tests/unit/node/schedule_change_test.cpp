// SPDX-License-Identifier: Apache-2.0
// Schedules that follow one another in virtual time, against an oracle that reads the text of the configurations alone:
// which module runs in which tick, and in which order. It shares no code with the tables of the scheduler.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <random>
#include <regex>
#include <string>
#include <vector>

#include "config/check/check.h"
#include "config/xml/reader.h"
#include "engine_of_modules.h"

namespace indurop::node {
namespace {

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

  std::optional<EngineOfModules> sut_;
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

}  // namespace
}  // namespace indurop::node
