// SPDX-License-Identifier: Apache-2.0
// Virtual time against a reference written another way: every unit of time, one after the other.

#include "scheduler/simulated_kernel.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "fixture.h"

namespace indurop::scheduler {
namespace {

struct Job {
  int core = 0;
  int priority = 1;
  std::int64_t period = 1;
  std::int64_t offset = 0;
  std::int64_t work = 1;
};

// When each run of each job ended, as the kernel has it.
std::vector<std::vector<std::int64_t>> simulate(const std::vector<Job>& jobs, std::int64_t end) {
  std::atomic<std::int64_t> shown{0};
  SimulatedKernel kernel(rt::mono_time(0), {&shown}, {});
  std::vector<std::vector<std::int64_t>> ended(jobs.size());
  std::vector<std::unique_ptr<KernelThread>> threads;
  std::atomic<bool> stop{false};
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    auto thread = kernel.start({"job", jobs[i].priority, jobs[i].core}, [&, i] {
      const Job& job = jobs[i];
      for (std::int64_t at = job.offset; !stop; at += job.period) {
        kernel.sleep_until(rt::mono_time(at));
        kernel.work(job.work);
        ended[i].push_back(rt::to_ns(kernel.now()));
      }
    });
    threads.push_back(std::move(thread).value());
  }
  kernel.sleep_until(rt::mono_time(end));
  EXPECT_EQ(shown.load(), end);
  stop = true;
  threads.clear();
  for (auto& one : ended) {
    std::erase_if(one, [end](std::int64_t at) { return at > end; });
  }
  return ended;
}

std::vector<std::vector<std::int64_t>> simulate_every_unit(const std::vector<Job>& jobs, std::int64_t end) {
  std::vector<std::vector<std::int64_t>> ended(jobs.size());
  std::vector<std::int64_t> next(jobs.size());  // release of the run that is not over
  std::vector<std::int64_t> left(jobs.size());
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    next[i] = jobs[i].offset;
    left[i] = jobs[i].work;
  }
  for (std::int64_t now = 0; now < end; ++now) {
    std::array<int, 2> chosen{-1, -1};
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      int& best = chosen[static_cast<std::size_t>(jobs[i].core)];
      if (next[i] <= now && (best < 0 || jobs[i].priority > jobs[static_cast<std::size_t>(best)].priority)) {
        best = static_cast<int>(i);
      }
    }
    for (const int one : chosen) {
      if (one >= 0 && --left[static_cast<std::size_t>(one)] == 0) {
        const auto i = static_cast<std::size_t>(one);
        ended[i].push_back(now + 1);
        next[i] += jobs[i].period;
        left[i] = jobs[i].work;
      }
    }
  }
  return ended;
}

TEST(SimulatedKernel, Dispatches_like_a_reference_that_simulates_every_unit_of_time) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    const auto upto = [&random](int least, int most) { return std::uniform_int_distribution(least, most)(random); };
    std::vector<Job> jobs;
    const int count = upto(1, 6);
    for (int i = 0; i < count; ++i) {
      // Any load, overload too; no two of the same priority, whose order the reference does not know.
      jobs.push_back({upto(0, 1), 1 + i, upto(3, 40), upto(0, 20), upto(1, 12)});
    }
    ASSERT_EQ(simulate(jobs, 500), simulate_every_unit(jobs, 500)) << "seed " << seed;
  }
}

TEST(SimulatedKernel, Threads_of_one_priority_run_in_the_order_they_became_ready) {
  SimulatedKernel kernel(rt::mono_time(0), {}, {});
  std::string order;
  std::vector<std::unique_ptr<KernelThread>> threads;
  for (const std::pair<char, int>& one : {std::pair{'a', 20}, std::pair{'b', 10}, std::pair{'c', 10}}) {
    auto thread = kernel.start({"t", 5, 0}, [&kernel, &order, name = one.first, begin = one.second] {
      kernel.sleep_until(rt::mono_time(begin));
      order += name;
      kernel.work(30);
      order += name;
    });
    threads.push_back(std::move(thread).value());
  }
  kernel.sleep_until(rt::mono_time(200));
  EXPECT_EQ(order, "bbccaa");
}

TEST(SimulatedKernel, Waiting_ends_with_the_wake_up_and_takes_no_time) {
  SimulatedKernel kernel(rt::mono_time(0), {}, {});
  rt::SignalWord word{};
  word.init(false);
  std::int64_t woken = -1;
  auto waits = kernel.start({"low", 1, 0}, [&] {
    kernel.wait(word);
    woken = rt::to_ns(kernel.now());
  });
  auto wakes = kernel.start({"high", 2, 0}, [&] {
    kernel.sleep_until(rt::mono_time(70));
    word.wake();
    kernel.work(5);
  });
  kernel.sleep_until(rt::mono_time(100));
  EXPECT_EQ(woken, 75) << "the one that woke it was in its way";
  EXPECT_EQ(kernel.next_event(), SimulatedKernel::kNever);
}

struct Recorded {
  std::uint64_t overruns;
  std::uint64_t skipped;
  std::int64_t response;
  std::uint64_t lost;
  bool operator==(const Recorded&) const = default;
};

Recorded run_engine(std::int64_t work_ns, std::int64_t budget_ns = 0) {
  Task slow = periodic(1, 2'000'000, 2, [] {});
  slow.work_ns = work_ns;
  slow.budget_ns = budget_ns;
  Task fast = periodic(0, 1'000'000, 1, [] {});
  fast.work_ns = 400'000;
  const std::vector<Task> tasks = {fast, slow};
  const BlockPointer block = make_block(tasks, 1'000'000, 2'000'000);
  EngineSettings settings;
  settings.basic_period_ns = 1'000'000;
  settings.spin.mode = SpinMode::Off;
  SimulatedKernel kernel(rt::mono_time(1'000'000), {}, {});
  Engine engine(*block, tasks, settings, Hooks{}, kernel);
  EXPECT_TRUE(engine.start(100).ok());
  engine.join();
  const ModuleRecord& record = block->modules()[1];
  EXPECT_EQ(block->modules()[0].overruns.load(), 0U);
  EXPECT_EQ(block->modules()[0].response.max.load(), 400'000);
  return {record.overruns.load(), record.skipped.load(), record.response.max.load(), block->lost_ticks.load()};
}

TEST(SimulatedKernel, The_engine_preempts_overruns_and_ends_modules_in_virtual_time) {
  // Two fast runs of 400 us in each macro period leave 1200 us of it.
  EXPECT_EQ(run_engine(600'000), (Recorded{0, 0, 1'000'000, 0}));
  EXPECT_EQ(run_engine(700'000), (Recorded{0, 0, 1'500'000, 0})) << "preempted once: two runs before it, then 700 us";
  EXPECT_EQ(run_engine(1'200'000), (Recorded{0, 0, 2'000'000, 0}));
  const Recorded over = run_engine(1'500'000);
  EXPECT_GT(over.overruns, 20U);
  EXPECT_EQ(over.overruns, over.skipped);
  EXPECT_EQ(over, run_engine(1'500'000)) << "the same on every run";
}

}  // namespace
}  // namespace indurop::scheduler
