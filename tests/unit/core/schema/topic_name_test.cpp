// SPDX-License-Identifier: Apache-2.0
#include "core/schema/topic_name.h"

#include <gtest/gtest.h>

namespace indurop::schema {
namespace {

TEST(TopicName, Tells_plant_and_board_again) {
  for (const char* board : {"sensor", "left-arm", "left_arm", "a_m", "_-_"}) {
    const auto speaker = sender_of_topic(board_topics("cell-1", board) + "prompt");
    ASSERT_TRUE(speaker) << board;
    EXPECT_EQ(speaker->protocol, protocol());
    EXPECT_EQ(speaker->plant, "cell-1");
    EXPECT_EQ(speaker->board, board);
  }
}

TEST(TopicName, Of_another_protocol_is_read_as_well) {
  const auto speaker = sender_of_topic("indurop/17/cell/control/bulk");
  ASSERT_TRUE(speaker);
  EXPECT_EQ(speaker->protocol, 17U);
  EXPECT_EQ(speaker->board, "control");
  EXPECT_EQ(sender_of_topic("indurop/1/cell/catalogue")->board, "");
  EXPECT_EQ(sender_of_topic("indurop/1/deploy/board")->plant, "deploy");
}

TEST(TopicName, Of_others_is_nobodys) {
  for (const char* topic : {"", "rt/chatter", "indurop", "indurop/2", "indurop/2/cell", "indurop/x/cell/catalogue",
                            "indurop//cell/catalogue", "indurop/2/a/b/c/d", "other/2/cell/catalogue"}) {
    EXPECT_FALSE(sender_of_topic(topic)) << topic;
  }
}

}  // namespace
}  // namespace indurop::schema
