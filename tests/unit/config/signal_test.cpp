// SPDX-License-Identifier: Apache-2.0
// Signals a legacy program can be woken with, by name and number.

#include <gmock/gmock.h>

#include <csignal>

#include "config/xml/values.h"

namespace indurop::config {
namespace {

using testing::HasSubstr;
using testing::Optional;

TEST(Signal, Names_and_numbers_mean_the_same) {
  EXPECT_THAT(read_signal("SIGUSR1").value, Optional(SIGUSR1));
  EXPECT_THAT(read_signal("USR1").value, Optional(SIGUSR1));
  EXPECT_THAT(read_signal(std::to_string(SIGUSR1)).value, Optional(SIGUSR1));
  EXPECT_THAT(read_signal("SIGRTMIN+2").value, Optional(SIGRTMIN + 2));
  EXPECT_THAT(read_signal("SIGRTMIN").value, Optional(SIGRTMIN));
  EXPECT_THAT(read_signal("RTMAX-1").value, Optional(SIGRTMAX - 1));
  EXPECT_THAT(read_signal(std::to_string(SIGRTMAX)).value, Optional(SIGRTMAX));
}

TEST(Signal, Those_that_cannot_be_handled_are_rejected) {
  for (const char* text : {"KILL", "SIGKILL", "9", "STOP", "SIGSTOP", "19"}) {
    EXPECT_THAT(read_signal(text).problem, HasSubstr("cannot be handled")) << text;
  }
}

TEST(Signal, What_is_none_is_refused) {
  for (const char* text : {"", "0", "-1", "65", "32", "33", "SIG", "sigusr1", "USR3", "RTMIN+99", "RTMIN-1", "10.0",
                           "RTMAX+1", "99999999999999999999"}) {
    EXPECT_FALSE(read_signal(text).value.has_value()) << text;
    EXPECT_FALSE(read_signal(text).problem.empty()) << text;
  }
}

TEST(Signal, Printed_name_is_read_back) {
  for (int signal = 1; signal <= SIGRTMAX; ++signal) {
    if (const auto known = read_signal(std::to_string(signal)).value) {
      EXPECT_THAT(read_signal(signal_name(signal)).value, Optional(*known));
    }
  }
}

}  // namespace
}  // namespace indurop::config
