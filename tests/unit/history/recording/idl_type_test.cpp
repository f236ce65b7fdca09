// SPDX-License-Identifier: Apache-2.0
#include "history/recording/idl_type.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "history/recording/cdr.h"
#include "history/recording/omg_idl.h"
#include "tests/unit/history/recording/random_value.h"

namespace indurop::recording {
namespace {

using schema::Type;

TEST(IdlType, Is_the_type_that_was_written) {
  RandomValue random(11);
  for (int i = 0; i < 3000; ++i) {
    const Type type = random.type();
    const OmgIdl idl = omg_idl(type);
    const auto back = idl_type(idl.text, idl.name);
    ASSERT_TRUE(back) << idl.text;
    ASSERT_EQ(schema::canonical(*back), schema::canonical(type)) << idl.text;
    ASSERT_EQ(schema::display_name(*back), schema::display_name(type)) << idl.text;
  }
}

TEST(IdlType, What_is_not_understood_is_an_error) {
  for (const char* text :
       {"", "struct", "module a {", "struct a { double x", "struct a { double x[; };", "union a {};",
        "struct a { b c; };", "struct a { a b; };", "struct a { double x[100000000]; };", "struct a { };",
        "struct a { double x[0]; };", "struct a { string x; };", "struct a { string<99999999999> x; };",
        "struct a { double x[4000000000][4000000000][4000000000]; };", "enum b { }; struct a { b c; };",
        "enum b { @value(5000000000) ONE }; struct a { b c; };",
        "enum b { @value(2147483647) ONE, TWO }; struct a { b c; };", "struct a { sequence<double> x; };"}) {
    EXPECT_FALSE(idl_type(text, "a").ok()) << text;
  }
}

TEST(IdlType, What_has_no_end_is_given_up) {
  std::string tree = "struct t30 { octet x; };";
  for (int i = 30; i > 0; --i) {
    tree += " struct t" + std::to_string(i - 1) + " { t" + std::to_string(i) + " x; t" + std::to_string(i) + " y; };";
  }
  EXPECT_FALSE(idl_type(tree, "t0").ok());
}

}  // namespace
}  // namespace indurop::recording
