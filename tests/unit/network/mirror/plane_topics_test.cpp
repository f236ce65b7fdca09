// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/plane_topics.h"

#include <gmock/gmock.h>

namespace indurop::mirror {
namespace {

TEST(Topics, Boards_and_streams_have_their_own) {
  EXPECT_EQ(frames_topic("cell", "a", Stream::Prompt), "indurop/6/cell/a/prompt");
  EXPECT_EQ(frames_topic("cell", "a", Stream::Bulk), "indurop/6/cell/a/bulk");
  EXPECT_EQ(frames_topic("c_1", "a-b", Stream::Prompt), "indurop/6/c__1/a_mb/prompt");
  EXPECT_EQ(catalogue_topic("cell"), "indurop/6/cell/catalogue");
}

}  // namespace
}  // namespace indurop::mirror
