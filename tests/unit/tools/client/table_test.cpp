// SPDX-License-Identifier: Apache-2.0
// One set of rows as CSV and JSON.
#include "tools/client/text/table.h"

#include <gtest/gtest.h>

namespace indurop::tools {
namespace {

Table sample() {
  Table sut({{"NAME", "name"}, {"TIME", "time_ns", Align::Right}, {"", "hidden"}, {"NOTE", ""}});
  sut.add({Cell("a"), {"12.3 us", 12345}, {"", true}, {"x", nullptr}});
  sut.add({Cell("longer, \"name\""), {"1 ns", 1}, {"", false}, {"", nullptr}});
  return sut;
}

TEST(Table, Csv_holds_raw_values_and_quotes_what_must_be_quoted) {
  EXPECT_EQ(sample().csv(),
            "name,time_ns,hidden\n"
            "a,12345,true\n"
            "\"longer, \"\"name\"\"\",1,false\n");
}

TEST(Table, Json_holds_raw_values_under_their_keys) {
  EXPECT_EQ(sample().json().dump(),
            R"([{"name":"a","time_ns":12345,"hidden":true},{"name":"longer, \"name\"","time_ns":1,"hidden":false}])");
}

TEST(Table, Without_rows_csv_has_its_heading) {
  const Table sut(std::vector<Column>{{"A", "a"}});
  EXPECT_EQ(sut.csv(), "a\n");
  EXPECT_EQ(sut.json().dump(), "[]");
}

TEST(Table, Broken_text_cannot_break_json) {
  Table sut(std::vector<Column>{{"A", "a"}});
  sut.add({Cell("\x1b[2J\xff")});
  EXPECT_NE(sut.json().dump().find("\\u001b[2J"), std::string::npos);
}

TEST(Table, Lists_of_names_are_one_csv_field) {
  EXPECT_EQ(csv_value(JsonValue{"a", "b"}), "a b");
  EXPECT_EQ(csv_value(JsonValue{1, 2}), "\"[1,2]\"");
  EXPECT_EQ(csv_value(JsonValue()), "");
}

}  // namespace
}  // namespace indurop::tools
