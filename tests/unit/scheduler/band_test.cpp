// SPDX-License-Identifier: Apache-2.0
#include "scheduler/band.h"

#include <gtest/gtest.h>

#include "fixture.h"

namespace indurop::scheduler {
namespace {

int g_runs = 0;

// Three bands without threads; the test says who runs when.
class BandGate : public testing::Test {
 protected:
  BandGate() { g_runs = 0; }
  Band make(std::size_t number) {
    TaskState& state = states_[number];
    state.task = tasks_[number];
    state.record = &block_->modules()[number];
    BandPlan plan;
    plan.period_ns = 1000;
    return Band{plan, {&state}, {}, *block_, clock_, Hooks{}, trace_, 1000};
  }

  std::vector<Task> tasks_{periodic(0, 1000, 1, [] {}), periodic(1, 1000, 1, [] {}),
                           periodic(2, 1000, 2, [] { ++g_runs; })};
  std::array<TaskState, 3> states_;
  BlockPointer block_ = make_block(tasks_, 1000, 1000);
  VirtualClock clock_;
  CoreTrace trace_;
};

// The two first ones may run at the same time, so the nearest one does not speak for the other.
TEST_F(BandGate, Opens_when_every_predecessor_is_done) {
  Band first = make(0);
  Band second = make(1);
  Band sut = make(2);
  sut.set_predecessors({&first, &second});
  for (Band* band : {&first, &second, &sut}) {
    band->release_due(0, rt::MonoTime{});
  }
  second.drain();
  sut.drain();
  EXPECT_EQ(g_runs, 0);
  first.drain();
  sut.drain();
  EXPECT_EQ(g_runs, 1);
}

}  // namespace
}  // namespace indurop::scheduler
