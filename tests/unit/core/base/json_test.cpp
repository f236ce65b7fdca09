// SPDX-License-Identifier: Apache-2.0
// JSON written and read: order, numbers, broken text, nesting.
#include "core/base/json.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace indurop::base {
namespace {

TEST(Json, Members_stay_in_the_order_they_were_made_in) {
  Json sut{{"z", 1}, {"a", "x"}, {"m", nullptr}};
  sut["b"] = true;
  sut["z"] = -2;
  EXPECT_EQ(sut.dump(), R"({"z":-2,"a":"x","m":null,"b":true})");
}

TEST(Json, Braces_are_an_object_only_if_all_of_them_are_pairs_with_a_name) {
  EXPECT_EQ((Json{{"a", 1}}).dump(), R"({"a":1})");
  EXPECT_EQ((Json{"a", 1}).dump(), R"(["a",1])");
  EXPECT_EQ((Json{{1, "a"}}).dump(), R"([[1,"a"]])");
  EXPECT_EQ((Json{{"a", {{"b", 1.5}}}}).dump(), R"({"a":{"b":1.5}})");
}

TEST(Json, Tables_have_a_line_for_each_row) {
  const Json row{{"slot", 0}, {"modules", {"a", "b"}}};
  const Json sut{{"name", "x"}, {"slots", {row, row}}, {"none", Json::array()}};
  EXPECT_EQ(sut.dump_rows(), R"({
  "name": "x",
  "slots": [
    {"slot":0,"modules":["a","b"]},
    {"slot":0,"modules":["a","b"]}
  ],
  "none": []
})");
  EXPECT_EQ(Json(7).dump_rows(), "7");
}

TEST(Json, Lines_are_indented) {
  const Json sut{{"a", {1, 2}}, {"b", Json::object()}, {"c", Json::array()}};
  EXPECT_EQ(sut.dump(2), "{\n  \"a\": [\n    1,\n    2\n  ],\n  \"b\": {},\n  \"c\": []\n}");
}

TEST(Json, Whole_doubles_stay_doubles_and_what_is_no_number_is_null) {
  EXPECT_EQ(Json(1.0).dump(), "1.0");
  EXPECT_EQ(Json(0.1).dump(), "0.1");
  EXPECT_EQ(Json(std::numeric_limits<double>::infinity()).dump(), "null");
}

TEST(Json, Integers_keep_all_their_digits) {
  EXPECT_EQ(Json(INT64_MIN).dump(), "-9223372036854775808");
  EXPECT_EQ(Json(UINT64_MAX).dump(), "18446744073709551615");
  EXPECT_EQ(Json::parse("18446744073709551615")->natural(), UINT64_MAX);
  EXPECT_EQ(Json::parse("18446744073709551615")->integer(), std::nullopt);
  EXPECT_EQ(Json::parse("-1")->natural(), std::nullopt);
  EXPECT_EQ(Json::parse("-1")->integer(), -1);
}

TEST(Json, Broken_text_is_replaced) {
  EXPECT_EQ(Json("\xff\"\x1b").dump(), "\"\xEF\xBF\xBD\\\"\\u001b\"");
}

TEST(Json, Reading_what_is_not_there_gives_nothing) {
  const auto sut = Json::parse(R"({"a": [1, "x"], "b": 1.5})");
  ASSERT_TRUE(sut);
  EXPECT_EQ(sut->find("c"), nullptr);
  EXPECT_EQ(sut->find("a")->find("a"), nullptr);
  EXPECT_EQ(sut->find("a")->values()[1].text(), "x");
  EXPECT_EQ(sut->find("a")->text(), std::nullopt);
  EXPECT_EQ(sut->find("b")->number(), 1.5);
  EXPECT_EQ(sut->find("b")->integer(), std::nullopt);
  EXPECT_EQ(sut->text(), std::nullopt);
}

TEST(Json, A_member_that_may_be_missing_must_have_its_type) {
  const Json sut{{"yes", true}, {"text", "true"}};
  bool value = false;
  EXPECT_TRUE(read_if_given(sut, "none", value));
  EXPECT_FALSE(read_if_given(sut, "text", value));
  EXPECT_FALSE(value) << "unchanged";
  EXPECT_TRUE(read_if_given(sut, "yes", value));
  EXPECT_TRUE(value);
}

TEST(Json, What_is_no_json_is_refused) {
  for (const char* text : {"", "{", "[1,]", "{\"a\"}", "1 2", "nul", "\"\xff\""}) {
    EXPECT_FALSE(Json::parse(text)) << text;
  }
}

TEST(Json, Deep_nesting_is_refused_before_it_costs_the_stack) {
  EXPECT_TRUE(Json::parse(std::string(60, '[') + std::string(60, ']')));
  EXPECT_FALSE(Json::parse(std::string(100'000, '[')));
  EXPECT_FALSE(Json::parse(std::string(100, '[') + std::string(100, ']')));
}

Json any_value(std::mt19937& random, int depth) {
  switch (random() % (depth > 3 ? 6 : 8)) {
    case 0:
      return nullptr;
    case 1:
      return random() % 2 == 0;
    case 2:
      return static_cast<std::int64_t>(random()) - INT32_MAX;
    case 3:
      return static_cast<std::uint64_t>(random()) << 32U;
    case 4:
      return static_cast<double>(random()) / 7;
    case 5:
      return std::string(random() % 5, static_cast<char>('a' + random() % 26));
    case 6: {
      Json list = Json::array();
      for (auto n = random() % 4; n > 0; --n) {
        list.push_back(any_value(random, depth + 1));
      }
      return list;
    }
    default: {
      Json object = Json::object();
      for (auto n = random() % 4; n > 0; --n) {
        object["k" + std::to_string(n)] = any_value(random, depth + 1);
      }
      return object;
    }
  }
}

TEST(Json, What_is_written_reads_the_same) {
  std::mt19937 random(7);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same values every time
  for (int i = 0; i < 300; ++i) {
    const Json value = any_value(random, 0);
    for (const std::string& text : {value.dump(), value.dump(2), value.dump_rows()}) {
      const auto read = Json::parse(text);
      ASSERT_TRUE(read) << value.dump();
      EXPECT_EQ(read->dump(), value.dump());
    }
  }
}

}  // namespace
}  // namespace indurop::base
