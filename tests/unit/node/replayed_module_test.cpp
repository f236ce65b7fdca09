// SPDX-License-Identifier: Apache-2.0
#include "node/replay/replayed_module.h"

#include <gtest/gtest.h>

namespace indurop::node {
namespace {

// Reads variable 0 and writes variable 1.
void describe(ReplayedModule& module) {
  module.known.resize(2);
  module.known[0].read = true;
  module.known[1].written = true;
}

TEST(ReplayedModule, Knows_its_inputs_when_each_variable_that_it_reads_has_a_value) {
  ReplayedModule sut;
  describe(sut);
  EXPECT_FALSE(sut.knows_inputs());
  sut.known[0].has_value = true;
  EXPECT_TRUE(sut.knows_inputs());
}

TEST(ReplayedModule, Begins_its_next_run_with_the_recorded_outputs_of_the_last_one) {
  ReplayedModule sut;
  describe(sut);
  sut.seen = 7;
  sut.clock = {1};
  sut.codes = {0};
  sut.answers = {{1, 2}};
  sut.outputs.push_back({1, tape::EntryKind::After, {3}, {4}});
  sut.take_outputs();
  EXPECT_TRUE(sut.known[1].has_value);
  EXPECT_EQ(sut.known[1].recorded_run, 7U);
  EXPECT_EQ(sut.known[1].cdr, std::vector<std::uint8_t>{3});
  EXPECT_EQ(sut.known[1].bytes, std::vector<std::uint8_t>{4});
  EXPECT_FALSE(sut.disturbed);
  EXPECT_TRUE(sut.outputs.empty() && sut.clock.empty() && sut.replayed_answers().empty());
}

TEST(ReplayedModule, Is_disturbed_by_an_input_that_changed_during_the_run_and_only_in_that_run) {
  ReplayedModule sut;
  describe(sut);
  sut.outputs.push_back({0, tape::EntryKind::During, {}, {1}});
  sut.take_outputs();
  EXPECT_TRUE(sut.disturbed);
  sut.take_outputs();
  EXPECT_FALSE(sut.disturbed);
}

TEST(ReplayedModule, Forgets_values_that_may_have_changed_in_missing_runs) {
  ReplayedModule sut;
  describe(sut);
  sut.seen = 3;
  sut.known[0].has_value = sut.known[1].has_value = true;
  sut.known[0].recorded_run = 2;
  sut.known[1].recorded_run = 3;
  sut.forget_older_values();
  EXPECT_FALSE(sut.known[0].has_value);
  EXPECT_TRUE(sut.known[1].has_value);
}

}  // namespace
}  // namespace indurop::node
