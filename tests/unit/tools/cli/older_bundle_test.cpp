// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/older_bundle.h"

#include <gtest/gtest.h>

namespace indurop::tools {
namespace {

PastDeployment past(const std::string& deployment, std::uint64_t generation, const std::string& plant = "cell",
                    const std::string& outcome = "committed") {
  return {deployment, plant, generation, "desk", 0, outcome, ""};
}

TEST(OlderBundle, Is_one_that_was_committed_first_before_what_runs) {
  const std::vector<PastDeployment> history{past("one", 1), past("two", 2), past("two", 3)};
  const auto older = older_bundle(history, "two", "one");
  ASSERT_TRUE(older);
  EXPECT_EQ(older->bundle.generation, 1U);
  EXPECT_EQ(older->current.generation, 2U);
  EXPECT_FALSE(older_bundle(history, "two", "two")) << "it runs";
  EXPECT_FALSE(older_bundle(history, "two", "three")) << "it is new to the board";
  EXPECT_FALSE(older_bundle({}, "", "one")) << "the board runs nothing";
}

TEST(OlderBundle, Is_none_that_a_rollback_has_replaced) {
  const std::vector<PastDeployment> history{past("one", 1), past("two", 2), past("one", 3)};
  EXPECT_FALSE(older_bundle(history, "one", "two"));
}

TEST(OlderBundle, Is_none_that_failed_before_or_that_another_plant_has_replaced) {
  EXPECT_FALSE(older_bundle({past("one", 1, "cell", "rolled back: x"), past("two", 2)}, "two", "one"));
  EXPECT_FALSE(older_bundle({past("one", 1, "cell"), past("two", 2, "press")}, "two", "one"));
}

}  // namespace
}  // namespace indurop::tools
