// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "tests/unit/core/schema/types.h"

namespace indurop::schema {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Merge, Adds_what_is_new_and_keeps_what_is_equal_once) {
  Schema sut;
  sut.variables = {variable("a", number(Base::Int32)), variable("b", joints_type())};
  Schema from;
  from.variables = {variable("b", joints_type()), variable("c", number(Base::Bool))};
  from.functions.push_back({"f", structure("f_args", {}), number(Base::Int32), 0, 0, "", ""});
  std::vector<std::string> differences;
  merge(sut, from, differences);
  merge(sut, from, differences);
  EXPECT_THAT(differences, IsEmpty());
  EXPECT_EQ(sut.variables.size(), 3U);
  EXPECT_EQ(sut.functions.size(), 1U);
}

TEST(Merge, Keeps_the_first_of_two_types_and_says_where_they_differ) {
  Schema sut;
  sut.variables = {variable("knu::joints", joints_type())};
  sut.variables[0].source = "new.glb:3";
  Schema from;
  Type other = joints_type();
  other.fields[1].type = number(Base::Float);
  from.variables = {variable("knu::joints", other)};
  from.variables[0].source = "old.glb:4";
  std::vector<std::string> differences;
  merge(sut, from, differences);
  EXPECT_THAT(differences, ElementsAre("knu::joints: field y: double at 8 / float at 8 (new.glb:3 / old.glb:4)"));
  ASSERT_EQ(sut.variables.size(), 1U);
  EXPECT_EQ(sut.variables[0].type.fields[1].type.base, Base::Double);
}

TEST(Merge, Another_kind_of_storage_is_a_difference_too) {
  Schema sut;
  sut.variables = {variable("a", number(Base::Int32))};
  Schema from = sut;
  from.variables[0].kind = abi::Kind::Ring;
  std::vector<std::string> differences;
  merge(sut, from, differences);
  EXPECT_THAT(differences, ElementsAre("a: an atomic / a ring of versions"));
}

TEST(Merge, Functions_differ_by_arguments_or_result) {
  Schema sut;
  sut.functions.push_back({"f", structure("f_args", {{"a", number(Base::Double)}}), number(Base::Int32), 0, 0, "", ""});
  Schema from = sut;
  from.functions[0].arguments.fields[0].type = number(Base::Float);
  std::vector<std::string> differences;
  merge(sut, from, differences);
  from = sut;
  from.functions[0].result = number(Base::Bool);
  merge(sut, from, differences);
  EXPECT_THAT(differences, ElementsAre("f: arguments: field a: double at 0 / float at 0", "f: result: int32_t / bool"));
}

TEST(First_difference, Names_the_innermost_place) {
  EXPECT_EQ(first_difference(joints_type(), joints_type()), "");
  EXPECT_EQ(first_difference(number(Base::Int32), number(Base::Double)), "int32_t / double");
  EXPECT_EQ(first_difference(number(Base::Int32, {3}), number(Base::Int32, {4})), "[3] / [4]");
  EXPECT_EQ(first_difference(number(Base::Int32, {3}), number(Base::Int32)), "[3] / no array");
  EXPECT_EQ(first_difference(text(8), text(16)), "char[8] / char[16]");

  const Type inner = structure("p", {{"u", number(Base::Double)}, {"v", number(Base::Double)}});
  Type inner_less = structure("p", {{"u", number(Base::Double)}});
  EXPECT_EQ(first_difference(structure("s", {{"p", inner}}), structure("s", {{"p", inner_less}})),
            "field p.v: double at 8 / absent");
  EXPECT_EQ(first_difference(structure("s", {{"p", inner_less}}), structure("s", {{"p", inner}})),
            "field p.v: absent / double at 8");
  EXPECT_EQ(first_difference(structure("s", {{"p", number(Base::Int32, {2})}}),
                             structure("s", {{"p", number(Base::Int32, {3})}})),
            "field p: int32_t[2] at 0 / int32_t[3] at 0");

  Type moved = joints_type();
  moved.fields[2].offset = 24;
  EXPECT_EQ(first_difference(joints_type(), moved), "field z: double at 16 / double at 24");
  Type padded = joints_type();
  padded.element_size = 32;
  EXPECT_EQ(first_difference(joints_type(), padded), "24 bytes aligned to 8 / 32 bytes aligned to 8");

  Type mode = mode_type();
  mode.enumerators[2].name = "Automatic";
  EXPECT_EQ(first_difference(mode_type(), mode), "enumerator 3: Auto = 2 / Automatic = 2");
  EXPECT_EQ(first_difference(structure("s", {{"m", mode_type()}}), structure("s", {{"m", mode}})),
            "field m: enumerator 3: Auto = 2 / Automatic = 2");
}

}  // namespace
}  // namespace indurop::schema
