// SPDX-License-Identifier: Apache-2.0
#include "core/base/stop_signal.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>

namespace indurop::base {
namespace {

// Ends with the signal that a program in this state is stopped by, 0 if by none.
[[noreturn]] void receive(int number) {
  StopSignal sut;
  (void)std::raise(number);
  std::exit(sut.wait(std::chrono::nanoseconds(0)));
}

class StopSignals : public ::testing::TestWithParam<int> {};

TEST_P(StopSignals, Are_kept_until_the_program_asks) {
  EXPECT_EXIT(receive(GetParam()), ::testing::ExitedWithCode(GetParam()), "");
}

INSTANTIATE_TEST_SUITE_P(Each, StopSignals, ::testing::Values(SIGINT, SIGTERM, SIGHUP));

TEST(StopSignal, Goes_on_when_the_terminal_of_nohup_ends) {
  EXPECT_EXIT(
      {
        (void)std::signal(SIGHUP, SIG_IGN);
        receive(SIGHUP);
      },
      ::testing::ExitedWithCode(0), "");
}

// A shell starts programs in the background so; they are ended by it nevertheless.
TEST(StopSignal, Stops_at_an_interrupt_that_was_ignored) {
  EXPECT_EXIT(
      {
        (void)std::signal(SIGINT, SIG_IGN);
        receive(SIGINT);
      },
      ::testing::ExitedWithCode(SIGINT), "");
}

TEST(StopSignal, Goes_on_at_the_end_of_a_child) {
  EXPECT_EXIT(receive(SIGCHLD), ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace indurop::base
