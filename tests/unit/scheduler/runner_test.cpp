// SPDX-License-Identifier: Apache-2.0
#include "scheduler/runner.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/rt/guard.h"
#include "fixture.h"

namespace indurop::scheduler {
namespace {

constexpr std::int64_t kRun = 10;
constexpr std::size_t kTasks = 8;

class CountedClock final : public Kernel {
 public:
  rt::MonoTime now() noexcept override {
    ++looks;
    return rt::mono_time(ns);
  }
  void sleep_until(rt::MonoTime /*deadline*/) noexcept override {}
  std::int64_t ns = 1'000'000;
  int looks = 0;
};
CountedClock* g_counted_clock = nullptr;

// What the hooks take, and say about it.
struct Notes {
  std::int64_t before_ns = 0;
  std::int64_t after_ns = 0;
  static bool take(std::int64_t ns) noexcept {
    g_counted_clock->ns += ns;
    return ns > 0;
  }
};

class RunnerClock : public testing::Test {
 protected:
  RunnerClock() {
    g_counted_clock = &clock_;
    for (std::uint32_t i = 0; i < kTasks; ++i) {
      tasks_.push_back(periodic(i, 1'000'000, 1, [] { g_counted_clock->ns += kRun; }));
    }
    block_ = make_block(tasks_, 1'000'000, 1'000'000);
    for (std::size_t i = 0; i < kTasks; ++i) {
      states_[i].task = tasks_[i];
      states_[i].record = &block_->modules()[i];
      pointers_.push_back(&states_[i]);
    }
    hooks_.context = &notes_;
    hooks_.begins = [](void* context, std::uint32_t) noexcept {
      return Notes::take(static_cast<Notes*>(context)->before_ns);
    };
    hooks_.ended = [](void* context, std::uint32_t, std::uint64_t, const RunTimes&, bool) noexcept {
      return Notes::take(static_cast<Notes*>(context)->after_ns);
    };
  }
  // How often it read the clock; every run took as long as it did.
  int looks() {
    Runner sut(*block_, clock_, hooks_, trace_, kTasks);
    clock_.looks = 0;
    sut.run(pointers_, 0, rt::mono_time(clock_.ns));
    for (std::size_t i = 0; i < kTasks; ++i) {
      EXPECT_EQ(sut.times(i).end_ns - sut.times(i).start_ns, kRun) << i;
    }
    return clock_.looks;
  }

  CountedClock clock_;
  std::vector<Task> tasks_;
  BlockPointer block_;
  std::array<TaskState, kTasks> states_;
  std::vector<TaskState*> pointers_;
  CoreTrace trace_;
  Notes notes_;
  Hooks hooks_;
};

TEST_F(RunnerClock, Looks_once_for_each_run_where_the_hooks_do_little) {
  EXPECT_EQ(looks(), 1 + static_cast<int>(kTasks));
}

TEST_F(RunnerClock, What_the_hooks_do_is_no_time_of_a_run_where_it_is_much) {
  notes_.before_ns = 500;
  EXPECT_EQ(looks(), 1 + 2 * static_cast<int>(kTasks));
  notes_.after_ns = 700;
  EXPECT_EQ(looks(), 1 + 2 * static_cast<int>(kTasks)) << "one look serves both";
  notes_.before_ns = 0;
  EXPECT_EQ(looks(), 2 * static_cast<int>(kTasks)) << "nothing follows the last one";
}

// It reads the clock after the condition anyway.
TEST_F(RunnerClock, Conditions_are_asked_after_what_the_hooks_did_for_the_run_before) {
  notes_.after_ns = 700;
  for (TaskState& state : states_) {
    state.task.condition = [] { return true; };
  }
  EXPECT_EQ(looks(), 1 + 2 * static_cast<int>(kTasks));
}

// A run is ended by a signal to its thread, which this one sends to itself.
#ifndef __SANITIZE_THREAD__
class RunnerBudget : public RunnerClock {
 protected:
  static constexpr std::int64_t kBudget = 10'000;
  RunnerBudget() {
    rt::install_guard_handlers();
    g_runner = &sut;
    sut.attach_thread();
    states_[0].task.budget_ns = kBudget;
  }
  ~RunnerBudget() override { sut.detach_thread(); }
  // The watchdog looks after this time, by so much later than planned.
  static void pass(std::int64_t after_ns, std::int64_t late_ns) {
    g_counted_clock->ns += after_ns;
    g_runner->enforce_budget(g_counted_clock->now(), false, 0, late_ns);
    g_passed += after_ns - late_ns;
  }
  // How much of its time counted in the passes that the run survived.
  std::int64_t run(void (*module)()) {
    states_[0].task.run = module;
    states_[0].gate = Gate::Open;
    block_->modules()[0].state.store(ModuleState::Running);
    g_passed = 0;
    sut.run(std::span(pointers_).first(1), 0, rt::mono_time(clock_.ns));
    return g_passed;
  }
  [[nodiscard]] bool was_ended() const { return block_->modules()[0].state.load() == ModuleState::Faulted; }

  static inline Runner* g_runner = nullptr;
  static inline std::int64_t g_passed = 0;
  Runner sut{*block_, clock_, hooks_, trace_, kTasks};
};

TEST_F(RunnerBudget, Time_in_which_the_watchdog_could_not_run_either_does_not_count) {
  const auto stalls = [] {
    pass(50'000, 45'000);
    pass(4'000, 0);
    pass(80'000, 80'000);
  };
  EXPECT_EQ(run(stalls), 9'000);
  EXPECT_FALSE(was_ended());
}

TEST_F(RunnerBudget, A_run_that_hangs_is_ended_after_a_stall_too) {
  const auto hangs = [] {
    pass(50'000, 45'000);
    for (;;) {
      pass(2'000, 0);
    }
  };
  EXPECT_EQ(run(hangs), 9'000);
  EXPECT_TRUE(was_ended());
}

TEST_F(RunnerBudget, A_stall_is_not_for_the_next_run) {
  EXPECT_EQ(run([] { pass(50'000, 45'000); }), 5'000);
  EXPECT_FALSE(was_ended());
  EXPECT_EQ(run([] { pass(kBudget + 1, 0); }), 0);
  EXPECT_TRUE(was_ended());
}

// A watchdog that is later than the run is long was late before it, too.
TEST_F(RunnerBudget, No_more_than_the_whole_run_is_excused) {
  const auto runs = [] {
    pass(1'000, 500'000);
    for (;;) {
      pass(2'000, 0);
    }
  };
  g_passed = 0;
  run(runs);
  EXPECT_TRUE(was_ended());
  EXPECT_LT(clock_.ns, 1'000'000 + 1'000 + kBudget + 4'000);
}
#endif

}  // namespace
}  // namespace indurop::scheduler
