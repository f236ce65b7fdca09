// SPDX-License-Identifier: Apache-2.0
// String functions, with positions and lengths inside, at and beyond the ends of the text.

#include <gtest/gtest.h>
#include <indurop/plc/select.h>
#include <indurop/plc/text.h>
#include <indurop/plc/wide.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

namespace indurop::iec {
namespace {

const String<10> kText("ABCDEFG");
constexpr std::int64_t kFar = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kBack = std::numeric_limits<std::int64_t>::min();

TEST(PlcText, Length_is_that_of_the_text_not_of_its_room) {
  EXPECT_EQ(len(kText), 7);
  EXPECT_EQ(len(String<5>("")), 0);
  EXPECT_EQ(len(String<5>("12345678")), 5);
  EXPECT_EQ(len(String<40000>(std::string(40000, 'x'))), 32767);
}

TEST(PlcText, Left_and_right_parts) {
  struct Row {
    std::int64_t length;
    const char* left;
    const char* right;
  };
  for (const auto& [length, left_part, right_part] :
       {Row{0, "", ""}, Row{3, "ABC", "EFG"}, Row{7, "ABCDEFG", "ABCDEFG"}, Row{8, "ABCDEFG", "ABCDEFG"},
        Row{-1, "", ""}, Row{kFar, "ABCDEFG", "ABCDEFG"}, Row{kBack, "", ""}}) {
    EXPECT_EQ(left(kText, length), left_part) << length;
    EXPECT_EQ(right(kText, length), right_part) << length;
  }
}

TEST(PlcText, Middle_and_deleted_parts) {
  struct Row {
    std::int64_t length, first;
    const char* inside;
    const char* rest;
  };
  for (const auto& [length, first, inside, rest] :
       {Row{2, 3, "CD", "ABEFG"}, Row{1, 1, "A", "BCDEFG"}, Row{1, 7, "G", "ABCDEF"}, Row{5, 6, "FG", "ABCDE"},
        Row{2, 8, "", "ABCDEFG"}, Row{0, 3, "", "ABCDEFG"}, Row{-2, 3, "", "ABCDEFG"}, Row{2, 0, "A", "BCDEFG"},
        Row{2, -5, "", "ABCDEFG"}, Row{kFar, 1, "ABCDEFG", ""}, Row{kFar, kFar, "", "ABCDEFG"},
        Row{kFar, kBack, "ABCDEFG", ""}}) {
    if (first != kBack) {
      EXPECT_EQ(mid(kText, length, first), inside) << length << " from " << first;
      EXPECT_EQ(erase(kText, length, first), rest) << length << " from " << first;
    }
  }
  EXPECT_EQ(mid(kText, std::uint64_t{2}, std::int8_t{3}), "CD");
}

TEST(PlcText, Parts_are_the_characters_at_their_positions) {
  const std::string all = "ABCDEF";
  for (int size = 0; size <= 6; ++size) {
    const String<6> text(all.substr(0, static_cast<std::size_t>(size)));
    for (int length = -2; length <= 8; ++length) {
      for (int first = -3; first <= 9; ++first) {
        std::string inside;
        std::string rest;
        for (int position = 1; position <= size; ++position) {
          const bool is_inside = position >= first && position < first + length;
          std::string& part = is_inside ? inside : rest;
          part += all[static_cast<std::size_t>(position - 1)];
        }
        ASSERT_EQ(mid(text, length, first).view(), inside) << length << " from " << first << " of " << size;
        ASSERT_EQ(erase(text, length, first).view(), rest) << length << " from " << first << " of " << size;
      }
    }
  }
}

TEST(PlcText, Texts_are_joined_without_loss) {
  const String<3> abc("abc");
  const auto joined = concat(abc, String<2>("de"), abc);
  EXPECT_EQ(joined, "abcdeabc");
  EXPECT_EQ(joined.capacity(), 8U);
  EXPECT_EQ(concat(String<3>(""), abc), "abc");
  EXPECT_EQ(String<4>(joined), "abcd");
}

TEST(PlcText, Joined_texts_are_texts_for_every_function) {
  const String<3> abc("abc");
  const auto joined = concat(abc, String<4>("de"));
  EXPECT_EQ(len(joined), 5);
  EXPECT_EQ(find(joined, String<2>("cd")), 3);
  EXPECT_EQ(left(joined, 4), "abcd");
  EXPECT_EQ(right(joined, 2), "de");
  EXPECT_EQ(mid(joined, 2, 3), "cd");
  EXPECT_EQ(erase(joined, 2, 3), "abe");
  EXPECT_EQ(concat(joined, joined), "abcdeabcde");
  EXPECT_EQ(insert(joined, joined, 1), "aabcdebcde");
  EXPECT_EQ(replace(joined, abc, 5, 1), "abc");
  EXPECT_EQ(concat(String<0>(""), String<0>("")), "");
  EXPECT_TRUE(lt(joined, String<5>("abcdf")) && eq(joined, joined));
  EXPECT_EQ(sel(true, abc, joined), "abcde");
  EXPECT_EQ(max(joined, abc), "abcde");
  EXPECT_EQ(to<std::int32_t>(concat(String<1>("4"), String<1>("2"))), 42);
  EXPECT_EQ(to<double>(concat(to_string(4), String<2>(".5"))), 4.5);
  EXPECT_EQ(to<char8_t>(joined), u8'a');
  EXPECT_EQ(to_string(joined), "abcde");
  EXPECT_EQ(to_wstring(joined).view(), u"abcde");
  EXPECT_EQ(to_string(concat(WString<2>(u"ab"), WString<1>(u"c"))).view(), "abc");
  EXPECT_EQ(to<char16_t>(concat(WString<2>(u"ab"), WString<1>(u"c"))), u'a');
  EXPECT_EQ(to<std::int32_t>(concat(WString<1>(u"4"), WString<1>(u"2"))), 42);
}

// The bytes after a text are compared and recorded with it.
TEST(PlcText, What_lies_after_an_assigned_text_is_zero) {
  String<10> text("0123456789");
  text = String<10>(concat(String<3>("abc"), String<20>("")));
  for (std::size_t i = 3; i < sizeof text.data; ++i) {
    EXPECT_EQ(text.data[i], '\0') << i;
  }
}

TEST(PlcText, Insertion_after_a_position) {
  const String<2> xy("xy");
  EXPECT_EQ(insert(kText, xy, 0), "xyABCDEFG");
  EXPECT_EQ(insert(kText, xy, 3), "ABCxyDEFG");
  EXPECT_EQ(insert(kText, xy, 7), "ABCDEFGxy");
  EXPECT_EQ(insert(kText, xy, 20), "ABCDEFGxy");
  EXPECT_EQ(insert(kText, xy, -1), "xyABCDEFG");
  EXPECT_EQ(insert(kText, xy, kFar), "ABCDEFGxy");
}

TEST(PlcText, Replacement_of_a_part) {
  const String<3> xyz("xyz");
  EXPECT_EQ(replace(kText, xyz, 2, 3), "ABxyzEFG");
  EXPECT_EQ(replace(kText, xyz, 0, 3), "ABxyzCDEFG");
  EXPECT_EQ(replace(kText, xyz, 10, 6), "ABCDExyz");
  EXPECT_EQ(replace(kText, xyz, 2, 100), "ABCDEFGxyz");
  EXPECT_EQ(replace(kText, xyz, 2, 0), "xyzBCDEFG");
  EXPECT_EQ(replace(kText, String<1>(""), 2, 3), "ABEFG");
}

// As generated code puts a joined text into a variable: the same as joined first and cut then, for each length.
TEST(PlcText, Texts_joined_for_a_variable_are_cut_to_it) {
  const String<6> abc("abcdef");
  const String<4> xy("xyz");
  const auto check = [&]<std::size_t N>(indurop::string<N> expected, indurop::string<N> found) {
    EXPECT_EQ(found, expected);
    for (std::size_t i = expected.size(); i < N; ++i) {
      EXPECT_EQ(found.data[i], '\0') << i << " of " << N;
    }
  };
  for (std::int16_t first = -1; first <= 8; ++first) {
    check(String<20>(insert(abc, xy, first)), insert_as<String<20>>(abc, xy, first));
    check(String<8>(insert(abc, xy, first)), insert_as<String<8>>(abc, xy, first));
    check(String<2>(insert(abc, xy, first)), insert_as<String<2>>(abc, xy, first));
    for (std::int16_t length = -1; length <= 8; ++length) {
      check(String<20>(replace(abc, xy, length, first)), replace_as<String<20>>(abc, xy, length, first));
      check(String<4>(replace(abc, xy, length, first)), replace_as<String<4>>(abc, xy, length, first));
    }
  }
  check(String<10>("xyzabcdefx"), concat_as<String<10>>(xy, abc, xy));
  check(String<0>(""), concat_as<String<0>>(xy, abc));
  EXPECT_EQ((concat_as<WString<3>>(WString<2>(u"ab"), WString<5>(u"cde")).view()), u"abc");
  EXPECT_EQ((insert_as<WString<3>>(WString<2>(u"ab"), WString<5>(u"c"), 1).view()), u"acb");
}

TEST(PlcText, The_first_occurrence_is_found) {
  const String<20> text("banana");
  EXPECT_EQ(find(text, String<3>("an")), 2);
  EXPECT_EQ(find(text, String<3>("b")), 1);
  EXPECT_EQ(find(text, String<3>("x")), 0);
  EXPECT_EQ(find(text, String<3>("")), 0);
  EXPECT_EQ(find(String<2>("a"), text), 0);
}

}  // namespace
}  // namespace indurop::iec
