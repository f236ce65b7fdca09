// SPDX-License-Identifier: Apache-2.0
#include "doors/pools/options.h"

#include <gtest/gtest.h>

namespace indurop::pool_door {
namespace {

TEST(PoolOptions, A_pool_may_have_a_time_or_a_rate_of_its_own) {
  std::string problem;
  EXPECT_EQ(read_sent_pool("n::eye", problem).name, "n::eye");
  EXPECT_EQ(read_sent_pool("n::eye", problem).every_ns, -1);
  EXPECT_EQ(read_sent_pool("n::eye@100ms", problem).every_ns, 100'000'000);
  EXPECT_EQ(read_sent_pool("n::eye@10Hz", problem).every_ns, 100'000'000);
  EXPECT_EQ(read_sent_pool("n::eye@100000000ns", problem).every_ns, 100'000'000) << "as agents write it";
  EXPECT_EQ(problem, "");
}

TEST(PoolOptions, A_time_that_is_none_is_refused) {
  for (const char* wrong : {"eye@", "eye@0", "eye@-1s", "eye@soon", "eye@1s@2s"}) {
    std::string problem;
    EXPECT_EQ(read_sent_pool(wrong, problem).name, "eye");
    EXPECT_NE(problem, "") << wrong;
  }
}

}  // namespace
}  // namespace indurop::pool_door
