// SPDX-License-Identifier: Apache-2.0
// Orders about one module: who may place one, and who learns what of it.

#include "scheduler/module_order.h"

#include <gtest/gtest.h>

namespace indurop::scheduler {
namespace {

TEST(ModuleOrder, IsSeenByTheNodeAndItsAnswerByWhoeverPlacedIt) {
  ModuleRecord sut{};
  EXPECT_EQ(waiting_order(sut), ModuleOrder::None);
  const auto ticket = place_order(sut, ModuleOrder::Restart);
  ASSERT_TRUE(ticket);
  EXPECT_EQ(waiting_order(sut), ModuleOrder::Restart);
  EXPECT_EQ(result_of(sut, *ticket), OrderResult::None);
  answer_order(sut, OrderResult::Failed);
  EXPECT_EQ(waiting_order(sut), ModuleOrder::None);
  EXPECT_EQ(result_of(sut, *ticket), OrderResult::Failed);
}

TEST(ModuleOrder, WaitsForTheAnswerToTheOneBefore) {
  ModuleRecord sut{};
  const auto first = place_order(sut, ModuleOrder::Stop);
  EXPECT_FALSE(place_order(sut, ModuleOrder::Start));
  answer_order(sut, OrderResult::Done);
  const auto second = place_order(sut, ModuleOrder::Start);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(result_of(sut, *first), OrderResult::Done);
  answer_order(sut, OrderResult::Failed);
  EXPECT_EQ(result_of(sut, *first), OrderResult::Done) << "what became of the second is not its business";
  EXPECT_EQ(result_of(sut, *second), OrderResult::Failed);
}

TEST(ModuleOrder, OfAnUnknownKindIsNone) {
  ModuleRecord sut{};
  sut.order.store(1U << 8U | 99U);
  EXPECT_EQ(waiting_order(sut), ModuleOrder::None);
}

}  // namespace
}  // namespace indurop::scheduler
