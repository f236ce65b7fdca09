// SPDX-License-Identifier: Apache-2.0
// Names as people type them.

#include <gmock/gmock.h>

#include "core/schema/place_index.h"
#include "tests/unit/core/schema/types.h"

namespace indurop::schema {
namespace {

using testing::HasSubstr;

class Place_of_a_name : public testing::Test {
 protected:
  Place_of_a_name() {
    const Type pose = structure("pose_t", {{"at", number(Base::Double, {3})}, {"label", text(8)}});
    schema_.variables = {
        variable("knu::Robot::tick", number(Base::UInt32)),
        variable("knu::Robot::joints", joints_type()),
        variable("plant::grid", number(Base::Int16, {2, 3})),
        variable("plant::speed", number(Base::Float)),
        variable("robot::speed", number(Base::Double)),
        variable("speedy", number(Base::Double)),
        variable("tool",
                 structure("tool_t", {{"n", number(Base::Int8)}, {"poses", structure("pose_t", {{"p", pose}}, {4})}})),
        variable("tool2::x", number(Base::Double)),
        variable("x", number(Base::Int32)),
    };
    schema_.variables[1].unit = "mm";
    schema_.variables[1].range = Range{-1, 1};
    schema_.variables[1].type.fields[1].unit = "rad";
    schema_.variables[1].type.fields[1].range = Range{-180, 180};
  }

  Place found(std::string_view text) {
    auto sut = find_place(schema_, text);
    EXPECT_TRUE(sut.ok()) << text << ": " << sut.error().message;
    const auto same = PlaceIndex(schema_).find(text, NearestName::Skip);
    EXPECT_TRUE(same.ok() && same->variable == sut->variable && same->offset == sut->offset) << text;
    return sut.ok() ? sut.value() : Place{};
  }
  Errc failed(std::string_view text) {
    const auto sut = find_place(schema_, text);
    const auto same = PlaceIndex(schema_).find(text, NearestName::Search);
    const auto shorter = PlaceIndex(schema_).find(text, NearestName::Skip);
    EXPECT_FALSE(sut.ok() || same.ok() || shorter.ok()) << text;
    if (sut.ok() || same.ok() || shorter.ok()) {
      return Errc::Ok;
    }
    message_ = sut.error().message;
    EXPECT_NE(message_, "");
    EXPECT_EQ(same.error().message, message_);
    EXPECT_EQ(shorter.error().code, sut.error().code);
    EXPECT_NE(shorter.error().message, "");
    return sut.error().code;
  }

  Schema schema_;
  std::string message_;
};

TEST_F(Place_of_a_name, Whole_variable_by_full_and_short_names) {
  for (const char* text : {"knu::Robot::joints", "knu.Robot.joints", "Robot::joints", "Robot.joints", "joints",
                           "  joints\n", "::knu::Robot::joints", "knu::Robot.joints"}) {
    const Place sut = found(text);
    EXPECT_EQ(sut.variable, &schema_.variables[1]) << text;
    EXPECT_EQ(sut.offset, 0U);
    EXPECT_EQ(sut.type.size(), 240U);
    EXPECT_EQ(sut.unit, "mm");
  }
}

TEST_F(Place_of_a_name, Field_of_an_element) {
  const Place sut = found("joints[1].y");
  EXPECT_EQ(sut.offset, 32U);
  EXPECT_EQ(sut.type.base, Base::Double);
  EXPECT_TRUE(sut.type.dims.empty());
  EXPECT_EQ(sut.unit, "rad");
  EXPECT_EQ(sut.range->max, 180);
  EXPECT_EQ(found("knu.Robot.joints[9].z").offset, 9 * 24 + 16U);
  EXPECT_EQ(found("joints[0].x").unit, "mm");
}

TEST_F(Place_of_a_name, Indices_leave_the_inner_dimensions) {
  EXPECT_EQ(found("grid[1]").type.dims, std::vector<std::uint32_t>{3});
  EXPECT_EQ(found("grid[1]").offset, 6U);
  EXPECT_EQ(found("grid[1][2]").offset, 10U);
  EXPECT_EQ(found("grid[1][2]").type.size(), 2U);
}

TEST_F(Place_of_a_name, Nested_structs_and_characters_of_text) {
  const Place sut = found("tool.poses[2].p.at[1]");
  EXPECT_EQ(sut.offset, 8U + 2 * 32 + 8);
  EXPECT_EQ(found("tool.poses[0].p.label").type.base, Base::Text);
  const Place letter = found("tool.poses[0].p.label[3]");
  EXPECT_EQ(letter.type.base, Base::Char);
  EXPECT_EQ(letter.type.size(), 1U);
  EXPECT_EQ(letter.offset, 8U + 24 + 3);
  EXPECT_EQ(failed("tool.poses[0].p.label[8]"), Errc::OutOfRange);
  EXPECT_EQ(failed("tool.poses[0].p.label[3][0]"), Errc::InvalidArgument);
}

TEST_F(Place_of_a_name, Full_name_wins_over_the_end_of_another) {
  EXPECT_EQ(found("x").variable->name, "x");
  EXPECT_EQ(found("tool2.x").variable->name, "tool2::x");
}

TEST_F(Place_of_a_name, Ambiguous_short_names_list_the_choices) {
  EXPECT_EQ(failed("speed"), Errc::NotFound);
  EXPECT_EQ(message_, "'speed' may be 'plant::speed', 'robot::speed'; write the namespace too");
  EXPECT_EQ(found("plant.speed").type.base, Base::Float);
}

TEST_F(Place_of_a_name, Unknown_names_get_the_nearest) {
  EXPECT_EQ(failed("joint[1].y"), Errc::NotFound);
  EXPECT_EQ(message_, "no variable 'joint'; did you mean 'knu::Robot::joints'?");
  EXPECT_EQ(failed("knu::Robt::joints"), Errc::NotFound);
  EXPECT_THAT(message_, HasSubstr("'knu::Robot::joints'"));
  EXPECT_EQ(failed("other::joints"), Errc::NotFound);
  EXPECT_THAT(message_, HasSubstr("'knu::Robot::joints'"));
  EXPECT_EQ(failed("::joints"), Errc::NotFound);
  EXPECT_EQ(failed("oint"), Errc::NotFound);
  EXPECT_EQ(message_, "no variable 'oint'; did you mean 'knu::Robot::joints'?");
  EXPECT_EQ(failed("temperature"), Errc::NotFound);
  EXPECT_EQ(message_, "no variable 'temperature'; 'indurop vars' lists them");
  EXPECT_EQ(failed("joints[1].yy"), Errc::NotFound);
  EXPECT_EQ(message_, "knu::Robot::joints[1] has no field 'yy'; did you mean 'y'?");
  EXPECT_EQ(failed("joints[1].roll"), Errc::NotFound);
  EXPECT_EQ(message_, "knu::Robot::joints[1] has no field 'roll'; it has x, y, z");
}

TEST_F(Place_of_a_name, Wrong_indices_and_forms_say_what_to_do) {
  EXPECT_EQ(failed("joints[10].x"), Errc::OutOfRange);
  EXPECT_EQ(message_, "index 10 is outside knu::Robot::joints, which has 10 elements: 0 to 9");
  EXPECT_EQ(failed("joints[99999999999999999999].x"), Errc::OutOfRange);
  EXPECT_EQ(message_, "index 99999999999999999999 is outside knu::Robot::joints, which has 10 elements: 0 to 9");
  EXPECT_EQ(failed("tick[99999999999999999999]"), Errc::InvalidArgument);
  EXPECT_EQ(message_, "knu::Robot::tick is a uint32_t, not an array; leave out the [99999999999999999999]");
  EXPECT_EQ(failed("tick[0]"), Errc::InvalidArgument);
  EXPECT_EQ(message_, "knu::Robot::tick is a uint32_t, not an array; leave out the [0]");
  EXPECT_EQ(failed("grid[0][0][0]"), Errc::InvalidArgument);
  EXPECT_EQ(failed("joints.y"), Errc::InvalidArgument);
  EXPECT_EQ(message_, "knu::Robot::joints is an array of 10; name one element: knu::Robot::joints[0].y");
  EXPECT_EQ(failed("tick.x"), Errc::NotFound);
  EXPECT_EQ(failed("tool::n"), Errc::InvalidArgument);
  for (const char* text :
       {"", " ", ".", "::", "joints.", "joints[", "joints[]", "joints[a]", "joints[-1]", "joints[1", "joints]",
        "joints[1]y", "a b", "joints[1]..y", "joints[1].[2]", "[1]", "joints:x", "jo\xC3\xBCnts", "joints[0x1]"}) {
    EXPECT_EQ(failed(text), Errc::InvalidArgument) << text;
  }
}

TEST_F(Place_of_a_name, Empty_schema_has_nothing) {
  EXPECT_FALSE(find_place({}, "joints").ok());
}

TEST_F(Place_of_a_name, And_the_name_of_a_place) {
  for (const char* name : {"knu::Robot::tick", "knu::Robot::joints[9].y", "plant::grid[1][2]", "tool.n",
                           "tool.poses[3].p.at[2]", "tool.poses[1].p.label"}) {
    const auto place = find_place(schema_, std::string("::") + name);
    ASSERT_TRUE(place.ok()) << name;
    const Part part = part_at(*place->variable, place->offset);
    EXPECT_EQ(part.name, name);
    EXPECT_EQ(canonical(part.type), canonical(place->type));
  }
}

}  // namespace
}  // namespace indurop::schema
