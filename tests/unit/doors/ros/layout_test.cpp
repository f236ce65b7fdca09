// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/model/layout.h"

#include <gmock/gmock.h>

#include <array>
#include <limits>

namespace indurop::ros {
namespace {

constexpr const char* kText =
    "struct(40,8){a@0:u8,inner@8:struct(8,4){x@0:f32,mode@4:enum{OFF=0,ON=3}}[2],name@24:text(5),y@32:f64}[3][2]";

TEST(RosLayout, Is_read_with_its_fields_and_dimensions) {
  const auto layout = read_layout(kText);
  ASSERT_TRUE(layout);
  EXPECT_EQ(layout->base, Base::Struct);
  EXPECT_THAT(layout->dims, testing::ElementsAre(3, 2));
  EXPECT_EQ(layout->size(), 240U);
  ASSERT_EQ(layout->fields.size(), 4U);
  EXPECT_EQ(layout->fields[1].type.count(), 2U);
  EXPECT_EQ(layout->fields[1].type.fields[1].type.base, Base::Enum);
  EXPECT_EQ(layout->fields[2].type.element, 5U);
}

TEST(RosLayout, Parts_are_found_at_their_bytes) {
  const auto layout = read_layout(kText);
  ASSERT_TRUE(layout);
  const auto at = [&layout](const char* part) { return find_spot(*layout, part).value().offset; };
  EXPECT_EQ(at("[0][0].a"), 0U);
  EXPECT_EQ(at("[1][0].y"), 80U + 32U);
  EXPECT_EQ(at("[2][1].inner[1].mode"), 200U + 8 + 8 + 4);
  for (const char* const wrong : {"", "[0].a", "[3][0].a", "[0][2].a", "[0][0].b", "[0][0].inner.x", "[0][0].name",
                                  "[0][0].inner[2].x", "[0][0]", "[x][0].a", "[0", "[0][0].a[0]", "..", "[0][0].a.b"}) {
    EXPECT_FALSE(find_spot(*layout, wrong)) << wrong;
  }
}

TEST(RosLayout, What_is_none_is_not_read) {
  for (const char* const text :
       {"", "f65", "f64[", "f64[0]", "f64]", "text(", "text()", "enum{A=1", "struct(8,8){x@0:f64",
        "struct(8,8){x@4:f64}", "struct(8){x@0:f64}", "struct(8,8){x:f64}", "f64 "}) {
    EXPECT_FALSE(read_layout(text)) << text;
  }
}

TEST(RosLayout, Numbers_that_a_type_cannot_have_become_the_nearest) {
  std::array<std::uint8_t, 8> bytes{};
  const auto kept = [&bytes](Base base, double number) {
    put_number(bytes, base, number);
    return number_in(bytes, base);
  };
  EXPECT_EQ(kept(Base::U8, -1), 0);
  EXPECT_EQ(kept(Base::U8, 300), 255);
  EXPECT_EQ(kept(Base::I16, -40000), -32768);
  EXPECT_EQ(kept(Base::I32, 2.6), 3);
  EXPECT_EQ(kept(Base::U32, 4294967295.0), 4294967295.0);
  EXPECT_EQ(kept(Base::I64, std::numeric_limits<double>::quiet_NaN()), -9223372036854775808.0);
  EXPECT_EQ(kept(Base::F64, 0.1), 0.1);
}

}  // namespace
}  // namespace indurop::ros
