// SPDX-License-Identifier: Apache-2.0
#include "scheduler/runner.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

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

}  // namespace
}  // namespace indurop::scheduler
