// SPDX-License-Identifier: Apache-2.0
// Plain topics: what is published, and which commands are passed on in whose name.

#include "doors/mqtt/plain/plain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "described_board.h"
#include "doors/mqtt/plain/topics.h"
#include "listed_outlet.h"

namespace indurop::mqtt {
namespace {

struct PlainUnderTest {
  ListedOutlet outlet;
  std::vector<Command> commands;
  Plain plain{{"plant", Retain::Yes, {{"anna", "token-of-anna"}}}, outlet, [this](Command command) {
                commands.push_back(std::move(command));
              }};
};

TEST(PlainTopics, Are_names_with_levels) {
  EXPECT_EQ(levels_of("knu::Robot::joints[1].y"), "knu/Robot/joints[1].y");
  EXPECT_EQ(variable_of("knu/Robot/joints[1].y"), "knu::Robot::joints[1].y");
  const auto topic = read_set_topic("plant", "plant/cell/set/anna/knu/gain");
  ASSERT_TRUE(topic);
  EXPECT_EQ(topic->board + "," + topic->user + "," + topic->variable, "cell,anna,knu::gain");
  EXPECT_EQ(read_set_topic("plant", "plant/cell/set/anna")->variable, "");
  for (const char* other : {"plant/cell/values/knu/gain", "plant/cell/set", "plant/cell/set/", "plants/cell/set/anna",
                            "plant//set/anna", "plant", "x"}) {
    EXPECT_FALSE(read_set_topic("plant", other)) << other;
  }
  EXPECT_TRUE(is_level("press_1"));
  for (const char* wrong : {"", "a/b", "+", "a#"}) {
    EXPECT_FALSE(is_level(wrong)) << wrong;
  }
}

TEST(Plain, Publishes_changed_values_with_unit_quality_and_time) {
  PlainUnderTest sut;
  Board board = make_board();
  (void)board.update(FrameBytes().frame());
  sut.plain.publish(board, board.update(FrameBytes().gain(2.5).put(88, std::uint8_t{4}).frame()));
  const auto sent = sut.outlet.take();
  ASSERT_EQ(sent.size(), 1U);
  EXPECT_EQ(sent[0].topic, "plant/cell/values/knu/gain");
  EXPECT_TRUE(sent[0].retain);
  EXPECT_EQ(
      sent[0].payload,
      R"({"value":2.5,"unit":"mm","quality":"good","forced":true,"time_ns":5000000,"wall_ns":1700000000123000000})");
}

TEST(Plain, Publishes_everything_for_a_new_connection) {
  PlainUnderTest sut;
  Board board = make_board();
  (void)board.update(FrameBytes().frame());
  sut.plain.connected({&board});
  EXPECT_THAT(sut.outlet.filters, testing::ElementsAre("plant/+/set/#"));
  std::vector<std::string> topics;
  for (const auto& one : sut.outlet.take()) {
    topics.push_back(one.topic);
  }
  EXPECT_THAT(topics, testing::ElementsAre("plant/online", "plant/cell/alive", "plant/cell/values/knu/gain",
                                           "plant/cell/values/knu/mode", "plant/cell/values/station/name",
                                           "plant/cell/values/knu/joints", "plant/cell/values/knu/count"));
}

TEST(Plain, Passes_commands_on_in_the_name_of_their_user) {
  PlainUnderTest sut;
  sut.plain.receive("plant/cell/set/anna", R"({"id":17,"values":{"gain":3,"mode":"AUTO"},"reason":"shift"})", false);
  sut.plain.receive("plant/cell/set/anna/knu/gain", "4.5", false);
  sut.plain.receive("plant/cell/set/anna/station/name", "press one", false);
  ASSERT_EQ(sut.commands.size(), 3U);
  EXPECT_EQ(sut.commands[0].token, "token-of-anna");
  EXPECT_EQ(sut.commands[0].values.dump(), R"({"gain":3,"mode":"AUTO"})");
  EXPECT_EQ(sut.commands[0].reason, "shift");
  EXPECT_EQ(sut.commands[1].values.dump(), R"({"knu::gain":4.5})");
  EXPECT_EQ(sut.commands[2].values.dump(), R"({"station::name":"press one"})");
  sut.commands[0].then({true, base::Json{{"board", "cell"}}});
  const auto sent = sut.outlet.take();
  ASSERT_EQ(sent.size(), 1U);
  EXPECT_EQ(sent[0].topic, "plant/cell/answer/anna");
  EXPECT_EQ(sent[0].payload, R"({"id":17,"done":true,"board":"cell"})");
  EXPECT_FALSE(sent[0].retain);
}

TEST(Plain, Refuses_commands_that_are_retained_malformed_or_of_strangers) {
  PlainUnderTest sut;
  sut.plain.receive("plant/cell/set/anna/knu/gain", "4.5", true);
  sut.plain.receive("plant/cell/set/anna", "4.5", false);
  sut.plain.receive("plant/cell/set/anna", "{", false);
  sut.plain.receive("plant/cell/set/bert/knu/gain", "4.5", false);
  EXPECT_TRUE(sut.commands.empty());
  const auto sent = sut.outlet.take();
  ASSERT_EQ(sent.size(), 4U);
  for (const auto& one : sent) {
    EXPECT_THAT(one.payload, testing::HasSubstr(R"("done":false,"error":")"));
  }
  EXPECT_EQ(sent[3].topic, "plant/cell/answer/bert");
}

TEST(Plain, Removes_the_values_of_variables_that_are_gone) {
  PlainUnderTest sut;
  sut.plain.forget(make_board());
  for (const auto& one : sut.outlet.take()) {
    EXPECT_TRUE(one.retain && one.payload.empty()) << one.topic;
  }
}

}  // namespace
}  // namespace indurop::mqtt
