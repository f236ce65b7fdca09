// SPDX-License-Identifier: Apache-2.0
// Comparison, selection, checked indices and subranges.

#include <gtest/gtest.h>
#include <indurop/plc/select.h>

#include <cmath>
#include <string>

namespace indurop::iec {
namespace {

constexpr Place kSelectPlace{"prog.st:12:5", "MAIN"};

template <class Call>
std::string fault_of_select(Call call) {
  try {
    call();
  } catch (const Fault& fault) {
    return fault.what();
  }
  return "no fault";
}

TEST(PlcCompare, Neighbours_are_compared_with_each_other) {
  EXPECT_TRUE(gt(3, 2, 1));
  EXPECT_FALSE(gt(3, 1, 2));
  EXPECT_TRUE(ge(3, 3, 2));
  EXPECT_TRUE(eq(2, 2, 2));
  EXPECT_FALSE(eq(2, 2, 3));
  EXPECT_TRUE(le(1, 1, 2));
  EXPECT_TRUE(lt(1, 2, 3));
  EXPECT_FALSE(lt(1, 2, 2));
  EXPECT_TRUE(ne(1, 2));
}

TEST(PlcCompare, Texts_compare_by_characters_whatever_their_room) {
  const String<3> abc("abc");
  const String<80> also_abc("abc");
  const String<10> b("b");
  EXPECT_TRUE(eq(abc, also_abc));
  EXPECT_TRUE(lt(abc, b));
  EXPECT_TRUE(gt(b, abc));
  EXPECT_TRUE(lt(String<5>("ab"), abc));
  EXPECT_TRUE(lt(String<5>("z"), String<5>("\xE4")));  // characters are bytes without a sign
}

TEST(PlcCompare, Times_and_bools_have_an_order) {
  EXPECT_TRUE(lt(Time{-1}, Time{0}, Time{1}));
  EXPECT_TRUE(gt(DateTime{2}, DateTime{1}));
  EXPECT_TRUE(gt(true, false));
}

TEST(PlcCompare, Nothing_is_equal_to_a_nan) {
  const double nan = std::nan("");
  EXPECT_FALSE(eq(nan, nan));
  EXPECT_FALSE(lt(nan, 1.0));
  EXPECT_TRUE(ne(nan, nan));
}

TEST(PlcSelect, Sel_takes_the_second_input_if_the_gate_is_true) {
  EXPECT_EQ(sel(false, 1, 2), 1);
  EXPECT_EQ(sel(true, 1, 2), 2);
  EXPECT_EQ(sel(true, String<2>("ab"), String<5>("hello")), "hello");
  EXPECT_EQ(sel(false, String<2>("ab"), String<5>("hello")), "ab");
}

TEST(PlcSelect, Max_and_min_of_many) {
  EXPECT_EQ(max(1, 7, 3), 7);
  EXPECT_EQ(min(4, -2, 3), -2);
  EXPECT_EQ(max(std::uint8_t{200}, std::uint8_t{100}), 200);
  EXPECT_EQ(max(Time{1}, Time{5}, Time{3}), Time{5});
  EXPECT_EQ(min(String<3>("abd"), String<8>("abcdefgh")), "abcdefgh");
  EXPECT_EQ(max(1.0, std::nan("")), 1.0);
  EXPECT_TRUE(std::isnan(max(std::nan(""), 1.0)));
}

TEST(PlcSelect, Limit_keeps_a_value_between_two_others) {
  EXPECT_EQ(limit(0, -1, 10), 0);
  EXPECT_EQ(limit(0, 5, 10), 5);
  EXPECT_EQ(limit(0, 11, 10), 10);
  EXPECT_EQ(limit(10, 5, 0), 0);  // crossed limits: the upper one counts
  EXPECT_TRUE(std::isnan(limit(0.0, std::nan(""), 1.0)));
}

TEST(PlcSelect, Mux_takes_the_input_of_a_number) {
  EXPECT_EQ(mux(kSelectPlace, std::int16_t{0}, 10, 20, 30), 10);
  EXPECT_EQ(mux(kSelectPlace, std::uint64_t{2}, 10, 20, 30), 30);
  EXPECT_EQ(mux(kSelectPlace, 1, String<1>("a"), String<4>("text")), "text");
}

TEST(PlcSelect, Mux_beyond_its_inputs_is_a_fault) {
  EXPECT_EQ(fault_of_select([] { mux(kSelectPlace, 3, 10, 20, 30); }),
            "prog.st:12:5: selector K of MUX 3 is outside of 0..2 in MAIN");
  EXPECT_EQ(fault_of_select([] { mux(kSelectPlace, std::int8_t{-1}, 10, 20); }),
            "prog.st:12:5: selector K of MUX -1 is outside of 0..1 in MAIN");
}

TEST(PlcIndex, Counts_from_the_lower_bound) {
  EXPECT_EQ(index(kSelectPlace, std::int16_t{1}, 1, 10), 0U);
  EXPECT_EQ(index(kSelectPlace, std::int16_t{10}, 1, 10), 9U);
  EXPECT_EQ(index(kSelectPlace, std::int8_t{-5}, -5, 5), 0U);
  EXPECT_EQ(index(kSelectPlace, std::uint8_t{5}, -5, 5), 10U);
}

TEST(PlcIndex, Outside_is_a_fault_that_names_the_bounds) {
  EXPECT_EQ(fault_of_select([] { index(kSelectPlace, std::int16_t{11}, 1, 10); }),
            "prog.st:12:5: index 11 is outside of 1..10 in MAIN");
  EXPECT_EQ(fault_of_select([] { index(kSelectPlace, std::int16_t{0}, 1, 10); }),
            "prog.st:12:5: index 0 is outside of 1..10 in MAIN");
  EXPECT_EQ(fault_of_select([] { index(kSelectPlace, ~std::uint64_t{0}, -1, 10); }),
            "prog.st:12:5: index 9223372036854775807 is outside of -1..10 in MAIN");
}

TEST(PlcIndex, Subranges_are_checked_alike) {
  EXPECT_EQ(in_range(kSelectPlace, std::int16_t{-3}, -3, 3), -3);
  EXPECT_EQ(fault_of_select([] { in_range(kSelectPlace, std::int16_t{4}, -3, 3); }),
            "prog.st:12:5: value 4 is outside of -3..3 in MAIN");
}

}  // namespace
}  // namespace indurop::iec
