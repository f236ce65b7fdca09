// SPDX-License-Identifier: Apache-2.0
#include "history/recording/idl_layout.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>

#include "history/recording/cdr.h"
#include "history/recording/omg_idl.h"

namespace indurop::recording {
namespace {

using schema::Base;
using schema::Type;
using testing::ElementsAre;
using testing::NanSensitiveDoubleEq;

Type scalar(Base base) {
  Type type;
  type.base = base;
  type.element_size = schema::size_of(base);
  type.align = type.element_size;
  return type;
}

std::vector<std::string> names(const Type& type) {
  const OmgIdl idl = omg_idl(type);
  const auto layout = idl_layout(idl.text, idl.name);
  EXPECT_TRUE(layout) << idl.text;
  std::vector<std::string> out;
  for (const IdlLeaf& leaf : *layout) {
    out.push_back(leaf.name);
  }
  return out;
}

// A bool, a text and an enum before numbers of all sizes: what shifts places in CDR.
Type mixed() {
  Type text;
  text.base = Base::Text;
  text.text_size = text.element_size = 6;
  Type mode = scalar(Base::Enum);
  mode.name = "knu::mode_t";
  mode.enumerators = {{"OFF", 0}, {"AUTO", 5}};
  Type type;
  type.base = Base::Struct;
  type.name = "knu::mixed_t";
  type.element_size = 40;
  type.align = 8;
  type.fields.push_back({"on", scalar(Base::Bool), 0, "", "", {}, {}});
  type.fields.push_back({"name", text, 1, "", "", {}, {}});
  type.fields.push_back({"mode", mode, 8, "", "", {}, {}});
  type.fields.push_back({"x", scalar(Base::Double), 16, "", "", {}, {}});
  type.fields.push_back({"n", scalar(Base::Int16), 24, "", "", {}, {}});
  type.fields.push_back({"f", scalar(Base::Float), 28, "", "", {}, {}});
  type.fields.push_back({"big", scalar(Base::UInt64), 32, "", "", {}, {}});
  return type;
}

TEST(IdlLayout, Names_numbers_as_we_do) {
  Type array = scalar(Base::Double);
  array.dims = {2, 2};
  EXPECT_THAT(names(scalar(Base::UInt32)), ElementsAre(""));
  EXPECT_THAT(names(array), ElementsAre("[0][0]", "[0][1]", "[1][0]", "[1][1]"));
  EXPECT_THAT(names(mixed()), ElementsAre(".on", ".name", ".mode", ".x", ".n", ".f", ".big"));
  Type many = mixed();
  many.dims = {2};
  EXPECT_EQ(names(many).back(), "[1].big");
}

TEST(IdlLayout, Reads_what_we_write) {
  const Type type = mixed();
  std::vector<std::uint8_t> value(type.size());
  const auto put = [&value](std::size_t at, auto number) { std::memcpy(value.data() + at, &number, sizeof number); };
  put(0, true);
  std::memcpy(value.data() + 1, "belt", 5);
  put(8, std::int32_t{5});
  put(16, 2.5);
  put(24, std::int16_t{-7});
  put(28, 0.5F);
  put(32, std::uint64_t{1} << 40U);
  std::vector<std::uint8_t> cdr;
  ASSERT_TRUE(to_cdr(type, value, cdr).ok());
  const OmgIdl idl = omg_idl(type);
  const auto layout = idl_layout(idl.text, idl.name);
  std::vector<double> numbers;
  ASSERT_TRUE(read_leaves(*layout, cdr, numbers));
  EXPECT_THAT(numbers, ElementsAre(1, NanSensitiveDoubleEq(std::nan("")), 5, 2.5, -7, 0.5, 1099511627776.0));
  for (std::size_t length = 0; length < cdr.size(); ++length) {
    EXPECT_FALSE(read_leaves(*layout, {cdr.data(), length}, numbers)) << length;
  }
}

TEST(IdlLayout, What_is_not_understood_is_an_error) {
  for (const char* text : {"", "struct", "module a {", "struct a { double x", "struct a { double x[; };", "union a {};",
                           "struct a { b c; };", "struct a { a b; };", "struct a { double x[100000]; };", "} }"}) {
    EXPECT_FALSE(idl_layout(text, "a").ok()) << text;
  }
}

TEST(IdlLayout, What_has_no_end_is_given_up) {
  EXPECT_FALSE(idl_layout("struct a { }; struct b { a x[4000000000]; };", "b").ok());
  std::string tree = "struct t30 { };";
  for (int i = 30; i > 0; --i) {
    tree += " struct t" + std::to_string(i - 1) + " { t" + std::to_string(i) + " x; t" + std::to_string(i) + " y; };";
  }
  EXPECT_FALSE(idl_layout(tree, "t0").ok());
}

}  // namespace
}  // namespace indurop::recording
