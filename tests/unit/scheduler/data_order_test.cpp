// SPDX-License-Identifier: Apache-2.0
// Several cores in virtual time, where only data keeps the order: what modules read is what they read on one core.

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "fixture.h"
#include "scheduler/bands.h"
#include "scheduler/response_time.h"
#include "scheduler/simulated_kernel.h"

namespace indurop::scheduler {
namespace {

constexpr std::int64_t kBasic = 1'000'000;
constexpr std::uint64_t kTicks = 60;

struct Access {
  std::vector<std::size_t> reads;
  std::vector<std::size_t> writes;
};

bool share(const Access& a, const Access& b) {
  const auto writes_of = [](const Access& from, const Access& to) {
    return std::any_of(from.writes.begin(), from.writes.end(), [&](std::size_t variable) {
      return std::find(to.reads.begin(), to.reads.end(), variable) != to.reads.end() ||
             std::find(to.writes.begin(), to.writes.end(), variable) != to.writes.end();
    });
  };
  return writes_of(a, b) || writes_of(b, a);
}

struct World {
  std::vector<Access> access;  // by module
  std::array<std::uint64_t, 8> variables{};
  std::vector<std::vector<std::uint64_t>> seen;  // by module, what each run made of what it read
  std::size_t running = 0;
};
World* g_world = nullptr;

// Reads all it may, then writes something that depends on all of it and on itself.
void run_module() {
  World& world = *g_world;
  const Access& access = world.access[world.running];
  std::uint64_t sum = 17 + world.running;
  for (const std::size_t variable : access.reads) {
    sum = sum * 1'000'003 + world.variables.at(variable);
  }
  for (const std::size_t variable : access.writes) {
    world.variables.at(variable) = ++sum;
  }
  world.seen[world.running].push_back(sum);
}

struct Outcome {
  std::vector<std::vector<std::uint64_t>> seen;
  std::vector<std::int64_t> longest;  // response, by module
  std::uint64_t overruns = 0;
};

Outcome run(const std::vector<Task>& tasks, const std::vector<Access>& access, CoreOrder order) {
  World world{access, {}, std::vector<std::vector<std::uint64_t>>(tasks.size()), 0};
  g_world = &world;
  std::int64_t macro = kBasic;
  for (const Task& task : tasks) {
    macro = std::max(macro, task.period_ns);
  }
  const BlockPointer block = make_block(tasks, kBasic, macro);
  EngineSettings settings;
  settings.basic_period_ns = kBasic;
  settings.spin.mode = SpinMode::Off;
  settings.order = order;
  Hooks hooks;
  hooks.context = &world;
  hooks.entering = [](void* context, std::uint32_t module, std::uint64_t, std::int64_t) noexcept {
    static_cast<World*>(context)->running = module;
  };
  SimulatedKernel kernel(rt::mono_time(kBasic), {}, {});
  Engine engine(*block, tasks, settings, hooks, kernel);
  EXPECT_TRUE(engine.start(kTicks).ok());
  engine.join();
  Outcome outcome{world.seen, {}, 0};
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    outcome.longest.push_back(block->modules()[i].response.max.load());
    outcome.overruns += block->modules()[i].overruns.load();
  }
  return outcome;
}

Task of(std::uint32_t index, int priority, int core, std::int64_t work_ns) {
  Task task = periodic(index, kBasic, priority, run_module);
  task.core = core;
  task.work_ns = work_ns;
  return task;
}

TEST(DataOrder, Modules_that_share_nothing_run_side_by_side) {
  const std::vector<Task> tasks = {of(0, 1, 0, 700'000), of(1, 2, 1, 600'000)};
  const std::vector<Access> nothing(2);
  EXPECT_THAT(run(tasks, nothing, CoreOrder::Data).longest, testing::ElementsAre(700'000, 600'000));
  EXPECT_GT(run(tasks, nothing, CoreOrder::Total).overruns, 0U) << "one after the other they do not fit";
}

TEST(DataOrder, A_module_waits_for_that_of_another_core_its_data_comes_from) {
  std::vector<Task> tasks = {of(0, 1, 0, 300'000), of(1, 2, 1, 200'000), of(2, 3, 1, 100'000)};
  tasks[1].after = {0};
  const Outcome sut = run(tasks, std::vector<Access>(3), CoreOrder::Data);
  EXPECT_THAT(sut.longest, testing::ElementsAre(300'000, 500'000, 600'000));
}

struct Random {
  std::mt19937 engine;
  int upto(int least, int most) { return std::uniform_int_distribution(least, most)(engine); }
};

// All that is due in a basic period fits into it even on one core.
std::vector<Task> random_tasks(Random& random, std::vector<Access>& access) {
  const int count = random.upto(2, 9);
  std::vector<Task> tasks;
  for (int i = 0; i < count; ++i) {
    const int priority = random.upto(1, 5);  // compilers evaluate arguments in different orders
    Task task = of(static_cast<std::uint32_t>(i), priority, 0, kBasic / count - random.upto(1, 50) * 1000);
    task.period_ns = kBasic * std::array{1, 1, 2, 3, 4}.at(static_cast<std::size_t>(random.upto(0, 4)));
    task.offset_ns = random.upto(0, 3) == 0 ? task.period_ns - kBasic : 0;
    tasks.push_back(task);
    Access uses;
    for (int n = random.upto(0, 3); n > 0; --n) {
      auto& list = random.upto(0, 2) == 0 ? uses.writes : uses.reads;
      list.push_back(static_cast<std::size_t>(random.upto(0, 7)));
    }
    access.push_back(uses);
  }
  return tasks;
}

void connect(std::vector<Task>& tasks, const std::vector<Access>& access) {
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    for (std::size_t k = 0; k < tasks.size(); ++k) {
      const bool earlier = tasks[k].priority < tasks[i].priority || (tasks[k].priority == tasks[i].priority && k < i);
      if (earlier && share(access[i], access[k])) {
        tasks[i].after.push_back(static_cast<std::uint32_t>(k));
      }
    }
  }
}

TEST(DataOrder, On_up_to_four_cores_every_run_reads_what_it_reads_on_one) {
  int earlier = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random{std::mt19937(seed)};
    std::vector<Access> access;
    std::vector<Task> tasks = random_tasks(random, access);
    connect(tasks, access);
    const Outcome alone = run(tasks, access, CoreOrder::Data);
    const int cores = random.upto(2, 4);
    for (Task& task : tasks) {
      task.core = random.upto(0, cores - 1);
    }
    const Outcome together = run(tasks, access, CoreOrder::Data);
    ASSERT_EQ(alone.overruns + together.overruns, 0U);
    ASSERT_EQ(together.seen, alone.seen);
    earlier += together.longest.back() < alone.longest.back() ? 1 : 0;
  }
  EXPECT_GT(earlier, 100) << "what need not wait does not";
}

// Work of any length, up to several basic periods.
std::vector<Task> long_tasks(Random& random, std::vector<Access>& access, int cores) {
  std::vector<Task> tasks = random_tasks(random, access);
  for (Task& task : tasks) {
    task.core = random.upto(0, cores - 1);
    task.work_ns = random.upto(1, static_cast<int>(task.period_ns / 1000 / 3)) * 1000;
  }
  connect(tasks, access);
  return tasks;
}

// By task. Empty: not all are done before their next release.
std::vector<std::int64_t> bounds_of(const std::vector<Task>& tasks, CoreOrder order) {
  std::vector<std::uint32_t> turn;
  std::vector<int> front;  // priority of the first task of its band
  for (const BandPlan& band : make_bands(tasks, kBasic, order)) {
    turn.insert(turn.end(), band.tasks.begin(), band.tasks.end());
    front.resize(turn.size(), tasks[band.tasks.front()].priority);
  }
  std::vector<Demand> demands;
  for (std::uint32_t i = 0; i < turn.size(); ++i) {
    const Task& task = tasks[turn[i]];
    Demand demand{Nanos(task.period_ns), Nanos(task.offset_ns), Nanos(task.work_ns), false, task.core};
    for (std::uint32_t k = 0; k < i; ++k) {
      const Task& other = tasks[turn[k]];
      const bool required = order == CoreOrder::Total
                                ? front[k] < front[i]
                                : std::find(task.after.begin(), task.after.end(), other.index) != task.after.end();
      if (required && other.core != task.core) {
        demand.after.push_back(k);
      }
    }
    demands.push_back(demand);
  }
  const WorstResponses found = worst_responses(demands, Nanos(kBasic), {});
  std::vector<std::int64_t> bounds(tasks.size());
  for (std::size_t i = 0; i < turn.size(); ++i) {
    bounds[turn[i]] = found.worst[i].count();
    if (found.worst[i] == WorstResponses::kNotDone || bounds[turn[i]] > tasks[turn[i]].period_ns) {
      return {};
    }
  }
  return bounds;
}

TEST(DataOrder, No_run_on_several_cores_ends_later_than_its_bound_says) {
  int checked = 0;
  int exact = 0;
  for (unsigned seed = 0; seed < 1000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random{std::mt19937(seed)};
    std::vector<Access> access;
    const std::vector<Task> tasks = long_tasks(random, access, random.upto(2, 4));
    const CoreOrder order = random.upto(0, 3) == 0 ? CoreOrder::Total : CoreOrder::Data;
    const std::vector<std::int64_t> bounds = bounds_of(tasks, order);
    if (bounds.empty()) {
      continue;
    }
    ++checked;
    // With the longest work, and with less, where others can begin earlier and be in the way.
    for (const int share : {100, random.upto(10, 90)}) {
      std::vector<Task> shorter = tasks;
      for (Task& task : shorter) {
        task.work_ns = task.work_ns * (random.upto(0, 1) == 0 ? share : 100) / 100;
      }
      const Outcome sut = run(shorter, access, order);
      for (std::size_t i = 0; i < tasks.size(); ++i) {
        ASSERT_LE(sut.longest[i], bounds[i]) << "task " << i;
        exact += share == 100 && sut.longest[i] == bounds[i] ? 1 : 0;
      }
    }
  }
  EXPECT_GT(checked, 200);
  EXPECT_GT(exact, 600) << "and it is not far off";
}

}  // namespace
}  // namespace indurop::scheduler
