// SPDX-License-Identifier: Apache-2.0
// The word that was meant.
#include "tools/client/text/suggest.h"

#include <gtest/gtest.h>

#include <vector>

namespace indurop::tools {
namespace {

const std::vector<std::string> kVerbs{"status", "stop", "set", "jitter", "vars"};

TEST(Suggest, A_swap_or_a_missing_letter_is_found) {
  EXPECT_EQ(did_you_mean("statsu", kVerbs), " Did you mean 'status'?");
  EXPECT_EQ(did_you_mean("jiter", kVerbs), " Did you mean 'jitter'?");
}

TEST(Suggest, The_only_continuation_of_a_beginning_is_found) {
  EXPECT_EQ(did_you_mean("ji", kVerbs), " Did you mean 'jitter'?");
  EXPECT_EQ(did_you_mean("st", kVerbs).find("jitter"), std::string::npos);
}

TEST(Suggest, Nothing_near_gives_nothing) {
  EXPECT_EQ(did_you_mean("zzzzzz", kVerbs), "");
  EXPECT_EQ(did_you_mean("", kVerbs), "");
  EXPECT_EQ(did_you_mean("status", {}), "");
}

}  // namespace
}  // namespace indurop::tools
