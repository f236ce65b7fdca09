// SPDX-License-Identifier: Apache-2.0
#include "tools/client/process/interrupt.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace indurop::tools {
namespace {

TEST(Interrupt, Ends_long_work_that_asks_for_none) {
  for (const int number : {SIGINT, SIGTERM}) {
    EXPECT_EXIT(
        {
          catch_interrupts();
          const EndsAtOnce ends;
          std::raise(number);
          std::exit(0);
        },
        ::testing::KilledBySignal(number), "");
    EXPECT_EXIT(
        {
          catch_interrupts();
          std::raise(number);  // before the work begins
          const EndsAtOnce ends;
          std::exit(0);
        },
        ::testing::KilledBySignal(number), "");
  }
}

TEST(Interrupt, Is_only_noted_behind_such_work) {
  EXPECT_EXIT(
      {
        catch_interrupts();
        { const EndsAtOnce ends; }
        std::raise(SIGTERM);
        std::exit(interrupted() ? 7 : 0);
      },
      ::testing::ExitedWithCode(7), "");
}

}  // namespace
}  // namespace indurop::tools
