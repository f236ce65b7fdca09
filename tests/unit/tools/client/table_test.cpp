// SPDX-License-Identifier: Apache-2.0
// One set of rows as text, CSV and JSON.
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

TEST(Table, Text_is_aligned_without_spaces_at_the_end) {
  const Output plain(ColorWhen::Never);
  EXPECT_EQ(sample().text(plain),
            "NAME               TIME  NOTE\n"
            "a               12.3 us  x\n"
            "longer, \"name\"     1 ns\n");
}

TEST(Table, Colour_does_not_change_the_alignment) {
  Table sut({{"A", "a"}, {"B", "b"}});
  sut.add({Cell("x", Style::Bad), Cell("y")});
  sut.add({Cell("long"), Cell("z")});
  const Output colored(ColorWhen::Always);
  EXPECT_EQ(sut.text(colored), "\x1b[1mA     B\x1b[0m\n\x1b[1;31mx\x1b[0m     y\nlong  z\n");
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

TEST(Table, Without_rows_the_text_is_empty_but_csv_has_its_heading) {
  const Table sut(std::vector<Column>{{"A", "a"}});
  EXPECT_EQ(sut.text(Output(ColorWhen::Never)), "");
  EXPECT_EQ(sut.csv(), "a\n");
  EXPECT_EQ(sut.json().dump(), "[]");
}

TEST(Table, Broken_text_cannot_reach_the_terminal_or_break_json) {
  Table sut(std::vector<Column>{{"A", "a"}});
  sut.add({Cell("\x1b[2J\xff")});
  EXPECT_EQ(sut.text(Output(ColorWhen::Never)), "A\n?[2J?\n");
  EXPECT_NE(sut.json().dump().find("\\u001b[2J"), std::string::npos);
}

TEST(Table, Lists_of_names_are_one_csv_field) {
  EXPECT_EQ(csv_value(JsonValue{"a", "b"}), "a b");
  EXPECT_EQ(csv_value(JsonValue{1, 2}), "\"[1,2]\"");
  EXPECT_EQ(csv_value(JsonValue()), "");
}

}  // namespace
}  // namespace indurop::tools
