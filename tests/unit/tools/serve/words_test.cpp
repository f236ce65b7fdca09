// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/stream/words.h"

#include <gtest/gtest.h>

namespace indurop::serve {
namespace {

TEST(Words, Subscribe) {
  const auto word =
      read_word(R"({"type":"subscribe","id":7,"board":"local","names":["a","b*"],"rate_hz":25,"binary":true})");
  ASSERT_TRUE(word);
  EXPECT_EQ(word->id, 7U);
  EXPECT_EQ(word->board, "local");
  EXPECT_EQ(word->names.size(), 2U);
  EXPECT_EQ(word->rate_hz, 25);
  EXPECT_TRUE(word->binary);
}

TEST(Words, Have_defaults) {
  const auto word = read_word(R"({"type":"subscribe","id":0,"names":["a"]})");
  ASSERT_TRUE(word);
  EXPECT_EQ(word->board, "");
  EXPECT_EQ(word->rate_hz, kUsualRateHz);
  EXPECT_FALSE(word->binary);
}

TEST(Words, That_are_no_json_object_are_garbage) {
  for (const char* text : {"", "x", "[1]", "1", "\"a\"", "{", "{\"a\":}", "null"}) {
    const auto word = read_word(text);
    ASSERT_FALSE(word) << text;
    EXPECT_TRUE(word.error().garbage) << text;
  }
}

TEST(Words, That_make_no_sense_are_answered) {
  for (const char* text :
       {R"({"type":"subscribe","id":1})", R"({"type":"subscribe","id":1,"names":[]})",
        R"({"type":"subscribe","id":1,"names":"a"})", R"({"type":"subscribe","id":1,"names":[1]})",
        R"({"type":"subscribe","id":1,"names":["a"],"rate_hz":0})",
        R"({"type":"subscribe","id":1,"names":["a"],"rate_hz":101})",
        R"({"type":"subscribe","id":1,"names":["a"],"rate_hz":"fast"})",
        R"({"type":"subscribe","id":1,"names":["a"],"rate_hz":null})",
        R"({"type":"subscribe","id":1,"names":["a"],"binary":1})",
        R"({"type":"subscribe","id":1,"names":["a"],"board":1})", R"({"type":"set","id":1})", R"({"id":1})"}) {
    const auto word = read_word(text);
    ASSERT_FALSE(word) << text;
    EXPECT_FALSE(word.error().garbage) << text;
    EXPECT_EQ(word.error().id, 1U) << text;
  }
  for (const char* text : {R"({"type":"subscribe"})", R"({"type":"subscribe","id":-1,"names":["a"]})",
                           R"({"type":"unsubscribe","id":4294967296})", R"({"type":"unsubscribe","id":1.5})"}) {
    ASSERT_FALSE(read_word(text)) << text;
    EXPECT_EQ(read_word(text).error().id, std::nullopt) << text;
  }
}

}  // namespace
}  // namespace indurop::serve
