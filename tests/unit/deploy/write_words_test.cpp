// SPDX-License-Identifier: Apache-2.0
// Requests to hold values as text: written and read back, from earlier agents and tools, and invalid ones.

#include "deploy/transaction/write_words.h"

#include <gtest/gtest.h>

namespace indurop::deploy {
namespace {

TEST(WriteWords, Come_back_as_they_were) {
  const WriteOrder order{5'000'000'000,   true, false, true, "anna \"the\" first", "valve {stuck}\nsince noon",
                         {"a=1", "b=x y"}};
  const auto sut = parse_write_order(text_of(order));
  ASSERT_TRUE(sut.has_value());
  EXPECT_EQ(sut->for_ns, order.for_ns);
  EXPECT_EQ(sut->lease, true);
  EXPECT_EQ(sut->renew, false);
  EXPECT_EQ(sut->end, true);
  EXPECT_EQ(sut->who, order.who);
  EXPECT_EQ(sut->reason, order.reason);
  EXPECT_EQ(sut->lines, order.lines);
}

TEST(WriteWords, Earlier_tools_send_less) {
  const auto sut = parse_write_order("30\na=1\nb={x: 2}");
  ASSERT_TRUE(sut.has_value());
  EXPECT_EQ(sut->for_ns, 30);
  EXPECT_EQ(sut->lines, (std::vector<std::string>{"a=1", "b={x: 2}"}));
  EXPECT_FALSE(sut->lease);
}

TEST(WriteWords, Nonsense_is_none) {
  for (const char* text : {"", "x\na=1", "-1\na=1", "a=1"}) {
    EXPECT_FALSE(parse_write_order(text).has_value()) << text;
  }
}

TEST(WriteWords, Modules_and_nodes_get_user_and_reason) {
  WriteOrder order;
  order.who = "anna";
  order.reason = "shift: \"ends\"";
  for (const std::vector<std::string>& lines : {std::vector<std::string>{}, {"gripper"}, {"7 axes"}}) {
    order.lines = lines;
    const WriteOrder sut = parse_module_target(module_target(order, "0.2.0"));
    EXPECT_EQ(sut.lines, lines);
    EXPECT_EQ(sut.who, order.who);
    EXPECT_EQ(sut.reason, order.reason);
  }
}

TEST(WriteWords, An_earlier_agent_gets_the_module_only_and_earlier_tools_send_no_more) {
  WriteOrder order;
  order.who = "anna";
  EXPECT_EQ(module_target(order, "0.1.0"), "");
  order.lines = {"gripper"};
  EXPECT_EQ(module_target(order, "0.1.0"), "gripper");
  for (const char* module : {"gripper", "7", "7 axes", "-"}) {
    const WriteOrder sut = parse_module_target(module);
    EXPECT_EQ(sut.lines, std::vector<std::string>{module});
    EXPECT_EQ(sut.who, "");
  }
  EXPECT_TRUE(parse_module_target("").lines.empty());
}

}  // namespace
}  // namespace indurop::deploy
