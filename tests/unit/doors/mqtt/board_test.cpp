// SPDX-License-Identifier: Apache-2.0
// Which values are published: compared with what changed in the frames.

#include "doors/mqtt/model/board.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "described_board.h"

namespace indurop::mqtt {
namespace {

std::vector<std::size_t> variables_of(const std::vector<Change>& changes) {
  std::vector<std::size_t> all;
  for (const Change& one : changes) {
    all.push_back(one.variable);
  }
  return all;
}

TEST(MqttBoard, Has_the_variables_that_the_server_describes) {
  const Board sut = make_board();
  ASSERT_EQ(sut.variables().size(), 5U);
  std::vector<std::string> names;
  for (const Leaf& leaf : sut.variables()[3].leaves) {
    names.push_back(leaf.name);
  }
  EXPECT_THAT(names,
              testing::ElementsAre("knu::joints[0].x", "knu::joints[0].on", "knu::joints[1].x", "knu::joints[1].on"));
  EXPECT_EQ(sut.variables()[3].leaves[2].offset, 8U);
  EXPECT_EQ(sut.variables()[3].leaves[2].unit, "deg");
  EXPECT_EQ(sut.variables()[1].type.enumerators[1].name, "AUTO");
}

TEST(MqttBoard, Publishes_what_has_changed_and_nothing_else) {
  Board sut = make_board();
  FrameBytes bytes;
  EXPECT_THAT(variables_of(sut.update(bytes.frame())), testing::ElementsAre(0, 1, 2, 3, 4)) << "the first frame";
  EXPECT_THAT(sut.update(bytes.frame()), testing::IsEmpty());
  bytes.put(60 + 8, 1.5F).put(80, std::int64_t{-3});
  const auto changes = sut.update(bytes.frame());
  ASSERT_THAT(variables_of(changes), testing::ElementsAre(3, 4));
  EXPECT_THAT(changes[0].leaves, testing::ElementsAre(2)) << "joints[1].x";
  EXPECT_EQ(schema::value_to_json(sut.variables()[3].type, sut.value(3)),
            R"([{"x":0,"on":false},{"x":1.5,"on":false}])");
  bytes.put(88, std::uint8_t{5});  // stale and forced
  ASSERT_THAT(variables_of(sut.update(bytes.frame())), testing::ElementsAre(0));
  EXPECT_EQ(sut.quality(0), Quality::Stale);
  EXPECT_TRUE(sut.is_forced(0));
}

TEST(MqttBoard, All_values_change_when_the_node_ends_or_comes_back) {
  Board sut = make_board();
  (void)sut.update(FrameBytes().frame());
  EXPECT_EQ(sut.update(FrameBytes().alive(false).frame()).size(), 5U);
  EXPECT_EQ(word_of(sut.quality(0)), std::string("stopped"));
  EXPECT_THAT(sut.update(FrameBytes().alive(false).frame()), testing::IsEmpty());
  EXPECT_EQ(sut.update(FrameBytes().frame()).size(), 5U);
  EXPECT_EQ(sut.quality(0), Quality::Good);
}

TEST(MqttBoard, A_deadband_is_about_the_value_that_was_published) {
  Board sut = make_board("cell", {{"knu::g*", 0.5}});
  FrameBytes bytes;
  (void)sut.update(bytes.gain(1).frame());
  for (const double value : {1.3, 1.5, 0.6}) {  // each small step counts from 1
    EXPECT_THAT(sut.update(bytes.gain(value).frame()), testing::IsEmpty()) << value;
  }
  EXPECT_EQ(sut.update(bytes.gain(1.6).frame()).size(), 1U);
  EXPECT_THAT(sut.update(bytes.gain(1.2).frame()), testing::IsEmpty());
  EXPECT_EQ(sut.update(bytes.gain(std::numeric_limits<double>::quiet_NaN()).frame()).size(), 1U);
  EXPECT_EQ(sut.update(bytes.gain(1.2).frame()).size(), 1U) << "after no number";
}

TEST(MqttBoard, Frames_of_others_change_nothing) {
  Board sut = make_board();
  EXPECT_THAT(sut.update(FrameBytes(8).frame()), testing::IsEmpty());
  EXPECT_FALSE(sut.has_values());
  EXPECT_FALSE(read_frame(std::string(39, '\1')));
  EXPECT_FALSE(read_frame("\2\1" + std::string(91, '\0')));
  EXPECT_TRUE(sut.update(FrameBytes().frame()).size() == 5);
}

TEST(MqttBoard, Refuses_descriptions_that_do_not_fit) {
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{R"("offset":80)", R"("offset":81)"},
                                                        {R"("kind":"i64")", R"("kind":"i63")"},
                                                        {R"("kind":"i64","size":8)", R"("kind":"i64","size":4)"},
                                                        {R"("dims":[2])", R"("dims":[4294967295,4294967295])"},
                                                        {R"("offset":4,"type")", R"("offset":8,"type")"},
                                                        {R"("record_size":93)", R"("record_size":92)"},
                                                        {R"("quality_offset":88)", R"("quality_offset":3)"}}) {
    std::string text = described().dump();
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    EXPECT_FALSE(Board::from(*base::Json::parse(text.replace(at, from.size(), to)), {}).ok()) << to;
  }
}

TEST(MqttBoard, A_variable_of_very_many_numbers_has_no_leaves) {
  const std::string text = R"({"board":"b","stream":1,"record_size":16441,"quality_offset":16440,"variables":[
    {"name":"map","offset":40,"unit":"","form":{"kind":"f64","size":8,"dims":[41,50]}}]})";
  EXPECT_THAT(Board::from(*base::Json::parse(text), {})->variables()[0].leaves, testing::IsEmpty());
}

}  // namespace
}  // namespace indurop::mqtt
