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

// A module that keeps nothing continues with the recorded values after a run that was disturbed.
TEST(ReplayedModule, Takes_all_values_from_the_recording_once_and_after_a_disturbed_run) {
  StateDescriptor nothing;
  const ModuleMemory memory(nothing);
  ReplayedModule sut;
  describe(sut);
  sut.keeps_own = true;
  sut.kept.expect(memory, false);
  EXPECT_TRUE(sut.known[1].foreign);
  sut.outputs.push_back({1, tape::EntryKind::After, {}, {4}});
  sut.take_outputs();
  sut.note_disturbance();
  EXPECT_FALSE(sut.known[1].foreign);
  sut.outputs.push_back({0, tape::EntryKind::During, {}, {1}});
  sut.take_outputs();
  sut.note_disturbance();
  EXPECT_TRUE(sut.known[1].foreign);
  EXPECT_FALSE(sut.doubtful);
}

// What it keeps inside may differ then, and only a keyframe puts that right.
TEST(ReplayedModule, Is_doubtful_after_a_disturbed_run_until_the_next_keyframe) {
  std::int64_t counted = 0;
  const StateItem item{"counted", 7, 4, "long", &counted, sizeof counted};
  StateDescriptor declared;
  declared.items = &item;
  declared.item_count = 1;
  const ModuleMemory memory(declared);
  ReplayedModule sut;
  describe(sut);
  sut.keeps_own = true;
  sut.kept.expect(memory, true);
  const std::vector<std::uint8_t> bytes(sizeof counted, 0);
  const auto keyframe = [&](std::uint64_t run) { sut.kept.take({run, run, bytes}, memory.form()); };
  keyframe(0);
  EXPECT_EQ(sut.kept.next(0, false, true), ReplayedMemory::Next::Run) << "the first run of all";
  keyframe(1);
  EXPECT_EQ(sut.kept.next(1, false, true), ReplayedMemory::Next::Run) << "it keeps what it kept";
  sut.outputs.push_back({0, tape::EntryKind::During, {}, {1}});
  sut.take_outputs();
  sut.note_disturbance();
  EXPECT_TRUE(sut.doubtful);
  EXPECT_EQ(sut.kept.next(2, false, true), ReplayedMemory::Next::Run);
  keyframe(3);
  EXPECT_EQ(sut.kept.next(3, false, true), ReplayedMemory::Next::Restore);
  sut.begin_with_recorded();
  EXPECT_FALSE(sut.doubtful);
  keyframe(4);
  EXPECT_EQ(sut.kept.next(4, false, true), ReplayedMemory::Next::Run);
}

}  // namespace
}  // namespace indurop::node
