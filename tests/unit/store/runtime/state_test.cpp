// SPDX-License-Identifier: Apache-2.0
// INDUROP_STATE: what a module says of the variables that it keeps.

#include <gtest/gtest.h>
#include <indurop/indurop.h>

#include <string>

namespace {

struct Filter {
  double taps[3];
  int next;
};
template <class A, class B>
struct Pair {
  static inline long both = 0;
};

std::uint32_t counter = 7;
Filter filter{};
int row[4]{};

}  // namespace

INDUROP_STATE(counter, filter, Pair<int, long>::both, row, row[2])

namespace {

std::string text(const char* begin, std::uint32_t length) {
  return {begin, length};
}

TEST(StateDescriptor, Names_each_variable_with_type_size_and_place) {
  indurop::StateDescriptor sut;
  indurop_module_state(&sut);
  EXPECT_EQ(sut.size, sizeof sut);
  EXPECT_EQ(sut.abi, indurop::abi::kVersion);
  EXPECT_EQ(sut.item_size, sizeof(indurop::StateItem));
  ASSERT_EQ(sut.item_count, 5U);
  const indurop::StateItem* item = sut.items;
  EXPECT_EQ(text(item[0].name, item[0].name_length), "counter");
  EXPECT_EQ(text(item[0].type, item[0].type_length), "unsigned int");
  EXPECT_EQ(item[0].address, &counter);
  EXPECT_EQ(text(item[1].name, item[1].name_length), "filter");
  EXPECT_NE(text(item[1].type, item[1].type_length).find("Filter"), std::string::npos);
  EXPECT_EQ(item[1].size, sizeof filter);
  EXPECT_EQ(text(item[2].name, item[2].name_length), "Pair<int, long>::both");
  EXPECT_EQ(text(item[3].name, item[3].name_length), "row");
  EXPECT_EQ(item[3].size, sizeof row);
  EXPECT_EQ(text(item[4].name, item[4].name_length), "row[2]");
  EXPECT_EQ(item[4].address, row + 2);
}

TEST(StateDescriptor, Of_an_older_node_is_not_written_beyond_its_size) {
  indurop::StateDescriptor old;
  old.size = offsetof(indurop::StateDescriptor, most);
  old.missing = "untouched";
  indurop_module_state(&old);
  EXPECT_EQ(old.item_count, 5U);
  EXPECT_STREQ(old.missing, "untouched");
}

}  // namespace
