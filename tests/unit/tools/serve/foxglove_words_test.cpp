// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/stream/foxglove_words.h"

#include <gmock/gmock.h>

#include <array>

namespace indurop::serve {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

TEST(Foxglove_words, Name_channels_and_subscriptions) {
  const auto word = read_foxglove_word(
      R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":3},{"id":4294967295,"channelId":5}]})");
  ASSERT_TRUE(word);
  EXPECT_EQ(word->op, "subscribe");
  EXPECT_THAT(word->subscribe, ElementsAre(Pair(0, 3), Pair(4294967295, 5)));
  const auto back = read_foxglove_word(R"({"op":"unsubscribe","subscriptionIds":[0,7]})");
  ASSERT_TRUE(back);
  EXPECT_THAT(back->unsubscribe, ElementsAre(0, 7));
}

TEST(Foxglove_words, That_are_none_are_refused_and_what_is_no_number_is_left_out) {
  for (const char* text : {"", "x", "[]", "{}", R"({"op":1})", R"("op")", R"({"op":"subscribe")"}) {
    EXPECT_FALSE(read_foxglove_word(text)) << text;
  }
  for (const char* text : {R"({"op":"subscribe"})", R"({"op":"subscribe","subscriptions":{"id":1,"channelId":2}})",
                           R"({"op":"subscribe","subscriptions":[1,null,{"id":-1,"channelId":2},{"id":1}]})",
                           R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":2}]})"}) {
    const auto word = read_foxglove_word(text);
    ASSERT_TRUE(word) << text;
    EXPECT_THAT(word->subscribe, IsEmpty()) << text;
  }
}

// As the protocol's description has it: a byte 1, the subscription, the time, the message; little endian.
TEST(Foxglove_words, A_message_is_laid_out_as_described) {
  const std::array<std::uint8_t, 3> cdr{7, 8, 9};
  EXPECT_THAT(foxglove::message(0x04030201, 0x0c0b0a0908070605, cdr),
              ElementsAre(1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 7, 8, 9));
}

}  // namespace
}  // namespace indurop::serve
