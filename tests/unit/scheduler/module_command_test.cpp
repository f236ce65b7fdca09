// SPDX-License-Identifier: Apache-2.0
// Commands about one module: who may place one, and who learns what of it.

#include "scheduler/module_command.h"

#include <gtest/gtest.h>

namespace indurop::scheduler {
namespace {

TEST(ModuleCommand, Reaches_the_node_and_its_answer_the_sender) {
  ModuleRecord sut{};
  EXPECT_EQ(waiting_command(sut), ModuleCommand::None);
  const auto ticket = place_command(sut, ModuleCommand::Restart);
  ASSERT_TRUE(ticket);
  EXPECT_EQ(waiting_command(sut), ModuleCommand::Restart);
  EXPECT_EQ(result_of(sut, *ticket), CommandResult::None);
  answer_command(sut, CommandResult::Failed);
  EXPECT_EQ(waiting_command(sut), ModuleCommand::None);
  EXPECT_EQ(result_of(sut, *ticket), CommandResult::Failed);
}

TEST(ModuleCommand, Waits_for_the_answer_to_the_one_before) {
  ModuleRecord sut{};
  const auto first = place_command(sut, ModuleCommand::Stop);
  EXPECT_FALSE(place_command(sut, ModuleCommand::Start));
  answer_command(sut, CommandResult::Done);
  const auto second = place_command(sut, ModuleCommand::Start);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(result_of(sut, *first), CommandResult::Done);
  answer_command(sut, CommandResult::Failed);
  EXPECT_EQ(result_of(sut, *first), CommandResult::Done) << "what became of the second is not its business";
  EXPECT_EQ(result_of(sut, *second), CommandResult::Failed);
}

TEST(ModuleCommand, Of_an_unknown_kind_is_none) {
  ModuleRecord sut{};
  sut.command.store(1U << 8U | 99U);
  EXPECT_EQ(waiting_command(sut), ModuleCommand::None);
}

}  // namespace
}  // namespace indurop::scheduler
