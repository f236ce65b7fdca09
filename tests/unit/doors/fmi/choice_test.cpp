// SPDX-License-Identifier: Apache-2.0
#include "doors/fmi/description/choice.h"

#include <gmock/gmock.h>

#include "doors/fmi/description/units.h"

namespace indurop::fmi {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

schema::Variable variable(const std::string& name, std::vector<std::uint32_t> dims) {
  schema::Variable one;
  one.name = name;
  one.type.base = schema::Base::Double;
  one.type.element_size = 8;
  one.type.dims = std::move(dims);
  return one;
}

std::vector<std::string> names_of(const Choice& choice) {
  std::vector<std::string> names;
  for (const ChosenVariable& one : choice.variables) {
    names.push_back(one.part.name + (one.input ? "<" : ">"));
  }
  return names;
}

class ChoiceTest : public ::testing::Test {
 protected:
  const schema::Variable set_ = variable("a::set", {2});
  const schema::Variable made_ = variable("a::made", {});
  const schema::Variable idle_ = variable("b::idle", {});
  const std::vector<SharedVariable> all_{
      {&set_, {""}, {}, true}, {&made_, {""}, {"maker"}, true}, {&idle_, {""}, {}, false}};
};

TEST_F(ChoiceTest, Inputs_are_what_modules_read_and_none_writes) {
  EXPECT_THAT(names_of(*choose(all_, {}, {})), ElementsAre("a::set[0]<", "a::set[1]<", "a::made>", "b::idle>"));
}

TEST_F(ChoiceTest, Patterns_choose) {
  EXPECT_THAT(names_of(*choose(all_, {"a::set[1]"}, {})), ElementsAre("a::set[1]<", "a::made>", "b::idle>"));
  EXPECT_THAT(names_of(*choose(all_, {}, {"a::*"})), ElementsAre("a::set[0]<", "a::set[1]<", "a::made>"));
  EXPECT_THAT(names_of(*choose(all_, {"idle"}, {"a::set[0]"})), ElementsAre("a::set[0]>", "b::idle<"));
  const auto written = choose(all_, {"made"}, {"set"});
  ASSERT_TRUE(written);
  EXPECT_THAT(written->warnings, ElementsAre(HasSubstr("a::made is an input although maker writes it")));
  EXPECT_THAT(choose(all_, {"a::st"}, {}).error().text, HasSubstr("--inputs 'a::st'"));
  EXPECT_FALSE(choose({}, {}, {}));
  schema::Variable point = variable("c::point", {});
  point.type.base = schema::Base::Struct;
  point.type.fields.push_back({"far", made_.type, 0, "", "", {}, {}});
  point.type.fields.push_back({"near", made_.type, 8, "", "", {}, {}});
  EXPECT_THAT(names_of(*choose({{&point, {""}, {}, true}}, {"c::point.f*"}, {"point.near"})),
              ElementsAre("c::point.far<", "c::point.near>"));
}

TEST_F(ChoiceTest, Parts_are_found_where_they_are) {
  schema::Type inner;
  inner.base = schema::Base::Struct;
  inner.element_size = 16;
  inner.dims = {3};
  inner.fields.push_back({"x", made_.type, 0, "m", "", {}, {}});
  inner.fields.push_back({"y", made_.type, 8, "", "", {}, {}});
  schema::Variable grid = variable("g", {});
  grid.type = inner;
  grid.unit = "rad";
  std::vector<std::string> found;
  for_each_part(grid, [&found](const ShownPart& part) {
    found.push_back(part.name + "@" + std::to_string(part.offset) + part.unit);
  });
  EXPECT_THAT(found,
              ElementsAre("g[0].x@0m", "g[0].y@8rad", "g[1].x@16m", "g[1].y@24rad", "g[2].x@32m", "g[2].y@40rad"));
  EXPECT_EQ(count_parts(grid.type), 6U);
  const schema::Variable huge = variable("h", {1000, 1000});
  EXPECT_THAT(choose({{&huge, {""}, {}, true}}, {}, {}).error().text, HasSubstr("h has 1000000 parts"));
}

TEST(Units, Known_ones_are_in_terms_of_the_SI) {
  EXPECT_EQ(unit_in_si("km")->factor, 1000);
  EXPECT_EQ(unit_in_si("degC")->offset, 273.15);
  EXPECT_EQ(unit_in_si("Nm")->exponents, (std::array<std::int8_t, 8>{1, 2, -2}));
  EXPECT_EQ(unit_in_si("W")->exponents, (std::array<std::int8_t, 8>{1, 2, -3}));
  EXPECT_FALSE(unit_in_si("furlong"));
}

}  // namespace
}  // namespace indurop::fmi
